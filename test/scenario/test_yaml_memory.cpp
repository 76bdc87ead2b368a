#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/yaml_text.h"

#include "../support/allocation_counter.h"
#include "../support/files.h"

namespace hovercraft {
namespace {

// yaml-cpp would keep 240 bytes of each bracket before anybody could say that they are too many.
TEST(YamlMemory, BracketsBeyondAllDepthAreRefusedForNoMoreThanTheirText) {
  for (const char bracket : {'[', '{'}) {
    const std::string text(1000000, bracket);
    const long before = testing::live_bytes;
    testing::peak_bytes = before;
    EXPECT_EQ(testing::messageOf([&text] { treeOf(text, "t"); }),
              "t: must have at most 32 maps and lists within each other");
    EXPECT_LT(testing::peak_bytes - before, 8 * static_cast<long>(text.size()));
  }
}

}  // namespace
}  // namespace hovercraft
