// Craft on cushions, live and recorded: each scene flies its commands, and its bag is read. The
// flight is that of simulate to the last bit, and so are the messages of the cushion.

#include <algorithm>
#include <cmath>
#include <sstream>
#include <std_srvs/Trigger.h>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <hovercraft_sim/Cushion.h>
#include <hovercraft_sim/State.h>
#include <ros/package.h>
#include <ros/service.h>

#include "hovercraft_sim/bags/replay.h"
#include "hovercraft_sim/bags/simulate.h"
#include "hovercraft_sim/clients/flight_test.h"

#include "../support/recorded_flight.h"

namespace hovercraft_ros::testing {
namespace {

constexpr double kWeight = 5.15 * 9.80665;  // N, of rc5
constexpr double kHoverHeight = 0.053;      // m, of its centre of mass: 50 mm over a gap of 3 mm
constexpr double kPadHeight = 0.042;        // m, on its hull

class Scene {
 public:
  /// Flies the scene with its commands, for `settle` s after the last of them.
  Scene(const std::string& name, double settle) : recording_(fly(name, settle)) {}

  /// The state at or after a time, s.
  const hovercraft_sim::State& at(double time) const {
    const auto found = std::find_if(states_.begin(), states_.end(), [time](const auto& state) {
      return 1e-3 * static_cast<double>(state.tick) >= time;
    });
    EXPECT_NE(found, states_.end());
    return found == states_.end() ? states_.back() : *found;
  }
  /// Force of the cushion at that time, N.
  double force(double time) const {
    double sum = 0.0;
    for (const auto& cell : cushionAt(time).cells) sum += cell.force;
    return sum;
  }
  /// Of the only fan, a share of the nominal speed.
  double fanSpeed(double time) const { return cushionAt(time).fan_speed.at(0); }
  const std::vector<hovercraft_sim::State>& states() const { return states_; }
  const std::vector<hovercraft_sim::Cushion>& cushions() const { return cushions_; }

 private:
  const hovercraft_sim::Cushion& cushionAt(double time) const {
    const ros::Time stamp = at(time).header.stamp;
    const auto found =
        std::find_if(cushions_.begin(), cushions_.end(),
                     [stamp](const auto& cushion) { return cushion.header.stamp == stamp; });
    EXPECT_NE(found, cushions_.end()) << "no cushion at " << time;
    return found == cushions_.end() ? cushions_.back() : *found;
  }
  Recording fly(const std::string& name, double settle) {
    const std::string config = ros::package::getPath("hovercraft_sim") + "/config/" + name;
    const TemporaryFolder folder;
    SimulateRequest request;
    request.scenario = config + ".yaml";
    request.commands = config + ".csv";
    request.output = folder.path() + "/reference.bag";
    request.every = 10;
    request.hold = true;
    std::ostringstream messages;
    simulate(request, messages);
    std::vector<std::string> topics = outputTopics({"rc5"});
    for (const char* topic : {"/rc5/cushion", "/hovercraft_sim/events"}) topics.emplace_back(topic);
    RecordedFlight recorded(topics);
    Flight flight;
    flight.play(config + ".csv", settle);
    EXPECT_TRUE(follows(flight, request.output, {}));
    std_srvs::Trigger resume;  // it was paused at the end of its flight: nothing more would come
    EXPECT_TRUE(ros::service::call("/hovercraft_sim/resume", resume));
    Recording recording = recorded.finish();
    states_ = recording.messages<hovercraft_sim::State>("/rc5/state");
    cushions_ = recording.messages<hovercraft_sim::Cushion>("/rc5/cushion");
    // The simulation runs while the recorder stops: perhaps between the two of the last tick.
    const std::size_t pairs = std::min(states_.size(), cushions_.size());
    EXPECT_LE(std::max(states_.size(), cushions_.size()), pairs + 1);
    states_.resize(pairs);
    cushions_.resize(pairs);
    for (std::size_t i = 0; i < pairs; ++i) {
      EXPECT_EQ(states_[i].header.stamp, cushions_[i].header.stamp);
    }
    compareCushions(Recording(request.output));
    ReplayRequest again;
    again.bag = recorded.bagPath();
    std::string verdict;
    EXPECT_EQ(replayBag(again, verdict), 0) << verdict;
    return recording;
  }

