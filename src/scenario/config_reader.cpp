#include "hovercraft_sim/scenario/config_reader.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

constexpr std::size_t kLongestShown = 80;  // bytes of a value in a message

/// What a message shows of a value: not a whole tree.
std::string shown(const ConfigNode& node) {
  std::string text = node.beginning(kLongestShown);
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

/// YAML 1.1 reads 020 as an octal number. @param number a decimal one.
bool isOctal(const std::string& number) {
  const std::size_t first = number.find_first_not_of("+-");
  return first + 1 < number.size() && number[first] == '0' &&
         number.find_first_of(".eE") == std::string::npos;
}

}  // namespace

const NumberRule kAnyNumber = {[](double) { return true; }, "must be a finite number"};
const NumberRule kPositive = {[](double x) { return x > 0.0; }, "must be greater than 0"};
const NumberRule kNotNegative = {[](double x) { return x >= 0.0; }, "must be 0 or greater"};
const NumberRule kNotPositive = {[](double x) { return x <= 0.0; }, "must be 0 or less"};

const NumberRule kCoordinate = {[](double x) { return x >= -kFarthest && x <= kFarthest; },
                                "must be at most 1e30, of either sign"};

ConfigReader::ConfigReader(ConfigNode node, std::string source, std::string path, bool quotes)
    : node_(std::move(node)), source_(std::move(source)), path_(std::move(path)), quotes_(quotes) {
  if (node_.isNull()) fail("", "must be a map of keys; it is empty");
  if (!node_.isMap()) fail("", "must be a map of keys");
}

std::string ConfigReader::where(const std::string& key) const {
  const std::string path = pathOf(key);
  if (!quotes_) return path.empty() ? source_ : source_ + ": " + path;
  const ConfigNode* const found = key.empty() ? &node_ : node_.find(key);
  const std::string value = found == nullptr ? "" : shown(*found);
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
  allowOnly(std::vector<std::string>(keys.begin(), keys.end()));
}

void ConfigReader::allowOnly(const std::vector<std::string>& keys) const {
  for (const auto& [key, value] : node_.members()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    fail(quotes_ ? key : "", fmt::format("unknown key; known here: {}", fmt::join(keys, ", ")));
  }
}

std::size_t ConfigReader::size() const {
  return node_.members().size();
}

bool ConfigReader::has(const char* key) const {
  return node_.find(key) != nullptr;
}

bool ConfigReader::isMap(const char* key) const {
  return required(key).isMap();
}

const ConfigNode& ConfigReader::required(const std::string& key) const {
  const ConfigNode* const found = node_.find(key);
  if (found == nullptr) fail(key, "the key is missing");
  if (found->isNull()) fail(key, "the value is missing");
  return *found;
}

ConfigReader ConfigReader::map(const std::string& key) const {
  return {required(key), source_, pathOf(key), quotes_};
}

