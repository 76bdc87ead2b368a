#include "hovercraft_sim/sim/config_reader.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <locale>
#include <map>
#include <sstream>
#include <stdexcept>

#include "hovercraft_sim/sim/number_text.h"

namespace hovercraft {
namespace {

constexpr std::size_t kLongestShown = 80;  // bytes of a value in a message

std::string textOf(const YAML::Node& node) {
  if (!node.IsDefined() || node.IsNull()) return "";
  if (node.IsScalar()) return node.Scalar();
  // The style of the node decides: yaml-cpp 0.6 does not heed that of the emitter.
  YAML::Node in_braces = YAML::Clone(node);
  in_braces.SetStyle(YAML::EmitterStyle::Flow);
  YAML::Emitter emitter;
  emitter << in_braces;
  return emitter.c_str();
}

/// What a message shows of a value: not a whole tree.
std::string shown(const YAML::Node& node) {
  std::string text = textOf(node);
  if (text.size() <= kLongestShown) return text;
  const auto continues_character = [](char c) {  // of UTF-8
    return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U;
  };
  std::size_t end = kLongestShown;
  while (end > 0 && continues_character(text[end])) --end;
  return text.substr(0, end) + "...";
}

std::string onOneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return text;
}

}  // namespace

const NumberRule kAnyNumber = {[](double) { return true; }, "must be a finite number"};
const NumberRule kPositive = {[](double x) { return x > 0.0; }, "must be greater than 0"};
const NumberRule kNotNegative = {[](double x) { return x >= 0.0; }, "must be 0 or greater"};
const NumberRule kNotPositive = {[](double x) { return x <= 0.0; }, "must be 0 or less"};

ConfigReader::ConfigReader(const YAML::Node& node, std::string source, std::string path)
    : node_(node), source_(std::move(source)), path_(std::move(path)) {
  if (!node_.IsDefined() || node_.IsNull()) fail("", "must be a map of keys; it is empty");
  if (!node_.IsMap()) fail("", "must be a map of keys");
}

std::string ConfigReader::where(const std::string& key) const {
  const std::string path = pathOf(key);
  std::string value;
  if (key.empty()) {
    value = shown(node_);
  } else if (node_.IsMap()) {
    const YAML::Node& tree = node_;
    value = shown(tree[key]);
  }
  return onOneLine(fmt::format("{}: {}{}{}", source_, path.empty() ? "the scenario" : path,
                               value.empty() ? "" : " = ", value));
}

void ConfigReader::fail(const std::string& key, const std::string& rule) const {
  throw std::invalid_argument(fmt::format("{}: {}", where(key), rule));
}

std::string ConfigReader::pathOf(const std::string& key) const {
  if (path_.empty() || key.empty()) return path_ + key;
  return path_ + "." + key;
}

void ConfigReader::allowOnly(std::initializer_list<const char*> keys) const {
  std::map<std::string, int> seen;
  for (const auto& entry : node_) {
    const std::string key = textOf(entry.first);
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      fail(key, fmt::format("unknown key; known here: {}", fmt::join(keys, ", ")));
    }
    if (++seen[key] == 2) fail(key, "the key stands twice");
  }
}

bool ConfigReader::has(const char* key) const {
  const YAML::Node& tree = node_;
  return tree[key].IsDefined();
}

bool ConfigReader::isMap(const char* key) const {
  return required(key).IsMap();
}

YAML::Node ConfigReader::required(const std::string& key) const {
  const YAML::Node& tree = node_;
  const YAML::Node found = tree[key];
  if (!found.IsDefined()) fail(key, "the key is missing");
  if (found.IsNull()) fail(key, "the value is missing");
  return found;
}

ConfigReader ConfigReader::map(const std::string& key) const {
  return {required(key), source_, pathOf(key)};
}

