#include "hovercraft_sim/scenario/yaml_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/io/utf8.h"

namespace hovercraft {
namespace {

constexpr std::size_t kLongestRule = 400;  // bytes of a message behind its source: keys may be long

/// One line, whatever keys and values are in the rule.
[[noreturn]] void fail(const std::string& source, const std::string& rule) {
  std::string shown = rule.substr(0, kLongestRule);
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  throw std::invalid_argument(source + ": " + shown + (shown.size() < rule.size() ? "..." : ""));
}

/// What there is of one map or list while it is read.
struct Open {
  bool is_map = false;
  std::optional<YAML::Mark> key_mark;  // it stands where a key belongs
  YAML::anchor_t anchor = 0;
  ConfigNode::List items;
  ConfigNode::Map members;
  std::set<std::string> keys;      // of the members
  std::optional<std::string> key;  // whose value comes next
  bool is_merge = false;           // that key is <<
  bool has_merge = false;
  std::vector<ConfigNode> merged;  // the maps of <<, the first of which wins
};

std::string deepText() {
  return fmt::format("must have at most {} maps and lists within each other", kDeepestYaml);
}

/// Makes the tree from what yaml-cpp reads piece by piece. Its own tree (YAML::Node) would take
/// duplicate keys, know no merge keys, and share nodes that overrides are to change apart.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const std::string& source) : source_(source) {}

  const ConfigNode& tree() const { return tree_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (began_) failAt(mark, "must be one YAML document, and here a second one begins");
    began_ = true;
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    take(mark, anchor, ConfigNode());
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) failAt(mark, "an alias must not lie within what it names");
    take(mark, 0, found->second);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    checkTag(mark, tag == "!" ? "" : tag);  // a value in quotes has this one
    if (hasControlCharacter(value)) failAt(mark, "a value must not hold a control character");
    take(mark, anchor, ConfigNode::ofText(value, tag != "!"));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    open(mark, tag, anchor, false);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    open(mark, tag, anchor, true);
  }
  void OnMapEnd() override { close(); }

 private:
  [[noreturn]] void failAt(const YAML::Mark& mark, const std::string& rule) const {
    fail(source_, fmt::format("line {}: {}", mark.line + 1, rule));
  }

  /// Key path of the value that comes next.
  std::string path() const {
    std::string path;
    for (const Open& level : open_) {
      if (!level.is_map) {
        path += fmt::format("[{}]", level.items.size());
      } else if (level.key) {
        path += (path.empty() ? "" : ".") + *level.key;
      }
    }
    return path;
  }

  void checkTag(const YAML::Mark& mark, const std::string& tag) const {
    if (tag.empty() || tag == "?") return;  // none
    failAt(mark, "a tag (!...) has no meaning here");
  }

  bool awaitsKey() const { return !open_.empty() && open_.back().is_map && !open_.back().key; }

  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, bool is_map) {
    checkTag(mark, tag);
    if (open_.size() == kDeepestYaml) failDeep();
    Open level;
    // Refused when it is whole: what is never closed is no YAML.
    if (awaitsKey()) level.key_mark = mark;
    level.is_map = is_map;
    level.anchor = anchor;
    open_.push_back(std::move(level));
  }

  void close() {
    Open level = std::move(open_.back());
    open_.pop_back();
    if (level.key_mark) failAt(*level.key_mark, "a key must be a text");
    for (const ConfigNode& map : level.merged) {
      count(map.members().size());
      for (const auto& member : map.members()) {
        if (level.keys.insert(member.first).second) level.members.push_back(member);
      }
    }
    // NOLINTNEXTLINE(performance-move-const-arg): both are taken by value.
    place(level.anchor, level.is_map ? ConfigNode::ofMap(std::move(level.members))
                                     : ConfigNode::ofList(std::move(level.items)));
  }

  void take(const YAML::Mark& mark, YAML::anchor_t anchor, const ConfigNode& node) {
    if (!awaitsKey()) {
      place(anchor, node);
      return;
    }
    if (!node.isText()) failAt(mark, "a key must be a text; put it in quotes if it is one");
    if (anchor != 0) anchors_[anchor] = node;
    Open& map = open_.back();
    map.is_merge = node.isPlainText() && node.text() == "<<";
    const bool is_known = map.is_merge ? map.has_merge : !map.keys.insert(node.text()).second;
    map.key = node.text();
    if (is_known) {
      fail(source_, fmt::format("{}: duplicate key, again in line {}", path(), mark.line + 1));
    }
  }

  void place(YAML::anchor_t anchor, const ConfigNode& node) {
    if (node.size() > kMostYamlValues) failLarge();
    if (node.depth() > kDeepestYaml) failDeep();
    if (anchor != 0) anchors_[anchor] = node;
    if (open_.empty()) {
      tree_ = node;
      return;
    }
    Open& level = open_.back();
    if (!level.is_map) {
      level.items.push_back(node);
    } else if (level.is_merge) {
      merge(level, node);
      level.key.reset();
    } else {
      level.members.emplace_back(*level.key, node);
      level.key.reset();
    }
  }

  void merge(Open& level, const ConfigNode& node) {
    level.has_merge = true;
    level.merged = node.isList() ? node.items() : ConfigNode::List{node};
    for (const ConfigNode& map : level.merged) {
      if (!map.isMap()) fail(source_, path() + ": must be a map or a list of maps");
    }
  }

  void count(std::size_t values) {
    merged_ += values;
    if (merged_ > kMostYamlValues) failLarge();
  }

  [[noreturn]] void failLarge() const {
    fail(source_, fmt::format("must hold at most {} values, aliases and merge keys written out",
                              kMostYamlValues));
  }
  [[noreturn]] void failDeep() const { fail(source_, deepText()); }

  const std::string& source_;
  bool began_ = false;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, ConfigNode> anchors_;
  std::size_t merged_ = 0;  // values that merge keys copied
  ConfigNode tree_;
};

