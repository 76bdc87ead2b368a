#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/cushion/cushion.h"
#include "hovercraft_sim/scenario/actuator_keys.h"
#include "hovercraft_sim/scenario/air_keys.h"
#include "hovercraft_sim/scenario/craft_keys.h"
#include "hovercraft_sim/scenario/cushion_keys.h"
#include "hovercraft_sim/scenario/ground_keys.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/scenario/sensor_keys.h"
#include "hovercraft_sim/scenario/world_keys.h"

#include "../support/files.h"

/// Each table of keys is held against itself: what is written is read back, what is left out is the
/// default, and what is no key is refused. And against the documentation.

namespace hovercraft {
namespace {

using testing::messageOf;

/// Gives each member a value that its key allows and that is not the default.
struct Changer {
  template <class Table>
  void operator()(const MapKey<Table>& key, GustAxis& axis) const {
    (*key.table)(axis, *this);
  }
  void operator()(const NumberKey& key, double& value) const { value = otherThan(value, key.rule); }
  void operator()(const LengthKey& /*key*/, double& value) const { value += 0.25; }
  void operator()(const DurationKey& /*key*/, std::int64_t& ns) const { ns += 250000000; }
  template <class Number>
  void operator()(const WholeNumberKey& /*key*/, Number& value) const {
    value += 2;
  }
  void operator()(const ThreeNumbersKey& key, Vector3& value) const {
    for (int i = 0; i < 3; ++i) value[i] = otherThan(value[i], key.rule);
  }
  void operator()(const OriginKey& /*key*/, Vector3& value) const { value = {-2.0, 3.0, 0.0}; }
  void operator()(const FlagKey& /*key*/, bool& value) const { value = !value; }
  void operator()(const TextKey& /*key*/, std::string& value) const { value += "another"; }
  template <class Choice>
  void operator()(const ChoiceKey& key, Choice& value) const {
    const std::size_t next = (static_cast<std::size_t>(value) + 1) % key.names->size();
    value = static_cast<Choice>(next);
  }
  void operator()(const RotationKey& /*key*/, double& value) const { value = -value; }

