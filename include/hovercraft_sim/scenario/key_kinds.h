#pragma once

#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/step_time.h"
#include "hovercraft_sim/scenario/yaml_text.h"

/// The kinds of keys of a scenario by their values (key_table.h): how a value that is there is
/// read, and written.

namespace hovercraft {

/// What is said of a key besides its kind of value.
struct Key {
  Key(const char* its_name, const char* its_unit) : name(its_name), unit(its_unit) {}

  const char* name;
  const char* unit;         // empty: none
  bool is_required = true;  // else the member stays as it is where there is no such key
  bool is_read = true;      // else it has no meaning here
  bool is_written = true;   // by keysText()
};

/// The key may be missing.
template <class KeyOfKind>
KeyOfKind optional(KeyOfKind key) {
  key.is_required = false;
  return key;
}
/// It is written where the condition holds only.
template <class KeyOfKind>
KeyOfKind writtenIf(bool condition, KeyOfKind key) {
  key.is_written = condition;
  return key;
}
/// It has a meaning, is read and written, where the condition holds only.
template <class KeyOfKind>
KeyOfKind onlyIf(bool condition, KeyOfKind key) {
  key.is_read = condition;
  key.is_written = condition;
  return key;
}

/// A number that obeys the rule.
struct NumberKey : Key {
  NumberKey(const char* its_name, const char* its_unit, const NumberRule& its_rule = kAnyNumber)
      : Key(its_name, its_unit), rule(its_rule) {}
  void read(const ConfigReader& reader, const char* full_name, double& value) const {
    value = reader.number(full_name, rule);
  }
  static std::string text(double value) { return yamlNumber(value); }

  NumberRule rule;
};

/// Greater than 0 and at most kFarthest.
struct LengthKey : Key {
  using Key::Key;
  static void read(const ConfigReader& reader, const char* full_name, double& value) {
    value = reader.length(full_name);
  }
  static std::string text(double value) { return yamlNumber(value); }
};

/// Seconds that are kept as whole nanoseconds.
struct DurationKey : NumberKey {
  DurationKey(const char* its_name, const NumberRule& its_rule)
      : NumberKey(its_name, "s", its_rule) {}
  void read(const ConfigReader& reader, const char* full_name, std::int64_t& value) const {
    value = nanosecondsOf(reader, full_name, reader.number(full_name, rule));
  }
  static std::string text(std::int64_t value) { return yamlNumber(toSeconds(value)); }
};

/// An integer; with a rule it is held against it as a number first.
struct WholeNumberKey : Key {
  WholeNumberKey(const char* its_name, const char* its_unit) : Key(its_name, its_unit) {}
  WholeNumberKey(const char* its_name, const char* its_unit, const NumberRule& its_rule)
      : Key(its_name, its_unit), rule(its_rule), has_rule(true) {}
  template <class Number>
  void read(const ConfigReader& reader, const char* full_name, Number& value) const {
    if (has_rule) reader.number(full_name, rule);
    value = static_cast<Number>(reader.wholeNumberOr(0, full_name));
  }
  static std::string text(std::int64_t value) { return fmt::format("{}", value); }

  NumberRule rule = kAnyNumber;
  bool has_rule = false;
};

/// Three numbers, each of which obeys the rule.
struct ThreeNumbersKey : Key {
  ThreeNumbersKey(const char* its_name, const char* its_unit,
                  const NumberRule& its_rule = kAnyNumber)
      : Key(its_name, its_unit), rule(its_rule) {}
  static std::string text(const Vector3& value) { return yamlVector(value); }

  NumberRule rule;
};
/// As a list of them.
struct VectorKey : ThreeNumbersKey {
  using ThreeNumbersKey::ThreeNumbersKey;
  void read(const ConfigReader& reader, const char* full_name, Vector3& value) const {
    value = reader.vector(full_name, rule);
  }
};
/// The same, or one number that stands for all of them.
struct NumberOrVectorKey : ThreeNumbersKey {
  using ThreeNumbersKey::ThreeNumbersKey;
  void read(const ConfigReader& reader, const char* full_name, Vector3& value) const {
    value = reader.numberOrVector(full_name, rule);
  }
};

/// true or false.
struct FlagKey : Key {
  explicit FlagKey(const char* its_name) : Key(its_name, "") {}
  static void read(const ConfigReader& reader, const char* full_name, bool& value) {
    value = reader.flagOr(value, full_name);
  }
  static std::string text(bool value) { return value ? "true" : "false"; }
};

/// A text as it is.
struct TextKey : Key {
  explicit TextKey(const char* its_name) : Key(its_name, "") {}
  static void read(const ConfigReader& reader, const char* full_name, std::string& value) {
    value = reader.text(full_name);
  }
  static std::string text(const std::string& value) { return yamlText(value); }
};

/// One of some names, which outlive the key; what is kept is an enumerator or an index.
struct ChoiceKey : Key {
  ChoiceKey(const char* its_name, const std::vector<std::string>& its_names)
      : Key(its_name, ""), names(&its_names) {}
  template <class Choice>
  void read(const ConfigReader& reader, const char* full_name, Choice& value) const {
    (void)reader.text(full_name);  // must be there
    value = static_cast<Choice>(reader.choiceOr(0, full_name, *names));
  }
  template <class Choice>
  std::string text(Choice value) const {
    return yamlText((*names)[static_cast<std::size_t>(value)]);
  }

  const std::vector<std::string>* names;
};

}  // namespace hovercraft
