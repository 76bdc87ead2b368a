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

/// What a node of this name says before it gives up.
std::string lastWordsOf(const std::string& name) {
  const TemporaryFolder folder;
  const std::string log = folder.path() + "/stderr";
  ChildProcess node(
      {"sh", "-c", "exec rosrun hovercraft_sim hovercraft_node __name:=" + name + " 2> " + log});
  waitUntil("the node has given up", [&] { return node.hasEnded(); });
  EXPECT_EQ(node.exitStatus(), 1);
  std::ostringstream text;
  text << std::ifstream(log).rdbuf();
  return text.str();
}

TEST(BadScenario, TheNodeNamesParameterValueAndRuleAndEndsWithStatusOne) {
  const std::string words = lastWordsOf("broken");
  EXPECT_NE(words.find("/broken/scenario with /broken/set vehicles.hovercraft.mass=-5.0: "
                       "vehicles.hovercraft.mass = -5.0: must be greater than 0"),
            std::string::npos)
      << words;
}

TEST(BadScenario, TheTreeOfOldIsRefusedWithTheLineToWrite) {
  const std::string words = lastWordsOf("tree");
  EXPECT_NE(words.find("/tree/scenario: must be the text of a scenario file"), std::string::npos)
      << words;
  EXPECT_NE(words.find("<param name=\"scenario\" textfile=\"FILE\"/>"), std::string::npos) << words;
}

}  // namespace
}  // namespace hovercraft_ros::testing
