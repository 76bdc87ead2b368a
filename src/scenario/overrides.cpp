#include "hovercraft_sim/scenario/overrides.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <optional>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

constexpr const char* kWhiteSpace = " \t\r\n";
constexpr std::size_t kLongestOverrideShown = 120;  // bytes of an override in a message
constexpr std::size_t kMostIndexDigits = 9;         // fit every list that can be read

/// One part of a path: a key of a map, or the number of an element of a list.
struct Step {
  std::string key;
  std::optional<std::size_t> index;

  bool operator==(const Step& other) const { return key == other.key && index == other.index; }
};

struct Override {
  std::string name;  // source and text, for messages
  std::vector<Step> path;
  ConfigNode value;

  [[noreturn]] void fail(const std::string& rule) const {
    throw std::invalid_argument(fmt::format("{}: {}", name, rule));
  }
};

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(kWhiteSpace);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(kWhiteSpace) + 1 - begin);
}

/// Goes through a text and knows what of it is in quotes or in brackets.
class Nesting {
 public:
  /// @returns true if the character stands by itself: neither in quotes nor in brackets.
  bool isFree(char c) {
    const char before = std::exchange(before_, std::isspace(asByte(c)) != 0 ? before_ : c);
    const char closed = std::exchange(closed_, '\0');
    if (quote_ != 0) {
      passQuoted(c);
      return false;
    }
    if (c == '\'' && closed == c) {  // twice: a quote within the text
      quote_ = c;
      return false;
    }
    // A quote within a word, as in o'clock, is a letter.
    if ((c == '"' || c == '\'') && std::string("=.;,:[{").find(before) != std::string::npos) {
      quote_ = c;
      return false;
    }
    if (c == '[' || c == '{') ++depth_;
    if ((c == ']' || c == '}') && depth_ > 0) --depth_;
    return depth_ == 0;
  }

 private:
  static unsigned char asByte(char c) { return static_cast<unsigned char>(c); }

  void passQuoted(char c) {
    if (is_escaped_) {
      is_escaped_ = false;
    } else if (c == '\\' && quote_ == '"') {
      is_escaped_ = true;
    } else if (c == quote_) {
      closed_ = std::exchange(quote_, '\0');
    }
  }

  char before_ = ';';  // the last character that is no white space: what comes first begins a text
  char quote_ = 0;
  char closed_ = 0;  // the quote that ended just now
  bool is_escaped_ = false;
  int depth_ = 0;
};

std::vector<std::string> assignmentsOf(const std::string& text) {
  std::vector<std::string> parts(1);
  Nesting nesting;
  for (const char c : text) {
    if (nesting.isFree(c) && c == ';') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  for (std::string& part : parts) part = trimmed(part);
  parts.erase(std::remove(parts.begin(), parts.end(), ""), parts.end());
  return parts;
}

/// The first = outside of quotes and brackets, or npos.
std::size_t equalsOf(const std::string& assignment) {
  Nesting nesting;
  for (std::size_t i = 0; i < assignment.size(); ++i) {
    if (nesting.isFree(assignment[i]) && assignment[i] == '=') return i;
  }
  return std::string::npos;
}

/// Reads KEY.PATH into steps.
class PathReader {
 public:
  PathReader(const std::string& path, const Override& override) : path_(path), error_(override) {}

  std::vector<Step> steps() {
    std::vector<Step> steps = {{key(), {}}};
    while (position_ < path_.size()) {
      const char c = path_[position_++];
      if (c == '.') {
        steps.push_back({key(), {}});
      } else if (c == '[') {
        steps.push_back({"", index()});
      } else {
        fail();
      }
    }
    return steps;
  }

 private:
  [[noreturn]] void fail() const {
    error_.fail("must be KEY.PATH=VALUE, with [N] behind a key for an element of a list");
  }

  std::string key() {
    const char quote = position_ < path_.size() ? path_[position_] : '\0';
    const bool is_quoted = quote == '"' || quote == '\'';
    if (is_quoted) ++position_;
    const std::size_t end =
        is_quoted ? path_.find(quote, position_)
                  : std::min(path_.find_first_of(".[]\"'; \t\r\n", position_), path_.size());
    if (end == std::string::npos || end == position_) fail();
    const std::string key = path_.substr(position_, end - position_);
    position_ = is_quoted ? end + 1 : end;
    return key;
  }

  std::size_t index() {
    const std::size_t end = path_.find(']', position_);
    if (end == std::string::npos) fail();
    const std::string digits = path_.substr(position_, end - position_);
    const bool is_number =
        !digits.empty() && digits.size() <= kMostIndexDigits &&
        std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!is_number) fail();
    position_ = end + 1;
    return std::stoul(digits);
  }

  const std::string& path_;
  const Override& error_;
  std::size_t position_ = 0;
};

