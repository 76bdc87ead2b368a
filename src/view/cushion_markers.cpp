#include "hovercraft_sim/view/cushion_markers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <variant>

#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/tf_frames.h"
#include "hovercraft_sim/view/vehicle_markers.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Vector3;
using visualization_msgs::Marker;

constexpr double kHemPoint = 0.1;        // of the shorter side of a cell
constexpr double kPillarWidth = 0.3;     // of it
constexpr double kTextHeight = 0.2;      // of it
constexpr double kSheet = 20.0;          // m, edge of what is shown of a plane
constexpr std::size_t kMostShown = 200;  // rows and columns of a height map that are drawn

/// The corners of two triangles that make a square of edge 1.
constexpr std::array<std::array<int, 2>, 6> kTwoTriangles = {
    {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}};

std_msgs::ColorRGBA colorOf(float r, float g, float b, float a) {
  std_msgs::ColorRGBA color;
  color.r = r;
  color.g = g;
  color.b = b;
  color.a = a;
  return color;
}

/// A length that goes with a cell, m.
double sizeOf(const hovercraft::CushionCell& cell) {
  return std::sqrt(cell.area);
}

Marker hemMarker(const hovercraft::VehicleScenario& craft, const std::string& frame) {
  Marker hem = markerOf(frame, craft.name + "/hem", 0, Marker::SPHERE_LIST);
  hem.frame_locked = 1;
  hem.color = colorOf(0.1F, 0.1F, 0.1F, 1.0F);
  double size = sizeOf(craft.cushion->cells.front());
  for (const hovercraft::CushionCell& cell : craft.cushion->cells) {
    size = std::min(size, sizeOf(cell));
    for (const hovercraft::HemPoint& point : cell.hem) {
      hem.points.push_back(toPointMessage(point.p_HK));
    }
  }
  hem.scale = toVector3Message(Vector3::Constant(kHemPoint * size));
  return hem;
}

/// Red: more than the mean of the cells, blue: less; suction points down.
Marker pillarMarker(const hovercraft::VehicleScenario& craft, const std::string& frame,
                    std::size_t index, double share) {
  const hovercraft::CushionCell& cell = craft.cushion->cells[index];
  Marker pillar =
      markerOf(frame, craft.name + "/pressure", static_cast<int>(index), Marker::CYLINDER);
  pillar.frame_locked = 1;
  const double width = kPillarWidth * sizeOf(cell);
  const double length = std::max(std::abs(share) * sizeOf(cell), 1e-6);
  pillar.scale = toVector3Message({width, width, length});
  pillar.pose.position =
      toPointMessage(cell.p_HC + Vector3(0.0, 0.0, 0.5 * std::copysign(length, share)));
  const auto excess = static_cast<float>(std::clamp(share - 1.0, -1.0, 1.0));
  pillar.color = colorOf(0.5F + 0.5F * excess, 0.4F, 0.5F - 0.5F * excess, 0.7F);
  return pillar;
}

Marker gapMarker(const hovercraft::VehicleScenario& craft, const std::string& frame,
                 std::size_t index, double gap) {
  const hovercraft::CushionCell& cell = craft.cushion->cells[index];
  Marker text =
      markerOf(frame, craft.name + "/gap", static_cast<int>(index), Marker::TEXT_VIEW_FACING);
  text.frame_locked = 1;
  text.scale.z = kTextHeight * sizeOf(cell);
  text.pose.position = toPointMessage(cell.p_HC + Vector3(0.0, 0.0, 1.3 * sizeOf(cell)));
  text.color = colorOf(1.0F, 1.0F, 1.0F, 1.0F);
  std::array<char, 32> words = {};
  std::snprintf(words.data(), words.size(), "%.1f mm", 1e3 * gap);
  text.text = words.data();
  return text;
}

/// Heights as triangles, thinned out if there are many, dark where it is low.
struct SurfacePainter {
  Marker& target;

  void operator()(const hovercraft::PlaneScenario& plane) const {
    const double half = 0.5 * kSheet;
    const auto point_at = [&](double x, double y) {
      const Vector3& n = plane.normal;
      return toPointMessage({x, y, plane.height - (n.x() * x + n.y() * y) / n.z()});
    };
    for (const auto& corner : kTwoTriangles) {
      target.points.push_back(
          point_at(half * (2.0 * corner[0] - 1.0), half * (2.0 * corner[1] - 1.0)));
    }
  }
  void operator()(const hovercraft::HeightMapScenario& map) const {
    const hovercraft::HeightGrid& grid = map.surface->grid();
    const std::size_t step = 1 + std::max(grid.columns, grid.rows) / kMostShown;
    for (std::size_t row = 0; row + step < grid.rows; row += step) {
      for (std::size_t column = 0; column + step < grid.columns; column += step) {
        for (const auto& corner : kTwoTriangles) {
          add(map, column + static_cast<std::size_t>(corner[0]) * step,
              row + static_cast<std::size_t>(corner[1]) * step);
        }
      }
    }
  }

 private:
  void add(const hovercraft::HeightMapScenario& map, std::size_t column, std::size_t row) const {
    const hovercraft::HeightGrid& grid = map.surface->grid();
    const double z = grid.at(column, row);
    target.points.push_back(toPointMessage({grid.x + static_cast<double>(column) * grid.spacing,
                                            grid.y + static_cast<double>(row) * grid.spacing, z}));
    const auto share = static_cast<float>((z - map.z_min) / (map.z_max - map.z_min));
    target.colors.push_back(
        colorOf(0.25F + 0.5F * share, 0.3F + 0.45F * share, 0.25F + 0.4F * share, 1.0F));
  }
};

}  // namespace

std::vector<Marker> cushionMarkers(const hovercraft::VehicleScenario& craft,
                                   const hovercraft_sim::Cushion& cushion) {
  if (!craft.cushion) return {};
  const std::string frame = TfFrames().of(craft.name);
  std::vector<Marker> markers = {hemMarker(craft, frame)};
  const std::vector<hovercraft::CushionCell>& cells = craft.cushion->cells;
  if (cushion.cells.size() != cells.size()) return markers;
  double force = 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    force += std::abs(cushion.cells[i].force);
    area += cells[i].area;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double share = force > 0.0 ? cushion.cells[i].pressure * area / force : 0.0;
    markers.push_back(pillarMarker(craft, frame, i, share));
    markers.push_back(gapMarker(craft, frame, i, cushion.cells[i].gap));
  }
  return markers;
}

std::vector<Marker> groundMarkers(const hovercraft::Scenario& scenario,
                                  const std::string& world_frame) {
  if (!scenario.ground) return {};
  Marker sheet = markerOf(world_frame, "ground", 0, Marker::TRIANGLE_LIST);
  sheet.scale = toVector3Message(Vector3::Ones());
  sheet.color = colorOf(0.45F, 0.5F, 0.45F, 1.0F);
  std::visit(SurfacePainter{sheet}, scenario.ground->surface);
  return {sheet};
}

}  // namespace hovercraft_ros