  static double otherThan(double value, const NumberRule& rule) {
    for (const double other : {value + 0.25, value - 0.25, 0.25}) {
      if (other != value && rule.holds(other)) return other;
    }
    throw std::logic_error(std::string("no other number: ") + rule.text);
  }
};

/// What each key says of an object, by name.
template <class Table, class Object>
std::map<std::string, std::string> textsOf(const Table& table, const Object& object) {
  std::map<std::string, std::string> texts;
  table(object, [&](const auto& key, const auto& value) { texts[key.name] = key.text(value); });
  return texts;
}

ConfigNode treeOfMap(const std::string& pairs) {
  return treeOf("{" + pairs + "}", "table");
}

ConfigNode mapWithout(const ConfigNode& tree, const std::string& key) {
  ConfigNode::Map members;
  for (const auto& member : tree.members()) {
    if (member.first != key) members.push_back(member);
  }
  return ConfigNode::ofMap(std::move(members));
}

/// Calls check(title, table, object) with every table and an object that has its defaults.
template <class Check>
void forEachTable(const Check& check) {
  check("noise", kNoiseKeys, NoiseParameters());
  for (std::size_t kind = 0; traitsOf(static_cast<SensorKind>(kind)).name != nullptr; ++kind) {
    SensorParameters sensor;
    sensor.model = unreadModel(static_cast<SensorKind>(kind));
    check(traitsOf(sensor.kind()).name, kSensorKeys, sensor);
  }
  check("pads", kPadKeys, PadParameters());
  check("plane", kPlaneKeys, PlaneScenario());
  check("height map", kHeightMapKeys, HeightMapScenario());
  check("gusts", kGustKeys, GustParameters());
  check("gusts along an axis", kGustAxisKeys, GustAxis());
  check("engine", kEngineKeys, unreadEngine());
  check("rotor", kRotorKeys, RotorParameters());
  for (std::size_t kind = 0; traitsOf(static_cast<ActuatorKind>(kind)).name != nullptr; ++kind) {
    const ActuatorScenario actuator = unreadActuator(static_cast<ActuatorKind>(kind));
    check(traitsOf(actuator.kind).name, kPlaceKeys, actuator);
    check(traitsOf(actuator.kind).name, kActuatorKindKeys, actuator);
    check(traitsOf(actuator.kind).name, kLevelKeys, actuator);
  }
  check("cushion", kCushionKeys, CushionParameters());
  check("fan of a cushion", kCushionFanKeys, CushionFan());
  check("speed of a fan", kFanSpeedKeys, FanSpeedPoint());
  check("cell", kCellKeys, CushionCell());
  check("hem", kHemKeys, HemPoint());
  check("rectangle", kRectangleKeys, CellRectangle());
  check("skirt", kSkirtKeys, Skirt());
  check("world", kWorldKeys, WorldScenario());
  check("material", kMaterialKeys, ContactMaterial());
  check("run", kRunKeys, Scenario());
  check("seed", kSeedKeys, Scenario());
  check("inertia", kInertiaKeys, Matrix3(Matrix3::Zero()));
  check("initial", kInitialKeys, VehicleScenario());
  check("drag", kDragKeys, Drag());
  check("polar", kPolarKeys, DragPolar());
}

template <class Table, class Object>
Object withOtherValues(const Table& table, Object object) {
  table(object, Changer());
  return object;
}

TEST(KeyTables, WhatIsWrittenIsReadBackEachKeyInItsPlace) {
  forEachTable([](const char* title, const auto& table, const auto& defaults) {
    SCOPED_TRACE(title);
    auto object = withOtherValues(table, defaults);
    const std::string text = keysText(table, object);
    const ConfigNode tree = treeOfMap(text);
    auto back = defaults;
    ASSERT_NO_THROW(parseKeys(ConfigReader(tree, "table"), table, back)) << text;
    EXPECT_EQ(keysText(table, back), text);
    const std::vector<std::string> names = keyNames(table, object);
    std::size_t place = 0;
    for (const auto& [name, value] : tree.members()) {
      while (place < names.size() && names[place] != name) ++place;
      EXPECT_LT(place, names.size()) << name;
    }
  });
}

TEST(KeyTables, AKeyThatIsLeftOutHasTheDefaultOrIsMissing) {
  forEachTable([](const char* title, const auto& table, const auto& defaults) {
    SCOPED_TRACE(title);
    auto object = withOtherValues(table, defaults);
    const ConfigNode tree = treeOfMap(keysText(table, object));
    const auto unread = textsOf(table, defaults);
    const auto written = textsOf(table, object);
    table(object, [&, &all = table](const auto& key, const auto& /*value*/) {
      if (tree.find(key.name) == nullptr) return;
      EXPECT_NE(written.at(key.name), unread.at(key.name)) << key.name;
      auto back = defaults;
      const std::string error = messageOf(
          [&] { parseKeys(ConfigReader(mapWithout(tree, key.name), "table"), all, back); });
      EXPECT_EQ(error, key.is_required ? fmt::format("table: {}: the key is missing", key.name)
                                       : "nothing was thrown");
      EXPECT_EQ(textsOf(all, back).at(key.name), unread.at(key.name)) << key.name;
    });
  });
}

TEST(KeyTables, ThereAreNoOtherKeysAndNoneTwice) {
  forEachTable([](const char* title, const auto& table, const auto& defaults) {
    SCOPED_TRACE(title);
    auto object = defaults;
    std::vector<std::string> names = keyNames(table, object);
    const ConfigReader reader(treeOfMap("no_such_key: 1"), "table");
    EXPECT_EQ(
        messageOf([&] { parseKeys(reader, table, object); }),
        fmt::format("table: no_such_key = 1: unknown key; known here: {}", fmt::join(names, ", ")));
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  });
}

TEST(KeyTables, ANumberIsHeldAgainstItsRule) {
  forEachTable([](const char* title, const auto& table, const auto& defaults) {
    SCOPED_TRACE(title);
    auto object = withOtherValues(table, defaults);
    const auto texts = textsOf(table, object);
    table(object, [&, &all = table](const auto& key, const auto& /*value*/) {
      if constexpr (std::is_convertible_v<decltype(key), const NumberKey&>) {
        for (const double bad : {-1e3, 1e31}) {
          if (key.rule.holds(bad) || !key.is_written) continue;
          ConfigNode::Map members =
              mapWithout(treeOfMap(keysText(all, object)), key.name).members();
          members.emplace_back(key.name, ConfigNode::ofText(yamlNumber(bad), true));
          auto back = defaults;
          EXPECT_EQ(messageOf([&] {
                      parseKeys(ConfigReader(ConfigNode::ofMap(members), "table"), all, back);
                    }),
                    fmt::format("table: {} = {}: {}", key.name, yamlNumber(bad), key.rule.text));
        }
      }
    });
  });
}

bool isPartOfAWord(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '/' ||
         (static_cast<unsigned char>(c) & 0x80U) != 0;
}

/// Whether a text stands there by itself, not as a part of a longer word or unit.
bool stands(const std::string& word, const std::string& text) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !isPartOfAWord(text[at - 1]);
    if (begins && (end == text.size() || !isPartOfAWord(text[end]))) return true;
  }
  return false;
}

/// The paragraphs of the documentation of keys, and the rows of its tables, each on one line.
std::vector<std::string> paragraphs() {
  std::vector<std::string> result = {""};
  for (const char* page : {"doc/reference.md", "doc/sensors.md", "doc/craft.md"}) {
    const std::string text = testing::contentOf(page);
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      const std::string line = text.substr(begin, end - begin);
      if (line.empty() || line.front() == '|') result.emplace_back();
      result.back() += line + " ";
      begin = end + 1;
    }
    result.emplace_back();
  }
  return result;
}

TEST(KeyTables, EachKeyIsInTheDocumentationWithItsUnit) {
  const std::vector<std::string> places = paragraphs();
  forEachTable([&](const char* title, const auto& table, const auto& object) {
    table(object, [&](const auto& key, const auto& /*value*/) {
      const bool is_there = std::any_of(places.begin(), places.end(), [&key](const auto& place) {
        return stands(key.name, place) && (*key.unit == '\0' || stands(key.unit, place));
      });
      EXPECT_TRUE(is_there) << title << ": " << key.name << ", " << key.unit;
    });
  });
}

}  // namespace
}  // namespace hovercraft
