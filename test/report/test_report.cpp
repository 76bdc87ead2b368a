#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <hovercraft_sim/Contact.h>
#include <hovercraft_sim/State.h>
#include <hovercraft_sim/States.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/bags/simulate.h"
#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/report/page.h"
#include "hovercraft_sim/report/report.h"
#include "hovercraft_sim/report/run_reader.h"

#include "../support/files.h"
#include "../support/scenarios.h"

namespace hovercraft_ros {
namespace {

using hovercraft::testing::contentOf;
using hovercraft::testing::messageOf;
using hovercraft::testing::TestFolder;

class Report : public ::testing::Test {
 protected:
  /// A bag of a run. @returns its path.
  std::string flown(const std::string& name, const std::string& scenario, double duration,
                    const std::string& commands = "", const std::string& set = "") const {
    SimulateRequest request;
    request.scenario = folder_.write("scenario.yaml", scenario);
    if (!commands.empty()) request.commands = folder_.write("commands.csv", commands);
    if (!set.empty()) request.sets = {set};
    request.duration = hovercraft::numberText(duration);
    request.output = folder_.file(name);
    std::ostringstream ignored;
    simulate(request, ignored);
    return request.output;
  }

  /// A bag with nothing but poses or odometry: 5 s along x at 2 m/s, turning at 0.5 rad/s.
  template <class Message, class SetPose>
  std::string foreign(const std::string& name, const std::string& topic,
                      const SetPose& set_pose) const {
    rosbag::Bag bag(folder_.file(name), rosbag::bagmode::Write);
    for (int i = 0; i <= 100; ++i) {
      Message message;
      const double time = 0.05 * i;
      message.header.stamp = ros::Time(1000.0 + time);
      geometry_msgs::Pose pose;
      pose.position.x = 2.0 * time;
      pose.orientation.z = std::sin(0.25 * time);
      pose.orientation.w = std::cos(0.25 * time);
      set_pose(message, pose);
      bag.write(topic, message.header.stamp, message);
    }
    return folder_.file(name);
  }

  std::string onlyPoses(const std::string& topic) const {
    return foreign<geometry_msgs::PoseStamped>(
        "poses.bag", topic, [](auto& message, const auto& pose) { message.pose = pose; });
  }

  RunData run(const std::string& bag) const { return runDataOf(readTopics(bag)); }

  std::string made(const std::string& bag, const std::string& other = "") const {
    ReportRequest request;
    request.bag = bag;
    request.other = other;
    request.output = folder_.file("report.html");
    std::ostringstream terminal;
    makeReport(request, terminal);
    return contentOf(request.output);
  }

