#include <cmath>

#include <gtest/gtest.h>

#include "hovercraft_sim/cushion/gap.h"

namespace hovercraft {
namespace {

constexpr double kResidual = 1e-4;  // m

TEST(HemGap, OpenGapAndCompressionSolveTheHyperbola) {
  // h - c = g and h c = d²/4: the two roots of x² - g x - d²/4, of which c is the negative one.
  for (const double gap : {-0.05, -1e-3, -1e-4, 0.0, 1e-4, 3e-3, 0.2}) {
    const HemGap hem = hemGap(gap, kResidual);
    EXPECT_NEAR(hem.open - hem.compression, gap, 1e-15);
    EXPECT_NEAR(hem.open * hem.compression, 0.25 * kResidual * kResidual, 1e-17);
    EXPECT_GT(hem.open, 0.0);
    EXPECT_GT(hem.compression, 0.0);
  }
}

TEST(HemGap, HighHemIsNotCompressedAndADeepOneLeaksNothing) {
  EXPECT_NEAR(hemGap(3e-3, kResidual).compression, 8.3e-7, 0.1e-7);  // d²/(4 g)
  EXPECT_NEAR(hemGap(-3e-3, kResidual).open, 8.3e-7, 0.1e-7);
  EXPECT_EQ(hemGap(0.0, kResidual).open, 0.5 * kResidual);
}

TEST(HemGap, SlopesAreThoseOfTheFunctions) {
  const double by = 1e-8;
  for (const double gap : {-1e-3, 0.0, 5e-5, 3e-3}) {
    const double slope =
        (hemGap(gap + by, kResidual).open - hemGap(gap - by, kResidual).open) / (2.0 * by);
    EXPECT_NEAR(openGapSlope(gap, kResidual), slope, 1e-6);
  }
  for (const double area : {1e-4, 1e-2, 0.3}) {
    const double slope = (leakArea(area + by, 0.027) - leakArea(area - by, 0.027)) / (2.0 * by);
    EXPECT_NEAR(leakAreaSlope(area, 0.027), slope, 1e-6);
  }
}

TEST(LeakArea, AirThatEscapesMustPassTheCellTooAndSoNoMoreThanItsArea) {
  EXPECT_NEAR(leakArea(1e-6, 0.027), 1e-6, 1e-14);
  EXPECT_NEAR(leakArea(0.027, 0.027), 0.027 / std::sqrt(2.0), 1e-16);
  EXPECT_NEAR(leakArea(1e6, 0.027), 0.027, 1e-14);
}

}  // namespace
}  // namespace hovercraft
