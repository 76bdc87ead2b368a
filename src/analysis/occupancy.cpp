#include "hovercraft_sim/analysis/occupancy.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/io/output_file.h"
#include "hovercraft_sim/math/files_read.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/world_builder.h"

namespace hovercraft {
namespace {

constexpr double kMostCells = 1e8;
constexpr double kTouching = 1e-9;  // m: a cell whose border an obstacle shares is occupied

/// Where a x + b y <= c.
struct HalfPlane {
  double a;
  double b;
  double c;
};

struct Point {
  double x;
  double y;
};

struct Rectangle {
  double low_x;
  double low_y;
  double high_x;
  double high_y;
};

using Polygon = std::vector<Point>;

/// The part of a convex polygon in a half plane (Sutherland & Hodgman).
Polygon clipped(const Polygon& polygon, const HalfPlane& half) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& p = polygon[i];
    const Point& q = polygon[(i + 1) % polygon.size()];
    const double at_p = half.a * p.x + half.b * p.y - half.c;
    const double at_q = half.a * q.x + half.b * q.y - half.c;
    if (at_p <= 0.0) result.push_back(p);
    if ((at_p < 0.0 && at_q > 0.0) || (at_p > 0.0 && at_q < 0.0)) {
      const double t = at_p / (at_p - at_q);
      result.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
  }
  return result;
}

Polygon corners(const Rectangle& r) {
  return {{r.low_x, r.low_y}, {r.high_x, r.low_y}, {r.high_x, r.high_y}, {r.low_x, r.high_y}};
}

/// An obstacle cut by the plane: half planes, and the rectangle around them.
struct Slice {
  std::vector<HalfPlane> halves;
  Rectangle around{};
  bool is_empty = true;
};

Slice sliceOf(const WorldObstacle& obstacle, double height) {
  Slice slice;
  double reach = 0.0;
  for (const Vector3& vertex : obstacle.hull.vertices()) {
    const Vector3 p_W = transform(obstacle.X_WO, vertex);
    reach = std::max({reach, std::abs(p_W.x()), std::abs(p_W.y())});
  }
  for (const PolyhedronData::Face& face : obstacle.hull.data().faces) {
    const Vector3 normal = times(obstacle.X_WO.R_AB, face.normal);
    const double offset = face.offset + dot(normal, obstacle.X_WO.p_AB);
    slice.halves.push_back({normal.x(), normal.y(), offset - normal.z() * height});
  }
  const double border = reach + 1.0;
  Polygon polygon = corners({-border, -border, border, border});
  for (const HalfPlane& half : slice.halves) polygon = clipped(polygon, half);
  slice.is_empty = polygon.empty();
  if (slice.is_empty) return slice;
  const auto by_x = [](const Point& p, const Point& q) { return p.x < q.x; };
  const auto by_y = [](const Point& p, const Point& q) { return p.y < q.y; };
  const auto [left, right] = std::minmax_element(polygon.begin(), polygon.end(), by_x);
  const auto [low, high] = std::minmax_element(polygon.begin(), polygon.end(), by_y);
  slice.around = {left->x, low->y, right->x, high->y};
  for (HalfPlane& half : slice.halves) half.c += kTouching;
  return slice;
}

bool reachesInto(const Slice& slice, const Rectangle& cell) {
  Polygon polygon = corners(cell);
  for (const HalfPlane& half : slice.halves) {
    polygon = clipped(polygon, half);
    if (polygon.empty()) return false;
  }
  return true;
}

void requirePositive(const char* name, double value) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw std::invalid_argument(fmt::format("{} = {}: must be greater than 0", name, value));
}

