#pragma once

#include <fmt/format.h>
#include <string>
#include <vector>

#include "scenario_text.h"

/// What YAML may do in a scenario: whole texts that mean validScenario() with another mass, or
/// nothing. The same for a file and for the parameter of a node.

namespace hovercraft::testing {

struct YamlRule {
  const char* name;
  std::string text;
  double mass;              // of the craft; 0: the text is refused
  std::string beginning{};  // of the message behind the source
};

/// validScenario() with another line in the place of that of the mass, and others in front.
inline std::string withMassLine(const std::string& line, const std::string& front = "") {
  return front + with(validScenario(), "    mass: 5.5\n", line);
}

inline std::string withMass(const std::string& number) {
  return withMassLine("    mass: " + number + "\n");
}

/// A map of the craft's centre of mass and moments from which the craft takes what it lacks.
inline std::string withMerge(const std::string& merge) {
  const std::string at_top = "wind: [1, -2, 0.5]\n";
  return with(withMassLine(merge), at_top, "wind: &air [1, -2, 0.5]\n");
}

inline std::string crlf(const std::string& text) {
  std::string lines;
  for (const char c : text) lines += c == '\n' ? "\r\n" : std::string(1, c);
  return lines;
}

inline std::string nested(std::size_t depth) {
  return std::string(depth, '[') + std::string(depth, ']');
}

/// Ten to the ninth values by nine lists of ten aliases each.
inline std::string billionLaughs() {
  std::string text = "a0: &a0 x\n";
  for (int i = 1; i < 10; ++i) {
    text += fmt::format("a{0}: &a{0} [*a{1}", i, i - 1);
    for (int k = 1; k < 10; ++k) text += fmt::format(", *a{}", i - 1);
    text += "]\n";
  }
  return text;
}

inline std::vector<YamlRule> numberRules() {
  std::vector<YamlRule> rules;
  const struct {
    const char* text;
    double value;
  } numbers[] = {{"3000000000", 3e9}, {"+5", 5.0},     {"5.", 5.0},
                 {".5", 0.5},         {"1e3", 1000.0}, {"1E+3", 1e3},
                 {"2.5e-3", 0.0025},  {"0.5", 0.5},    {"0e1", 0.0},
                 {"005.50", 5.5},     {"20", 20.0},    {"9007199254740993", 9007199254740992.0},
                 {"1e22", 1e22}};
  for (const auto& [text, value] : numbers) rules.push_back({text, withMass(text), value, ""});
  rules[8].beginning = "vehicles.alpha.mass = 0e1: must be greater than 0";
  for (const char* text :
       {"020",       "08",        "0x10",       "0o17",       "0b11", "1_000", "1:30",
        "1:30.5",    "deg(90)",   "rad(2*pi)",  "pi",         "1,5",  "5 kg",  "--1",
        "1e",        "'5'",       "\"5\"",      "yes",        "null", "~",     "",
        "!!float 5", "!!int '5'", "!!str 5",    "!foo 5",     "! 5",  ".inf",  "-.Inf",
        ".NaN",      "1e400",     "|\n      5", ">-\n      5"}) {
    rules.push_back({text, withMass(text), 0.0, ""});
  }
  return rules;
}

inline std::vector<YamlRule> mergeRules() {
  return {
      {"MergeKey", withMassLine("    <<: {mass: 2}\n"), 2.0},
      {"ExplicitKeysWin", withMassLine("    <<: {mass: 2}\n    mass: 3\n"), 3.0},
      {"ExplicitKeysWinInFront", withMassLine("    mass: 3\n    <<: {mass: 2}\n"), 3.0},
      {"TheEarlierOfAListWins", withMassLine("    <<: [{mass: 2}, {mass: 4}]\n"), 2.0},
      {"AMergedMapMayMerge", withMassLine("    <<: {<<: {mass: 2}}\n"), 2.0},
      {"AnchorAndAlias", with(withMass("*m"), "seed: 7", "seed: &m 7"), 7.0},
      {"AnAnchorMayBeGivenAgain",
       with(with(withMass("*m"), "seed: 7", "seed: &m 7"), "[0, 0, -9.81]", "[0, &m 0, -9.81]"),
       7.0},
      {"AnAliasAsAKey", with(withMassLine("    *k : 2\n"), "integrator: rk4", "&k mass: 1"), 0.0,
       "mass = 1: unknown key"},
      {"MergeKeyInQuotes", withMassLine("    '<<': {mass: 2}\n"), 0.0, "vehicles.alpha.<<"},
      {"MergeOfANumber", withMassLine("    <<: 5\n"), 0.0,
       "vehicles.alpha.<<: must be a map or a list of maps"},
      {"MergeOfAListOfNumbers", withMassLine("    <<: [5]\n"), 0.0,
       "vehicles.alpha.<<: must be a map or a list of maps"},
      {"MergeTwice", withMassLine("    <<: {mass: 2}\n    <<: {mass: 3}\n"), 0.0,
       "vehicles.alpha.<<: duplicate key"},
      {"MergeOfAnUnknownKey", withMassLine("    <<: {mass: 2, weight: 3}\n"), 0.0,
       "vehicles.alpha.weight = 3: unknown key"},
      {"NoSuchAnchor", withMass("*nowhere"), 0.0, "not YAML: "},
      {"AnAliasWithinItself", withMassLine("    mass: 2\n    hull: &h {box: *h}\n"), 0.0,
       "line 11: an alias must not lie within what it names"},
      {"MergeWithinItself", withMassLine("    drag: &d\n      <<: *d\n"), 0.0,
       "line 11: an alias must not lie within what it names"},
      {"BillionLaughs", billionLaughs() + validScenario(), 0.0, "must hold at most 1000000 values"},
  };
}

// NOLINTNEXTLINE(readability-function-size): a table.
inline std::vector<YamlRule> textRules() {
  const std::string& good = validScenario();
  return {
      {"AsItIs", good, 5.5},
      {"ByteOrderMark", "\xef\xbb\xbf" + good, 5.5},
      {"CrLf", crlf(good), 5.5},
      {"DocumentMarks", "%YAML 1.2\n---\n" + good + "...\n", 5.5},
      {"NoLastLineEnd", good.substr(0, good.size() - 1), 5.5},
      {"CommentInUtf8", "# 90\xc2\xb0 \xe2\x88\x9e\n" + good, 5.5},
      {"TabBehindAKey", withMass("\t5.5\t# kg"), 5.5},
      {"Json",
       R"({"step_size": 0.01, "vehicles": {"alpha": {"mass": 2, "inertia": )"
       R"({"ixx": 1, "iyy": 1, "izz": 1}, "engines": {"rear": {"position": [0, 0, 0], )"
       R"("direction": [1, 0, 0], "min_thrust": 0, "max_thrust": 1}, "left": {"position": )"
       R"([0, 0, 0], "direction": [1, 0, 0], "min_thrust": 0, "max_thrust": 1}, "right": )"
       R"({"position": [0, 0, 0], "direction": [1, 0, 0], "min_thrust": 0, "max_thrust": )"
       R"(1}}}}})",
       2.0},
      {"Empty", "", 0.0, "the scenario: must be a map of keys; it is empty"},
      {"OnlyAComment", "# nothing\n", 0.0, "the scenario: must be a map of keys; it is empty"},
      {"OnlyMarks", "---\n...\n", 0.0, "the scenario: must be a map of keys; it is empty"},
      {"AText", "scenario.yaml", 0.0, "the scenario = scenario.yaml: must be a map of keys"},
      {"SecondDocument", good + "---\n" + good, 0.0, "line 19: must be one YAML document"},
      {"EmptySecondDocument", good + "---\n", 0.0, "line 19: must be one YAML document"},
      {"SomethingBehindADocument", "{a: 1} {b: 2}", 0.0, ""},
      {"KeyTwiceDeepInside", with(good, "ixx: 0.1,", "ixx: 0.1, ixx: 0.1,"), 0.0,
       "vehicles.alpha.inertia.ixx: duplicate key, again in line 12"},
      {"KeyTwiceInAList",
       with(good, "    drag:", "    hull: {points: [{p: [0, 0, 0], p: [0, 0, 1]}]}\n    drag:"),
       0.0, "vehicles.alpha.hull.points[0].p: duplicate key"},
      {"KeyOfSeveralLinesTwice", with(good, "seed: 7", "\"a\\nb\": 7\n\"a\\nb\": 8"), 0.0,
       "a b: duplicate key, again in line 8"},
      {"KeyThatIsAList", with(good, "seed: 7", "[1, 2]: 7"), 0.0, "line 7: a key must be a text"},
      {"KeyThatIsAMap", with(good, "seed: 7", "{a: 1}: 7"), 0.0, "line 7: a key must be a text"},
      {"KeyThatIsNothing", with(good, "seed: 7", "~: 7"), 0.0, "line 7: a key must be a text"},
      {"KeyThatIsANumber", with(good, "seed: 7", "7: 7"), 0.0, "7 = 7: unknown key"},
      {"VehicleNamedNull", with(good, "  alpha:", "  null:"), 0.0, "line 9: a key must be a text"},
      {"Tag", with(good, "seed: 7", "seed: !!int 7"), 0.0, "line 7: a tag (!...) has no meaning"},
      {"TagOfAMap", "!!map\n" + good, 0.0, ""},
      {"NonSpecificTagOfAMap", with(good, "inertia: {", "inertia: ! {"), 0.0,
       "line 12: a tag (!...) has no meaning"},
      {"LoneTag", "!foo", 0.0, ""},
      {"LoneAnchor", "&foo", 0.0, ""},
      {"Tab", with(good, "    mass: 5.5", "\tmass: 5.5"), 0.0,
       "line 10: must be indented by spaces, not by a tab"},
      {"TabBehindSpaces", with(good, "    mass: 5.5", "   \tmass: 5.5"), 0.0,
       "line 10: must be indented by spaces, not by a tab"},
      {"LoneCarriageReturn", with(good, "seed: 7\n", "seed: 7\r"), 0.0,
       "line 7: a line must end in LF or CR LF"},
      {"LineSeparator", with(good, "seed: 7\n", "seed: 7 #\xe2\x80\xa8\n"), 0.0,
       "line 7: a line must end in LF or CR LF"},
      {"Nul", with(good, "seed: 7", std::string("seed: 7\0", 8)), 0.0,
       "line 7: must not hold a control character"},
      {"EndOfTransmission", with(good, "seed: 7", "seed: 7\n\x04"), 0.0,
       "line 8: must not hold a control character"},
      {"EscapedNul", with(good, "integrator: rk4", "integrator: \"rk4\\0\""), 0.0,
       "line 2: a value must not hold a control character"},
      {"Latin1", "# 90\xb0\n" + good, 0.0, "line 1: must be UTF-8"},
      {"Utf16", std::string("\xff\xfe\x61\x00", 4), 0.0, "line 1: must be UTF-8"},
      {"Overlong", std::string("# \xc0\xaf\n"), 0.0, "line 1: must be UTF-8"},
      {"Surrogate", std::string("# \xed\xa0\x80\n"), 0.0, "line 1: must be UTF-8"},
      {"CutCharacter", std::string("# \xe2\x88"), 0.0, "line 1: must be UTF-8"},
      {"Unclosed", "vehicles: [1, 2", 0.0, "not YAML: "},
      {"NestedTooDeep", "a: " + nested(32), 0.0, "must have at most 32 maps and lists"},
      {"NestedDeeperThanAStack", nested(1000000), 0.0, "must have at most 32 maps and lists"},
      {"NestedLists", std::string(100000, '-'), 0.0, ""},
  };
}

inline std::vector<YamlRule> yamlRules() {
  std::vector<YamlRule> rules = textRules();
  for (const auto& more : {numberRules(), mergeRules()}) {
    rules.insert(rules.end(), more.begin(), more.end());
  }
  return rules;
}

}  // namespace hovercraft::testing
