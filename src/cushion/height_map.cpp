#include "hovercraft_sim/cushion/height_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

/// Where a coordinate lies among `count` lines of the grid.
struct MeshPlace {
  std::size_t line;  // the mesh between this line and the next
  double share;      // of the mesh, 0 to 1
  bool is_inside;    // else it is held at the edge
};

/// @param lines in spacings from the first line.
MeshPlace placeOf(double lines, std::size_t count) {
  const double last = static_cast<double>(count - 1);
  if (!(lines > 0.0)) return {0, 0.0, false};
  if (lines >= last) return {count - 2, 1.0, false};
  const auto line = static_cast<std::size_t>(lines);
  return {line, lines - static_cast<double>(line), true};
}

}  // namespace

HeightMapGround::HeightMapGround(HeightGrid grid) : grid_(std::move(grid)) {
  const FloatingPointEnvironment environment;
  demand(grid_.columns >= 2 && grid_.rows >= 2 && grid_.spacing > 0.0 &&
             grid_.heights.size() == grid_.columns * grid_.rows,
         "a height map has at least two rows and columns, and a height for each point");
  per_spacing_ = 1.0 / grid_.spacing;
}

GroundSample HeightMapGround::sampleAt(const GroundPoint& point) const {
  const MeshPlace x = placeOf((point.x - grid_.x) * per_spacing_, grid_.columns);
  const MeshPlace y = placeOf((point.y - grid_.y) * per_spacing_, grid_.rows);
  const double z00 = grid_.at(x.line, y.line);
  const double z10 = grid_.at(x.line + 1, y.line);
  const double z01 = grid_.at(x.line, y.line + 1);
  const double z11 = grid_.at(x.line + 1, y.line + 1);
  const double near = z00 + x.share * (z10 - z00);
  const double far = z01 + x.share * (z11 - z01);
  const double height = near + y.share * (far - near);
  const double along_x =
      x.is_inside ? ((z10 - z00) + y.share * ((z11 - z01) - (z10 - z00))) * per_spacing_ : 0.0;
  const double along_y = y.is_inside ? (far - near) * per_spacing_ : 0.0;
  const double nz = 1.0 / std::sqrt((1.0 + along_x * along_x) + along_y * along_y);
  return {(point.z - height) * nz, -along_x * nz, -along_y * nz, nz};
}

void HeightMapGround::sample(const GroundQuery& query, GroundSample* samples) const {
  for (int i = 0; i < query.count; ++i) samples[i] = sampleAt(query.points[i]);
}

}  // namespace hovercraft
