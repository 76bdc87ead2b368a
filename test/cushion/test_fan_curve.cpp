#include <cmath>

#include <gtest/gtest.h>

#include "hovercraft_sim/cushion/fan_curve.h"

namespace hovercraft {
namespace {

const FanCurve kCurves[] = {{940.0, 0.0, 1.1e5}, {180.0, -2e4, 3e7}, {4200.0, -3.0, 0.0}};

TEST(FanCurve, FlowIsTheInverseOfPressureForwardsAndReversed) {
  for (const FanCurve& curve : kCurves) {
    for (const double speed : {0.2, 1.0, 1.3}) {
      const FanAtSpeed fan = atSpeed(curve, speed);
      for (const double share : {-0.5, 0.0, 0.4, 0.999, 1.0, 1.8}) {
        const double pressure = share * fan.shutoff;
        const double flow = fanFlow(fan, pressure);
        const double again =
            fan.shutoff + fan.slope * flow - fan.curve * flow * std::abs(flow);  // (5)
        EXPECT_NEAR(again, pressure, 1e-12 * fan.shutoff);
        EXPECT_EQ(flow<0.0, share> 1.0);
      }
    }
  }
}

TEST(FanCurve, FanLawsFlowGrowsWithSpeedAndPressureWithItsSquare) {
  for (const FanCurve& curve : kCurves) {
    const FanAtSpeed nominal = atSpeed(curve, 1.0);
    const FanAtSpeed half = atSpeed(curve, 0.5);
    const double pressure = 0.3 * nominal.shutoff;
    EXPECT_NEAR(fanFlow(half, 0.25 * pressure), 0.5 * fanFlow(nominal, pressure),
                1e-14 * nominal.free_flow);
  }
}

TEST(FanCurve, SlopeIsThatOfTheFlow) {
  for (const FanCurve& curve : kCurves) {
    const FanAtSpeed fan = atSpeed(curve, 0.9);
    const double pressure = 0.4 * fan.shutoff;
    const double by = 1e-5 * fan.shutoff;
    const double slope = (fanFlow(fan, pressure + by) - fanFlow(fan, pressure - by)) / (2.0 * by);
    EXPECT_NEAR(fanFlowSlope(fan, fanFlow(fan, pressure)), -slope, 1e-6 * std::abs(slope));
  }
}

TEST(FanCurve, StandingFanLetsAirThroughBackwardsAndOneWithoutCurveNone) {
  const FanAtSpeed stands = atSpeed(kCurves[0], 0.0);
  EXPECT_EQ(stands.free_flow, 0.0);
  EXPECT_NEAR(fanFlow(stands, 440.0), -std::sqrt(440.0 / 1.1e5), 1e-15);
  EXPECT_EQ(fanFlow(atSpeed(kCurves[2], 0.0), 100.0), 0.0);
}

}  // namespace
}  // namespace hovercraft
