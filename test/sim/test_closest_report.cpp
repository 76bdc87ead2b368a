#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/closest_report.h"

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
