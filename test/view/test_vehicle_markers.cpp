#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/view/vehicle_markers.h"

#include "../support/scenario_text.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Vector3;
using visualization_msgs::Marker;

hovercraft::VehicleScenario craft() {
  return hovercraft::testing::parsed(hovercraft::testing::validScenario()).vehicles.front();
}

double lengthOf(const Marker& arrow) {
  const geometry_msgs::Point& from = arrow.points.at(0);
  const geometry_msgs::Point& to = arrow.points.at(1);
  return std::hypot(to.x - from.x, to.y - from.y, to.z - from.z);
}

/// Corners of the box around a marker's points, m.
struct Bounds {
  explicit Bounds(const Marker& marker) {
    for (const geometry_msgs::Point& point : marker.points) {
      low = low.cwiseMin(Vector3(point.x, point.y, point.z));
      high = high.cwiseMax(Vector3(point.x, point.y, point.z));
    }
  }
  Vector3 low = Vector3::Constant(1e9);
  Vector3 high = Vector3::Constant(-1e9);
};

TEST(VehicleMarkers, ACraftGivenByNumbersIsABoxOfItsInertia) {
  hovercraft::MassProperties box;
  box.mass = 3.0;
  const Vector3 edges(0.6, 0.4, 0.1);
  box.I_BBo_B = Vector3(0.16 + 0.01, 0.36 + 0.01, 0.36 + 0.16).asDiagonal();
  box.I_BBo_B *= box.mass / 12.0;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(equivalentBox(box)[i], edges[i], 1e-12);
}

TEST(VehicleMarkers, EveryPartAndEveryEngineIsDrawnInBaseLink) {
  const auto scenario = hovercraft::testing::parsed(hovercraft::testing::scenarioOfParts());
  const std::vector<Marker> markers = craftMarkers(scenario.vehicles.front());
  ASSERT_EQ(markers.size(), 4U + 3U);
  EXPECT_EQ(markers[0].type, Marker::CUBE);
  EXPECT_EQ(markers[0].scale.x, 0.6);
  EXPECT_EQ(markers[1].type, Marker::CYLINDER);
  EXPECT_EQ(markers[1].pose.position.x, -0.25);
  EXPECT_EQ(markers[2].type, Marker::ARROW);  // a head without a shaft
  EXPECT_NEAR(lengthOf(markers[2]), 0.3, 1e-15);
  EXPECT_EQ(markers[3].type, Marker::SPHERE);
  EXPECT_EQ(markers[3].scale.z, 0.066);
  for (const Marker& marker : markers) {
    EXPECT_EQ(marker.header.frame_id, "alpha/base_link");
    EXPECT_EQ(marker.frame_locked, 1);
  }
}

void expectAt(const geometry_msgs::Point& point, const Vector3& expected) {
  EXPECT_NEAR(point.x, expected.x(), 1e-12);
  EXPECT_NEAR(point.y, expected.y(), 1e-12);
  EXPECT_NEAR(point.z, expected.z(), 1e-12);
}

void expectScale(const Marker& marker, const Vector3& expected) {
  EXPECT_NEAR(marker.scale.x, expected.x(), 1e-12);
  EXPECT_NEAR(marker.scale.y, expected.y(), 1e-12);
  EXPECT_NEAR(marker.scale.z, expected.z(), 1e-12);
}

/// Where a marker's pose takes a direction of its own.
Vector3 turned(const Marker& marker, const Vector3& direction) {
  const geometry_msgs::Quaternion& q = marker.pose.orientation;
  return hovercraft::rotationMatrix(hovercraft::Quaternion{q.w, {q.x, q.y, q.z}}) * direction;
}

// RViz reads a mesh by its URI; "file://" and an absolute path are one.
TEST(VehicleMarkers, AMeshIsDrawnFromItsFile) {
  const std::string part =
      "    parts: [{mesh: {file: l_shape.obj}, mass: 2, position: [1, 2, 3]}]\n";
  hovercraft::ScenarioSource source;
  source.name = "test.yaml";
  source.directory = (std::filesystem::current_path() / "test/data").string();
  const auto scenario = hovercraft::parseScenario(
      hovercraft::testing::with(hovercraft::testing::validScenario(),
                                hovercraft::testing::kMassByNumbers, part),
      source);
  const Marker mesh = craftMarkers(scenario.vehicles.front()).front();
  EXPECT_EQ(mesh.type, Marker::MESH_RESOURCE);
  EXPECT_EQ(mesh.mesh_resource, "file://" + source.directory + "/l_shape.obj");
  EXPECT_EQ(mesh.mesh_resource.rfind("file:///", 0), 0U);
  expectScale(mesh, Vector3::Ones());
  expectAt(mesh.pose.position, {1.0, 2.0, 3.0});
}