std::vector<std::pair<std::string, ConfigReader>> ConfigReader::maps() const {
  std::vector<std::pair<std::string, ConfigReader>> readers;
  for (const auto& [key, value] : node_.members()) {
    readers.emplace_back(key, ConfigReader(value, source_, pathOf(key), quotes_));
  }
  std::sort(readers.begin(), readers.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  return readers;
}

std::vector<ConfigReader> ConfigReader::list(const char* key) const {
  const ConfigNode& list = required(key);
  if (list.items().empty()) fail(key, "must be a list, not empty");
  std::vector<ConfigReader> readers;
  readers.reserve(list.items().size());
  for (std::size_t i = 0; i < list.items().size(); ++i) {
    readers.emplace_back(list.items()[i], source_, fmt::format("{}[{}]", pathOf(key), i), quotes_);
  }
  return readers;
}

double ConfigReader::numberAt(const ConfigNode& node, const std::string& key,
                              const NumberRule& rule) const {
  const ParsedNumber parsed = parseNumber(node.text());
  if (parsed.syntax == NumberSyntax::kNoNumber) {
    const bool has_digit = node.text().find_first_of("0123456789") != std::string::npos;
    fail(key, has_digit ? "must be a number in decimal digits" : "must be a number");
  }
  if (!node.isPlainText()) fail(key, "must be a number, not a text in quotes");
  if (parsed.syntax == NumberSyntax::kNotFinite) fail(key, "must be finite");
  if (isOctal(node.text())) {
    fail(key, "must be a number without leading zeros (YAML 1.1 would read it as octal)");
  }
  if (!rule.holds(parsed.value)) fail(key, rule.text);
  return parsed.value;
}

double ConfigReader::number(const char* key, const NumberRule& rule) const {
  return numberAt(required(key), key, rule);
}

double ConfigReader::numberOr(double fallback, const char* key, const NumberRule& rule) const {
  return has(key) ? number(key, rule) : fallback;
}

std::int64_t ConfigReader::wholeNumber(const char* key, std::int64_t least,
                                       std::int64_t most) const {
  if (!has(key)) fail(key, "the key is missing");
  const std::int64_t value = wholeNumberOr(0, key);
  if (value < least || value > most) fail(key, fmt::format("must be {} to {}", least, most));
  return value;
}

std::int64_t ConfigReader::wholeNumberOr(std::int64_t fallback, const char* key) const {
  if (!has(key)) return fallback;
  const ConfigNode& node = required(key);
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::string digits = node.isPlainText() ? node.text() : "";
  if (!digits.empty() && (digits.front() == '+' || digits.front() == '-')) digits.erase(0, 1);
  errno = 0;
  const std::int64_t value = std::strtoll(node.text().c_str(), nullptr, 10);
  if (digits.empty() || !std::all_of(digits.begin(), digits.end(), is_digit) || errno == ERANGE) {
    fail(key, node.isPlainText() ? "must be a whole number of at most 64 bits"
                                 : "must be a whole number, not a text in quotes");
  }
  if (isOctal(digits)) fail(key, "must be a whole number without leading zeros");
  return value;
}

Vector3 ConfigReader::vector(const char* key, const NumberRule& rule) const {
  const ConfigNode& list = required(key);
  if (list.items().size() != 3) fail(key, "must be a list of three numbers");
  Vector3 result;
  for (int i = 0; i < 3; ++i) {
    result[i] = numberAt(list.items()[static_cast<std::size_t>(i)], key, rule);
  }
  return result;
}

std::vector<double> ConfigReader::numbers(const char* key, std::size_t most) const {
  const ConfigNode& list = required(key);
  if (list.isMap() || list.isText()) fail(key, "must be a list of numbers");
  if (list.items().size() > most) {
    fail(key, fmt::format("must be a list of at most {} numbers", most));
  }
  std::vector<double> result;
  result.reserve(list.items().size());
  for (const ConfigNode& item : list.items()) result.push_back(numberAt(item, key, kAnyNumber));
  return result;
}

std::vector<std::array<double, 2>> ConfigReader::pairs(const char* key,
                                                       const NumberRule& rule) const {
  const ConfigNode& list = required(key);
  if (!list.isList()) fail(key, "must be a list of pairs of numbers: [[0, 1], [2, 3]]");
  std::vector<std::array<double, 2>> result;
  result.reserve(list.items().size());
  for (std::size_t i = 0; i < list.items().size(); ++i) {
    const ConfigNode& item = list.items()[i];
    const std::string element = fmt::format("{}[{}]", key, i);
    if (!item.isList() || item.items().size() != 2) {
      throw std::invalid_argument(
          fmt::format("{}: {}: must be two numbers", source_, pathOf(element)));
    }
    result.push_back(
        {numberAt(item.items()[0], element, rule), numberAt(item.items()[1], element, rule)});
  }
  return result;
}

double ConfigReader::length(const char* key) const {
  number(key, kPositive);
  return number(key, kCoordinate);
}

Vector3 ConfigReader::lengths(const char* key) const {
  vector(key, kPositive);
  return vector(key, kCoordinate);
}

Vector3 ConfigReader::vectorOr(const Vector3& fallback, const char* key,
                               const NumberRule& rule) const {
  return has(key) ? vector(key, rule) : fallback;
}

Vector3 ConfigReader::numberOrVector(const char* key, const NumberRule& rule) const {
  const ConfigNode& node = required(key);
  if (node.isText()) return Vector3::Constant(numberAt(node, key, rule));
  if (node.items().size() != 3) {
    fail(key, "must be a number or a list of three numbers");
  }
  return vector(key, rule);
}

bool ConfigReader::flagOr(bool fallback, const char* key) const {
  if (!has(key)) return fallback;
  const ConfigNode& node = required(key);
  const std::string value = node.isPlainText() ? node.text() : "";
  if (value != "true" && value != "false") fail(key, "must be true or false");
  return value == "true";
}

std::string ConfigReader::text(const char* key) const {
  const ConfigNode& node = required(key);
  if (node.text().empty()) fail(key, "must be a text");
  return node.text();
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
