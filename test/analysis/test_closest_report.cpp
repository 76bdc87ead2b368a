#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>
#include <yaml-cpp/yaml.h>

#include <gtest/gtest.h>

#include "hovercraft_sim/analysis/closest_report.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {
namespace {

ClosestRequest cubes() {
  return {"test/data/cube.obj", "test/data/cube.obj", {}, {}, false, true};
}

bool holds(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

// test/data/cube.obj far away along x: its faces are parallel, so the distance is that of planes.
TEST(ClosestReport, SaysWhatDesignAsksFor) {
  ClosestRequest request = cubes();
  request.pose_b = {10, 0, 0, 0, 0, 0, 1};
  const std::string text = closestReport(request);
  for (const char* field : {"\"status\": \"separated\"", "\"distance\": ", "\"point_a\": [",
                            "\"point_b\": [", "\"normal\": [1, 0, 0]", "\"feature_a\": {\"type\": ",
                            "\"feature_b\": {\"type\": ", "\"vertices\": [", "\"steps\": "}) {
    EXPECT_TRUE(holds(text, field)) << field << " in " << text;
  }
  request.json = false;
  EXPECT_TRUE(holds(closestReport(request), "status     separated\n"));
  request.pose_b = {0.1, 0, 0, 0, 0, 0, 1};
  EXPECT_TRUE(holds(closestReport(request), "status     penetrating\n"));
}

/// The answer as data; JSON is YAML.
YAML::Node answerTo(const std::vector<double>& pose_b) {
  ClosestRequest request = cubes();
  request.pose_b = pose_b;
  return YAML::Load(closestReport(request));
}

void expectNear(const YAML::Node& vector, const Vector3& expected) {
  ASSERT_EQ(vector.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(vector[i].as<double>(), expected[static_cast<Eigen::Index>(i)], 1e-12) << i;
  }
}

void expectFeature(const YAML::Node& feature, const std::string& type,
                   const std::set<int>& vertices) {
  EXPECT_EQ(feature["type"].as<std::string>(), type);
  const auto numbers = feature["vertices"].as<std::vector<int>>();
  EXPECT_EQ(std::set<int>(numbers.begin(), numbers.end()), vertices);
  EXPECT_EQ(numbers.size(), vertices.size());
}

// Vertices count in the order in which the faces of the file use them: faces 1 4 3 2 and 5 6 7 8
// give (0, 0, 0) the number 0, (0, 1, 0) 1, (1, 1, 0) 2, (1, 0, 0) 3, (0, 0, 1) 4, (1, 0, 1) 5, (1,
// 1, 1) 6 and (0, 1, 1) 7.
TEST(ClosestReport, TwoVerticesAreNamedByTheirNumbersInTheFile) {
  const YAML::Node answer = answerTo({2, 3, 4, 0, 0, 0, 1});
  const Vector3 apart(1.0, 2.0, 3.0);
  EXPECT_NEAR(answer["distance"].as<double>(), std::sqrt(14.0), 1e-12);
  expectNear(answer["point_a"], {1.0, 1.0, 1.0});
  expectNear(answer["point_b"], {2.0, 3.0, 4.0});
  expectNear(answer["normal"], apart / std::sqrt(14.0));
  expectFeature(answer["feature_a"], "vertex", {6});
  expectFeature(answer["feature_b"], "vertex", {0});
}

// B stands on its corner (0, 0, 0), 0.25 m above the top of A: its diagonal is upright. That turn
// takes (1, 1, 1)/√3 to z, about (1, -1, 0)/√2 by the angle of cosine 1/√3; half of it has the
// cosine c = sqrt((1 + 1/√3)/2).
TEST(ClosestReport, AFaceIsNamedByAllItsVertices) {
  const double c = std::sqrt(0.5 + 0.5 / std::sqrt(3.0));
  const double s = std::sqrt(0.5 - 0.5 / std::sqrt(3.0)) / std::sqrt(2.0);
  const YAML::Node answer = answerTo({0.5, 0.25, 1.25, s, -s, 0, c});
  EXPECT_NEAR(answer["distance"].as<double>(), 0.25, 1e-12);
  expectNear(answer["point_a"], {0.5, 0.25, 1.0});
  expectNear(answer["point_b"], {0.5, 0.25, 1.25});
  expectNear(answer["normal"], {0.0, 0.0, 1.0});
  expectFeature(answer["feature_a"], "face", {4, 5, 6, 7});
  expectFeature(answer["feature_b"], "vertex", {0});
}

// A is turned by 45° about x: its edge from (0, 1, 1) to (1, 1, 1) is its top, along x at y = 0, z
// = √2. B is turned alike, so that it stands on its edge from (0, 0, 0) to (1, 0, 0), and then by
// 90° about z, so that this edge lies along y, 0.25 m above.
TEST(ClosestReport, CrossedEdgesAreNamedByTheirEnds) {
  const double half = std::sqrt(0.5);
  const double c = std::cos(std::atan(1.0) / 2.0);
  const double s = std::sin(std::atan(1.0) / 2.0);
  ClosestRequest request = cubes();
  request.pose_a = {0, 0, 0, s, 0, 0, c};
  request.pose_b = {0.25, -0.5, std::sqrt(2.0) + 0.25, half * s, half * s, half * c, half * c};
  const YAML::Node answer = YAML::Load(closestReport(request));
  EXPECT_NEAR(answer["distance"].as<double>(), 0.25, 1e-12);
  expectNear(answer["point_a"], {0.25, 0.0, std::sqrt(2.0)});
  expectNear(answer["point_b"], {0.25, 0.0, std::sqrt(2.0) + 0.25});
  expectFeature(answer["feature_a"], "edge", {6, 7});
  expectFeature(answer["feature_b"], "edge", {0, 3});
}

// Where the hull leaves out vertices (those of the notch, (1, 1, 0) and (1, 1, 0.5)), the numbers
// are still those of the mesh: its faces begin with 6 5 4 3 2 1 and 7 8 9, so that vertex 9 of the
// file, (3, 1, 0.5), has the number 8.
TEST(ClosestReport, VerticesOfAHullKeepTheNumbersOfTheMesh) {
  ClosestRequest request = cubes();
  request.mesh_a = "test/data/l_shape.obj";
  request.hull = true;
  request.pose_b = {4, 3, 2, 0, 0, 0, 1};
  const YAML::Node answer = YAML::Load(closestReport(request));
  expectNear(answer["point_a"], {3.0, 1.0, 0.5});
  expectFeature(answer["feature_a"], "vertex", {8});
  expectFeature(answer["feature_b"], "vertex", {0});
}

TEST(ClosestReport, TheTextSaysTheSameAsTheJson) {
  ClosestRequest request = cubes();
  request.pose_b = {2, 1.5, 1.5, 0, 0, 0, 1};
  request.json = false;
  const std::string text = closestReport(request);
  for (const char* line : {"point_a    1 1 1\n", "point_b    2 1.5 1.5\n", "feature_a  vertex 6\n",
                           "feature_b  vertex 0\n"}) {
    EXPECT_TRUE(holds(text, line)) << line << " in\n" << text;
  }
}

TEST(ClosestReport, RefusesBadPosesAndMeshes) {
  ClosestRequest request = cubes();
  request.pose_a = {0, 0, 0, 0, 0, 1};
  EXPECT_THROW(closestReport(request), std::invalid_argument);
  request.pose_a = {0, 0, 0, 0, 0, 0, 2};
  EXPECT_THROW(closestReport(request), std::invalid_argument);
  request.pose_a.clear();
  request.mesh_b = "test/data/l_shape.obj";
  EXPECT_THROW(closestReport(request), std::invalid_argument);
  request.hull = true;
  EXPECT_NO_THROW(closestReport(request));
}

// Cubes of 0.001 m whose origins are 0.01 m apart: 0.009 m to the last digits of a double.
TEST(ClosestReport, TheScaleIsOfBothMeshes) {
  ClosestRequest request = cubes();
  request.scale = Vector3::Constant(0.001);
  request.pose_b = {0.01, 0, 0, 0, 0, 0, 1};
  std::vector<std::string> notes;
  const std::string text = closestReport(request, &notes);
  const std::string key = "\"distance\": ";
  EXPECT_NEAR(std::stod(text.substr(text.find(key) + key.size())), 0.009, 1e-17);
  EXPECT_TRUE(notes.empty());
}

TEST(ClosestReport, HullTakesAnOpenMesh) {
  ClosestRequest request = cubes();
  request.mesh_b = "test/data/open_cube.obj";
  EXPECT_THROW(closestReport(request), std::invalid_argument);
  request.hull = true;
  EXPECT_NO_THROW(closestReport(request));
}

}  // namespace
}  // namespace hovercraft