void markSlice(const Slice& slice, OccupancyMap& map) {
  const auto cell_of = [&map](double place, double origin, std::int32_t count) {
    const double cell = std::floor((place - origin) / map.resolution);
    return static_cast<std::int32_t>(std::clamp(cell, 0.0, static_cast<double>(count - 1)));
  };
  const double slack = map.resolution * 0.5;
  const std::int32_t last_x = cell_of(slice.around.high_x + slack, map.origin_x, map.width);
  const std::int32_t last_y = cell_of(slice.around.high_y + slack, map.origin_y, map.height);
  for (std::int32_t y = cell_of(slice.around.low_y - slack, map.origin_y, map.height); y <= last_y;
       ++y) {
    for (std::int32_t x = cell_of(slice.around.low_x - slack, map.origin_x, map.width); x <= last_x;
         ++x) {
      const double left = map.origin_x + x * map.resolution;
      const double low = map.origin_y + y * map.resolution;
      auto& cell = map.cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                             static_cast<std::size_t>(x)];
      if (cell == 0 &&
          reachesInto(slice, {left, low, left + map.resolution, low + map.resolution})) {
        cell = 100;
      }
    }
  }
}

}  // namespace

OccupancyMap occupancyOf(const Scenario& scenario, const OccupancyRequest& request) {
  const FloatingPointEnvironment environment;
  requirePositive("the resolution of the map", request.resolution);
  requirePositive("the margin of the map", request.margin);
  if (!std::isfinite(request.height)) {
    throw std::invalid_argument("the height of the map must be finite");
  }
  std::vector<Slice> slices;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Rectangle all = {kInfinity, kInfinity, -kInfinity, -kInfinity};
  if (scenario.world) {
    const World world = worldOf(scenario);
    for (const WorldObstacle& obstacle : world.scene().obstacles()) {
      Slice slice = sliceOf(obstacle, request.height);
      if (slice.is_empty) continue;
      all = {std::min(all.low_x, slice.around.low_x), std::min(all.low_y, slice.around.low_y),
             std::max(all.high_x, slice.around.high_x), std::max(all.high_y, slice.around.high_y)};
      slices.push_back(std::move(slice));
    }
  }
  if (slices.empty()) {
    throw std::invalid_argument(
        fmt::format("the height of the map = {} m: no obstacle reaches it", request.height));
  }
  OccupancyMap map;
  map.resolution = request.resolution;
  map.origin_x = all.low_x - request.margin;
  map.origin_y = all.low_y - request.margin;
  const double width = std::ceil((all.high_x + request.margin - map.origin_x) / map.resolution);
  const double height = std::ceil((all.high_y + request.margin - map.origin_y) / map.resolution);
  if (!(width * height <= kMostCells)) {
    throw std::invalid_argument(fmt::format(
        "the resolution of the map = {} m: it would have more than 1e8 cells", request.resolution));
  }
  map.width = static_cast<std::int32_t>(width);
  map.height = static_cast<std::int32_t>(height);
  map.cells.assign(static_cast<std::size_t>(width * height), 0);
  for (const Slice& slice : slices) markSlice(slice, map);
  return map;
}

void writeMap(const OccupancyMap& map, const std::string& path,
              const std::vector<std::string>& inputs) {
  const std::filesystem::path yaml(path);
  if (yaml.extension() != ".yaml") {
    throw std::invalid_argument(fmt::format("--output = {}: must end in .yaml", path));
  }
  std::filesystem::path image = yaml;
  image.replace_extension(".pgm");
  // Black is occupied; the first row of the image is the one with the greatest y.
  std::string pixels = fmt::format("P5\n{} {}\n255\n", map.width, map.height);
  for (std::int32_t row = map.height; row-- > 0;) {
    for (std::int32_t x = 0; x < map.width; ++x) {
      const auto cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                        static_cast<std::size_t>(x);
      pixels += map.cells[cell] > 0 ? '\0' : static_cast<char>(254);
    }
  }
  checkOutputs({{"--output", path}, {"--output", image.string()}}, inputs);
  writeWholeFile(image.string(), pixels);
  writeWholeFile(path, fmt::format("image: {}\nresolution: {}\norigin: [{}, {}, 0]\nnegate: 0\n"
                                   "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
                                   image.filename().string(), numberText(map.resolution),
                                   numberText(map.origin_x), numberText(map.origin_y)));
}

void writeMapOf(const std::string& scenario, const OccupancyRequest& request,
                const std::string& path, RosFiles& ros) {
  const FilesRead read;
  const Scenario loaded = loadScenarioFile(scenario, {}, ros);
  writeMap(occupancyOf(loaded, request), path, read.paths());
}

}  // namespace hovercraft