  TestFolder folder_;
};

const RunPanel* panelOf(const std::vector<RunPanel>& panels, const std::string& title) {
  for (const RunPanel& panel : panels) {
    if (panel.title == title) return &panel;
  }
  return nullptr;
}

TEST_F(Report, ShowsTheManoeuvresThatAPilotHasFlown) {
  SimulateRequest request;
  request.scenario = folder_.write("scenario.yaml", hovercraft::testing::oneCraftYaml());
  request.pilots = {folder_.write("pilot.yaml",
                                  "manoeuvres:\n  - {name: it, kind: stop, throttle: {rear: 2}, "
                                  "approach: 1, levels: {rear: -2}}\n"
                                  "  - {kind: stop, levels: {rear: 0}, longest: 1}\n")};
  request.output = folder_.file("piloted.bag");
  std::ostringstream messages;
  simulate(request, messages);
  const RunData data = run(request.output);
  ASSERT_EQ(data.manoeuvres.size(), 2U);
  const RunManoeuvre& stop = data.manoeuvres[0];
  EXPECT_EQ(stop.craft, "craft");
  EXPECT_EQ(stop.name, "it");
  EXPECT_EQ(stop.kind, "stop");
  EXPECT_TRUE(stop.is_complete);
  // 2 N on 2 kg: 1 m/s after 1 s from the first decision, at 0.01 s, then back to 0.02 m/s.
  EXPECT_NEAR(1e-9 * static_cast<double>(stop.execute_ns), 1.01, 1e-6);
  EXPECT_NEAR(1e-9 * static_cast<double>(stop.end_ns), 1.99, 1e-6);
  EXPECT_NE(stop.text.find("head reach: 0.49"), std::string::npos) << stop.text;
  EXPECT_NE(messages.str().find(stop.text), std::string::npos);
  EXPECT_FALSE(data.manoeuvres[1].is_complete);
  EXPECT_NE(made(request.output).find("\"kind\":\"stop\""), std::string::npos);
}

TEST_F(Report, ABagOfPosesAloneHasAWayAndItsSpeeds) {
  const RunData data = run(onlyPoses("/mocap/car/pose_of_it"));
  ASSERT_EQ(data.bodies.size(), 1U);
  const RunBody& body = data.bodies[0];
  EXPECT_EQ(body.name, "/mocap/car/pose_of_it");
  EXPECT_EQ(data.end_ns, 5'000'000'000);
  EXPECT_EQ(body.motion.times_ns.front(), 0);
  EXPECT_NEAR(body.motion.position[0].back(), 10.0, 1e-12);
  ASSERT_TRUE(body.velocity);
  for (std::size_t i = 0; i < body.velocity->times_ns.size(); ++i) {
    // 2 m/s along x in W; in the axes of the body at the first of the two poses.
    const double yaw = 0.5 * 0.05 * static_cast<double>(i);
    EXPECT_NEAR(body.velocity->linear[0][i], 2.0 * std::cos(yaw), 1e-9) << i;
    EXPECT_NEAR(body.velocity->linear[1][i], -2.0 * std::sin(yaw), 1e-9) << i;
    EXPECT_NEAR(body.velocity->angular[2][i], 0.5, 1e-9) << i;
  }
  EXPECT_NE(panelOf(body.panels, "Yaw rate"), nullptr);
  EXPECT_NE(panelOf(body.panels, "Heading"), nullptr);
}

TEST_F(Report, ABagOfOdometryAloneHasTheVelocitiesThatItTells) {
  const std::string bag = foreign<nav_msgs::Odometry>(
      "odom.bag", "/odom", [](nav_msgs::Odometry& odom, const geometry_msgs::Pose& pose) {
        odom.pose.pose = pose;
        odom.twist.twist.linear.x = 1.75;
        odom.twist.twist.angular.z = -0.5;
      });
  const RunData data = run(bag);
  ASSERT_EQ(data.bodies.size(), 1U);
  ASSERT_TRUE(data.bodies[0].velocity);
  EXPECT_EQ(data.bodies[0].velocity->linear[0].at(50), 1.75);
  EXPECT_EQ(data.bodies[0].velocity->angular[2].at(50), -0.5);
  EXPECT_EQ(data.bodies[0].velocity->source, "/odom");
}

TEST_F(Report, WhatIsBrokenOrTellsNothingGetsASentence) {
  EXPECT_EQ(messageOf([&] { made(folder_.file("none.bag")); }),
            folder_.file("none.bag") + ": cannot be read: No such file or directory");
  const std::string text = folder_.write("text.bag", "This is no bag.\n");
  EXPECT_EQ(messageOf([&] { made(text); }).rfind(text + ":", 0), 0U);
  {
    rosbag::Bag bag(folder_.file("words.bag"), rosbag::bagmode::Write);
    std_msgs::String word;
    word.data = "nothing";
    bag.write("/words", ros::Time(1.0), word);
  }
  EXPECT_NE(messageOf([&] {
              made(folder_.file("words.bag"));
            }).find("nothing in it tells where something was"),
            std::string::npos);
  // A good one, cut short at every 97th byte.
  const std::string whole = contentOf(onlyPoses("/pose"));
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    const std::string cut = folder_.write("cut.bag", whole.substr(0, size));
    EXPECT_NE(messageOf([&] { made(cut); }), "nothing was thrown") << size;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.file("report.html")));
}

TEST_F(Report, AFileThatIsNoPageIsNotReplaced) {
  ReportRequest request;
  request.bag = onlyPoses("/pose");
  std::ostringstream terminal;
  for (const char* name : {"notes.txt", "page", "page.html.bak", "page.pdf"}) {
    request.output = folder_.write(name, "mine");
    EXPECT_EQ(
        messageOf([&] { makeReport(request, terminal); }),
        "--output = " + request.output + ": must end in .html, or be - for the standard output");
    EXPECT_EQ(contentOf(request.output), "mine");
  }
}

TEST_F(Report, PosesThatAreNoNumbersAreLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  int count = 0;
  const std::string bag =
      foreign<geometry_msgs::PoseStamped>("nan.bag", "/pose", [&](auto& message, const auto& pose) {
        message.pose = pose;
        if (count == 3) message.pose.position.y = nan;
        if (count == 4) message.pose.position.x = 1e308;
        if (count == 5) message.pose.orientation = geometry_msgs::Quaternion();
        ++count;
      });
  const RunData data = run(bag);
  EXPECT_EQ(data.bodies.at(0).motion.times_ns.size(), 99U);
  EXPECT_EQ(data.bodies[0].motion.orientation[3].at(3), 1.0);  // no turn where none is told
  const std::string all_nan = foreign<geometry_msgs::PoseStamped>(
      "all_nan.bag", "/pose", [&](auto& message, const auto& pose) {
        message.pose = pose;
        message.pose.position.z = nan;
      });
  EXPECT_EQ(messageOf([&] { run(all_nan); }), all_nan + ": none of its poses has finite numbers");
}

TEST_F(Report, AnyTopicWithNumbersHasItsCurves) {
  const std::string path = onlyPoses("/car/pose");
  {
    rosbag::Bag bag(path, rosbag::bagmode::Append);
    for (int i = 0; i < 10; ++i) {
      geometry_msgs::WrenchStamped wrench;
      wrench.header.stamp = ros::Time(1000.0 + 0.1 * i);
      wrench.wrench.force.z = 0.1 * i;
      wrench.wrench.torque.z = 9.81;  // does not change: no curve
      bag.write("/car/arm/load", wrench.header.stamp, wrench);
      std_msgs::Float64 level;
      level.data = 0.5 * i;
      bag.write("/level", wrench.header.stamp, level);
    }
  }
  const RunData data = run(path);
  ASSERT_EQ(data.bodies.size(), 1U);
  const RunPanel* force = panelOf(data.bodies[0].panels, "wrench.force");
  ASSERT_NE(force, nullptr);
  EXPECT_EQ(force->unit, "N");
  ASSERT_EQ(force->curves.size(), 1U);
  EXPECT_EQ(force->curves[0].label, "z");
  EXPECT_EQ(force->times_ns.at(3), 300'000'000);
  EXPECT_EQ(panelOf(data.bodies[0].panels, "wrench.torque"), nullptr);
  const RunPanel* level = panelOf(data.panels, "data");
  ASSERT_NE(level, nullptr);
  EXPECT_EQ(level->source, "/level");
  EXPECT_EQ(level->curves.at(0).values.at(9), 4.5);
}

TEST_F(Report, NamesOfABagAreNoMarkup) {
  const std::string tag = "</script><script>alert(1)</script><img src=x onerror=alert(2)>";
  const std::string path = onlyPoses("/car/pose");
  {
    rosbag::Bag bag(path, rosbag::bagmode::Append);
    hovercraft_sim::Contact contact;
    contact.header.stamp = ros::Time(1001.0);
    contact.body_a = tag;
    contact.body_b = "\"\\\n\x01\xff";
    bag.write("/contacts", contact.header.stamp, contact);
    std_msgs::String scenario;
    scenario.data = tag + "<!-- script --><!-- data -->";
    bag.write("/sim/scenario", contact.header.stamp, scenario);
  }
  const std::string page = made(path);
  EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
  EXPECT_EQ(page.find("<img"), std::string::npos);
  // The page's own two scripts, and their ends.
  const auto count = [&](const std::string& word) {
    std::size_t found = 0;
    for (std::size_t at = page.find(word); at != std::string::npos; at = page.find(word, at + 1)) {
      ++found;
    }
    return found;
  };
  EXPECT_EQ(count("<script"), 2U);
  EXPECT_EQ(count("</script"), 2U);
  EXPECT_NE(page.find("\\u003c/script\\u003e\\u003cscript\\u003ealert(1)"), std::string::npos);
  EXPECT_NE(page.find("\\u0022\\u005c\\u000a\\u0001\xff"), std::string::npos);
}

TEST_F(Report, ARunOfThisPackageHasThrustsLedgerAndHash) {
  const std::string bag = flown("run.bag", hovercraft::testing::oneCraftYaml(), 0.7,
                                "time,rear,left,right\n0,1,0,0\n0.3,99,0.5,0\n");
  const RunData data = run(bag);
  ASSERT_EQ(data.bodies.size(), 1U);
  const RunBody& craft = data.bodies[0];
  const RunPanel* thrust = panelOf(craft.panels, "Thrust");
  ASSERT_NE(thrust, nullptr);
  EXPECT_EQ(thrust->curves.at(0).label, "rear");
  EXPECT_TRUE(thrust->curves.at(1).is_demand);
  EXPECT_EQ(thrust->curves.at(1).values.back(), 99.0);
  bool was_saturated = false;
  for (const RunBand& band : thrust->bands) {
    if (band.kind != "saturated") continue;
    was_saturated = true;
    EXPECT_EQ(band.label, "rear");
    EXPECT_NEAR(1e-9 * static_cast<double>(band.spans_ns.at(0).first), 0.31, 0.0101);
  }
  EXPECT_TRUE(was_saturated);
  ASSERT_TRUE(craft.ledger);
  const EnergyLedger& ledger = *craft.ledger;
  EXPECT_NEAR(ledger.begin + ledger.engines + ledger.drag + ledger.contacts + ledger.others,
              ledger.end, 1e-12);
  EXPECT_GT(ledger.engines, 0.0);
  EXPECT_EQ(ledger.contacts, 0.0);
  // What the trapezoidal rule leaves where the thrust jumps between samples 10 ms apart.
  EXPECT_LT(std::abs(ledger.others), 2e-3 * ledger.engines);
  EXPECT_FALSE(craft.engines.empty());
  EXPECT_FALSE(craft.shapes.empty());
  EXPECT_FALSE(data.scenario_text.empty());
}

// The drag's work is that of the wind that was met, gusts and a polar included.
TEST_F(Report, TheLedgerOfACraftInGustsCloses) {
  const RunData data =
      run(flown("gusts.bag", contentOf("config/gusts.yaml"), 8.0, contentOf("config/gusts.csv")));
  const RunBody& craft = data.bodies.at(0);
  ASSERT_TRUE(craft.ledger);
  EXPECT_GT(std::abs(craft.ledger->drag), 1.0);
  EXPECT_LT(std::abs(craft.ledger->others), 5e-3 * std::abs(craft.ledger->drag));
}

// Of a fleet, the states of all craft may be the only thing that was recorded.
TEST_F(Report, AFleetMayHaveItsStatesInOneTopic) {
  const std::string flown_bag = flown("two.bag", hovercraft::testing::twoCraftYaml(), 1.0,
                                      "time,vehicle,rear,left,right\n0,alpha,1,0,0\n");
  std::map<std::uint64_t, hovercraft_sim::States> fleet;
  {
    const rosbag::Bag bag(flown_bag);
    for (const char* name : {"alpha", "beta"}) {
      rosbag::View view(bag, rosbag::TopicQuery("/" + std::string(name) + "/state"));
      for (const rosbag::MessageInstance& instance : view) {
        const auto state = instance.instantiate<hovercraft_sim::State>();
        hovercraft_sim::States& states = fleet[state->tick];
        states.header.stamp = state->header.stamp;
        states.names.emplace_back(name);
        states.states.push_back(*state);
      }
    }
  }
  ASSERT_GT(fleet.size(), 50U);
  {
    rosbag::Bag bag(folder_.file("fleet.bag"), rosbag::bagmode::Write);
    for (const auto& [tick, states] : fleet) {
      bag.write("/hovercraft_sim/states", states.header.stamp, states);
    }
  }
  const RunData whole = run(flown_bag);
  const RunData data = run(folder_.file("fleet.bag"));
  ASSERT_EQ(data.bodies.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(data.bodies[i].motion.position[0].size(), fleet.size());
    EXPECT_EQ(data.bodies[i].motion.position[0].back(), whole.bodies[i].motion.position[0].back());
  }
}

TEST_F(Report, TwoRunsArePartedWhereTheyPart) {
  const std::string scenario = hovercraft::testing::oneCraftYaml();
  const std::string a = flown("a.bag", scenario, 0.5, "time,rear,left,right\n0.2,1,0,0\n");
  const std::string b = flown("b.bag", scenario, 0.5, "time,rear,left,right\n0.2,2,0,0\n");
  const auto same = compareRuns(run(a), run(a));
  ASSERT_EQ(same.size(), 1U);
  EXPECT_FALSE(same[0].comparison.divergence);
  const auto parted = compareRuns(run(a), run(b));
  ASSERT_EQ(parted.size(), 1U);
  ASSERT_TRUE(parted[0].comparison.divergence);
  const std::int64_t time_ns = parted[0].comparison.divergence->time_ns;
  EXPECT_GT(time_ns, 200'000'000);
  EXPECT_LE(time_ns, 220'000'000);
  EXPECT_NE(made(a, b).find("\"parted\""), std::string::npos);
}

TEST_F(Report, PlotsAreWrittenAsPicturesAndDrawings) {
  ReportRequest request;
  request.bag = flown("run.bag", hovercraft::testing::oneCraftYaml(), 0.5,
                      "time,rear,left,right\n0,1,0.3,0\n");
  request.output = folder_.file("report.html");
  request.png = folder_.file("deep/png");
  request.svg = folder_.file("svg");
  std::ostringstream terminal;
  makeReport(request, terminal);
  int pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(request.png)) {
    const std::string png = contentOf(entry.path().string());
    EXPECT_EQ(png.rfind("\x89PNG\r\n\x1a\n", 0), 0U) << entry.path();
    EXPECT_EQ(png.substr(png.size() - 8, 4), "IEND") << entry.path();
    const auto drawing = std::filesystem::path(request.svg) / entry.path().stem();
    const std::string svg = contentOf(drawing.string() + ".svg");
    EXPECT_NE(svg.find("<polyline"), std::string::npos) << drawing;
    EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n") << drawing;
    ++pictures;
  }
  EXPECT_GE(pictures, 5);
  EXPECT_TRUE(std::filesystem::exists(request.png + "/way.png"));

  request.png = request.bag;  // a file
  EXPECT_EQ(messageOf([&] { makeReport(request, terminal); }).rfind("--png = " + request.bag, 0),
            0U);
  request.png.clear();
  request.output = request.bag;
  EXPECT_EQ(messageOf([&] { makeReport(request, terminal); }),
            "--output = " + request.bag + ": must not be a file that is read");
}

}  // namespace
}  // namespace hovercraft_ros
