#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/vehicle_messages.h"

#include "../support/scenario_text.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Simulation;
using hovercraft::Vector3;

const ros::Time kStampOfAll(1234, 56000000);

/// A spatial craft with its centre of mass off base_link's origin, some steps into a driven flight.
Simulation flownSimulation() {
  Simulation simulation(hovercraft::testing::parsed(hovercraft::testing::validScenario()));
  simulation.push({0, 0, hovercraft::kAllEngines, {9.0, 0.5, 0.25}});
  for (int i = 0; i < 25; ++i) simulation.step();
  return simulation;
}

TEST(VehicleMessages, StampIsEpochPlusTimeInWholeNanoseconds) {
  EXPECT_EQ(stampOf(ros::Time(), 1), ros::Time(0, 1));
  EXPECT_EQ(stampOf(ros::Time(10, 999999999), 1), ros::Time(11, 0));
  // Four years, beyond 32 bits of seconds in nanoseconds and the 53 bits of a double.
  EXPECT_EQ(stampOf(ros::Time(1700000000, 123456789), 126230400000000001),
            ros::Time(1826230400, 123456790));
}

TEST(VehicleMessages, EveryHeaderHasTheStampAndItsFrame) {
  const Simulation simulation = flownSimulation();
  VehicleMessages messages(simulation.scenario(), 0, {"map", ""});
  messages.fill(simulation, {kStampOfAll});
  const std::vector<const std_msgs::Header*> in_world = {
      &messages.pose().header, &messages.odom().header, &messages.transform().header,
      &messages.state().header};
  for (const std_msgs::Header* header : in_world) {
    EXPECT_EQ(header->stamp, kStampOfAll);
    EXPECT_EQ(header->frame_id, "map");
  }
  for (const std_msgs::Header* header : {&messages.twist().header, &messages.engines().header}) {
    EXPECT_EQ(header->stamp, kStampOfAll);
    EXPECT_EQ(header->frame_id, "alpha/base_link");
  }
  EXPECT_EQ(messages.odom().child_frame_id, "alpha/base_link");
  EXPECT_EQ(messages.transform().child_frame_id, "alpha/base_link");
  EXPECT_EQ(messages.name(), "alpha");
}

TEST(VehicleMessages, WhatIsNotWantedIsNotFilled) {
  const Simulation simulation = flownSimulation();
  const VehicleMessages empty(simulation.scenario(), 0);
  VehicleMessages whole(simulation.scenario(), 0);
  whole.fill(simulation, {kStampOfAll});
  VehicleMessages messages(simulation.scenario(), 0);
  MessageParts parts;
  parts.state = true;
  messages.fill(simulation, {kStampOfAll}, parts);
  EXPECT_EQ(messages.state(), whole.state());
  EXPECT_EQ(messages.odom(), empty.odom());
  EXPECT_EQ(messages.engines(), empty.engines());
  EXPECT_EQ(messages.wind(), empty.wind());
  parts = MessageParts();
  parts.frames = parts.wind = true;
  messages = VehicleMessages(simulation.scenario(), 0);
  messages.fill(simulation, {kStampOfAll}, parts);
  EXPECT_EQ(messages.odom(), whole.odom());
  EXPECT_EQ(messages.pose(), whole.pose());
  EXPECT_EQ(messages.transform(), whole.transform());
  EXPECT_EQ(messages.wind(), whole.wind());
  EXPECT_EQ(messages.state(), empty.state());
}

