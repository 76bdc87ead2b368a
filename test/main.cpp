// Every gtest executable's main(): catkin links no gtest_main.
#include <gtest/gtest.h>

#include "support/sanitizer_options.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