  /// Live and by simulate: cell by cell the same numbers.
  void compareCushions(const Recording& reference) {
    std::size_t compared = 0;
    for (const auto& expected : reference.messages<hovercraft_sim::Cushion>("/rc5/cushion")) {
      const std::int64_t since = (expected.header.stamp - ros::Time()).toNSec();
      for (std::size_t i = 0; i < states_.size(); ++i) {
        if (static_cast<std::int64_t>(states_[i].tick) * 1000000 != since) continue;
        ASSERT_LT(i, cushions_.size());
        ASSERT_EQ(cushions_[i].cells.size(), expected.cells.size());
        EXPECT_EQ(cushions_[i].fan_speed, expected.fan_speed);
        for (std::size_t k = 0; k < expected.cells.size(); ++k) {
          EXPECT_EQ(cushions_[i].cells[k].pressure, expected.cells[k].pressure);
          EXPECT_EQ(cushions_[i].cells[k].gap, expected.cells[k].gap);
        }
        ++compared;
        break;
      }
    }
    EXPECT_GT(compared, 50U);
  }

  std::vector<hovercraft_sim::State> states_;
  std::vector<hovercraft_sim::Cushion> cushions_;
  Recording recording_;
};

TEST(Ramp, IsClimbedAndTheCraftSettlesOnItAndLiftsOffAgain) {
  const Scene scene("ramp", 3.6);
  const auto above = [&](double time) {
    const auto& p = scene.at(time).pose.position;
    return p.z - (p.x > 0.5 ? (p.x - 0.5) * std::tan(0.05) : 0.0);
  };
  EXPECT_NEAR(scene.at(0.2).pose.position.z, kHoverHeight, 1e-3);
  EXPECT_NEAR(scene.force(0.2), kWeight, 0.05 * kWeight);
  // On the slope, with its fan at rest: it stands on its hull.
  EXPECT_GT(scene.at(4.5).pose.position.x, 1.0);
  EXPECT_NEAR(above(4.5), kPadHeight / std::cos(0.05), 1e-4);
  EXPECT_NEAR(scene.force(4.5), 0.0, 0.01 * kWeight);
  const double way = std::hypot(scene.at(4.9).pose.position.x - scene.at(4.5).pose.position.x,
                                scene.at(4.9).pose.position.y - scene.at(4.5).pose.position.y);
  EXPECT_LT(way, 2e-5);  // it creeps: doc/craft.md
  // Its fan turns again: it lifts off, and slides down.
  EXPECT_NEAR(above(6.0), kHoverHeight, 1.5e-3);
  EXPECT_LT(scene.at(6.1).pose.position.x, scene.at(5.0).pose.position.x - 0.05);
}

TEST(LiftFan, StopsByCommandSoThatTheCraftSettlesAndLiftsItOffAgain) {
  const Scene scene("lift_fan", 2.0);
  const auto height = [&](double time) { return scene.at(time).pose.position.z; };
  EXPECT_NEAR(height(1.4), kHoverHeight, 1e-3);
  EXPECT_NEAR(scene.fanSpeed(1.4), 1.0, 0.0);
  // 0.15 s of lag: e^(-0.3/0.15) of its speed 0.3 s after the command of 1.5 s.
  EXPECT_NEAR(scene.fanSpeed(1.8), std::exp(-2.0), 1e-9);
  EXPECT_NEAR(height(3.9), kPadHeight, 1e-5);
  EXPECT_NEAR(scene.force(3.9), 0.0, 1e-3 * kWeight);
  EXPECT_NEAR(scene.at(3.9).pose.position.x, scene.at(3.0).pose.position.x, 1e-4);
  EXPECT_NEAR(height(4.9), kHoverHeight, 1e-3);
  EXPECT_NEAR(scene.force(4.9), kWeight, 0.05 * kWeight);
  EXPECT_GT(scene.at(6.5).pose.position.x, scene.at(4.9).pose.position.x + 0.3);
}

TEST(Rough, GroundIsFollowedWithTheWeightOnTheCushion) {
  const Scene scene("rough", 5.0);
  double lowest = 1.0;
  double highest = 0.0;
  double mean = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < scene.states().size(); ++i) {
    if (scene.states()[i].tick < 1000) continue;
    lowest = std::min(lowest, scene.states()[i].pose.position.z);
    highest = std::max(highest, scene.states()[i].pose.position.z);
    for (const auto& cell : scene.cushions()[i].cells) mean += cell.force;
    count += 1.0;
  }
  EXPECT_GT(scene.states().back().pose.position.x, 3.0);
  EXPECT_GT(highest - lowest, 0.004);
  EXPECT_GT(mean / count, 0.5 * kWeight);
  EXPECT_LT(mean / count, 1.05 * kWeight);
}

}  // namespace
}  // namespace hovercraft_ros::testing
