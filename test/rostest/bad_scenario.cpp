#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "../support/child_process.h"
#include "../support/temporary_folder.h"
#include "../support/wait_until.h"

namespace hovercraft_ros::testing {
namespace {

TEST(BadScenario, TheNodeNamesParameterValueAndRuleAndEndsWithStatusOne) {
  const TemporaryFolder folder;
  const std::string log = folder.path() + "/stderr";
  ChildProcess node(
      {"sh", "-c", "exec rosrun hovercraft_sim hovercraft_node __name:=broken 2> " + log});
  waitUntil("the node has given up", [&] { return node.hasEnded(); });
  EXPECT_EQ(node.exitStatus(), 1);
  std::ostringstream text;
  text << std::ifstream(log).rdbuf();
  EXPECT_NE(
      text.str().find("/broken/scenario: vehicles.hovercraft.mass = -5: must be greater than 0"),
      std::string::npos)
      << text.str();
}

}  // namespace
}  // namespace hovercraft_ros::testing
