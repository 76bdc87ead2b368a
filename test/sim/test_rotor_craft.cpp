#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/run_observer.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/snapshot.h"

#include "../support/scenario_text.h"

/// Craft whose actuators have rotors: (32) of doc/craft.md.

namespace hovercraft {
namespace {

using testing::complaintAbout;
using testing::parsed;
using testing::with;

constexpr double kLiftFanInertia = 2e-4;  // kg m²
constexpr double kLiftFanSpeed = 900.0;   // rad/s

/// An engine, a fan, a lift fan and a propeller with rotors.
std::string rotorCraft(const std::string& model) {
  return "step_size: 0.001\nmodel: " + model +
         "\nvehicles:\n  craft:\n    mass: 2\n    inertia: {ixx: 0.03, iyy: 0.04, izz: 0.05}\n"
         "    engines:\n"
         "      left: {position: [0, 0, 0], direction: [1, 0, 0], min_thrust: -2, max_thrust: 4, "
         "rotor_inertia: 1e-4, rotor_speed: 800, rotation: left}\n"
         "    actuators:\n"
         "      fan: {kind: fan, position: [0, 0, 0], direction: [0, 1, 0], min_thrust: 0, "
         "max_thrust: 9, time_constant: 0.1, rotor_inertia: 1e-4, rotor_speed: 600}\n"
         "      lift: {kind: lift_fan, initial: 0, time_constant: 0.2, rotor_inertia: 2e-4, "
         "rotor_speed: 900}\n"
         "      screw: {kind: propeller, position: [0, 0, 0], direction: [0.6, 0, 0.8], min_speed: "
         "-9, max_speed: 90, time_constant: 0.1, diameter: 0.2, thrust_coefficients: [0, 0, 0], "
         "rotor_inertia: 1e-4, rotation: left}\n";
}

constexpr std::size_t kSpunFan = 3;
constexpr std::size_t kSpunLift = 4;
constexpr std::size_t kSpunScrew = 5;

void spin(Simulation& simulation, std::size_t id, double value) {
  Command command{simulation.tick(), 0, maskOf(id), {}};
  if (id >= kFirstActuator) command.thrusts.resize(id + 1);
  command.thrusts[id] = value;
  simulation.push(command);
}

// L = 0: the yaw rate is -J Omega/I_zz, exactly.
TEST(RotorCraft, TurnsTheOtherWayAsItsLiftFanSpinsUp) {
  for (const char* model : {"planar", "spatial"}) {
    Simulation simulation(parsed(rotorCraft(model)));
    spin(simulation, kSpunLift, 1.0);
    for (int i = 0; i < 400; ++i) {
      simulation.step();
      const double level = simulation.engineReport(0, kSpunLift).applied;
      const Motion motion = simulation.motion(0);
      ASSERT_DOUBLE_EQ(motion.twist.w_WB.z(), -kLiftFanInertia * (kLiftFanSpeed * level) / 0.05);
      ASSERT_EQ(norm(motion.angular_momentum_W), 0.0);
    }
    EXPECT_LT(simulation.motion(0).twist.w_WB.z(), -3.0);
  }
}

TEST(RotorCraft, HasTheSpinOfEachKindAboutItsAxis) {
  struct Case {
    std::size_t id;
    double level;
    Vector3 momentum_B;  // N m s
  };
  // A thrust goes with the square of the speed: a quarter of the greater limit is half of it.
  const double of_screw = -1e-4 * 2.0 * kPi * 30.0;
  for (const Case& one :
       {Case{1, 1.0, {-1e-4 * 400.0, 0.0, 0.0}}, Case{1, -1.0, {1e-4 * 400.0, 0.0, 0.0}},
        Case{kSpunFan, 2.25, {0.0, 1e-4 * 300.0, 0.0}},
        Case{kSpunLift, 0.5, {0.0, 0.0, 2e-4 * 450.0}},
        Case{kSpunScrew, 30.0, {0.6 * of_screw, 0.0, 0.8 * of_screw}}}) {
    Simulation simulation(parsed(rotorCraft("spatial")));
    SimulationState state = simulation.state();
    state.engines[0][one.id].thrust = one.level;
    simulation.restore(state);  // at rest in its total momentum
    const Vector3 w = simulation.motion(0).twist.w_WB;
    const Vector3 expected = {-one.momentum_B.x() / 0.03, -one.momentum_B.y() / 0.04,
                              -one.momentum_B.z() / 0.05};
    EXPECT_LT(norm(w - expected), 1e-13) << one.id;
  }
}

TEST(RotorCraft, KeepsItsMomentumToTheLastBit) {
  std::string text = rotorCraft("spatial") +
                     "    initial: {angular_velocity: [0.3, 0.2, -0.4], velocity: [1, 2, 3]}\n";
  Simulation simulation(parsed(text));
  const Motion start = simulation.motion(0);
  EXPECT_LT(norm(start.twist.w_WB - Vector3(0.3, 0.2, -0.4)), 1e-15);
  spin(simulation, kSpunLift, 1.0);
  for (int i = 0; i < 2000; ++i) {
    if (i % 100 == 0) spin(simulation, kSpunScrew, i % 200 == 0 ? 80.0 : -5.0);
    simulation.step();
  }
  EXPECT_EQ(simulation.motion(0).angular_momentum_W, start.angular_momentum_W);
  EXPECT_GT(norm(simulation.motion(0).twist.w_WB - start.twist.w_WB), 1.0);
}

TEST(RotorCraft, MovesAsItIsSetWhileItsRotorsTurn) {
  for (const char* model : {"planar", "spatial"}) {
    Simulation simulation(parsed(rotorCraft(model)));
    spin(simulation, kSpunLift, 1.0);
    for (int i = 0; i < 300; ++i) simulation.step();
    const Quaternion q_WB = quaternionFromRpy({0.0, 0.0, 0.7});
    const Twist twist = {{1.0, 2.0, 0.0}, {0.0, 0.0, 0.5}};
    simulation.setMotion(0, {1.0, 0.0, 0.0}, q_WB, twist);
    EXPECT_NEAR(simulation.motion(0).twist.w_WB.z(), 0.5, 1e-14);
    EXPECT_NEAR(simulation.motion(0).energy, 0.5 * 2.0 * 5.0 + 0.5 * 0.05 * 0.25, 1e-13);
  }
}

TEST(RotorCraft, GoesThroughASnapshotAndIsWrittenAsItIsRead) {
  const Scenario scenario = parsed(rotorCraft("spatial"));
  EXPECT_EQ(toYaml(parsed(toYaml(scenario))), toYaml(scenario));
  Simulation whole(scenario);
  spin(whole, kSpunLift, 1.0);
  spin(whole, kSpunFan, 5.0);
  for (int i = 0; i < 50; ++i) whole.step();
  Simulation resumed(scenario);
  resumed.restore(parseSnapshot(toSnapshot(whole), "snap.yaml", scenario));
  for (int i = 0; i < 50; ++i) {
    whole.step();
    resumed.step();
  }
  EXPECT_EQ(resumed.hash(), whole.hash());
  EXPECT_EQ(resumed.motion(0).twist.w_WB, whole.motion(0).twist.w_WB);
}

// Its total momentum is that of its rotor alone: a contact that took it for the craft's own would
// stop it, and a gyroscope too would read a turn.
TEST(RotorCraft, RestsOnTheGroundAndItsGyroscopeReadsNothing) {
  const std::string text =
      "step_size: 0.001\nmodel: spatial\ngravity: [0, 0, -9.81]\nvehicles:\n  craft:\n    parts:\n"
      "      - {box: {size: [0.4, 0.3, 0.1]}, mass: 2}\n    actuators:\n      lift: {kind: "
      "lift_fan, "
      "rotor_inertia: 2e-4, rotor_speed: 900}\n    initial: {position: [0, 0, 0.05]}\n"
      "    sensors:\n      imu: {kind: imu, rate: 100}\nworld:\n  obstacles:\n    floor: {box: "
      "{size: "
      "[4, 4, 1]}, position: [0, 0, -0.5]}\n";
  Simulation simulation(parsed(text));
  double turn = 0.0;
  std::size_t samples = 0;
  RunCallbacks told;
  simulation.observe(&told);
  told.on_sample = [&](const SensorSample& sample) {
    ++samples;
    // Angular velocity, then specific force.
    for (std::size_t i = 0; i < 3; ++i) turn = std::max(turn, std::abs(sample.values[i]));
  };
  for (int i = 0; i < 1000; ++i) simulation.step();
  EXPECT_GT(norm(simulation.motion(0).angular_momentum_W), 0.17);
  EXPECT_LT(norm(simulation.motion(0).twist.w_WB), 1e-6);
  EXPECT_LT(std::abs(simulation.motion(0).q_WB.v.z()), 1e-6);
  EXPECT_LT(std::abs(simulation.motion(0).p_WB.x()), 1e-6);
  EXPECT_EQ(samples, 100U);
  EXPECT_LT(turn, 1e-5);
}

TEST(RotorCraft, IsRefusedByKeyAndRule) {
  const auto complaint = [](const std::string& old_part, const std::string& new_part) {
    return complaintAbout(with(rotorCraft("spatial"), old_part, new_part));
  };
  EXPECT_EQ(complaint("rotor_inertia: 2e-4, rotor_speed: 900", "rotor_inertia: 2e-4"),
            "test.yaml: vehicles.craft.actuators.lift.rotor_speed: the key is missing");
  EXPECT_NE(complaint("rotor_inertia: 2e-4, rotor_speed: 900", "rotor_speed: 900")
                .find("lift.rotor_speed = 900: has a meaning with"),
            std::string::npos);
  EXPECT_NE(complaint("rotor_speed: 900", "rotor_speed: 0").find("must be greater than 0"),
            std::string::npos);
  EXPECT_NE(complaint("rotor_inertia: 2e-4", "rotor_inertia: -1").find("must be 0 or greater"),
            std::string::npos);
  EXPECT_NE(complaint("rotor_speed: 900", "rotor_speed: 900, axis: [0, 0, 2]")
                .find("lift.axis = [0, 0, 2]: must have length 1"),
            std::string::npos);
  EXPECT_NE(complaint("rotor_speed: 800, rotation: left", "rotor_speed: 800, rotation: up")
                .find("left.rotation = up: must be one of: right, left"),
            std::string::npos);
  EXPECT_NE(
      complaint("rotor_inertia: 2e-4, rotor_speed: 900", "rotor_inertia: 1e300, rotor_speed: 1e300")
          .find("must be finite"),
      std::string::npos);
}

}  // namespace
}  // namespace hovercraft
