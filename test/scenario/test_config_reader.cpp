#include <fmt/format.h>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/yaml_text.h"

#include "../support/files.h"

namespace hovercraft {
namespace {

using testing::messageOf;

ConfigReader readerOf(const std::string& yaml) {
  return {treeOf(yaml, "file.yaml"), "file.yaml"};
}

TEST(ConfigReader, FindsWhatIsThere) {
  const ConfigReader reader = readerOf("{number: 1.5, vector: [1, 2, 3], word: text, empty: }");
  EXPECT_EQ(reader.number("number"), 1.5);
  EXPECT_EQ(reader.vector("vector"), Vector3(1.0, 2.0, 3.0));
  EXPECT_EQ(reader.text("word"), "text");
  EXPECT_TRUE(reader.has("number"));
  EXPECT_TRUE(reader.has("empty"));
  EXPECT_FALSE(reader.has("nothing"));
}

TEST(ConfigReader, FallsBackOnlyIfTheKeyIsNotThere) {
  const ConfigReader reader = readerOf("{number: 1.5, empty: , choice: b, count: -3}");
  EXPECT_EQ(reader.numberOr(7.0, "number"), 1.5);
  EXPECT_EQ(reader.numberOr(7.0, "nothing"), 7.0);
  EXPECT_EQ(reader.vectorOr(Vector3(1, 2, 3), "nothing"), Vector3(1, 2, 3));
  EXPECT_EQ(reader.choiceOr(0, "choice", {"a", "b"}), 1U);
  EXPECT_EQ(reader.choiceOr(1, "nothing", {"a", "b"}), 1U);
  EXPECT_EQ(reader.wholeNumberOr(5, "count"), -3);
  EXPECT_EQ(reader.wholeNumberOr(5, "nothing"), 5);
  EXPECT_EQ(messageOf([&] { reader.numberOr(7.0, "empty"); }),
            "file.yaml: empty: the value is missing");
}

TEST(ConfigReader, MessagesNameTheWholePath) {
  const ConfigReader reader = readerOf("{a: {b: [{c: 1}, {c: x}]}}");
  const ConfigReader second = reader.map("a").list("b").at(1);
  EXPECT_EQ(second.path(), "a.b[1]");
  EXPECT_EQ(messageOf([&] { second.number("c"); }), "file.yaml: a.b[1].c = x: must be a number");
  EXPECT_EQ(messageOf([&] { second.number("d"); }), "file.yaml: a.b[1].d: the key is missing");
  EXPECT_EQ(messageOf([&] { reader.fail("", "is bad"); }),
            "file.yaml: the scenario = {a: {b: [{c: 1}, {c: x}]}}: is bad");
}

TEST(ConfigReader, MapsComeInTheOrderOfTheirKeys) {
  const auto maps = readerOf("{b: {n: 2}, c: {n: 3}, a: {n: 1}}").maps();
  ASSERT_EQ(maps.size(), 3U);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    EXPECT_EQ(maps[i].first, std::string(1, static_cast<char>('a' + i)));
    EXPECT_EQ(maps[i].second.number("n"), static_cast<double>(i + 1));
  }
}

TEST(ConfigReader, RulesBindEachNumber) {
  const ConfigReader reader = readerOf("{zero: 0, minus: -1, plus: 1, minus_zero: -0.0}");
  const auto complaint = [&](const char* key, const NumberRule& rule) {
    return messageOf([&] { reader.number(key, rule); });
  };
  EXPECT_EQ(complaint("zero", kPositive), "file.yaml: zero = 0: must be greater than 0");
  EXPECT_EQ(complaint("minus", kNotNegative), "file.yaml: minus = -1: must be 0 or greater");
  EXPECT_EQ(complaint("plus", kNotPositive), "file.yaml: plus = 1: must be 0 or less");
  EXPECT_EQ(complaint("zero", kNotNegative), "nothing was thrown");
  EXPECT_EQ(complaint("zero", kNotPositive), "nothing was thrown");
  EXPECT_EQ(complaint("minus_zero", kNotNegative), "nothing was thrown");
  EXPECT_EQ(complaint("minus", kAnyNumber), "nothing was thrown");
}

// A long value is cut, and never inside a character of UTF-8: 79 letters and an é of two bytes.
TEST(ConfigReader, LongValuesAreShortened) {
  const std::string text = std::string(79, 'x') + "\xc3\xa9" + std::string(100, 'y');
  const ConfigReader reader = readerOf("{n: " + text + "}");
  EXPECT_EQ(messageOf([&] { reader.number("n"); }),
            "file.yaml: n = " + std::string(79, 'x') + "...: must be a number");
  const ConfigReader exact = readerOf("{n: " + std::string(80, 'x') + "}");
  EXPECT_EQ(messageOf([&] { exact.number("n"); }),
            "file.yaml: n = " + std::string(80, 'x') + ": must be a number");
}

TEST(ConfigReader, MessagesAreOneLineWhateverKeysAndValuesHold) {
  const ConfigReader reader = readerOf("{\"k\\ney\": \"a\\nb\\tc\"}");
  EXPECT_EQ(messageOf([&] { reader.allowOnly({"key"}); }),
            "file.yaml: k ey = a b c: unknown key; known here: key");
}

TEST(ConfigReader, AListOrAMapBeginsAMessageNoLongerThanATextDoes) {
  std::string list = "{n: [0";
  for (int i = 1; i < 1000; ++i) list += fmt::format(", {}", i);
  EXPECT_EQ(messageOf([&] { readerOf(list + "]}").number("n"); }),
            "file.yaml: n = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, "
            "20, 21, 2...: must be a number");
}

}  // namespace
}  // namespace hovercraft
