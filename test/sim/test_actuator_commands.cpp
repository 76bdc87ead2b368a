#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/actuator_topics.h"
#include "hovercraft_sim/scenario/pilot_parser.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/velocity_parameters.h"
#include "hovercraft_sim/scenario/yaml_text.h"
#include "hovercraft_sim/sim/craft_pilot.h"
#include "hovercraft_sim/sim/simulation.h"

#include "../support/scenario_text.h"

namespace hovercraft {
namespace {

using testing::complaintAbout;
using testing::parsed;
using testing::with;

/// An engine and three actuators, whose commands are no levels.
std::string boat() {
  return "step_size: 0.01\nmodel: planar\nvehicles:\n  wamv:\n    mass: 180\n"
         "    inertia: {ixx: 100, iyy: 200, izz: 250}\n"
         "    engines:\n"
         "      rear: {position: [-2, 0, 0], direction: [1, 0, 0], min_thrust: -80, max_thrust: "
         "200, command: normalized, type: float32, topic: thrusters/middle_thrust_cmd}\n"
         "    actuators:\n"
         "      port: {kind: fan, position: [-2, 1, 0], direction: [1, 0, 0], min_thrust: -100, "
         "max_thrust: 250, command: normalized, type: float32, topic: thrusters/left_thrust_cmd, "
         "thrust_table: {command: [-1, -0.1, 0.1, 1], thrust: [-90, 0, 0, 240]}}\n"
         "      screw: {kind: propeller, position: [-2, 0, 0], direction: [1, 0, 0], min_speed: "
         "-50, max_speed: 100, diameter: 0.4, thrust_coefficients: [0.1, 0, 0], command: "
         "normalized}\n"
         "      tail: {kind: rudder, position: [-2, -1, 0], area: 0.1, lift_slope: 3, max_angle: "
         "0.4, command: normalized, topic: /helm/angle}\n";
}

constexpr std::size_t kBoatPort = 3;
constexpr std::size_t kBoatScrew = 4;
constexpr std::size_t kBoatTail = 5;

Command boatCommand(double rear, double port, double screw, double tail) {
  Command command{0, 0, 0, {rear, 0.0, 0.0, port, screw, tail}};
  for (const std::size_t id : {std::size_t{0}, kBoatPort, kBoatScrew, kBoatTail}) {
    command.engines = static_cast<EngineMask>(command.engines | maskOf(id));
  }
  return command;
}

TEST(ActuatorCommands, OfEachKindMayBeSharesOfItsLimits) {
  Simulation simulation(parsed(boat()));
  simulation.push(boatCommand(-0.5, 0.55, -0.5, 0.25));
  simulation.step();
  EXPECT_EQ(simulation.engineReport(0, 0).applied, -40.0);
  EXPECT_EQ(simulation.engineReport(0, 0).commanded, -0.5);
  EXPECT_NEAR(simulation.engineReport(0, kBoatPort).applied, 120.0, 1e-12);
  EXPECT_EQ(simulation.engineReport(0, kBoatScrew).applied, -25.0);
  EXPECT_EQ(simulation.engineReport(0, kBoatTail).applied, 0.1);
  for (const int id : {0, 3, 4, 5}) EXPECT_FALSE(simulation.engineReport(0, id).saturated) << id;
  Command too_much = boatCommand(1.5, -2.0, 3.0, -1.01);
  too_much.tick = 1;
  simulation.push(too_much);
  simulation.step();
  EXPECT_EQ(simulation.engineReport(0, 0).applied, 200.0);
  EXPECT_EQ(simulation.engineReport(0, kBoatPort).applied, -90.0);
  EXPECT_EQ(simulation.engineReport(0, kBoatScrew).applied, 100.0);
  EXPECT_EQ(simulation.engineReport(0, kBoatTail).applied, -0.4);
  for (const int id : {0, 3, 4, 5}) EXPECT_TRUE(simulation.engineReport(0, id).saturated) << id;
}

TEST(ActuatorCommands, AreWrittenAsTheyAreRead) {
  const Scenario scenario = parsed(boat());
  const std::string text = toYaml(scenario);
  EXPECT_EQ(toYaml(parsed(text)), text);
  EXPECT_NE(text.find("topic: \"thrusters/middle_thrust_cmd\""), std::string::npos) << text;
  EXPECT_NE(text.find("type: float32"), std::string::npos);
  EXPECT_NE(text.find("command: normalized"), std::string::npos);
  const Scenario read = parsed(text);
  const VehicleScenario& craft = read.vehicles[0];
  EXPECT_EQ(craft.actuators[0].motion.command.table.size(), 4U);
  EXPECT_TRUE(isFloat32(craft, 0));
  EXPECT_TRUE(isFloat32(craft, kBoatPort));
  EXPECT_FALSE(isFloat32(craft, kBoatScrew));
  EXPECT_EQ(absoluteTopic(craft, commandTopicOf(craft, 0)), "/wamv/thrusters/middle_thrust_cmd");
  EXPECT_EQ(absoluteTopic(craft, commandTopicOf(craft, kBoatScrew)), "/wamv/actuators/screw");
  EXPECT_EQ(absoluteTopic(craft, commandTopicOf(craft, kBoatTail)), "/helm/angle");
}

std::string boatComplaint(const std::string& old_part, const std::string& new_part) {
  return complaintAbout(with(boat(), old_part, new_part));
}

TEST(ActuatorCommands, AreRefusedByKeyAndRule) {
  const std::string port = "test.yaml: vehicles.wamv.actuators.port.";
  const std::string knots = "command: [-1, -0.1, 0.1, 1], thrust: [-90, 0, 0, 240]";
  const auto table = [&](const std::string& text) { return boatComplaint(knots, text); };
  EXPECT_EQ(table("command: [0], thrust: [1]"),
            port + "thrust_table.command = [0]: must be two numbers or more");
  EXPECT_EQ(table("command: [0, 1], thrust: [1]"),
            port + "thrust_table.thrust = [1]: must be as many numbers as of command, 2");
  for (const char* second : {"0.5", "0.4"}) {
    EXPECT_NE(
        table(std::string("command: [0.5, ") + second + "], thrust: [1, 2]")
            .find("thrust_table.command = [0.5, " + std::string(second) + "]: must rise strictly"),
        std::string::npos);
  }
  EXPECT_NE(table("command: [0, 2], thrust: [1, 2]").find("must be -1 to 1"), std::string::npos);
  EXPECT_NE(table("command: [0, .nan], thrust: [1, 2]").find("thrust_table.command"),
            std::string::npos);
  EXPECT_NE(table("command: [0, 1], thrust: [1, 2e30]").find("thrust_table.thrust"),
            std::string::npos);
  EXPECT_NE(table("command: [0, 1]").find("thrust_table.thrust: the key is missing"),
            std::string::npos);
  EXPECT_NE(boatComplaint("command: normalized, topic: /helm", "command: newton, topic: /helm")
                .find("tail.command = newton: must be one of: radian, normalized"),
            std::string::npos);
  EXPECT_NE(boatComplaint("max_angle: 0.4", "thrust_table: {command: [0, 1], thrust: [0, 1]}")
                .find("unknown key"),
            std::string::npos);
  EXPECT_NE(boatComplaint("type: float32, topic: thrusters/left", "type: int, topic: left")
                .find("type = int: must be one of: float64, float32"),
            std::string::npos);
}

TEST(ActuatorTopics, AreNamesByTheRulesOfRos) {
  for (const char* good : {"a", "a/b", "/a/b_1", "A/1b", "a/_b"}) {
    EXPECT_TRUE(isTopicName(good)) << good;
  }
  for (const char* bad :
       {"", "/", "a/", "//a", "a//b", "1a", "_a", "~a", "a b", "a-b", "a.b", "ä", "/1a", "a/\n"}) {
    EXPECT_FALSE(isTopicName(bad)) << bad;
  }
  EXPECT_NE(boatComplaint("/helm/angle", "helm angle").find("tail.topic = helm angle: must be the"),
            std::string::npos);
}

TEST(ActuatorTopics, AreNotThoseOfSomethingElse) {
  for (const char* taken :
       {"pose", "/wamv/pose", "thrust", "actuators", "actuator_command", "imu/data", "cmd_vel",
        "/tf", "/clock", "/hovercraft_sim/scenario", "thrusters/left_thrust_cmd",
        "/wamv/thrusters/left_thrust_cmd", "actuators/screw"}) {
    const std::string said = boatComplaint("/helm/angle", taken);
    EXPECT_NE(said.find("actuators.tail.topic"), std::string::npos) << taken << ": " << said;
  }
  for (const char* free : {"actuators/rudder", "thrust/left", "/other/pose", "poses"}) {
    EXPECT_EQ(boatComplaint("/helm/angle", free), "nothing was thrown") << free;
  }
  // Of another craft too, also where that has the topic by its name.
  const std::string second =
      "  tug:\n    mass: 1\n    inertia: {ixx: 1, iyy: 1, izz: 1}\n    engines:\n      left: "
      "{position: [0, 0, 0], direction: [1, 0, 0], min_thrust: 0, max_thrust: 1}\n";
  EXPECT_EQ(complaintAbout(boat() + second), "nothing was thrown");
  EXPECT_EQ(complaintAbout(with(boat() + second, "/helm/angle", "/tug/thrust/left")),
            "test.yaml: vehicles.wamv.actuators.tail.topic: its topic would be "
            "/tug/thrust/left, which is the topic of vehicles.tug.engines.left");
}

TEST(ActuatorCommands, OfAPilotAreWhatMakesTheLevelsOfItsFile) {
  const Scenario scenario = parsed(boat());
  const PilotFile file = parsePilot(
      "manoeuvres:\n  - {kind: steps, throttle: {rear: -40, port: 120}, levels: [{tail: 0.1}], "
      "hold: 4}\n",
      "pilot.yaml", scenario);
  CraftPilot pilot(file, scenario.step_ns);
  ObservedMotion motion;
  motion.tick = pilot.periodTicks();
  motion.q_WB = Quaternion{1.0, Vector3::Zero()};
  const Command& command = pilot.decide(motion);
  EXPECT_EQ(command.thrusts[0], -0.5);
  EXPECT_NEAR(command.thrusts[kBoatPort], 0.55, 1e-15);
  EXPECT_EQ(command.thrusts[kBoatTail], 0.25);
}

TEST(ActuatorCommands, OfAVelocityControllerAreInItsParameters) {
  const std::string scenario = with(boat(), "min_speed: -50, ", "min_speed: 0, ");
  const VelocityParameters made = velocityParametersOf(parsed(scenario).vehicles[0]);
  const std::string text = velocityYaml(made, "boat.yaml");
  const VelocityParameters read =
      parseVelocityParameters(ConfigReader(treeOf(text, "boat"), "boat"));
  EXPECT_EQ(velocityYaml(read, "boat.yaml"), text);
  ASSERT_EQ(read.commands.size(), read.plant.actuators.size());
  for (std::size_t i = 0; i < read.commands.size(); ++i) {
    EXPECT_EQ(read.commands[i].unit, CommandUnit::kNormalized) << i;
  }
  EXPECT_EQ(read.commands[1].table.size(), 4U);
}

}  // namespace
}  // namespace hovercraft
