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

#include "hovercraft_sim/sim/simulation.h"

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
    states = recording.messages<hovercraft_sim::State>("/" + vehicle + "/state");
    expectEqualsCoreRun(recording);
    expectContactsOfCore(recording);
    for (const std::string& body : loose_bodies) expectBodyOfCore(recording, body);
  }

  int count(std::uint8_t kind) const {
    int found = 0;
    for (const Contact& contact : contacts) found += contact.kind == kind ? 1 : 0;
    return found;
  }

  std::vector<Contact> contacts;
  std::vector<hovercraft_sim::State> states;

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
  static void expectBodyOfCore(const Recording& recording, const std::string& name) {
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
    for (const auto& state : recording.messages<hovercraft_sim::State>("/hovercraft/state")) {
      ticks[state.header.stamp] = static_cast<hovercraft::Tick>(state.tick);
    }
    hovercraft::Simulation simulation(scenario);
    for (const hovercraft::Command& command : recording.commands(scenario)) {
      simulation.push(command);
    }
    std::size_t compared = 0;
    for (const auto& pose : recording.messages<geometry_msgs::PoseStamped>("/" + name + "/pose")) {
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

  /// Up to the last recorded state: a contact after it may have been on its way.
  void expectContactsOfCore(const Recording& recording) {
    const hovercraft::Scenario scenario = recording.scenario();
    hovercraft::Simulation simulation(scenario);
    std::vector<hovercraft::ContactEvent> expected;
    simulation.on_contact = [&expected](const hovercraft::ContactEvent& event) {
      expected.push_back(event);
    };
    for (const hovercraft::Command& command : recording.commands(scenario)) {
      while (simulation.tick() < command.tick) simulation.step();
      simulation.push(command);
    }
    ASSERT_FALSE(states.empty());
    const auto last = static_cast<hovercraft::Tick>(states.back().tick);
    while (simulation.tick() < last) simulation.step();
    ASSERT_GE(contacts.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(contacts[i].tick, static_cast<std::uint64_t>(expected[i].tick));
      EXPECT_EQ(contacts[i].kind, static_cast<std::uint8_t>(expected[i].kind));
      EXPECT_EQ(contacts[i].body_a, expected[i].a);
      EXPECT_EQ(contacts[i].body_b, expected[i].b);
      EXPECT_EQ(contacts[i].impulse.x, expected[i].impulse_B_W.x());
      EXPECT_EQ(contacts[i].point.y, expected[i].p_WC.y());
    }
    contacts.resize(expected.size());
    EXPECT_FALSE(contacts.empty());
  }
};

TEST(Pen, TheCraftBouncesOffTheWallsAndStaysInside) {
  const Flight flight("hovercraft", 6000, {2.0, 0.0, 0.0});
  EXPECT_GE(flight.count(Contact::BOUNCE), 2);
  for (const Contact& contact : flight.contacts) {
    EXPECT_EQ(contact.body_a, "hovercraft");
    EXPECT_NEAR(std::max(std::abs(contact.point.x), std::abs(contact.point.y)), 2.0, 1e-5);
  }
  for (const auto& state : flight.states) {
    EXPECT_LE(std::abs(state.pose.position.x), 1.8);
    EXPECT_LE(std::abs(state.pose.position.y), 1.8);
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
  const auto& last = flight.states.back();
  EXPECT_NEAR(last.momentum.x, 5.0 * 1.5 - hit.impulse.x, 1e-12);
  EXPECT_NEAR(last.momentum.y, -hit.impulse.y, 1e-12);
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
  const Flight flight("first", 1000, {0.0, 0.0, 0.0});
  ASSERT_EQ(flight.contacts.size(), 4U);
  for (const Contact& contact : flight.contacts) {
    EXPECT_EQ(contact.kind, Contact::BOUNCE);
    EXPECT_NEAR(contact.impulse.x, 1.0, 1e-12);
  }
  EXPECT_EQ(flight.contacts.back().body_b, "box_4");
  EXPECT_NEAR(flight.states.back().velocity.x, 0.0, 1e-12);
}

TEST(Tumble, EverythingBouncesAndSomeComesToRest) {
  const Flight flight("hull", 3000, {0.0, 0.0, 0.0});
  EXPECT_GE(flight.count(Contact::BOUNCE), 20);
  EXPECT_GE(flight.count(Contact::REST), 3);
  for (const Contact& contact : flight.contacts) EXPECT_GT(contact.point.z, -1e-5);
}

}  // namespace
}  // namespace hovercraft_ros::testing