TEST(VehicleMarkers, EachSolidHasItsSizesPlaceAndTurn) {
  const auto scenario = hovercraft::testing::parsed(hovercraft::testing::scenarioOfParts());
  const std::vector<Marker> markers = craftMarkers(scenario.vehicles.front());
  expectScale(markers[0], {0.6, 0.4, 0.1});
  expectScale(markers[1], {0.1, 0.1, 0.2});    // two radii, two radii, length
  expectScale(markers[2], {0.14, 0.14, 0.3});  // RViz: shaft and head diameter, length of the head
  expectAt(markers[2].points[0], {0.0, 0.0, -0.15});  // from its base to its tip
  expectAt(markers[2].points[1], {0.0, 0.0, 0.15});
  expectScale(markers[3], {0.066, 0.066, 0.066});
  expectAt(markers[0].pose.position, Vector3::Zero());
  expectAt(markers[1].pose.position, {-0.25, 0.0, 0.1});
  expectAt(markers[2].pose.position, {0.3, 0.0, 0.05});
  expectAt(markers[3].pose.position, {0.01, 0.07, 0.0});
  // Pitch by a right angle takes z to x.
  EXPECT_LT((turned(markers[1], Vector3::UnitZ()) - Vector3::UnitX()).norm(), 1e-12);
  std::set<std::pair<std::string, int>> names;
  for (const Marker& marker : markers) names.insert({marker.ns, marker.id});
  EXPECT_EQ(names.size(), markers.size());
}

TEST(VehicleMarkers, EnginesStandWhereTheyPushAndAlongIt) {
  const hovercraft::VehicleScenario alpha = craft();
  const std::vector<Marker> markers = craftMarkers(alpha);
  ASSERT_EQ(markers.size(), 2U + 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const Marker& fan = markers[2 + i];
    EXPECT_EQ(fan.type, Marker::CYLINDER);
    expectAt(fan.pose.position, alpha.engines[i].p_HE);
    EXPECT_LT((turned(fan, Vector3::UnitZ()) - alpha.engines[i].direction).norm(), 1e-12) << i;
  }
}

// A box of the same tensor, and the bow a quarter of its length ahead of the centre of mass.
TEST(VehicleMarkers, ACraftByNumbersIsDrawnAboutItsCentreOfMass) {
  const hovercraft::VehicleScenario alpha = craft();
  const std::vector<Marker> markers = craftMarkers(alpha);
  const Vector3 edges = equivalentBox(alpha.mass_properties);
  EXPECT_EQ(markers[0].type, Marker::CUBE);
  expectScale(markers[0], edges.cwiseMax(0.02));
  expectAt(markers[0].pose.position, {0.01, 0.02, 0.03});
  expectAt(markers[1].pose.position, {0.01 + 0.25 * edges.x(), 0.02, 0.03});
}

TEST(VehicleMarkers, AVisualIsDrawnInPlaceOfThePartsWithItsOwnColours) {
  hovercraft::VehicleScenario with_visual =
      hovercraft::testing::parsed(hovercraft::testing::scenarioOfParts()).vehicles.front();
  with_visual.visual = {"package://shapes/craft.dae", {0.1, 0.2, 0.3}, {1.0, 2.0, 3.0}, {}};
  with_visual.visual->rpy = {0.0, 0.0, std::acos(0.0)};
  const std::vector<Marker> markers = craftMarkers(with_visual);
  ASSERT_EQ(markers.size(), 1U + 3U);
  EXPECT_EQ(markers[0].type, Marker::MESH_RESOURCE);
  EXPECT_EQ(markers[0].mesh_resource, "package://shapes/craft.dae");
  EXPECT_EQ(markers[0].mesh_use_embedded_materials, 1);
  EXPECT_EQ(markers[0].color.a, 0.0F);
  EXPECT_EQ(markers[0].scale.y, 0.2);
  EXPECT_EQ(markers[0].pose.position.z, 3.0);
  EXPECT_NEAR(markers[0].pose.orientation.z, std::sqrt(0.5), 1e-15);
  EXPECT_EQ(markers[0].header.frame_id, "alpha/base_link");
}

// An obstacle at (50, 0, 0), turned a quarter about z, whose visual lies 1 m along its own x.
TEST(VehicleMarkers, TheVisualOfAnObstacleLiesInItsFrame) {
  const hovercraft::Scenario scenario = hovercraft::testing::parsed(
      hovercraft::testing::validScenario() +
      "    hull: {box: {size: [0.6, 0.4, 0.1]}}\nworld:\n  obstacles: {block: {box: {size: [1, 1, "
      "1]}, position: [50, 0, 0], rpy: [0, 0, "
      "1.5707963267948966], visual: {file: /a.dae, position: [1, 0, 0]}}}\n");
  const std::vector<Marker> markers = obstacleMarkers(scenario, "world");
  ASSERT_EQ(markers.size(), 1U);
  EXPECT_EQ(markers[0].mesh_resource, "file:///a.dae");
  EXPECT_TRUE(markers[0].points.empty());
  EXPECT_NEAR(markers[0].pose.position.x, 50.0, 1e-15);
  EXPECT_NEAR(markers[0].pose.position.y, 1.0, 1e-15);
  EXPECT_NEAR(markers[0].pose.orientation.z, std::sqrt(0.5), 1e-15);
}

