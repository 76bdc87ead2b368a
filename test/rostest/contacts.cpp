#include <algorithm>
#include <cmath>
#include <map>
#include <std_srvs/Trigger.h>
#include <string>
#include <tf2_msgs/TFMessage.h>
#include <vector>

#include <gtest/gtest.h>

#include <geometry_msgs/PoseStamped.h>
#include <hovercraft_sim/Contact.h>
#include <hovercraft_sim/SetState.h>
#include <hovercraft_sim/State.h>
#include <hovercraft_sim/ThrustCommand.h>
#include <ros/node_handle.h>
#include <ros/service.h>

#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/sim/run_observer.h"
#include "hovercraft_sim/sim/simulation.h"

#include "../support/contact_messages.h"
#include "../support/core_run.h"
#include "../support/recorded_flight.h"
#include "../support/wait_until.h"

namespace hovercraft_ros::testing {
namespace {

using hovercraft_sim::Contact;

constexpr const char* kContactsTopic = "/hovercraft_sim/contacts";

/// What was recorded of a shipped scenario that started paused, with its contacts checked against a
/// run of the core: each of them exactly once.
struct Flight {
  Flight(const std::string& vehicle, std::uint64_t ticks, const hovercraft::Vector3& thrusts,
         const std::vector<std::string>& others = {},
         const std::vector<std::string>& loose_bodies = {}) {
    std::vector<std::string> vehicles = {vehicle};
    vehicles.insert(vehicles.end(), others.begin(), others.end());
    std::vector<std::string> topics = outputTopics(vehicles);
    topics.emplace_back(kContactsTopic);
    for (const std::string& body : loose_bodies) topics.push_back("/" + body + "/pose");
    RecordedFlight recorder(topics);
    fly(vehicle, ticks, thrusts);
    const Recording recording = recorder.finish();
    contacts = recording.messages<Contact>(kContactsTopic);
    for (const std::string& name : vehicles) {
      states_of[name] = recording.messages<hovercraft_sim::State>("/" + name + "/state");
    }
    states = states_of[vehicle];
    expectEqualsCoreRun(recording);
    expectContactsOfCore(recording);
    for (const std::string& body : loose_bodies) {
      poses_of[body] = recording.messages<geometry_msgs::PoseStamped>("/" + body + "/pose");
      expectBodyOfCore(recording, body);
    }
  }

  int count(std::uint8_t kind) const {
    int found = 0;
    for (const Contact& contact : contacts) found += contact.kind == kind ? 1 : 0;
    return found;
  }

  std::vector<Contact> contacts;
  std::vector<hovercraft_sim::State> states;  // of the first vehicle
  std::map<std::string, std::vector<hovercraft_sim::State>> states_of;
  std::map<std::string, std::vector<geometry_msgs::PoseStamped>> poses_of;  // of loose bodies

 private:
  /// Commands the thrusts, lets the simulation go on, and waits until it is at the tick.
  static void fly(const std::string& vehicle, std::uint64_t ticks,
                  const hovercraft::Vector3& thrusts) {
    ros::NodeHandle node;
    std::uint64_t tick = 0;
    const boost::function<void(const hovercraft_sim::State&)> on_state =
        [&tick](const hovercraft_sim::State& state) { tick = state.tick; };
    const ros::Subscriber states =
        node.subscribe<hovercraft_sim::State>("/" + vehicle + "/state", 1000, on_state);
    ros::Publisher thrust =
        node.advertise<hovercraft_sim::ThrustCommand>("/" + vehicle + "/thrust", 1);
    waitUntil("the simulation hears thrusts", [&] { return thrust.getNumSubscribers() > 0; });
    hovercraft_sim::ThrustCommand command;
    command.rear = thrusts.x();
    command.left = thrusts.y();
    command.right = thrusts.z();
    thrust.publish(command);
    std_srvs::Trigger resume;
    EXPECT_TRUE(ros::service::call("/hovercraft_sim/resume", resume));
    waitUntil("the end of the flight", [&] { return tick >= ticks; });
  }

