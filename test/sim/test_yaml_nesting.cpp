#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/scenario_parser.h"
#include "hovercraft_sim/sim/yaml_nesting.h"

#include "../support/files.h"

namespace hovercraft {
namespace {

using testing::messageOf;

std::string repeated(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part;
  return text;
}

TEST(YamlNesting, WhatSomebodyWroteIsNotDeep) {
  EXPECT_NO_THROW(checkNesting("", "x"));
  EXPECT_NO_THROW(checkNesting(repeated("[", 200) + repeated("]", 200), "x"));
  EXPECT_NO_THROW(checkNesting(repeated("a: [1, 2]\n", 5000), "x"));
  EXPECT_NO_THROW(checkNesting("x: ']]]'\n" + repeated("- ", 200) + "1", "x"));
  EXPECT_NO_THROW(checkNesting(std::string(1000, ' ') + "x: 1\n", "x"));
}

// Each of these ended yaml-cpp 0.6 for want of stack when it was long enough.
TEST(YamlNesting, DepthIsRefusedHoweverItIsWritten) {
  const std::string rule = "must not be nested more than 200 deep";
  for (const std::string& text :
       {repeated("[", 201), repeated("{a: ", 201), repeated("- ", 201), repeated("? ", 201),
        repeated("- ? ", 101), std::string(1001, ' ') + "x: 1", repeated("[\n", 201)}) {
    const std::string message = messageOf([&] { checkNesting("a: 1\n" + text, "x"); });
    EXPECT_EQ(message.rfind("x: line ", 0), 0U) << message;
    EXPECT_NE(message.find(rule), std::string::npos) << message;
  }
  EXPECT_EQ(messageOf([&] { treeOf(repeated("[", 100000), "text"); }), "text: line 1: " + rule);
  const testing::TestFolder folder;
  const std::string path = folder.write("deep.yaml", repeated("- ", 100000));
  EXPECT_EQ(messageOf([&] { loadScenario(path); }), path + ": line 1: " + rule);
}

}  // namespace
}  // namespace hovercraft
