#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "hovercraft_sim/collision/motion.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// Finds the pairs of boxes that overlap: sweep and prune along the axis on which the boxes lie
/// farthest apart. The order of the boxes along the axis is kept, so that a small change costs a
/// small insertion sort. Pairs come sorted by index, whatever the boxes have been before: the same
/// boxes give the same list.
class HOVERCRAFT_PUBLIC BroadPhase {
 public:
  /// @returns the index of the new box: 0, 1, 2 ...
  int add(const AxisAlignedBox& box);

  /// Replaces a box. @throws std::logic_error if there is none of this index.
  void update(int index, const AxisAlignedBox& box);

  int size() const { return static_cast<int>(boxes_.size()); }

  /// All pairs (i, j), i < j, of boxes that overlap or touch, in ascending order. Valid until the
  /// next call; allocates only when there are more pairs or boxes than ever before.
  const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs();

 private:
  const AxisAlignedBox& box(std::int32_t index) const {
    return boxes_[static_cast<std::size_t>(index)];
  }
  /// Sorts the boxes by their lower ends; by insertion, as little changes from call to call, unless
  /// the axis did.
  void sortAlong(int axis);

  std::vector<AxisAlignedBox> boxes_;
  std::vector<std::int32_t> order_;  // by low end along axis_
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs_;
  int axis_ = 0;
};

}  // namespace hovercraft
