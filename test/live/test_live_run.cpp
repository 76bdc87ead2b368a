#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/live/live_run.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/run_events.h"
#include "hovercraft_sim/sim/run_observer.h"
#include "hovercraft_sim/sim/snapshot.h"

#include "../support/scenario_text.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Scenario;
using hovercraft::Vector3;
using hovercraft::testing::parsed;
using hovercraft::testing::validScenario;
using hovercraft::testing::with;
using hovercraft_sim::ApplyWrench;
using hovercraft_sim::SetState;

constexpr std::int64_t kEpoch = 5000000000;  // ns

/// The valid scenario, its craft held to the plane.
Scenario planarScenario() {
  std::string text = with(validScenario(), "model: spatial", "model: planar");
  text = with(text, "rpy: [0.1, 0.2, 0.3]", "rpy: [0, 0, 0.3]");
  text = with(text, "velocity: [4, 5, 6]", "velocity: [4, 5, 0]");
  return parsed(with(text, "angular_velocity: [0.4, 0.5, 0.6]", "angular_velocity: [0, 0, 0.6]"));
}

SetState::Request stateRequest() {
  SetState::Request request;
  request.vehicle = "alpha";
  request.pose.position = toPointMessage({1.0, 2.0, 3.0});
  request.pose.orientation = toQuaternionMessage(hovercraft::quaternionFromRpy({0.0, 0.0, 0.7}));
  request.twist.linear = toVector3Message({0.5, -0.4, 0.0});
  request.twist.angular = toVector3Message({0.0, 0.0, 0.9});
  return request;
}

ApplyWrench::Request wrenchRequest() {
  ApplyWrench::Request request;
  request.vehicle = "alpha";
  request.wrench.force.x = 1.5;
  request.frame_id = "world";
  request.duration = ros::Duration(0.0031);
  return request;
}

template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

void advance(LiveRun& run, int steps) {
  for (int n = 0; n < steps; ++n) run.simulation().step();
}

TEST(LiveRun, StampIsEpochPlusTicks) {
  LiveRun run(parsed(validScenario()), kEpoch);  // steps of 2 ms
  EXPECT_EQ(run.stamp(), ros::Time(5, 0));
  advance(run, 3);
  EXPECT_EQ(run.stamp(), ros::Time(5, 6000000));
}

/// ROS takes time 0 for no time.
TEST(LiveRun, WhatHappensAtTime0IsStampedAsTick1) {
  LiveRun run(parsed(validScenario()), 0);  // steps of 2 ms
  EXPECT_TRUE(run.stamp().isZero());
  EXPECT_EQ(run.place().stamp.toNSec(), 2000000U);
  EXPECT_EQ(run.apply(resetEvent(1)).header.stamp.toNSec(), 2000000U);
  advance(run, 1);
  EXPECT_EQ(run.place().stamp.toNSec(), 2000000U);
  advance(run, 1);
  EXPECT_EQ(run.place().stamp.toNSec(), 4000000U);
}

TEST(LiveRun, ResetBeginsAnEpisodeWhileTimeGoesOn) {
  LiveRun run(parsed(validScenario()), kEpoch);
  const std::uint64_t fresh = run.simulation().hash();
  advance(run, 250);
  const auto event = run.apply(resetEvent(1));
  EXPECT_EQ(event.tick, 250U);
  EXPECT_EQ(event.episode, 1U);
  EXPECT_EQ(event.header.stamp, ros::Time(5, 500000000));
  EXPECT_EQ(run.episode(), 1U);
  EXPECT_EQ(run.simulation().tick(), 0);
  EXPECT_EQ(run.simulation().hash(), fresh);
  EXPECT_EQ(run.stamp(), ros::Time(5, 500000000));
  advance(run, 1);
  EXPECT_EQ(run.stamp(), ros::Time(5, 502000000));
}

TEST(LiveRun, AResetBringsTheSeedThatItNames) {
  LiveRun run(parsed(validScenario()), kEpoch);
  ASSERT_NE(run.simulation().state().seed, 42);
  run.apply(resetEvent(42));
  EXPECT_EQ(run.simulation().state().seed, 42);
}

TEST(LiveRun, LoadGoesOnFromTheSnapshotsTickWhileTimeGoesOn) {
  const Scenario scenario = parsed(validScenario());
  hovercraft::Simulation saved(scenario);
  for (int n = 0; n < 9000; ++n) saved.step();  // 18 s: longer than the run that loads it is old
  LiveRun run(scenario, 0);
  advance(run, 1);
  run.apply(loadEvent(hovercraft::toSnapshot(saved)));
  EXPECT_EQ(run.episode(), 1U);
  EXPECT_EQ(run.simulation().hash(), saved.hash());
  EXPECT_EQ(run.stamp(), ros::Time(0, 2000000));
  advance(run, 1);
  EXPECT_EQ(run.simulation().tick(), 9001);
  EXPECT_EQ(run.stamp(), ros::Time(0, 4000000));
}

