#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/view/craft_placer.h"
#include "hovercraft_sim/view/detail_markers.h"
#include "hovercraft_sim/view/robot_description.h"
#include "hovercraft_sim/view/vehicle_markers.h"

#include "../support/scenario_text.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Vector3;
using visualization_msgs::Marker;

hovercraft::VehicleScenario dragged() {
  hovercraft::VehicleScenario craft;
  craft.name = "craft";
  craft.mass_properties.mass = 2.0;
  craft.drag.linear = {3.0, 5.0, 0.0};
  craft.engines[0].max_thrust = 4.0;
  return craft;
}

/// The bow along y, at 2 m/s along it.
hovercraft_sim::State stateAlongY() {
  hovercraft_sim::State state;
  state.header.frame_id = "world";
  state.header.stamp = ros::Time(10.0);
  state.pose.position.x = 1.0;
  state.pose.orientation.z = state.pose.orientation.w = std::sqrt(0.5);
  state.velocity.y = 2.0;
  state.momentum.y = 4.0;
  return state;
}

Vector3 along(const Marker& arrow) {
  return {arrow.points.at(1).x - arrow.points.at(0).x, arrow.points.at(1).y - arrow.points.at(0).y,
          arrow.points.at(1).z - arrow.points.at(0).z};
}

TEST(DetailMarkers, DragActsAgainstTheWayThroughTheAir) {
  // Along the bow 3 N s/m times the speed relative to the air.
  const Vector3 still = dragOf(dragged(), Vector3::Zero(), stateAlongY());
  EXPECT_NEAR((still - Vector3(0.0, -6.0, 0.0)).norm(), 0.0, 1e-12);
  // With a wind along the way of 1 m/s, and one across of 1 m/s, to which 5 N s/m count.
  const Vector3 windy = dragOf(dragged(), {1.0, 1.0, 0.0}, stateAlongY());
  EXPECT_NEAR((windy - Vector3(5.0, -3.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST(DetailMarkers, TheWindOfGustsCountsWhereItIsKnown) {
  CraftMotion motion;
  motion.state = stateAlongY();
  motion.wind = Vector3(0.0, 1.0, 0.0);
  const std::vector<Marker> markers = forceMarkers(dragged(), {0.5, 0.0, 0.0}, motion);
  EXPECT_NEAR((along(markers[0]) - 0.2 * Vector3(0.0, -3.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(markers[3].text, "wind 1 m/s");
}

// A polar of 1 m² ahead adds q = 2 kg/m³ (2 m/s)²/2 = 4 N.
TEST(DetailMarkers, DragIsThatOfThePolarToo) {
  hovercraft::VehicleScenario craft = dragged();
  hovercraft::DragPolar polar;
  polar.air_density = 2.0;
  polar.area_x = 1.0;
  polar.surge[1] = 1.0;
  craft.drag_laws = {polar};
  const Vector3 drag = dragOf(craft, Vector3::Zero(), stateAlongY());
  EXPECT_NEAR((drag - Vector3(0.0, -10.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST(DetailMarkers, TheResultantIsTheChangeOfMomentum) {
  CraftMotion motion;
  motion.state = stateAlongY();
  EXPECT_FALSE(resultantOf(motion));
  motion.before = motion.state;
  EXPECT_FALSE(resultantOf(motion));  // no time has passed
  motion.before->header.stamp = ros::Time(9.5);
  motion.before->momentum.y = 3.0;
  motion.before->momentum.x = 1.0;
  EXPECT_NEAR((resultantOf(motion).value() - Vector3(-2.0, 2.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST(DetailMarkers, ArrowsOfForcesAreAsLongAsThoseOfThrusts) {
  // 0.8 m for the full thrust of 4 N.
  CraftMotion motion;
  motion.state = stateAlongY();
  const std::vector<Marker> markers = forceMarkers(dragged(), {0.5, 0.0, 0.0}, motion);
  ASSERT_EQ(markers.size(), 4U);
  EXPECT_EQ(markers[0].ns, "craft/drag");
  EXPECT_EQ(markers[0].header.frame_id, "world");
  EXPECT_NEAR((along(markers[0]) - 0.2 * Vector3(2.5, -6.0, 0.0)).norm(), 0.0, 1e-6);
  EXPECT_EQ(markers[1].ns, "craft/resultant");
  EXPECT_EQ(markers[1].action, Marker::DELETE);
  EXPECT_EQ(markers[2].ns, "craft/wind");
  EXPECT_NEAR((along(markers[2]) - Vector3(0.1, 0.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(markers[3].text, "wind 0.5 m/s");
}

TEST(DetailMarkers, WithoutWindNoneIsDrawnAndNoArrowIsLongerThanFourMetres) {
  CraftMotion motion;
  motion.state = stateAlongY();
  motion.before = motion.state;
  motion.before->header.stamp = ros::Time(9.999);
  motion.before->momentum.y = -1e6;
  const std::vector<Marker> markers = forceMarkers(dragged(), Vector3::Zero(), motion);
  EXPECT_NEAR(along(markers[1]).norm(), 4.0, 1e-9);
  EXPECT_EQ(markers[2].action, Marker::DELETE);
  EXPECT_EQ(markers[3].action, Marker::DELETE);
}

TEST(DetailMarkers, AContactShowsItsImpulseAndGoesByItself) {
  hovercraft_sim::Contact contact;
  contact.header.frame_id = "world";
  contact.point.x = 3.0;
  contact.impulse.y = 2.0;
  const std::vector<Marker> markers = contactMarkers(contact, 7);
  ASSERT_EQ(markers.size(), 2U);
  EXPECT_EQ(markers[0].ns, "contacts");
  EXPECT_NEAR((along(markers[0]) - Vector3(0.0, 0.6, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(markers[1].text, "2 N s");
  EXPECT_NE(markers[0].id, markers[1].id);
  for (const Marker& marker : markers) EXPECT_EQ(marker.lifetime, ros::Duration(1.0));
}

TEST(DetailMarkers, TheNearestPairIsALineWithItsDistance) {
  const hovercraft::NearestPair pair = {"a", "wall", 0.25, {1.0, 0.0, 0.0}, {1.25, 0.0, 0.0}};
  const std::vector<Marker> markers = nearestMarkers(pair, "map");
  ASSERT_EQ(markers.size(), 3U);
  EXPECT_NEAR(along(markers[0]).x(), 0.25, 1e-12);
  EXPECT_EQ(markers[2].text, "a - wall: 0.250 m");
  for (const Marker& marker : nearestMarkers(std::nullopt, "map")) {
    EXPECT_EQ(marker.action, Marker::DELETE);
    EXPECT_EQ(marker.header.frame_id, "map");
  }
}

TEST(VehicleMarkers, CraftHaveColoursOfTheirOwnAndNames) {
  const hovercraft::VehicleScenario craft = dragged();
  std::vector<float> reds;
  for (std::size_t i = 0; i < kCraftColors; ++i) {
    const Marker hull = craftMarkers(craft, i).front();
    for (std::size_t j = 0; j < i; ++j) {
      const Marker other = craftMarkers(craft, j).front();
      EXPECT_GT(std::abs(hull.color.r - other.color.r) + std::abs(hull.color.g - other.color.g) +
                    std::abs(hull.color.b - other.color.b),
                0.2F);
    }
  }
  EXPECT_EQ(nameMarker(craft).text, "craft");
  EXPECT_EQ(nameMarker(craft).header.frame_id, "craft/base_link");
}

TEST(VehicleMarkers, ObstaclesAreBrighterThanAnyGround) {
  // The brightest of a height map is (0.75, 0.75, 0.65).
  hovercraft::Scenario scenario;
  scenario.world.emplace();
  scenario.world->obstacles.resize(1);
  scenario.world->obstacles[0].name = "wall";
  scenario.world->obstacles[0].hull.shape = hovercraft::BoxShape{{1.0, 1.0, 1.0}};
  const Marker wall = obstacleMarkers(scenario, "world").front();
  EXPECT_GT(wall.color.r + wall.color.g + wall.color.b, 0.75F + 0.75F + 0.65F);
  EXPECT_EQ(wall.color.a, 1.0F);
}

TEST(CraftPlacer, APlanarCraftTurnsAboutZAloneAndKeepsItsHeight) {
  geometry_msgs::Pose now;
  now.position.z = 0.3;
  now.orientation.w = 1.0;
  geometry_msgs::Pose wanted;
  wanted.position.x = 2.0;
  wanted.position.z = 0.31;
  wanted.orientation.x = 0.02;
  wanted.orientation.z = 2.0;
  wanted.orientation.w = 2.0;
  const auto planar = fittingPose(wanted, now, hovercraft::BodyModel::kPlanar);
  EXPECT_EQ(planar.position.x, 2.0);
  EXPECT_EQ(planar.position.z, 0.3);
  EXPECT_EQ(planar.orientation.x, 0.0);
  EXPECT_NEAR(planar.orientation.z, std::sqrt(0.5), 1e-15);
  const auto spatial = fittingPose(wanted, now, hovercraft::BodyModel::kSpatial);
  EXPECT_EQ(spatial.position.z, 0.31);
  EXPECT_NEAR(spatial.orientation.x / spatial.orientation.z, 0.01, 1e-12);
  EXPECT_NEAR(std::hypot(spatial.orientation.x, spatial.orientation.z, spatial.orientation.w), 1.0,
              1e-15);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

TEST(RobotDescription, HasEveryPartAndEveryEngineInTheFrameOfTf) {
  const auto scenario = hovercraft::testing::parsed(hovercraft::testing::scenarioOfParts());
  TfFrames frames;
  frames.prefix = "left";
  const std::string urdf = urdfOf(scenario.vehicles.front(), frames);
  EXPECT_EQ(count(urdf, "<link name=\"left/alpha/base_link\">"), 1U);
  EXPECT_EQ(count(urdf, "<box size=\"0.6 0.4 0.1\"/>"), 1U);
  EXPECT_EQ(count(urdf, "<sphere radius=\"0.033\"/>"), 1U);
  EXPECT_EQ(count(urdf, "<cylinder radius=\"0.05\" length=\"0.2\"/>"), 1U);
  EXPECT_EQ(count(urdf, "<material name=\"engine\"/>"), 3U);
  // Box, cylinder, ball, eight slices of the cone, three engines.
  EXPECT_EQ(count(urdf, "<visual>"), 14U);
  EXPECT_EQ(count(urdf, "<visual>"), count(urdf, "</visual>"));
}

TEST(RobotDescription, MeshesAreNamedAsXml) {
  hovercraft::VehicleScenario craft = dragged();
  craft.visual = hovercraft::VisualScenario{"file:///a&b\"<c>.dae", {0.001, 0.001, 0.001}};
  const std::string urdf = urdfOf(craft, {});
  EXPECT_NE(
      urdf.find("filename=\"file:///a&#38;b&#34;&#60;c&#62;.dae\" scale=\"0.001 0.001 0.001\""),
      std::string::npos)
      << urdf;
}

TEST(RobotDescription, ASkirtHasABallAtEachPointOfItsHem) {
  const auto scenario = hovercraft::loadScenario("config/rc5.yaml");
  const hovercraft::VehicleScenario& craft = scenario.vehicles.front();
  std::size_t points = 0;
  for (const auto& cell : craft.cushion->cells) points += cell.hem.size();
  EXPECT_EQ(count(urdfOf(craft, {}), "<material name=\"skirt\"/>"), points);
}

}  // namespace
}  // namespace hovercraft_ros