TEST(VehicleMessages, EveryFrameButTheWorldHasThePrefix) {
  const Simulation simulation = flownSimulation();
  VehicleMessages messages(simulation.scenario(), 0, {"map", "fleet/red"});
  messages.fill(simulation, {kStampOfAll});
  for (const std_msgs::Header* header : {&messages.pose().header, &messages.odom().header,
                                         &messages.transform().header, &messages.state().header}) {
    EXPECT_EQ(header->frame_id, "map");
  }
  const std::string base = "fleet/red/alpha/base_link";
  EXPECT_EQ(messages.twist().header.frame_id, base);
  EXPECT_EQ(messages.engines().header.frame_id, base);
  EXPECT_EQ(messages.appliedCommand({}, {kStampOfAll}).header.frame_id, base);
  EXPECT_EQ(messages.odom().child_frame_id, base);
  EXPECT_EQ(messages.transform().child_frame_id, base);
  const auto engines = messages.engineFrames(kStampOfAll);
  ASSERT_EQ(engines.size(), 3U);
  for (const auto& engine : engines) EXPECT_EQ(engine.header.frame_id, base);
  EXPECT_EQ(engines[0].child_frame_id, "fleet/red/alpha/engine_rear");
  EXPECT_EQ(engines[1].child_frame_id, "fleet/red/alpha/engine_left");
  EXPECT_EQ(engines[2].child_frame_id, "fleet/red/alpha/engine_right");
  EXPECT_EQ(prefixOf(base, "alpha"), "fleet/red");
  EXPECT_EQ(prefixOf("alpha/base_link", "alpha"), "");
  EXPECT_EQ(prefixOf("beta/base_link", "alpha"), "");
  EXPECT_EQ(prefixOf("", "alpha"), "");
}

TEST(VehicleMessages, TheWorldFrameIsCalledWorldIfNothingElseIsSaid) {
  const Simulation simulation = flownSimulation();
  EXPECT_EQ(VehicleMessages(simulation.scenario(), 0).pose().header.frame_id, "world");
}

TEST(VehicleMessages, TheStateHasEveryNumberAsTheSimulationHoldsIt) {
  const Simulation simulation = flownSimulation();
  VehicleMessages messages(simulation.scenario(), 0);
  messages.fill(simulation, {kStampOfAll, 3, 7});
  const hovercraft_sim::State& state = messages.state();
  const hovercraft::Motion motion = simulation.motion(0);
  EXPECT_EQ(state.tick, 25U);
  EXPECT_EQ(state.episode, 3U);
  EXPECT_EQ(state.commands, 0U);
  EXPECT_EQ(state.events, 7U);
  EXPECT_EQ(fromMessage(state.pose.position), motion.p_WB);
  EXPECT_EQ(fromMessage(state.pose.orientation).s, motion.q_WB.s);
  EXPECT_EQ(fromMessage(state.pose.orientation).v, motion.q_WB.v);
  EXPECT_EQ(fromMessage(state.velocity), motion.twist.v_WB);
  EXPECT_EQ(fromMessage(state.angular_velocity), motion.twist.w_WB);
  EXPECT_EQ(fromMessage(state.momentum), motion.momentum_W);
  EXPECT_EQ(fromMessage(state.angular_momentum), motion.angular_momentum_W);
  EXPECT_EQ(state.energy, motion.energy);
  EXPECT_EQ(state.hash, simulation.hash(0));
  for (int i = 0; i < hovercraft::kEngineCount; ++i) {
    const double applied = simulation.engineReport(0, i).applied;
    EXPECT_GT(applied, 0.0);
    EXPECT_EQ(state.thrust[static_cast<std::size_t>(i)], applied);
  }
}

TEST(VehicleMessages, PoseOdomAndTransformAreThoseOfBaseLink) {
  const Simulation simulation = flownSimulation();
  VehicleMessages messages(simulation.scenario(), 0);
  messages.fill(simulation, {kStampOfAll});
  const HullMotion hull = hullMotion(simulation.motion(0), Vector3(0.01, 0.02, 0.03));
  EXPECT_NE(hull.p_WH, simulation.motion(0).p_WB);
  EXPECT_EQ(fromMessage(messages.pose().pose.position), hull.p_WH);
  EXPECT_EQ(fromMessage(messages.pose().pose.orientation).v, hull.q_WH.v);
  EXPECT_EQ(messages.odom().pose.pose, messages.pose().pose);
  EXPECT_EQ(fromMessage(messages.transform().transform.translation), hull.p_WH);
  EXPECT_EQ(messages.transform().transform.rotation, messages.pose().pose.orientation);
  EXPECT_EQ(fromMessage(messages.twist().twist.linear), hull.v_WH_H);
  EXPECT_EQ(fromMessage(messages.twist().twist.angular), hull.w_WH_H);
  EXPECT_EQ(messages.odom().twist.twist, messages.twist().twist);
}

