#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/scenario/config_node.h"

namespace hovercraft {

/// What a number of a scenario must obey, and the words that say so.
struct NumberRule {
  bool (*holds)(double);
  const char* text;
};
extern HOVERCRAFT_PUBLIC const NumberRule kAnyNumber;
extern HOVERCRAFT_PUBLIC const NumberRule kPositive;
extern HOVERCRAFT_PUBLIC const NumberRule kNotNegative;
extern HOVERCRAFT_PUBLIC const NumberRule kNotPositive;
extern HOVERCRAFT_PUBLIC const NumberRule kCoordinate;  // m: at most kFarthest, of either sign

/// One map of a tree, with the path by which the user knows it. Every reading function throws
/// std::invalid_argument with one line: source, key path, value, rule. Numbers are decimal, as
/// YAML 1.2 writes them, without quotes and leading zeros: what YAML 1.1 would read as another
/// number is refused.
class HOVERCRAFT_PUBLIC ConfigReader {
 public:
  /// @param source name of the file or parameter that the tree came from.
  /// @param path key path of `node` within the source; empty at the top.
  /// @param quotes false: messages show neither values nor unknown keys. For a text that may be any
  /// file, and whose errors may be read far away.
  ConfigReader(ConfigNode node, std::string source, std::string path = "", bool quotes = true);

  /// Throws if there is a key that is not listed.
  void allowOnly(std::initializer_list<const char*> keys) const;
  void allowOnly(const std::vector<std::string>& keys) const;

  bool has(const char* key) const;
  /// How many keys there are.
  std::size_t size() const;
  /// Whether there is a map behind `key`.
  bool isMap(const char* key) const;
  /// The map behind `key`.
  ConfigReader map(const std::string& key) const;
  /// Every (key, map) pair of this map, in the order of the keys.
  std::vector<std::pair<std::string, ConfigReader>> maps() const;
  /// Every map of the list behind `key`; its path says which: key[0], key[1], ...
  std::vector<ConfigReader> list(const char* key) const;

  double number(const char* key, const NumberRule& rule = kAnyNumber) const;
  double numberOr(double fallback, const char* key, const NumberRule& rule = kAnyNumber) const;
  std::int64_t wholeNumberOr(std::int64_t fallback, const char* key) const;
  /// A whole number from `least` to `most`.
  std::int64_t wholeNumber(const char* key, std::int64_t least, std::int64_t most) const;
  /// Three numbers, each of which obeys the rule.
  Vector3 vector(const char* key, const NumberRule& rule = kAnyNumber) const;
  /// Any number of numbers, also none; at most `most`.
  std::vector<double> numbers(const char* key, std::size_t most) const;
  /// A list of pairs of numbers, each of which obeys the rule.
  std::vector<std::array<double, 2>> pairs(const char* key, const NumberRule& rule) const;
  /// A length, m: greater than 0 and at most kFarthest.
  double length(const char* key) const;
  /// Three of them.
  Vector3 lengths(const char* key) const;
  Vector3 vectorOr(const Vector3& fallback, const char* key,
                   const NumberRule& rule = kAnyNumber) const;
  /// Three numbers, or one that stands for all of them.
  Vector3 numberOrVector(const char* key, const NumberRule& rule) const;
  bool flagOr(bool fallback, const char* key) const;
  std::string text(const char* key) const;
  /// The index of the text behind `key` among `choices`.
  std::size_t choiceOr(std::size_t fallback, const char* key,
                       const std::vector<std::string>& choices) const;

  /// "source: path.key = value", the beginning of a message; the value is left out if there is
  /// none, and shortened if it is long.
  std::string where(const std::string& key) const;
  /// Throws std::invalid_argument: "source: path.key = value: rule".
  [[noreturn]] void fail(const std::string& key, const std::string& rule) const;

  const std::string& source() const { return source_; }
  const std::string& path() const { return path_; }

 private:
  const ConfigNode& required(const std::string& key) const;
  std::string pathOf(const std::string& key) const;
  double numberAt(const ConfigNode& node, const std::string& key, const NumberRule& rule) const;

  ConfigNode node_;
  std::string source_;
  std::string path_;
  bool quotes_ = true;
};

}  // namespace hovercraft
