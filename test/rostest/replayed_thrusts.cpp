#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/State.h>

#include "../support/child_process.h"
#include "../support/core_run.h"
#include "../support/pilot.h"
#include "../support/recorded_flight.h"
#include "../support/wait_until.h"
#include "../support/wires.h"

namespace hovercraft_ros::testing {
namespace {

using hovercraft::EngineId;

// replayed_thrusts.yaml
constexpr double kStep = 0.001;        // s
constexpr double kMass = 2.0;          // kg
constexpr double kDrag = 2.5;          // N s/m
constexpr double kInertia = 0.05;      // kg m²
constexpr double kAngularDrag = 0.25;  // N m s
constexpr double kThrust = 3.0;        // N
constexpr double kCouple = 0.5;        // N, of each engine; levers 0.1 m
constexpr double kTorque = 2.0 * 0.1 * kCouple;

constexpr double kTolerance = 1e-11;  // m, rad: roundings of several 1000 steps

/// Where a craft comes to rest when its engines stop, and what its engines did.
struct Outcome {
  double x, y;                              // m
  double yaw;                               // rad
  double rear_time;                         // s for which the rear engine was on
  double couple_time;                       // s for which the couple was on
  std::vector<std::vector<double>> phases;  // thrusts, each time that they changed
};

double yawOf(const geometry_msgs::Quaternion& q) {
  return 2.0 * std::atan2(q.z, q.w);
}

/// m v' = F - c v integrates to m v + c x = ∫F dt: x + m v/c is the place of rest. The same holds
/// for the yaw; a Runge-Kutta method keeps both sums.
Outcome outcomeOf(const Recording& recording) {
  const auto states = recording.messages<hovercraft_sim::State>("/hovercraft/state");
  const hovercraft_sim::State& last = states.at(states.size() - 1);
  Outcome outcome = {};
  outcome.x = last.pose.position.x + kMass * last.velocity.x / kDrag;
  outcome.y = last.pose.position.y + kMass * last.velocity.y / kDrag;
  outcome.yaw = yawOf(last.pose.orientation) + kInertia * last.angular_velocity.z / kAngularDrag;
  std::vector<double> thrusts = {0.0, 0.0, 0.0};
  std::uint64_t since = 0;
  for (const auto& command :
       recording.messages<hovercraft_sim::AppliedCommand>("/hovercraft/commands")) {
    const double held = kStep * static_cast<double>(command.tick - since);
    outcome.rear_time += thrusts[0] > 0.0 ? held : 0.0;
    outcome.couple_time += thrusts[2] > 0.0 ? held : 0.0;
    const std::vector<double> before = thrusts;
    const std::vector<double> received = {command.rear, command.left, command.right};
    for (std::size_t i = 0; i < received.size(); ++i) {
      if ((command.engines & hovercraft::maskOf(static_cast<EngineId>(i))) != 0) {
        thrusts[i] = received[i];
      }
    }
    if (thrusts != before) outcome.phases.push_back(thrusts);
    since = command.tick;
  }
  return outcome;
}

void expectAtItsPlaceOfRest(const Outcome& outcome) {
  EXPECT_NEAR(outcome.x, kThrust * outcome.rear_time / kDrag, kTolerance);
  EXPECT_NEAR(outcome.y, 0.0, kTolerance);
  EXPECT_NEAR(outcome.yaw, kTorque * outcome.couple_time / kAngularDrag, kTolerance);
}

/// Straight on, stop, turn, stop.
void flyManoeuvre(Pilot& pilot) {
  pilot.command(EngineId::kRear, kThrust);
  pilot.waitFor("is driven", [](const auto& state) { return state.thrust[0] > 0.0; });
  pilot.waitFor(500);
  pilot.command(EngineId::kRear, 0.0);
  pilot.waitFor("is driven no more", [](const auto& state) { return state.thrust[0] == 0.0; });
  pilot.flyFor(300, {0.0, -kCouple, kCouple});
  pilot.flyUntil("stops", {0.0, 0.0, 0.0},
                 [](const auto& state) { return state.thrust[2] == 0.0; });
}

TEST(Replay, ARecordedBagFliesTheSamePhasesAgain) {
  std::vector<std::string> topics = outputTopics({"hovercraft"});
  topics.insert(topics.end(), {"/hovercraft/thrust", "/hovercraft/thrust/rear"});
  Pilot pilot("hovercraft");
  RecordedFlight flight(topics);
  flyManoeuvre(pilot);
  const Recording flown = flight.finish();
  const std::uint64_t flown_ticks = pilot.state().tick;

  shutDown(kSimulationNode);
  pilot.waitFor("is back at the beginning",
                [&](const auto& state) { return state.tick < flown_ticks; });
  RecordedFlight second_flight(outputTopics({"hovercraft"}));
  ChildProcess player(
      {"roslaunch", "hovercraft_sim", "replay_commands.launch", "bag:=" + flight.bagPath()});
  waitUntil("rosbag play has played the bag", [&] { return player.hasEnded(); });
  EXPECT_EQ(player.exitStatus(), 0);
  const Recording replayed = second_flight.finish();

  const Outcome first = outcomeOf(flown);
  const Outcome second = outcomeOf(replayed);
  const std::vector<std::vector<double>> phases = {
      {kThrust, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, -kCouple, kCouple}, {0.0, 0.0, 0.0}};
  EXPECT_EQ(first.phases, phases);
  EXPECT_EQ(second.phases, phases);
  // rosbag play keeps wall time, so that each phase may last some ticks more or less, and the place
  // of rest follows from how long each did last.
  expectAtItsPlaceOfRest(first);
  expectAtItsPlaceOfRest(second);
  EXPECT_GT(second.x, 0.1);
  EXPECT_GT(second.yaw, 0.05);
  expectEqualsCoreRun(flown);
  expectEqualsCoreRun(replayed);
}

}  // namespace
}  // namespace hovercraft_ros::testing
