#pragma once

#include <cstddef>
#include <vector>

#include "hovercraft_sim/cushion/ground.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// Heights on a regular grid along the axes of W.
struct HeightGrid {
  std::size_t columns = 0;      // along x, >= 2
  std::size_t rows = 0;         // along y, >= 2
  double spacing = 0.0;         // m, > 0
  double x = 0.0;               // m, of the first column
  double y = 0.0;               // m, of the first row
  std::vector<double> heights;  // m, row by row

  /// m.
  double at(std::size_t column, std::size_t row) const { return heights[row * columns + column]; }
};

/// Ground of a grid of heights: bilinear within each mesh, with the normal of the same surface.
/// Beyond its edges the heights of the edge go on.
class HOVERCRAFT_PUBLIC HeightMapGround final : public Ground {
 public:
  /// @param grid at least two heights each way, and as many as it says.
  explicit HeightMapGround(HeightGrid grid);

  void sample(const GroundQuery& query, GroundSample* samples) const override;
  const HeightGrid& grid() const { return grid_; }  // as given

 private:
  GroundSample sampleAt(const GroundPoint& point) const;

  HeightGrid grid_;
  double per_spacing_ = 0.0;  // 1/m
};

}  // namespace hovercraft
