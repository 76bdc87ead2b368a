#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/messages/run_events.h"
#include "hovercraft_sim/messages/vehicle_messages.h"
#include "hovercraft_sim/view/actuator_markers.h"

#include "../support/files.h"
#include "../support/scenarios.h"

/// Faults of actuators as events, in status and state, and what RViz shows of them.

namespace hovercraft_ros {
namespace {

using hovercraft::Simulation;
using hovercraft::testing::messageOf;
using hovercraft::testing::scenarioOf;
using hovercraft_sim::RunEvent;
using visualization_msgs::Marker;

hovercraft::Scenario steeredCraft() {
  return scenarioOf(
      "step_size: 0.01\nmodel: planar\nvehicles:\n  craft:\n    mass: 2\n    inertia: {ixx: 1, "
      "iyy: 1, izz: 1}\n    engines:\n      left: {position: [0, 1, 0], direction: [1, 0, 0], "
      "min_thrust: 0, max_thrust: 4}\n    actuators:\n      fan: {kind: fan, position: [-1, 0, "
      "0.5], "
      "direction: [0, 1, 0], min_thrust: -2, max_thrust: 4, initial: 2}\n      tail: {kind: "
      "rudder, "
      "position: [-2, 0, 0], area: 0.25, lift_slope: 3, initial: 0.4}\n");
}

hovercraft_sim::SetActuator::Request fault(const std::string& name, double efficiency,
                                           bool stuck = false) {
  hovercraft_sim::SetActuator::Request request;
  request.vehicle = "craft";
  request.name = name;
  request.efficiency = efficiency;
  request.stuck = static_cast<std::uint8_t>(stuck ? 1 : 0);
  return request;
}

TEST(ActuatorEvents, AreThoseOfAnActuatorOfTheCraft) {
  const hovercraft::Scenario scenario = steeredCraft();
  const auto complaint = [&](const hovercraft_sim::SetActuator::Request& request) {
    return messageOf([&] { setActuatorEvent(scenario, request); });
  };
  EXPECT_EQ(complaint(fault("fan", 0.5)), "nothing was thrown");
  EXPECT_EQ(complaint(fault("left", 0.0, true)), "nothing was thrown");
  EXPECT_EQ(complaint(fault("rear", 0.5)), "name = rear: must be one of: left, fan, tail");
  EXPECT_EQ(complaint(fault("", 0.5)), "name = : must be one of: left, fan, tail");
  EXPECT_EQ(complaint(fault("fan", 1.5)), "efficiency = 1.5: must be 0 to 1");
  EXPECT_EQ(complaint(fault("fan", -0.1)), "efficiency = -0.1: must be 0 to 1");
  EXPECT_EQ(complaint(fault("fan", std::numeric_limits<double>::quiet_NaN())),
            "efficiency = nan: must be 0 to 1");
  auto elsewhere = fault("fan", 0.5);
  elsewhere.vehicle = "other";
  EXPECT_EQ(complaint(elsewhere), "vehicle = other: must be one of: craft");
}

TEST(ActuatorEvents, ActWhenTheyAreAppliedAndOnlyIfTheyAreWhole) {
  Simulation simulation(steeredCraft());
  const RunEvent event = setActuatorEvent(simulation.scenario(), fault("fan", 0.25, true));
  EXPECT_EQ(event.kind, kSetActuator);
  applyEvent(event, simulation);
  EXPECT_EQ(simulation.engineReport(0, 3).efficiency, 0.25);
  EXPECT_TRUE(simulation.engineReport(0, 3).stuck);
  const std::uint64_t hash = simulation.hash();
  const auto refused = [&](auto change) {
    RunEvent bad = event;
    change(bad);
    EXPECT_FALSE(isFault(bad) && bad.name == "fan");
    return messageOf([&] { applyEvent(bad, simulation); });
  };
  EXPECT_EQ(refused([](RunEvent& bad) { bad.values.pop_back(); }), kFaultRuleText);
  EXPECT_EQ(refused([](RunEvent& bad) { bad.values[0] = 1.25; }), kFaultRuleText);
  EXPECT_EQ(refused([](RunEvent& bad) { bad.values[1] = 0.5; }), kFaultRuleText);
  EXPECT_EQ(refused([](RunEvent& bad) { bad.name.clear(); }), kFaultRuleText);
  EXPECT_EQ(refused([](RunEvent& bad) { bad.name = "sail"; }),
            "name = sail: must be one of: left, fan, tail");
  EXPECT_EQ(simulation.hash(), hash);
}

TEST(ActuatorEvents, StandInStatusAndState) {
  Simulation simulation(steeredCraft());
  VehicleMessages messages(simulation.scenario(), 0);
  messages.fill(simulation, {});
  EXPECT_TRUE(messages.state().extra.empty());
  EXPECT_EQ(messages.actuators().actuators[0].efficiency, 1.0);
  applyEvent(setActuatorEvent(simulation.scenario(), fault("fan", 0.25)), simulation);
  applyEvent(setActuatorEvent(simulation.scenario(), fault("left", 1.0, true)), simulation);
  messages.fill(simulation, {});
  EXPECT_EQ(messages.actuators().actuators[0].efficiency, 0.25);
  EXPECT_EQ(messages.actuators().actuators[0].stuck, 0);
  EXPECT_EQ(messages.state().extra,
            (std::vector<double>{1.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.25, 0.0, 1.0, 0.0}));
}

TEST(ActuatorMarkers, ShowThrustsAsSharesAndRuddersAtTheirAngles) {
  const hovercraft::Scenario scenario = steeredCraft();
  Simulation simulation(scenario);
  VehicleMessages messages(scenario, 0);
  messages.fill(simulation, {});
  const auto markers = actuatorMarkers(scenario.vehicles[0], messages.actuators());
  ASSERT_EQ(markers.size(), 3U);
  EXPECT_EQ(markers[0].type, Marker::CYLINDER);
  EXPECT_EQ(markers[0].pose.position.z, 0.5);
  EXPECT_EQ(markers[1].ns, "craft/actuator_thrust");
  EXPECT_EQ(markers[1].action, Marker::ADD);
  EXPECT_NEAR(markers[1].points[1].y, 0.4, 1e-15);  // half of 4 N, which 0.8 m stand for
  EXPECT_EQ(markers[2].type, Marker::CUBE);
  EXPECT_EQ(markers[2].scale.x, 0.5);  // the root of its area
  EXPECT_NEAR(markers[2].pose.orientation.z, std::sin(0.2), 1e-12);
  const auto without = actuatorMarkers(scenario.vehicles[0], {});
  EXPECT_EQ(without[1].action, Marker::DELETE);
  EXPECT_EQ(without[2].pose.orientation.z, 0.0);

  applyEvent(setActuatorEvent(scenario, fault("fan", 0.5)), simulation);
  messages.fill(simulation, {});
  const auto broken = actuatorMarkers(scenario.vehicles[0], messages.actuators());
  EXPECT_NE(broken[1].color.b, markers[1].color.b);
  EXPECT_EQ(broken[2].color.b, markers[2].color.b);
}

}  // namespace
}  // namespace hovercraft_ros