  /// The poses of a loose body, whose centre of mass is its origin, and its transforms.
  void expectBodyOfCore(const Recording& recording, const std::string& name) {
    const hovercraft::Scenario scenario = recording.scenario();
    const auto& bodies = scenario.world->bodies;
    const auto found = std::find_if(bodies.begin(), bodies.end(), [&name](const auto& description) {
      return description.name == name;
    });
    ASSERT_NE(found, bodies.end());
    const auto body = static_cast<std::size_t>(found - bodies.begin());
    std::map<ros::Time, geometry_msgs::Vector3> shifts;
    for (const auto& message : recording.messages<tf2_msgs::TFMessage>("/tf")) {
      for (const auto& transform : message.transforms) {
        if (transform.child_frame_id == name + "/base_link") {
          shifts[transform.header.stamp] = transform.transform.translation;
        }
      }
    }
    std::map<ros::Time, hovercraft::Tick> ticks;
    for (const auto& state : states) {
      ticks[state.header.stamp] = static_cast<hovercraft::Tick>(state.tick);
    }
    hovercraft::Simulation simulation(scenario);
    for (const hovercraft::Command& command : recording.commands(scenario)) {
      simulation.push(command);
    }
    std::size_t compared = 0;
    for (const auto& pose : poses_of[name]) {
      const auto tick = ticks.find(pose.header.stamp);
      const auto shift = shifts.find(pose.header.stamp);
      if (tick == ticks.end() || shift == shifts.end()) continue;  // cut off at the end
      while (simulation.tick() < tick->second) simulation.step();
      const hovercraft::Motion motion = simulation.bodyMotion(body);
      EXPECT_EQ(pose.pose.position.x, motion.p_WB.x());
      EXPECT_EQ(pose.pose.orientation.z, motion.q_WB.v.z());
      EXPECT_EQ(shift->second.x, motion.p_WB.x());
      EXPECT_EQ(shift->second.y, motion.p_WB.y());
      ++compared;
    }
    EXPECT_GT(compared, 100U);
    EXPECT_GT(simulation.bodyMotion(body).p_WB.x(), found->initial_p_WB.x() + 0.1);
  }

  /// Up to the last recorded state, each once and in order: a contact after it may have been on its
  /// way.
  void expectContactsOfCore(const Recording& recording) {
    ASSERT_FALSE(states.empty());
    const std::uint64_t last = states.back().tick;
    const auto is_later = [last](const Contact& contact) { return contact.tick > last; };
    contacts.erase(std::remove_if(contacts.begin(), contacts.end(), is_later), contacts.end());
    EXPECT_FALSE(contacts.empty());

    const hovercraft::Scenario scenario = recording.scenario();
    hovercraft::Simulation simulation(scenario);
    std::vector<hovercraft::ContactEvent> expected;
    hovercraft::RunCallbacks told;
    simulation.observe(&told);
    told.on_contact = [&expected](const hovercraft::ContactEvent& event) {
      expected.push_back(event);
    };
    for (const hovercraft::Command& command : recording.commands(scenario)) {
      while (simulation.tick() < command.tick) simulation.step();
      simulation.push(command);
    }
    while (simulation.tick() < static_cast<hovercraft::Tick>(last)) simulation.step();
    const auto epoch_ns = static_cast<std::int64_t>(states.back().header.stamp.toNSec()) -
                          static_cast<std::int64_t>(last) * scenario.step_ns;
    ASSERT_EQ(contacts.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(differenceOf(contacts[i], expected[i], epoch_ns), "") << "contact " << i;
    }
  }
};

/// Momentum and angular momentum about the origin of W.
struct Momenta {
  hovercraft::Vector3 linear = hovercraft::Vector3::Zero();
  hovercraft::Vector3 angular = hovercraft::Vector3::Zero();

