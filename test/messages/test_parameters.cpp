#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/messages/parameters.h"

#include "../support/scenario_text.h"

namespace hovercraft_ros {
namespace {

using hovercraft::ConfigNode;
using XmlRpc::XmlRpcValue;

ConfigNode nodeOf(const XmlRpcValue& value) {
  XmlRpcValue parameters;
  parameters["p"] = value;
  return *parameterTree(parameters, "/sim").find("p");
}

TEST(Parameters, NumbersAndTruthsAreTextsThatGiveThemBack) {
  EXPECT_EQ(nodeOf(XmlRpcValue(0.1)).text(), "0.1");
  EXPECT_EQ(nodeOf(XmlRpcValue(1e-7)).text(), "1e-07");
  EXPECT_EQ(nodeOf(XmlRpcValue(-2147483647)).text(), "-2147483647");
  EXPECT_EQ(nodeOf(XmlRpcValue(true)).text(), "true");
  EXPECT_EQ(nodeOf(XmlRpcValue(false)).text(), "false");
  EXPECT_EQ(nodeOf(XmlRpcValue(std::numeric_limits<double>::infinity())).text(), "inf");
}

// roslaunch makes a text of 1e1, and it is to be a number.
TEST(Parameters, TextsAreKeptAndCountAsPlain) {
  for (const char* text : {"", "1e1", "yes", "a: 1\n<<: {}\n", "package://craft/hull: a.obj"}) {
    EXPECT_EQ(nodeOf(XmlRpcValue(text)).text(), text);
    EXPECT_TRUE(nodeOf(XmlRpcValue(text)).isPlainText());
  }
}

TEST(Parameters, TreesAndListsAreKnownAsSuchOnly) {
  XmlRpcValue tree;
  tree["a"][0] = 1;
  EXPECT_TRUE(nodeOf(tree).isMap());
  EXPECT_TRUE(nodeOf(tree).members().empty());
  EXPECT_TRUE(nodeOf(tree["a"]).isList());
  EXPECT_TRUE(nodeOf(tree["a"]).items().empty());
}

TEST(Parameters, ANamespaceThatIsNotThereIsEmpty) {
  EXPECT_TRUE(parameterTree(XmlRpcValue(), "/sim").isMap());
  EXPECT_TRUE(parameterTree(XmlRpcValue(), "/sim").members().empty());
}

TEST(Parameters, AnotherTypeIsRefusedByItsName) {
  char bytes[] = {1, 2, 3};
  const XmlRpcValue binary(bytes, 3);
  EXPECT_EQ(hovercraft::testing::messageOf([&binary] { nodeOf(binary); }),
            "/sim: p: must be a number, true or false, or a text");
}

}  // namespace
}  // namespace hovercraft_ros