std::vector<std::pair<std::string, ConfigReader>> ConfigReader::maps() const {
  std::map<std::string, ConfigReader> sorted;
  for (const auto& entry : node_) {
    const std::string key = textOf(entry.first);
    if (!sorted.emplace(key, ConfigReader(entry.second, source_, pathOf(key))).second) {
      fail(key, "the name stands twice");
    }
  }
  return {sorted.begin(), sorted.end()};
}

std::vector<ConfigReader> ConfigReader::list(const char* key) const {
  const YAML::Node sequence = required(key);
  if (!sequence.IsSequence() || sequence.size() == 0) fail(key, "must be a list, not empty");
  std::vector<ConfigReader> readers;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    readers.emplace_back(sequence[i], source_, fmt::format("{}[{}]", pathOf(key), i));
  }
  return readers;
}

double ConfigReader::numberAt(const YAML::Node& node, const std::string& key,
                              const NumberRule& rule) const {
  const ParsedNumber parsed = node.IsScalar() ? parseNumber(node.Scalar()) : ParsedNumber{};
  if (parsed.syntax == NumberSyntax::kNoNumber) fail(key, "must be a number");
  if (parsed.syntax == NumberSyntax::kNotFinite) fail(key, "must be finite");
  if (!rule.holds(parsed.value)) fail(key, rule.text);
  return parsed.value;
}

double ConfigReader::number(const char* key, const NumberRule& rule) const {
  return numberAt(required(key), key, rule);
}

double ConfigReader::numberOr(double fallback, const char* key, const NumberRule& rule) const {
  return has(key) ? number(key, rule) : fallback;
}

std::int64_t ConfigReader::wholeNumberOr(std::int64_t fallback, const char* key) const {
  if (!has(key)) return fallback;
  const YAML::Node node = required(key);
  std::istringstream stream(node.IsScalar() ? node.Scalar() : "");
  stream.imbue(std::locale::classic());
  std::int64_t value = 0;
  stream >> value;
  if (stream.fail() || !stream.eof()) fail(key, "must be a whole number of at most 64 bits");
  return value;
}

Vector3 ConfigReader::vector(const char* key, const NumberRule& rule) const {
  const YAML::Node sequence = required(key);
  if (!sequence.IsSequence() || sequence.size() != 3) fail(key, "must be a list of three numbers");
  Vector3 result;
  for (int i = 0; i < 3; ++i) {
    result[i] = numberAt(sequence[static_cast<std::size_t>(i)], key, rule);
  }
  return result;
}

Vector3 ConfigReader::vectorOr(const Vector3& fallback, const char* key,
                               const NumberRule& rule) const {
  return has(key) ? vector(key, rule) : fallback;
}

Vector3 ConfigReader::numberOrVector(const char* key, const NumberRule& rule) const {
  const YAML::Node node = required(key);
  if (node.IsScalar()) return Vector3::Constant(numberAt(node, key, rule));
  if (!node.IsSequence() || node.size() != 3) {
    fail(key, "must be a number or a list of three numbers");
  }
  return vector(key, rule);
}

bool ConfigReader::flagOr(bool fallback, const char* key) const {
  if (!has(key)) return fallback;
  const YAML::Node node = required(key);
  const std::string value = node.IsScalar() ? node.Scalar() : "";
  if (value != "true" && value != "false") fail(key, "must be true or false");
  return value == "true";
}

std::string ConfigReader::text(const char* key) const {
  const YAML::Node node = required(key);
  if (!node.IsScalar() || node.Scalar().empty()) fail(key, "must be a text");
  return node.Scalar();
}

std::size_t ConfigReader::choiceOr(std::size_t fallback, const char* key,
                                   const std::vector<std::string>& choices) const {
  if (!has(key)) return fallback;
  const std::string chosen = text(key);
  const auto found = std::find(choices.begin(), choices.end(), chosen);
  if (found == choices.end()) {
    fail(key, fmt::format("must be one of: {}", fmt::join(choices, ", ")));
  }
  return static_cast<std::size_t>(found - choices.begin());
}

}  // namespace hovercraft
