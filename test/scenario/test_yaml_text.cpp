#include <fmt/format.h>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/yaml_text.h"

#include "../support/files.h"
#include "../support/yaml_rules.h"

namespace hovercraft {
namespace {

using testing::messageOf;

void expectAsTheRuleSays(const testing::YamlRule& rule) {
  const std::string source = "test.yaml: ";
  double mass = 0.0;
  const std::string message =
      messageOf([&] { mass = testing::parsed(rule.text).vehicles.at(0).mass_properties.mass; });
  EXPECT_EQ(mass, rule.mass) << rule.name << ": " << message;
  if (rule.mass > 0.0) return;
  EXPECT_EQ(message.rfind(source + rule.beginning, 0), 0U) << rule.name << ": " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << rule.name;
}

TEST(YamlText, MeansWhatTheRulesSayOrNothing) {
  for (const testing::YamlRule& rule : testing::yamlRules()) expectAsTheRuleSays(rule);
}

TEST(YamlText, NamesThatYaml11TakesForTrueOrFalseAreNames) {
  for (const char* name :
       {"no", "yes", "on", "off", "y", "n", "No", "true", "FALSE", "e5", "nan"}) {
    const std::string text =
        testing::with(testing::validScenario(), "  alpha:", std::string("  ") + name + ":");
    const Scenario scenario = testing::parsed(text);
    EXPECT_EQ(scenario.vehicles.at(0).name, name);
    EXPECT_EQ(testing::parsed(toYaml(scenario)).vehicles.at(0).name, name);
  }
  const std::string quoted = testing::with(testing::validScenario(), "  alpha:", "  \"null\":");
  EXPECT_EQ(testing::parsed(toYaml(testing::parsed(quoted))).vehicles.at(0).name, "null");
}

TEST(YamlText, AMergedMapIsTheSameForAllAndIsChangedForNone) {
  const ConfigNode tree = treeOf(
      "base: &base {a: 1, b: {c: 2}}\nfirst: {<<: *base, a: 3}\nsecond: {<<: *base, d: 4}\n", "t");
  EXPECT_EQ(tree.find("base")->beginning(99), "{a: 1, b: {c: 2}}");
  EXPECT_EQ(tree.find("first")->beginning(99), "{a: 3, b: {c: 2}}");
  EXPECT_EQ(tree.find("second")->beginning(99), "{d: 4, a: 1, b: {c: 2}}");
}

// Each of 40,000 merge keys copies 1000 values: what is written out is bounded, not what is read.
TEST(YamlText, ManyMergesAreBounded) {
  std::string text = "base: &base {";
  for (int i = 0; i < 1000; ++i) text += fmt::format("k{}: 1, ", i);
  text += "z: 1}\nlist: [";
  for (int i = 0; i < 40000; ++i) text += "{<<: *base}, ";
  const std::string message = messageOf([&text] { treeOf(text + "]\n", "t"); });
  EXPECT_EQ(message, "t: must hold at most 1000000 values, aliases and merge keys written out");
}

TEST(YamlText, LongTextsAndLongValuesAreBounded) {
  EXPECT_EQ(messageOf([] { treeOf(std::string(kLongestYamlText + 1, ' '), "t"); }),
            "t: must be at most 16777216 bytes");
  // 1 MB counts as 16384 values: 80 of them are too many.
  std::string text = "- &long " + std::string(1 << 20, 'x') + "\n";
  for (int i = 0; i < 80; ++i) text += "- *long\n";
  EXPECT_EQ(messageOf([&text] { treeOf(text, "t"); }),
            "t: must hold at most 1000000 values, aliases and merge keys written out");
}

TEST(YamlText, DepthCountsAliasesAndHasRoomForScenarios) {
  const std::string open(kDeepestYaml, '[');
  const std::string close(kDeepestYaml, ']');
  EXPECT_EQ(treeOf(open + close, "t").depth(), kDeepestYaml);
  const std::string half(kDeepestYaml / 2, '[');
  const std::string half_end(kDeepestYaml / 2, ']');
  EXPECT_EQ(messageOf([&] {
              treeOf("- &a " + half + half_end + "\n- " + half + "*a" + half_end + "\n", "t");
            }),
            "t: must have at most 32 maps and lists within each other");
}

TEST(YamlText, NamesAreQuotedWhereTheyMustBe) {
  for (const char* name : {"wood", "a_1", "x.y", "a-b"}) EXPECT_EQ(yamlText(name), name);
  for (const char* name :
       {"no", "NULL", "", "1", "a b", "a: b", "#", "ä", "it's", "<<", "-", "y"}) {
    EXPECT_EQ(yamlText(name), "\"" + std::string(name) + "\"");
  }
  for (const std::string& name : {std::string("say \"\\\" twice"), std::string("two\nlines\tx")}) {
    const ConfigNode tree = treeOf("{" + yamlText(name) + ": " + yamlText(name) + "}", "t");
    ASSERT_NE(tree.find(name), nullptr);
    EXPECT_EQ(tree.find(name)->text(), name);
  }
}

TEST(YamlText, NumbersHaveAPointWhereYaml11WantsOne) {
  EXPECT_EQ(yamlNumber(0.6), "0.6");
  EXPECT_EQ(yamlNumber(1e-6), "1.0e-06");
  EXPECT_EQ(yamlNumber(-2.5e-7), "-2.5e-07");
  EXPECT_EQ(yamlNumber(3e9), "3000000000");
  EXPECT_EQ(yamlVector({1.0, 0.1, -0.0}), "[1, 0.1, -0]");
}

}  // namespace
}  // namespace hovercraft
