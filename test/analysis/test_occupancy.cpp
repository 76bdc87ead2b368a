#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/analysis/occupancy.h"

#include "../support/files.h"
#include "../support/scenarios.h"

namespace hovercraft {
namespace {

Scenario sceneWith(const std::string& obstacles) {
  return testing::scenarioOf("step_size: 0.01\nmodel: planar\nworld: {obstacles: {" + obstacles +
                             "}}\nvehicles:\n" + testing::craftYaml("craft") +
                             "    hull: {box: {size: [0.1, 0.1, 0.1]}}\n    initial: {position: "
                             "[50, 0, 0]}\n");
}

OccupancyRequest requestOf(double height, double resolution, double margin) {
  OccupancyRequest request;
  request.height = height;
  request.resolution = resolution;
  request.margin = margin;
  return request;
}

std::string rows(const OccupancyMap& map) {
  std::string text;
  for (std::int32_t y = map.height; y-- > 0;) {
    for (std::int32_t x = 0; x < map.width; ++x) {
      text += map.cells.at(static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                           static_cast<std::size_t>(x)) == 100
                  ? '#'
                  : '.';
    }
    text += '\n';
  }
  return text;
}

// A box of 1 m x 0.5 m with its corner off the grid by half a cell: cells of 0.25 m from -1 -
// 0.375.
TEST(Occupancy, ABoxFillsTheCellsThatItReachesInto) {
  const OccupancyMap map =
      occupancyOf(sceneWith("a: {box: {size: [1, 0.5, 1]}, position: [0.5, 0.25, 0]}"),
                  requestOf(0.1, 0.25, 0.375));
  EXPECT_EQ(map.origin_x, -0.375);
  EXPECT_EQ(map.origin_y, -0.375);
  EXPECT_EQ(rows(map),
            ".......\n"
            ".#####.\n"
            ".#####.\n"
            ".#####.\n"
            ".......\n");
}

TEST(Occupancy, ATurnedBoxIsADiamond) {
  const OccupancyMap map =
      occupancyOf(sceneWith("a: {box: {size: [1.38, 1.38, 1]}, rpy: [0, 0, 0.7853981633974483]}"),
                  requestOf(0.0, 0.5, 0.02419262));
  EXPECT_EQ(rows(map),
            ".##.\n"
            "####\n"
            "####\n"
            ".##.\n");
}

TEST(Occupancy, TheHeightDecides) {
  const Scenario scenario = sceneWith(
      "low: {box: {size: [1, 1, 0.2]}}, high: {box: {size: [1, 1, 0.2]}, position: [3, 0, 1]}");
  EXPECT_LT(occupancyOf(scenario, requestOf(0.05, 0.1, 0.5)).width, 25);
  EXPECT_GT(occupancyOf(scenario, requestOf(1.05, 0.1, 0.5)).origin_x, 1.9);
  EXPECT_EQ(testing::messageOf([&] { occupancyOf(scenario, requestOf(0.5, 0.1, 0.5)); }),
            "the height of the map = 0.5 m: no obstacle reaches it");
}

TEST(Occupancy, BadRequestsAreRefused) {
  const Scenario scenario = sceneWith("a: {box: {size: [1, 1, 1]}}");
  const auto complaint = [&](double resolution, double margin) {
    return testing::messageOf([&] { occupancyOf(scenario, requestOf(0.0, resolution, margin)); });
  };
  EXPECT_EQ(complaint(0.0, 1.0), "the resolution of the map = 0: must be greater than 0");
  EXPECT_EQ(complaint(0.1, -1.0), "the margin of the map = -1: must be greater than 0");
  EXPECT_EQ(complaint(1e-6, 1.0),
            "the resolution of the map = 1e-06 m: it would have more than 1e8 cells");
}

TEST(Occupancy, IsWrittenAsMapServerReadsIt) {
  const testing::TestFolder folder;
  const OccupancyMap map =
      occupancyOf(sceneWith("a: {box: {size: [1, 0.5, 1]}, position: [0.5, 0.25, 0]}"),
                  requestOf(0.1, 0.25, 0.375));
  writeMap(map, folder.file("pen.yaml"));
  EXPECT_EQ(testing::contentOf(folder.file("pen.yaml")),
            "image: pen.pgm\nresolution: 0.25\norigin: [-0.375, -0.375, 0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const std::string image = testing::contentOf(folder.file("pen.pgm"));
  ASSERT_EQ(image.substr(0, 11), "P5\n7 5\n255\n");
  ASSERT_EQ(image.size(), 11U + 35U);
  EXPECT_EQ(image[11 + 7], static_cast<char>(254));
  EXPECT_EQ(image[11 + 8], '\0');
  EXPECT_EQ(testing::messageOf([&] { writeMap(map, folder.file("pen.pgm")); }),
            "--output = " + folder.file("pen.pgm") + ": must end in .yaml");
}

}  // namespace
}  // namespace hovercraft