TEST(LiveRun, ARenewedStampIsOneStepLater) {
  LiveRun run(parsed(validScenario()), kEpoch);  // steps of 2 ms
  advance(run, 3);
  run.renewStamp();
  EXPECT_EQ(run.stamp(), ros::Time(5, 8000000));
  EXPECT_EQ(run.simulation().tick(), 3);
  advance(run, 1);
  EXPECT_EQ(run.stamp(), ros::Time(5, 10000000));
}

// A live command takes effect at the next step: it could not be queued behind a later one.
TEST(LiveRun, ASnapshotWithCommandsOfLaterTicksIsRefused) {
  const Scenario scenario = parsed(validScenario());
  hovercraft::Simulation saved(scenario);
  saved.push({0, 0, hovercraft::kAllEngines, {}});
  LiveRun run(scenario, kEpoch);
  run.apply(loadEvent(hovercraft::toSnapshot(saved)));
  EXPECT_TRUE(run.simulation().hasWaitingCommands());
  saved.push({3, 0, hovercraft::kAllEngines, {}});
  EXPECT_EQ(refusal([&] { run.apply(loadEvent(hovercraft::toSnapshot(saved))); }),
            "snapshot: commands: tick = 3: must be that of the snapshot, 0");
}

TEST(LiveRun, AnEventThatIsRefusedChangesNothing) {
  LiveRun run(parsed(validScenario()), kEpoch);
  advance(run, 10);
  const std::uint64_t before = run.simulation().hash();
  EXPECT_THROW(run.apply(loadEvent("no snapshot")), std::invalid_argument);
  hovercraft_sim::RunEvent unknown;
  EXPECT_THROW(run.apply(unknown), std::invalid_argument);
  EXPECT_EQ(run.simulation().hash(), before);
  EXPECT_EQ(run.episode(), 0U);
}

// base_link is off the centre of mass in this scenario: what was asked of base_link must come back
// for base_link.
TEST(RunEvents, SetStateMovesBaseLinkToTheMotionThatWasAsked) {
  const Scenario scenario = planarScenario();
  LiveRun run(scenario, kEpoch);
  run.apply(setStateEvent(scenario, stateRequest()));
  const HullMotion hull =
      hullMotion(run.simulation().motion(0), scenario.vehicles[0].mass_properties.p_HB);
  EXPECT_LT(hovercraft::norm(hull.p_WH - Vector3(1.0, 2.0, 3.0)), 1e-15);
  EXPECT_LT(hovercraft::norm(hull.v_WH_H - Vector3(0.5, -0.4, 0.0)), 1e-15);
  EXPECT_LT(hovercraft::norm(hull.w_WH_H - Vector3(0.0, 0.0, 0.9)), 1e-15);
}

// The drag of this craft, 0.4 N s²/m² in steps of 2 ms, diverges from some 1e4 m/s on.
TEST(RunEvents, WhatWouldEndTheRunIsRefusedAndChangesNothing) {
  const Scenario scenario = planarScenario();
  LiveRun run(scenario, kEpoch);
  advance(run, 10);
  const std::uint64_t before = run.simulation().hash();
  const auto complaint = [&](const hovercraft_sim::RunEvent& event) {
    return refusal([&] { run.apply(event); });
  };
  const std::string start =
      "it would end the run within 50 steps: vehicles.alpha: the motion diverges (";
  SetState::Request motion = stateRequest();
  motion.twist.linear.x = 1e6;
  EXPECT_EQ(complaint(setStateEvent(scenario, motion)).rfind(start, 0), 0U);
  ApplyWrench::Request wrench = wrenchRequest();
  wrench.wrench.force.x = 1e11;
  EXPECT_EQ(complaint(applyWrenchEvent(scenario, wrench, TfFrames(), 10)).rfind(start, 0), 0U);
  hovercraft_sim::SetWind::Request wind;
  wind.wind.x = 1e6;
  EXPECT_EQ(complaint(setWindEvent(wind)).rfind(start, 0), 0U);
  EXPECT_EQ(run.simulation().hash(), before);
  EXPECT_EQ(run.simulation().tick(), 10);
  EXPECT_EQ(run.place().events, 0U);
}