TEST(VehicleMessages, EachEngineReportsForItself) {
  const Simulation simulation = flownSimulation();
  VehicleMessages messages(simulation.scenario(), 0);
  messages.fill(simulation, {kStampOfAll});
  EXPECT_EQ(messages.engines().rear, toMessage(simulation.engineReport(0, 0)));
  EXPECT_EQ(messages.engines().left, toMessage(simulation.engineReport(0, 1)));
  EXPECT_EQ(messages.engines().right, toMessage(simulation.engineReport(0, 2)));
  EXPECT_EQ(messages.engines().rear.commanded, 9.0);
  EXPECT_TRUE(messages.engines().rear.saturated);
  EXPECT_EQ(messages.engines().left.applied, 0.5);
  EXPECT_EQ(messages.engines().right.applied, 0.25);
}

TEST(VehicleMessages, AnAppliedCommandCarriesStampFrameEpisodeAndNumber) {
  const Simulation simulation = flownSimulation();
  VehicleMessages messages(simulation.scenario(), 0);
  const hovercraft::Command command = {
      25, 0, hovercraft::maskOf(hovercraft::EngineId::kLeft), {0.5, 1.0, 0.25}};
  const hovercraft_sim::AppliedCommand message = messages.appliedCommand(command, {kStampOfAll, 4});
  EXPECT_EQ(message.header.stamp, kStampOfAll);
  EXPECT_EQ(message.header.frame_id, "alpha/base_link");
  EXPECT_EQ(message.episode, 4U);
  EXPECT_EQ(message.tick, 25U);
  EXPECT_EQ(message.engines, hovercraft_sim::AppliedCommand::LEFT);
  EXPECT_EQ(message.rear, 0.5);  // as it was sent, whatever the mask
  EXPECT_EQ(message.left, 1.0);
  EXPECT_EQ(message.right, 0.25);
  EXPECT_EQ(message.number, 1U);
  EXPECT_EQ(messages.appliedCommand(command, {kStampOfAll, 4}).number, 2U);
  messages.fill(simulation, {kStampOfAll, 4});
  EXPECT_EQ(messages.state().commands, 2U);
  messages.fill(simulation, {kStampOfAll, 5});
  EXPECT_EQ(messages.state().commands, 0U);
  EXPECT_EQ(messages.appliedCommand(command, {kStampOfAll, 5}).number, 1U);
}

TEST(VehicleMessages, EngineFramesLieAtTheEnginesAndPointAlongTheThrust) {
  const Simulation simulation = flownSimulation();
  const VehicleMessages messages(simulation.scenario(), 0);
  const auto frames = messages.engineFrames(kStampOfAll);
  ASSERT_EQ(frames.size(), 3U);
  const std::vector<std::string> names = {"alpha/engine_rear", "alpha/engine_left",
                                          "alpha/engine_right"};
  const std::vector<Vector3> positions = {{-0.25, 0, 0.05}, {0.2, 0.15, 0.05}, {0.2, -0.15, 0.05}};
  const std::vector<Vector3> directions = {{1, 0, 0}, {0, -1, 0}, {0, 0.6, 0.8}};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].header.stamp, kStampOfAll);
    EXPECT_EQ(frames[i].header.frame_id, "alpha/base_link");
    EXPECT_EQ(frames[i].child_frame_id, names[i]);
    EXPECT_EQ(fromMessage(frames[i].transform.translation), positions[i]);
    const Vector3 x =
        hovercraft::rotate(fromMessage(frames[i].transform.rotation), Vector3(Vector3::UnitX()));
    EXPECT_LT(hovercraft::norm(x - directions[i]), 1e-15) << names[i];
  }
}

TEST(VehicleMessages, AVehicleThatIsNotInTheScenarioIsAMistakeOfTheCaller) {
  const Simulation simulation = flownSimulation();
  EXPECT_THROW(VehicleMessages(simulation.scenario(), 1), std::out_of_range);
}

}  // namespace
}  // namespace hovercraft_ros