  void add(const hovercraft_sim::State& state) {
    const hovercraft::Vector3 momentum = fromMessage(state.momentum);
    linear += momentum;
    angular += fromMessage(state.angular_momentum) +
               hovercraft::cross(fromMessage(state.pose.position), momentum);
  }
};

TEST(Pen, TheCraftBouncesOffTheWallsAndStaysWhereItsEngineDrivesIt) {
  const Flight flight("hovercraft", 15000, {2.0, 0.0, 0.0});
  EXPECT_GE(flight.count(Contact::BOUNCE), 2);
  for (const Contact& contact : flight.contacts) {
    EXPECT_EQ(contact.body_a, "hovercraft");
    EXPECT_NEAR(std::max(std::abs(contact.point.x), std::abs(contact.point.y)), 2.0, 1e-5);
  }
  for (const auto& state : flight.states) {
    EXPECT_LE(std::abs(state.pose.position.x), 1.8);
    EXPECT_LE(std::abs(state.pose.position.y), 1.8);
  }
  // It comes to rest with its bow, 0.3 m before its centre of mass, flat against a wall.
  EXPECT_GE(flight.count(Contact::REST), 1);
  for (const auto& state : flight.states) {
    if (state.tick < 14000) continue;
    EXPECT_NEAR(state.thrust[0], 2.0, 1e-9);
    EXPECT_LT(hovercraft::norm(fromMessage(state.velocity)), 1e-9) << state.tick;
    EXPECT_NEAR(std::max(std::abs(state.pose.position.x), std::abs(state.pose.position.y)), 1.7,
                1e-5);
  }
}

TEST(Pen, NoCraftIsPutIntoAWall) {
  hovercraft_sim::SetState put;
  put.request.vehicle = "hovercraft";
  put.request.pose.position.x = 2.0;
  put.request.pose.orientation.w = 1.0;
  ASSERT_TRUE(ros::service::call("/hovercraft_sim/set_state", put));
  EXPECT_FALSE(put.response.success);
  EXPECT_NE(put.response.message.find("east"), std::string::npos) << put.response.message;
  put.request.pose.position.x = 0.0;
  ASSERT_TRUE(ros::service::call("/hovercraft_sim/set_state", put));
  EXPECT_TRUE(put.response.success) << put.response.message;
}

TEST(Curling, OneHitKeepsTheMomentumOfBoth) {
  const Flight flight("stone", 2000, {0.0, 0.0, 0.0}, {"target"});
  ASSERT_EQ(flight.contacts.size(), 1U);
  const Contact& hit = flight.contacts.front();
  EXPECT_EQ(hit.body_b, "target");
  const auto& stone = flight.states_of.at("stone");
  const auto& target = flight.states_of.at("target");
  EXPECT_NEAR(stone.back().momentum.x, 5.0 * 1.5 - hit.impulse.x, 1e-12);
  EXPECT_NEAR(stone.back().momentum.y, -hit.impulse.y, 1e-12);
  EXPECT_NEAR(target.back().momentum.x, hit.impulse.x, 1e-12);
  EXPECT_NEAR(target.back().momentum.y, hit.impulse.y, 1e-12);
  // Before: 5 kg at 1.5 m/s along x, 0.2 m to the left of the origin.
  const hovercraft::Vector3 linear(7.5, 0.0, 0.0);
  const hovercraft::Vector3 angular(0.0, 0.0, -0.2 * 7.5);
  EXPECT_LT(stone.front().tick, hit.tick);
  EXPECT_GT(stone.back().tick, hit.tick);
  const std::size_t count = std::min(stone.size(), target.size());
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_EQ(stone[i].tick, target[i].tick);
    Momenta both;
    both.add(stone[i]);
    both.add(target[i]);
    EXPECT_LT(hovercraft::norm(both.linear - linear), 1e-12) << stone[i].tick;
    // A rounding of the position in each of 2000 steps.
    EXPECT_LT(hovercraft::norm(both.angular - angular), 1e-11) << stone[i].tick;
  }
}

TEST(Crates, TheCraftSticksToTheFirstAndPushesItIntoTheSecond) {
  const Flight flight("hovercraft", 2000, {3.0, 0.0, 0.0}, {}, {"crate_a", "crate_b"});
  EXPECT_EQ(flight.count(Contact::BOUNCE), 0);
  EXPECT_EQ(flight.count(Contact::STICK), 2);
  EXPECT_EQ(flight.count(Contact::REST), 2);
  EXPECT_EQ(flight.contacts.front().body_b, "crate_a");
  EXPECT_EQ(flight.contacts.back().body_a, "crate_a");
  EXPECT_EQ(flight.contacts.back().body_b, "crate_b");
}

TEST(Cradle, TheSpeedGoesThroughAllBoxes) {
  const Flight flight("first", 1500, {0.0, 0.0, 0.0}, {}, {"box_4"});
  ASSERT_EQ(flight.contacts.size(), 4U);
  for (const Contact& contact : flight.contacts) {
    EXPECT_EQ(contact.kind, Contact::BOUNCE);
    EXPECT_NEAR(contact.impulse.x, 1.0, 1e-12);
  }
  EXPECT_EQ(flight.contacts.back().body_b, "box_4");
  EXPECT_NEAR(flight.states.back().velocity.x, 0.0, 1e-12);
  // box_4 stands still until it is hit, and leaves with the 1 m/s that the first one came with.
  const ros::Time hit = flight.contacts.back().header.stamp;
  const geometry_msgs::PoseStamped* left = nullptr;  // where it is first seen on its way
  for (const auto& pose : flight.poses_of.at("box_4")) {
    if (pose.header.stamp < hit) {
      EXPECT_EQ(pose.pose.position.x, 0.603);
      continue;
    }
    if (left == nullptr) left = &pose;
    const double passed = (pose.header.stamp - left->header.stamp).toSec();
    EXPECT_NEAR(pose.pose.position.x - left->pose.position.x, 1.0 * passed, 1e-9);
    EXPECT_NEAR(pose.pose.position.y, 0.0, 1e-12);
    EXPECT_NEAR(pose.pose.orientation.z, 0.0, 1e-12);
  }
  ASSERT_NE(left, nullptr);
  EXPECT_NEAR(left->pose.position.x, 0.603 + (left->header.stamp - hit).toSec(), 1e-5);
}

TEST(Tumble, EverythingBouncesAndSomeComesToRest) {
  const Flight flight("hull", 3000, {0.0, 0.0, 0.0});
  EXPECT_GE(flight.count(Contact::BOUNCE), 20);
  EXPECT_GE(flight.count(Contact::REST), 3);
  for (const Contact& contact : flight.contacts) EXPECT_GT(contact.point.z, -1e-5);
}

}  // namespace
}  // namespace hovercraft_ros::testing
