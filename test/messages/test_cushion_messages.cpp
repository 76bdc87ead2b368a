#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "hovercraft_sim/bags/bag_writer.h"
#include "hovercraft_sim/bags/simulate.h"
#include "hovercraft_sim/messages/vehicle_messages.h"
#include "hovercraft_sim/view/cushion_markers.h"

#include "../support/files.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Scenario;
using hovercraft::Simulation;
using visualization_msgs::Marker;

Simulation hovering() {
  Simulation simulation(loadScenarioFile("config/rc5.yaml"));
  for (int i = 0; i < 1000; ++i) simulation.step();
  return simulation;
}

std::size_t countOf(const std::vector<Marker>& markers, const std::string& kind) {
  return static_cast<std::size_t>(std::count_if(
      markers.begin(), markers.end(), [&](const Marker& marker) { return marker.ns == kind; }));
}

TEST(CushionMessage, HasTheCellsAsTheSimulationReportsThem) {
  const Simulation simulation = hovering();
  VehicleMessages messages(simulation.scenario(), 0);
  ASSERT_TRUE(messages.hasCushion());
  messages.fill(simulation, {ros::Time(12, 34)});
  const hovercraft_sim::Cushion& cushion = messages.cushion();
  EXPECT_EQ(cushion.header.stamp, ros::Time(12, 34));
  EXPECT_EQ(cushion.header.frame_id, "rc5/base_link");
  ASSERT_EQ(cushion.cells.size(), 4U);
  double force = 0.0;
  for (const auto& cell : cushion.cells) {
    EXPECT_NEAR(cell.pressure, 467.6, 1.0);
    EXPECT_NEAR(cell.gap, 0.003, 1e-4);
    EXPECT_NEAR(cell.flow, 0.0164, 1e-4);
    force += cell.force;
  }
  EXPECT_NEAR(force, 50.5, 0.2);
  EXPECT_EQ(cushion.fan_speed, std::vector<double>{1.0});
  EXPECT_NEAR(cushion.power, 30.7, 0.2);
}

TEST(CushionMessage, CraftWithoutACushionHasNone) {
  const Scenario scenario = loadScenarioFile("config/hovercraft.yaml");
  EXPECT_FALSE(VehicleMessages(scenario, 0).hasCushion());
}

TEST(CushionMessage, IsInTheBagOfSimulateAndInItsCsv) {
  const hovercraft::testing::TestFolder folder;
  SimulateRequest request;
  request.scenario = "config/rc5.yaml";
  request.duration = "0.1";
  request.output = folder.file("run.bag");
  request.cushion = folder.file("cells.csv");
  request.every = 10;
  std::ostringstream messages;
  simulate(request, messages);
  const rosbag::Bag bag(request.output, rosbag::bagmode::Read);
  rosbag::View view(bag, rosbag::TopicQuery("/rc5/cushion"));
  EXPECT_EQ(view.size(), 10U);
  const std::string csv = hovercraft::testing::contentOf(request.cushion);
  EXPECT_EQ(csv.rfind("time,vehicle,cell,pressure,gap,flow,force,fan_speed,power\n0,rc5,0,", 0),
            0U);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 11 * 4);
  EXPECT_NE(csv.find("\n0.1,rc5,3,"), std::string::npos);
  // Each cell gets a quarter of 30.7 W from a fan at its nominal speed.
  std::istringstream last(csv.substr(csv.find("\n0.1,rc5,3,") + 1));
  std::vector<std::string> fields;
  for (std::string field; std::getline(last, field, ',');) fields.push_back(field);
  ASSERT_EQ(fields.size(), 9U);
  EXPECT_EQ(fields[7], "1");
  EXPECT_NEAR(std::stod(fields[8]), 30.7 / 4.0, 0.1);
}

TEST(CushionMessage, CsvOfCellsWithoutACushionIsRefused) {
  const hovercraft::testing::TestFolder folder;
  SimulateRequest request;
  request.scenario = "config/hovercraft.yaml";
  request.duration = "0.1";
  request.output = folder.file("run.csv");
  request.cushion = folder.file("cells.csv");
  std::ostringstream messages;
  EXPECT_NE(hovercraft::testing::messageOf([&] {
              simulate(request, messages);
            }).find("no vehicle of the scenario has a cushion"),
            std::string::npos);
}

TEST(CushionMarkers, ShowHemPressureAndGapOfEachCell) {
  const Simulation simulation = hovering();
  const auto& craft = simulation.scenario().vehicles[0];
  VehicleMessages messages(simulation.scenario(), 0);
  messages.fill(simulation, {ros::Time(1, 0)});
  const std::vector<Marker> markers = cushionMarkers(craft, messages.cushion());
  EXPECT_EQ(countOf(markers, "rc5/hem"), 1U);
  EXPECT_EQ(countOf(markers, "rc5/pressure"), 4U);
  EXPECT_EQ(countOf(markers, "rc5/gap"), 4U);
  EXPECT_EQ(markers[0].points.size(), 8U);
  for (const Marker& marker : markers) {
    EXPECT_EQ(marker.header.frame_id, "rc5/base_link");
    if (marker.ns == "rc5/gap") {
      EXPECT_EQ(marker.text, "3.0 mm");
    }
    // At the mean pressure a pillar is as long as its cell is wide.
    if (marker.ns == "rc5/pressure") {
      EXPECT_NEAR(marker.scale.z, std::sqrt(0.027), 1e-3);
    }
  }
  EXPECT_EQ(cushionMarkers(craft, {}).size(), 1U);  // no message yet
  EXPECT_TRUE(cushionMarkers(loadScenarioFile("config/hovercraft.yaml").vehicles[0], {}).empty());
}

TEST(CushionMarkers, GroundIsASheetOrTheTrianglesOfItsHeights) {
  const std::vector<Marker> plane = groundMarkers(loadScenarioFile("config/rc5.yaml"), "map");
  ASSERT_EQ(plane.size(), 1U);
  EXPECT_EQ(plane[0].points.size(), 6U);
  EXPECT_EQ(plane[0].header.frame_id, "map");
  const std::vector<Marker> heights = groundMarkers(loadScenarioFile("config/rough.yaml"), "map");
  ASSERT_EQ(heights.size(), 1U);
  EXPECT_EQ(heights[0].points.size(), 6U * 120U * 60U);
  EXPECT_EQ(heights[0].colors.size(), heights[0].points.size());
  for (const geometry_msgs::Point& point : heights[0].points) {
    EXPECT_GE(point.z, 0.0);
    EXPECT_LE(point.z, 0.024);
  }
  EXPECT_TRUE(groundMarkers(loadScenarioFile("config/hovercraft.yaml"), "map").empty());
}

}  // namespace
}  // namespace hovercraft_ros