TEST(VehicleMarkers, AnEngineOfNoThrustIsNotBuiltIn) {
  hovercraft::VehicleScenario without = craft();
  const std::size_t before = craftMarkers(without).size();
  without.engines[0].min_thrust = without.engines[0].max_thrust = 0.0;
  EXPECT_EQ(craftMarkers(without).size(), before - 1);
}

TEST(VehicleMarkers, ArrowsGrowWithTheThrustAndTurnRedWhenSaturated) {
  hovercraft_sim::EngineStatus status;
  status.rear.applied = -2.25;  // half of the most
  status.left.applied = 1.5;    // all of it
  status.left.saturated = 1;
  const std::vector<Marker> arrows = thrustMarkers(craft(), status);
  ASSERT_EQ(arrows.size(), 3U);
  EXPECT_NEAR(lengthOf(arrows[0]), 0.5 * lengthOf(arrows[1]), 1e-12);
  // From the engine along its direction, 0.8 m at full thrust: backwards at half, to the right at
  // full.
  expectAt(arrows[0].points[0], {-0.25, 0.0, 0.05});
  expectAt(arrows[0].points[1], {-0.25 - 0.4, 0.0, 0.05});
  expectAt(arrows[1].points[0], {0.2, 0.15, 0.05});
  expectAt(arrows[1].points[1], {0.2, 0.15 - 0.8, 0.05});
  EXPECT_GT(arrows[1].color.r, arrows[1].color.g + 0.5F);
  EXPECT_GT(arrows[0].color.g, 0.5F);
  EXPECT_EQ(arrows[2].action, Marker::DELETE);
  EXPECT_EQ(arrows[1].action, Marker::ADD);
}

TEST(VehicleMarkers, ObstaclesAndLooseBodiesAreDrawnWhereTheyAre) {
  const std::string world = R"(world:
  obstacles:
    wall: {box: {size: [1, 2, 3]}, position: [4, 5, 6]}
  bodies:
    crate: {parts: [{box: {size: [0.2, 0.4, 0.6]}, mass: 1, position: [0.5, 0, 0]}], initial: {position: [9, 9, 9]}}
)";
  const auto scenario = hovercraft::testing::parsed(hovercraft::testing::scenarioOfParts() + world);
  const std::vector<Marker> walls = obstacleMarkers(scenario, "map");
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_EQ(walls[0].header.frame_id, "map");
  EXPECT_EQ(walls[0].points.size(), 36U);  // 12 triangles
  const Bounds wall(walls[0]);
  const Marker crate = bodyMarker(scenario.world->bodies.front());
  EXPECT_EQ(crate.header.frame_id, "crate/base_link");
  EXPECT_EQ(crate.points.size(), 36U);
  const Bounds hull(crate);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(wall.low[i], Vector3(3.5, 4.0, 4.5)[i], 1e-12);
    EXPECT_NEAR(wall.high[i], Vector3(4.5, 6.0, 7.5)[i], 1e-12);
    EXPECT_NEAR(hull.low[i], Vector3(0.4, -0.2, -0.3)[i], 1e-12);
    EXPECT_NEAR(hull.high[i], Vector3(0.6, 0.2, 0.3)[i], 1e-12);
  }
}

TEST(VehicleMarkers, APrefixStandsBeforeTheFrameOfEach) {
  std::vector<Marker> markers = craftMarkers(craft());
  const std::string frame = markers.front().header.frame_id;
  addPrefix("", markers);
  EXPECT_EQ(markers.front().header.frame_id, frame);
  addPrefix("fleet/red", markers);
  for (const Marker& marker : markers) EXPECT_EQ(marker.header.frame_id, "fleet/red/" + frame);
}

TEST(VehicleMarkers, APathNeedsTwoPoints) {
  std::vector<geometry_msgs::Point> path(1);
  EXPECT_EQ(pathMarker(craft(), "map", path).action, Marker::DELETE);
  path.emplace_back();
  EXPECT_EQ(pathMarker(craft(), "map", path).action, Marker::ADD);
  path.back().y = 2.0;
  const Marker line = pathMarker(craft(), "map", path);
  EXPECT_EQ(line.header.frame_id, "map");
  EXPECT_EQ(line.type, Marker::LINE_STRIP);
  EXPECT_EQ(line.ns, "alpha/path");
  EXPECT_EQ(line.frame_locked, 0);
  EXPECT_EQ(line.scale.x, 0.03);
  ASSERT_EQ(line.points.size(), 2U);
  expectAt(line.points[1], {0.0, 2.0, 0.0});
}

}  // namespace
}  // namespace hovercraft_ros
