#include <cmath>

#include <gtest/gtest.h>

#include "hovercraft_sim/control/plant_actuator.h"

namespace hovercraft {
namespace {

PlantActuator propeller() {
  PlantActuator actuator;
  actuator.kind = PlantActuator::Kind::kPropeller;
  actuator.min_thrust = -40.0;
  actuator.max_thrust = 100.0;
  actuator.air_density = 1.2;
  actuator.diameter = 0.5;
  actuator.thrust_coefficients = {0.1, -0.06, -0.04};
  return actuator;
}

/// (30), written out.
double thrustOf(const PlantActuator& p, double n, double speed) {
  const double j = speed / p.diameter;
  return p.air_density * std::pow(p.diameter, 4) *
         (p.thrust_coefficients[0] * n * std::abs(n) + p.thrust_coefficients[1] * std::abs(n) * j +
          p.thrust_coefficients[2] * j * std::abs(j));
}

TEST(PlantActuator, TheLevelOfAPropellerMakesTheForce) {
  const PlantActuator p = propeller();
  for (const double speed : {-3.0, 0.0, 2.0, 8.0}) {
    const ForceRange range = forceRange(p, speed, 0.0);
    EXPECT_NEAR(range.high, thrustOf(p, 100.0, speed), 1e-9);
    for (int i = 1; i <= 10; ++i) {
      const double ahead = 0.1 * i * range.high;
      EXPECT_NEAR(thrustOf(p, levelOf(p, ahead, speed, 0.0), speed), ahead, 1e-9) << speed;
      const double astern = 0.1 * i * range.low;
      const double n = levelOf(p, astern, speed, 0.0);
      // Where the stream brakes by more than that, no speed of this sense makes it.
      if (n < 0.0) {
        EXPECT_NEAR(thrustOf(p, n, speed), astern, 1e-9) << speed;
      }
    }
    EXPECT_EQ(levelOf(p, 0.0, speed, 0.0), 0.0);
    EXPECT_EQ(levelOf(p, 1e9, speed, 0.0), 100.0);
  }
}

TEST(PlantActuator, AFanIsAskedForMoreWhereSpeedTakesOfIt) {
  PlantActuator fan;
  fan.min_thrust = -2.0;
  fan.max_thrust = 4.0;
  fan.free_speed = 10.0;
  EXPECT_DOUBLE_EQ(forceRange(fan, 5.0, 0.0).high, 2.0);
  EXPECT_DOUBLE_EQ(forceRange(fan, 5.0, 0.0).low, -3.0);
  EXPECT_DOUBLE_EQ(levelOf(fan, 1.0, 5.0, 0.0), 2.0);
  EXPECT_DOUBLE_EQ(levelOf(fan, -1.5, 5.0, 0.0), -1.0);
  EXPECT_EQ(forceRange(fan, 12.0, 0.0).high, 0.0);
  EXPECT_EQ(levelOf(fan, 0.0, 12.0, 0.0), 0.0);
}

// (31): V_d = V/2 + √(V²/4 + T/(ρ A)).
TEST(PlantActuator, ARudderPushesAsItsFanBlows) {
  PlantActuator rudder;
  rudder.kind = PlantActuator::Kind::kRudder;
  rudder.min_thrust = -0.4;
  rudder.max_thrust = 0.5;
  rudder.air_density = 1.2;
  rudder.diameter = 0.3;
  rudder.area = 0.02;
  rudder.lift_slope = 3.0;
  rudder.fan = "aft";
  rudder.x = -0.5;
  const double disc = 0.25 * 3.14159265358979 * 0.09;
  const double stream = 1.0 + std::sqrt(1.0 + 5.0 / (1.2 * disc));
  const double slope = 0.5 * 1.2 * stream * stream * 0.02 * 3.0;
  EXPECT_NEAR(forceRange(rudder, 2.0, 5.0).high, 0.5 * slope, 1e-9);
  EXPECT_NEAR(forceRange(rudder, 2.0, 5.0).low, -0.4 * slope, 1e-9);
  EXPECT_NEAR(levelOf(rudder, 0.2 * slope, 2.0, 5.0), 0.2, 1e-9);
  EXPECT_EQ(rudder.column(), Vector3(0.0, 1.0, -0.5));
  EXPECT_EQ(levelOf(rudder, 1.0, 0.0, 0.0), 0.0);  // no stream, no force
  rudder.fan.clear();
  EXPECT_NEAR(forceRange(rudder, 2.0, 5.0).high, 0.5 * 0.5 * 1.2 * 4.0 * 0.02 * 3.0, 1e-12);
  EXPECT_EQ(forceRange(rudder, -2.0, 5.0).high, 0.0);
}

TEST(PlantActuator, TheSpeedOfAPlaceTurnsWithTheCraft) {
  PlantActuator fan;
  fan.x = 0.3;
  fan.y = 0.2;
  EXPECT_DOUBLE_EQ(fan.speed({1.0, 5.0, 2.0}), 1.0 - 2.0 * 0.2);
  fan.direction_x = 0.0;
  fan.direction_y = 1.0;
  EXPECT_DOUBLE_EQ(fan.speed({1.0, 5.0, 2.0}), 5.0 + 2.0 * 0.3);
}

}  // namespace
}  // namespace hovercraft
