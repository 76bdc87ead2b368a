#include <limits>
#include <vector>

#include <gtest/gtest.h>

/// That a build with the sanitizers sees what they are there for: each fault ends the program and
/// names its place.

namespace hovercraft {
namespace {

#ifdef HOVERCRAFT_SANITIZE

/// What no compiler knows.
template <class T>
T unknown(T value) {
  volatile T kept = value;
  return kept;
}

TEST(SanitizersDeathTest, AFaultEndsTheProgramAndItsPlaceIsNamed) {
  const std::vector<double> numbers{1.0};
  EXPECT_DEATH(unknown(*(numbers.data() + unknown(1))), "heap-buffer-overflow(.|\n)*test_san");
  EXPECT_DEATH(unknown(unknown(std::numeric_limits<int>::max()) + 1), "test_sanitizers");
  EXPECT_DEATH(unknown(1 << unknown(40)), "test_sanitizers");
  EXPECT_DEATH(unknown(1 / unknown(0)), "test_sanitizers");
  EXPECT_DEATH(unknown(static_cast<int>(unknown(1e300))), "test_sanitizers");
  EXPECT_DEATH(unknown(*unknown<int*>(nullptr)), "test_sanitizers");
  bool truth = false;
  *reinterpret_cast<unsigned char*>(&truth) = unknown<unsigned char>(2);
  EXPECT_DEATH(unknown(static_cast<int>(unknown(truth))), "test_sanitizers");
}

#endif

}  // namespace
}  // namespace hovercraft