/// The override in a message: one line, not a whole tree.
std::string nameOf(const std::string& assignment, const std::string& source) {
  std::string shown = assignment.substr(0, kLongestOverrideShown);
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return source + " " + shown + (shown.size() < assignment.size() ? "..." : "");
}

Override parsedOverride(const std::string& assignment, const std::string& source) {
  Override override;
  override.name = nameOf(assignment, source);
  const std::size_t equals = equalsOf(assignment);
  if (equals == std::string::npos) override.fail("must be KEY.PATH=VALUE");
  const std::string path = trimmed(assignment.substr(0, equals));
  override.path = PathReader(path, override).steps();
  override.value = treeOf(trimmed(assignment.substr(equals + 1)), override.name);
  if (override.value.isNull()) override.fail("must be KEY.PATH=VALUE; the value is missing");
  return override;
}

std::string textOf(const std::vector<Step>& path, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    const Step& step = path[i];
    text += step.index ? fmt::format("[{}]", *step.index) : (i > 0 ? "." : "") + step.key;
  }
  return text.empty() ? "the scenario" : text;
}

std::string keysOf(const ConfigNode& map) {
  std::string keys;
  for (const auto& [key, value] : map.members()) keys += (keys.empty() ? "" : ", ") + key;
  return keys.empty() ? "nothing" : keys;
}

ConfigNode changed(const ConfigNode& node, const Override& override, std::size_t depth) {
  if (depth == override.path.size()) return override.value;
  const Step& step = override.path[depth];
  const auto fail = [&](const std::string& rule) {
    override.fail(fmt::format("{} {}", textOf(override.path, depth), rule));
  };
  if (step.index) {
    if (!node.isList()) fail("is no list");
    ConfigNode::List items = node.items();
    if (*step.index >= items.size()) {
      fail(fmt::format("has no element {}; it has {}", *step.index, items.size()));
    }
    items[*step.index] = changed(items[*step.index], override, depth + 1);
    return ConfigNode::ofList(std::move(items));
  }
  if (!node.isMap()) fail("is no map of keys");
  const bool is_last = depth + 1 == override.path.size();
  if (!is_last && node.find(step.key) == nullptr) {
    fail(fmt::format("has no key {}; there: {}", step.key, keysOf(node)));
  }
  ConfigNode::Map members = node.members();
  auto member = std::find_if(members.begin(), members.end(),
                             [&step](const auto& known) { return known.first == step.key; });
  if (member == members.end()) member = members.insert(member, {step.key, ConfigNode()});
  member->second = changed(member->second, override, depth + 1);
  return ConfigNode::ofMap(std::move(members));
}

/// A later override may go into an earlier one, not undo it.
void checkOrder(const std::vector<Override>& overrides) {
  for (std::size_t later = 1; later < overrides.size(); ++later) {
    const std::vector<Step>& path = overrides[later].path;
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      const std::vector<Step>& other = overrides[earlier].path;
      if (path.size() > other.size() || !std::equal(path.begin(), path.end(), other.begin())) {
        continue;
      }
      overrides[later].fail(path == other ? "is set twice"
                                          : "undoes " + textOf(other, other.size()) +
                                                ", which is set before it");
    }
  }
}

}  // namespace

std::string sourceWith(const std::string& source, const OverrideList& overrides) {
  std::string all;
  for (const std::string& assignments : overrides.assignments) {
    for (const std::string& assignment : assignmentsOf(assignments)) {
      all += (all.empty() ? "" : "; ") + assignment;
    }
  }
  return all.empty() ? source : source + " with " + nameOf(all, overrides.source);
}

ConfigNode withOverrides(const ConfigNode& tree, const OverrideList& overrides) {
  std::vector<Override> parsed;
  for (const std::string& assignments : overrides.assignments) {
    for (const std::string& assignment : assignmentsOf(assignments)) {
      parsed.push_back(parsedOverride(assignment, overrides.source));
    }
  }
  checkOrder(parsed);
  ConfigNode result = tree;
  for (const Override& override : parsed) result = changed(result, override, 0);
  return result;
}

}  // namespace hovercraft