TEST(RunEvents, TheTrialOfOneLeavesNoTrace) {
  const Scenario scenario = parsed(validScenario());
  LiveRun run(scenario, kEpoch);
  hovercraft::Simulation plain(scenario);
  hovercraft::RunCallbacks told;
  int commands = 0;
  told.on_applied = [&commands](const hovercraft::Command& /*command*/) { ++commands; };
  run.simulation().observe(&told);
  run.simulation().push({0, 0, hovercraft::kAllEngines, {1.0, 0.5, 0.25}});
  plain.push({0, 0, hovercraft::kAllEngines, {1.0, 0.5, 0.25}});
  const auto event = applyWrenchEvent(scenario, wrenchRequest(), TfFrames(), 0);
  run.apply(event);
  applyEvent(event, plain);
  EXPECT_EQ(commands, 0);
  EXPECT_EQ(run.simulation().hash(), plain.hash());
  advance(run, 100);
  for (int n = 0; n < 100; ++n) plain.step();
  EXPECT_EQ(commands, 1);
  EXPECT_EQ(run.simulation().hash(), plain.hash());
}

TEST(RunEvents, WhatContactCutsOffInATrialIsNotOfTheRun) {
  // A crate that falls onto a craft, in steps too long for all that happens in them.
  std::string text = with(validScenario(), "step_size: 0.002", "step_size: 1");
  text = with(text, "    engines:", "    hull: {box: {size: [1.6, 0.4, 0.12]}}\n    engines:");
  text = with(text, "position: [1, 2, 3], rpy: [0.1, 0.2, 0.3]", "position: [0, 0, 0.16]");
  text = with(text, ", velocity: [4, 5, 6], angular_velocity: [0.4, 0.5, 0.6]", "");
  LiveRun run(parsed(text + R"(world:
  obstacles:
    floor: {box: {size: [300, 400, 1]}, position: [0, 0, -0.5]}
  bodies:
    crate: {mass: 2, inertia: {ixx: 0.1, iyy: 0.1, izz: 0.1}, hull: {box: {size: [1, 1, 1]}}, initial: {position: [0, 0, 2]}}
)"),
              kEpoch);
  hovercraft_sim::SetWind::Request calm;
  run.apply(setWindEvent(calm));
  EXPECT_GT(run.simulation().world()->stalls(), 0);
  EXPECT_EQ(run.stalls(), 0U);
  const auto in_trial = run.simulation().world()->stalls();
  advance(run, 10);
  const auto in_all = run.simulation().world()->stalls();
  EXPECT_GT(in_all, in_trial);
  EXPECT_EQ(run.stalls(), static_cast<std::uint64_t>(in_all - in_trial));
}

TEST(RunEvents, SpeedsAndForcesHaveBounds) {
  const Scenario scenario = planarScenario();
  const auto of_motion = [&scenario](double v, double w) {
    SetState::Request request = stateRequest();
    request.twist.linear.x = v;
    request.twist.angular.z = w;
    return refusal([&] { setStateEvent(scenario, request); });
  };
  EXPECT_EQ(of_motion(-1e6, 1e6), "");
  EXPECT_EQ(of_motion(1.1e6, 0.0), "twist.linear: must be at most 1e6 m/s, of either sign");
  EXPECT_EQ(of_motion(0.0, -1e9), "twist.angular: must be at most 1e6 rad/s, of either sign");
  const auto of_wrench = [&scenario](double force, double torque) {
    ApplyWrench::Request request = wrenchRequest();
    request.wrench.force.y = force;
    request.wrench.torque.z = torque;
    return refusal([&] { applyWrenchEvent(scenario, request, TfFrames(), 0); });
  };
  EXPECT_EQ(of_wrench(-1e11, 1e11), "");
  EXPECT_EQ(of_wrench(-1e30, 0.0), "wrench.force: must be at most 1e11 N, of either sign");
  EXPECT_EQ(of_wrench(0.0, 1e12), "wrench.torque: must be at most 1e11 N m, of either sign");
}

TEST(RunEvents, APlanarCraftIsNotPushedOutOfItsPlane) {
  const Scenario scenario = planarScenario();
  const auto complaint = [](const Scenario& of, const Vector3& force, const Vector3& torque) {
    ApplyWrench::Request request = wrenchRequest();
    request.wrench.force = toVector3Message(force);
    request.wrench.torque = toVector3Message(torque);
    return refusal([&] { applyWrenchEvent(of, request, TfFrames(), 0); });
  };
  EXPECT_EQ(complaint(scenario, {1.0, 2.0, 0.0}, {0.0, 0.0, 3.0}), "");
  EXPECT_EQ(complaint(scenario, {0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}),
            "wrench.force: the model is planar: z must be 0");
  for (const Vector3& torque : {Vector3(1e-9, 0.0, 0.0), Vector3(0.0, -1.0, 0.0)}) {
    EXPECT_EQ(complaint(scenario, {0.0, 0.0, 0.0}, torque),
              "wrench.torque: the model is planar: x and y must be 0");
  }
  EXPECT_EQ(complaint(parsed(validScenario()), {1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}), "");
}