/// @param begin of a line. @returns true if a tab is part of its indentation.
bool isIndentedByTab(const std::string& text, std::size_t begin) {
  const std::size_t indented = std::min(text.find_first_not_of(' ', begin), text.size());
  const std::size_t end = std::min(text.find_first_not_of(" \t", indented), text.size());
  const bool is_blank = end == text.size() || text[end] == '\n';
  return indented < end && !is_blank;
}

/// The lines with LF at each end.
std::string linesOf(const std::string& text, const std::string& source) {
  std::string lines;
  lines.reserve(text.size());
  std::size_t number = 1;
  for (const char c : text) {
    if (!lines.empty() && lines.back() == '\r') {
      if (c != '\n') fail(source, fmt::format("line {}: a line must end in LF or CR LF", number));
      lines.pop_back();
    }
    lines.push_back(c);
    if (c == '\n') ++number;
  }
  if (!lines.empty() && lines.back() == '\r') lines.pop_back();
  number = 1;
  for (std::size_t begin = 0; begin < lines.size(); ++number) {
    if (isIndentedByTab(lines, begin)) {
      fail(source, fmt::format("line {}: must be indented by spaces, not by a tab", number));
    }
    begin = std::min(lines.find('\n', begin), lines.size() - 1) + 1;
  }
  return lines;
}

/// yaml-cpp 0.6 looks beyond the last token for what a tag or an anchor belongs to: a text that may
/// end in one gets the mark of a document's end.
std::string guarded(const std::string& lines) {
  std::size_t end = lines.size();
  while (end > 0) {
    const std::size_t break_before = lines.rfind('\n', end - 1);
    const std::size_t begin = break_before == std::string::npos ? 0 : break_before + 1;
    const std::string line = lines.substr(begin, end - begin);
    const std::size_t first = line.find_first_not_of(" \t");
    if (first != std::string::npos && line[first] != '#') {
      return line.find_first_of("!&") == std::string::npos ? lines : lines + "\n...\n";
    }
    end = begin == 0 ? 0 : begin - 1;
  }
  return lines;
}

bool isWordLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// Letters, digits, points and hyphens that are no word which YAML 1.1 takes for true, false or
/// nothing.
bool isPlainName(const std::string& text) {
  static const std::array<const char*, 9> words = {"true", "false", "yes", "no",  "on",
                                                   "off",  "y",     "n",   "null"};
  const auto is_of_name = [](char c) {
    return isWordLetter(c) || isDigit(c) || c == '.' || c == '-';
  };
  if (text.empty() || !isWordLetter(text.front())) return false;
  if (!std::all_of(text.begin(), text.end(), is_of_name)) return false;
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return std::find(words.begin(), words.end(), lower) == words.end();
}

/// In double quotes, with the escapes that YAML needs.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += {'\\', c};
    } else if (c == '\n') {
      result += "\\n";
    } else if (c == '\t') {
      result += "\\t";
    } else if (byte < ' ' || c == '\x7f') {
      result += fmt::format("\\x{:02x}", byte);
    } else {
      result += c;
    }
  }
  return result + "\"";
}

/// yaml-cpp keeps all that begins with a bracket in memory until it knows whether that is a key,
/// and says how deep it is only then. Brackets within quotes count too: no text has so many of them
/// open.
constexpr std::size_t kMostOpenBrackets = 1000;

std::size_t mostOpenBrackets(const std::string& text) {
  std::size_t open = 0;
  std::size_t most = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') most = std::max(most, ++open);
    if ((c == ']' || c == '}') && open > 0) --open;
  }
  return most;
}

}  // namespace

ConfigNode treeOf(const std::string& text, const std::string& source) {
  if (text.size() > kLongestYamlText) {
    fail(source, fmt::format("must be at most {} bytes", kLongestYamlText));
  }
  if (const auto fault = faultOfText(text)) {
    fail(source, fmt::format("line {}: {}", fault->line, fault->rule));
  }
  if (mostOpenBrackets(text) > kMostOpenBrackets) {
    fail(source, deepText());
  }
  std::istringstream stream(guarded(linesOf(withoutByteOrderMark(text), source)));
  TreeBuilder builder(source);
  try {
    YAML::Parser parser(stream);
    // yaml-cpp takes what follows a document for another one.
    if (parser.HandleNextDocument(builder)) parser.HandleNextDocument(builder);
  } catch (const YAML::Exception& error) {
    fail(source, fmt::format("not YAML: {}", error.what()));
  }
  return builder.tree();
}

std::string yamlText(const std::string& text) {
  return isPlainName(text) ? text : quoted(text);
}

std::string yamlNumber(double number) {
  std::string text = numberText(number);
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) {
    text.insert(exponent, ".0");
  }
  return text;
}

std::string yamlVector(const Vector3& v) {
  return fmt::format("[{}, {}, {}]", yamlNumber(v.x()), yamlNumber(v.y()), yamlNumber(v.z()));
}

}  // namespace hovercraft
