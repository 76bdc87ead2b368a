#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "hovercraft_sim/cushion/cell_pressure.h"

namespace hovercraft {
namespace {

double signedRoot(double pressure) {
  return pressure < 0.0 ? -std::sqrt(-pressure) : std::sqrt(pressure);
}

/// What the fan gives and does not go anywhere, m³/s.
double imbalance(const FanAtSpeed& fan, double outflow, double pumping, double pressure) {
  return fanFlow(fan, pressure) - outflow * signedRoot(pressure) - pumping;
}

TEST(CellPressure, BalancesTheFlowsWhateverTheCellDoes) {
  const unsigned seed = 19;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int cases[3] = {};
  for (int i = 0; i < 20000; ++i) {
    const FanCurve curve = {900.0 * share(random) + 50.0, -3000.0 * share(random),
                            2e6 * share(random) + 1.0};
    const FanAtSpeed fan = atSpeed(curve, 1.2 * share(random));
    const double outflow = 0.01 * share(random) * share(random);
    const double pumping = 0.4 * (share(random) - 0.5);
    const CellAir air = cellAir(fan, outflow, pumping);
    ++cases[air.pressure < 0.0 ? 0 : air.fan_flow < 0.0 ? 1 : 2];
    const double flows = std::abs(fanFlow(fan, air.pressure)) +
                         outflow * std::sqrt(std::abs(air.pressure)) + std::abs(pumping);
    EXPECT_NEAR(imbalance(fan, outflow, pumping, air.pressure), 0.0, 1e-9 * flows);
    EXPECT_NEAR(fanFlow(fan, air.pressure), air.fan_flow, 1e-9 * flows);
  }
  for (const int count : cases) EXPECT_GT(count, 1000);  // suction, reversed fan, normal
}

TEST(CellPressure, IsSteadyAcrossTheBordersOfItsCases) {
  const FanAtSpeed fan = atSpeed({940.0, -300.0, 1.1e5}, 0.9);
  const double outflow = 0.002;
  for (const double border : {fan.free_flow, -outflow * fan.root_shutoff}) {
    const double by = 1e-7;
    const double below = cellAir(fan, outflow, border - by).pressure;
    const double at = cellAir(fan, outflow, border).pressure;
    const double above = cellAir(fan, outflow, border + by).pressure;
    // The same slope on both sides.
    EXPECT_NEAR(at - below, above - at, 1e-3 * std::abs(above - below));
    EXPECT_LT(above, below);
  }
}

TEST(CellPressure, ShrinkingCellIsPressedAndAGrowingOneSucks) {
  const FanAtSpeed fan = atSpeed({940.0, 0.0, 1.1e5}, 1.0);
  double last = std::numeric_limits<double>::infinity();
  for (double pumping = -0.3; pumping < 0.3; pumping += 0.01) {
    const double pressure = cellAir(fan, 0.002, pumping).pressure;
    EXPECT_LT(pressure, last);
    last = pressure;
  }
  EXPECT_GT(cellAir(fan, 0.002, -0.3).pressure, 940.0);
  EXPECT_LT(cellAir(fan, 0.002, 0.3).pressure, 0.0);
}

TEST(CellPressure, SealedCellHasThePressureOfItsFanWithoutFlow) {
  EXPECT_NEAR(cellAir(atSpeed({940.0, -50.0, 1.1e5}, 0.5), 0.0, 0.0).pressure, 235.0, 1e-12);
}

TEST(CellPressure, StandingFanIsAnOpening) {
  const FanAtSpeed fan = atSpeed({940.0, 0.0, 1.1e5}, 0.0);
  const double k = 0.002;
  EXPECT_EQ(cellAir(fan, k, 0.0).pressure, 0.0);
  // Two openings side by side: u = -(k + 1/sqrt(c)) sqrt p.
  const double both = k + 1.0 / std::sqrt(1.1e5);
  EXPECT_NEAR(cellAir(fan, k, -0.05).pressure, (0.05 / both) * (0.05 / both), 1e-10);
  EXPECT_NEAR(cellAir(fan, k, 0.05).pressure, -(0.05 / both) * (0.05 / both), 1e-10);
  const FanAtSpeed without_curve = atSpeed({940.0, -50.0, 0.0}, 0.0);
  EXPECT_EQ(cellAir(without_curve, 0.0, 0.1).pressure, 0.0);
  EXPECT_EQ(cellAir(without_curve, 0.0, -0.1).pressure, 0.0);
}

}  // namespace
}  // namespace hovercraft