// What an earlier version has recorded.
TEST(RunEvents, AReplayAppliesWhatNoRequestMayAsk) {
  const Scenario scenario = planarScenario();
  hovercraft::Simulation simulation(scenario);
  hovercraft_sim::RunEvent event = applyWrenchEvent(scenario, wrenchRequest(), TfFrames(), 0);
  event.wrench.force.x = 2e11;
  event.wrench.force.z = 1.0;
  event.wrench.torque.x = 1.0;
  EXPECT_EQ(refusal([&] { applyEvent(event, simulation); }), "");
  event = setStateEvent(scenario, stateRequest());
  event.twist.linear.x = 1e7;
  EXPECT_EQ(refusal([&] { applyEvent(event, simulation); }), "");
}

// 5.5 kg at 1e200 m/s: the square is beyond a double.
TEST(RunEvents, AMotionWithoutFiniteEnergyIsRefused) {
  const Scenario scenario = parsed(validScenario());
  LiveRun run(scenario, kEpoch);
  const std::uint64_t before = run.simulation().hash();
  const std::string complaint = "pose, twist: the momenta and the energy must be finite";
  std::vector<hovercraft_sim::RunEvent> absurd(3, setStateEvent(scenario, stateRequest()));
  absurd[0].twist.linear.x = 1e200;
  absurd[1].twist.angular.z = 1e200;
  absurd[2].twist.linear.y = 1.7e308;
  for (const hovercraft_sim::RunEvent& event : absurd) {
    EXPECT_EQ(refusal([&] { run.apply(event); }), complaint);
  }
  SetState::Request far = stateRequest();
  far.pose.position.y = 1e200;
  EXPECT_EQ(refusal([&] { run.apply(setStateEvent(scenario, far)); }),
            "pose.position: must be at most 1e30 m, of either sign");
  EXPECT_EQ(run.simulation().hash(), before);
}

TEST(RunEvents, SetStateIsRefusedByName) {
  const Scenario scenario = planarScenario();
  const auto complaint = [&scenario](const SetState::Request& request) {
    return refusal([&] { setStateEvent(scenario, request); });
  };
  SetState::Request request = stateRequest();
  EXPECT_EQ(complaint(request), "");
  request.vehicle = "beta";
  EXPECT_EQ(complaint(request), "vehicle = beta: must be one of: alpha");
  request = stateRequest();
  request.pose.position.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaint(request), "pose.position: must be finite");
  request = stateRequest();
  request.twist.angular.z = std::numeric_limits<double>::infinity();
  EXPECT_EQ(complaint(request), "twist.angular: must be finite");
  request = stateRequest();
  request.pose.orientation.w = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaint(request), "pose.orientation: must have length 1 (it has nan)");
  request = stateRequest();
  request.pose.orientation = toQuaternionMessage({0.6, {0.8, 0.0, 0.0}});
  EXPECT_NE(complaint(request).find("the model is planar"), std::string::npos);
  request = stateRequest();
  request.twist.linear.z = 1e-9;
  EXPECT_NE(complaint(request).find("twist.linear: the model is planar"), std::string::npos);
}

TEST(RunEvents, WrenchLastsItsDurationRoundedUpToSteps) {
  const Scenario scenario = planarScenario();  // steps of 2 ms
  EXPECT_EQ(applyWrenchEvent(scenario, wrenchRequest(), TfFrames(), 100).end_tick, 102U);
  ApplyWrench::Request in_body = wrenchRequest();
  in_body.frame_id = "alpha/base_link";
  EXPECT_EQ(applyWrenchEvent(scenario, in_body, TfFrames(), 0).in_body_axes, 1);
  in_body.frame_id = "red/alpha/base_link";
  EXPECT_EQ(applyWrenchEvent(scenario, in_body, {"world", "red"}, 0).in_body_axes, 1);
}

TEST(RunEvents, WrenchIsRefusedByName) {
  const Scenario scenario = planarScenario();
  const auto complaint = [&scenario](const ApplyWrench::Request& request) {
    return refusal([&] { applyWrenchEvent(scenario, request, TfFrames(), 0); });
  };
  ApplyWrench::Request request = wrenchRequest();
  EXPECT_EQ(complaint(request), "");
  request.frame_id = "map";
  EXPECT_EQ(complaint(request), "frame_id = map: must be world or alpha/base_link");
  request = wrenchRequest();
  EXPECT_EQ(refusal([&] {
              applyWrenchEvent(scenario, request, {"map", "red"}, 0);
            }),
            "frame_id = world: must be map or red/alpha/base_link");
  request.duration = ros::Duration(0.0);
  EXPECT_EQ(complaint(request), "duration: must be greater than 0");
  request = wrenchRequest();
  request.wrench.torque.z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaint(request), "wrench.torque: must be finite");
}

}  // namespace
}  // namespace hovercraft_ros
