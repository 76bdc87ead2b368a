#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/overrides.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/yaml_text.h"

#include "../support/files.h"
#include "../support/scenario_text.h"

namespace hovercraft {
namespace {

using testing::messageOf;

ConfigNode tree() {
  return treeOf("{a: {b: 1, list: [1, {c: 2}, 3]}, 'x.y z': {k: 1}, word: text}", "t");
}

/// What comes of these overrides, or the message.
std::string after(const std::vector<std::string>& assignments) {
  std::string text;
  const std::string message = messageOf([&] {
    text = withOverrides(tree(), {"--set", assignments}).beginning(999);
  });
  return text.empty() ? message : text;
}

TEST(Overrides, TakeThePlaceOfValues) {
  const std::string rest = ", x.y z: {k: 1}, word: text}";
  EXPECT_EQ(after({}), "{a: {b: 1, list: [1, {c: 2}, 3]}" + rest);
  EXPECT_EQ(after({"", " ; ;"}), "{a: {b: 1, list: [1, {c: 2}, 3]}" + rest);
  EXPECT_EQ(after({"a.b=2"}), "{a: {b: 2, list: [1, {c: 2}, 3]}" + rest);
  EXPECT_EQ(after({" a.b = 2 ; a.list[0]=9;a.list[1].c=[7, 8]"}),
            "{a: {b: 2, list: [9, {c: [7, 8]}, 3]}" + rest);
  EXPECT_EQ(after({"a.b=2", "a.list[2]=0"}), "{a: {b: 2, list: [1, {c: 2}, 0]}" + rest);
  EXPECT_EQ(after({"a={}; a.new=1"}), "{a: {new: 1}" + rest);
  EXPECT_EQ(after({"\"x.y z\".k=5; word='a; b'"}),
            "{a: {b: 1, list: [1, {c: 2}, 3]}, x.y z: {k: 5}, word: a; b}");
}

TEST(Overrides, QuotesAndBracketsKeepSemicolonsAndEquals) {
  const std::string front = "{a: {b: 1, list: [1, {c: 2}, 3]}, x.y z: {k: 1}, word: ";
  EXPECT_EQ(after({R"(word="a;b=\"c\";d")"}), front + "a;b=\"c\";d}");
  EXPECT_EQ(after({"word='it''s; so'"}), front + "it's; so}");
  EXPECT_EQ(after({"word=o'clock; a.b=1"}), front + "o'clock}");
  EXPECT_EQ(after({"word={k: [1, 'x;y'], l: m;n}"}), front + "{k: [1, x;y], l: m;n}}");
  EXPECT_EQ(after({"word=a=b"}), front + "a=b}");
}

TEST(Overrides, ThatLeadNowhereAreNamed) {
  const auto fault = [](const char* assignment) {
    const std::string message = after({assignment});
    const std::string beginning = std::string("--set ") + assignment + ": ";
    EXPECT_EQ(message.rfind(beginning, 0), 0U) << message;
    return message.substr(std::min(beginning.size(), message.size()));
  };
  EXPECT_EQ(fault("b.c=1"), "the scenario has no key b; there: a, x.y z, word");
  EXPECT_EQ(fault("a.q.r=1"), "a has no key q; there: b, list");
  EXPECT_EQ(fault("a.b.c=1"), "a.b is no map of keys");
  EXPECT_EQ(fault("a.list.c=1"), "a.list is no map of keys");
  EXPECT_EQ(fault("a.b[0]=1"), "a.b is no list");
  EXPECT_EQ(fault("a[0]=1"), "a is no list");
  EXPECT_EQ(fault("a.list[3]=1"), "a.list has no element 3; it has 3");
  EXPECT_EQ(fault("a.list[0].c=1"), "a.list[0] is no map of keys");
  EXPECT_EQ(fault("mass"), "must be KEY.PATH=VALUE");
  for (const char* bad :
       {"=1", "a.=1", ".a=1", "a..b=1", "a b=1", "a.list[]=1", "a.list[x]=1", "a.list[-1]=1",
        "a.list[0=1", "a.list[9999999999]=1", "'a=1", "'a'b=1", "[0]=1", "a.list[0]b=1"}) {
    EXPECT_EQ(fault(bad).rfind("must be KEY.PATH=VALUE", 0), 0U) << bad;
  }
}

TEST(Overrides, MustHaveAValueThatIsYaml) {
  EXPECT_EQ(after({"a.b="}), "--set a.b=: must be KEY.PATH=VALUE; the value is missing");
  EXPECT_EQ(after({"a.b=~"}), "--set a.b=~: must be KEY.PATH=VALUE; the value is missing");
  EXPECT_EQ(after({"a.b=["}).rfind("--set a.b=[: not YAML: ", 0), 0U) << after({"a.b=["});
  EXPECT_EQ(after({"a.b='x"}).rfind("--set a.b='x: not YAML: ", 0), 0U) << after({"a.b='x"});
  EXPECT_EQ(after({"a.b={c: 1, c: 2}"}),
            "--set a.b={c: 1, c: 2}: c: duplicate key, again in line 1");
  EXPECT_EQ(after({"a.b=!!int 5"}), "--set a.b=!!int 5: line 1: a tag (!...) has no meaning here");
}

TEST(Overrides, DoNotUndoEachOther) {
  EXPECT_EQ(after({"a.b=1; a.b=2"}), "--set a.b=2: is set twice");
  EXPECT_EQ(after({"a.b=1", "'a'.\"b\" = 2"}), "--set 'a'.\"b\" = 2: is set twice");
  EXPECT_EQ(after({"a.list[1].c=1; a.list[1]={c: 2}"}),
            "--set a.list[1]={c: 2}: undoes a.list[1].c, which is set before it");
  EXPECT_EQ(after({"a.list[1].c=1; a.list[2]=2"}),
            "{a: {b: 1, list: [1, {c: 1}, 2]}, x.y z: {k: 1}, word: text}");
}

TEST(Overrides, ChangeOnePlaceOfWhatIsSharedByAliases) {
  const ConfigNode shared = treeOf("{a: &a {m: 1}, b: *a, c: {<<: *a}}", "t");
  EXPECT_EQ(withOverrides(shared, {"--set", {"b.m=2"}}).beginning(99),
            "{a: {m: 1}, b: {m: 2}, c: {m: 1}}");
}

TEST(Overrides, MakeAnotherScenarioAndAreNamedWhenItIsRefused) {
  const ScenarioSource source = {"s.yaml", "", {}};
  const std::string& text = testing::validScenario();
  const Scenario scenario = parseScenario(
      text, source, {"--set", {"vehicles.alpha.mass=6; vehicles.alpha.initial.position[1]=-2"}});
  EXPECT_EQ(scenario.vehicles[0].mass_properties.mass, 6.0);
  EXPECT_EQ(scenario.vehicles[0].initial_p_WB, Vector3(1.0, -2.0, 3.0));
  EXPECT_EQ(
      messageOf([&] {
        parseScenario(text, source, {"--set", {"vehicles.alpha.mas=6"}});
      }).rfind("s.yaml with --set vehicles.alpha.mas=6: vehicles.alpha.mas = 6: unknown key", 0),
      0U);
}

}  // namespace
}  // namespace hovercraft
