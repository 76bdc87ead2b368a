#include "hovercraft_sim/collision/broad_phase.h"

#include <algorithm>

#include "hovercraft_sim/math/demand.h"

namespace hovercraft {
namespace {

/// The axis along which the middles of the boxes vary most.
int widestAxis(const std::vector<AxisAlignedBox>& boxes) {
  Vector3 sum = Vector3::Zero();
  Vector3 squares = Vector3::Zero();
  for (const AxisAlignedBox& box : boxes) {
    const Vector3 middle = 0.5 * (box.low + box.high) - boxes[0].low;
    sum += middle;
    squares += middle.cwiseProduct(middle);
  }
  const Vector3 variance = squares - sum.cwiseProduct(sum) / static_cast<double>(boxes.size());
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (variance[i] > variance[axis]) axis = i;
  }
  return axis;
}

}  // namespace

int BroadPhase::add(const AxisAlignedBox& box) {
  order_.push_back(size());
  boxes_.push_back(box);
  return size() - 1;
}

void BroadPhase::update(int index, const AxisAlignedBox& box) {
  demand(index >= 0 && index < size(), "no such box in the broad phase");
  boxes_[static_cast<std::size_t>(index)] = box;
}

void BroadPhase::sortAlong(int axis) {
  const auto before = [&](std::int32_t a, std::int32_t b) {
    return box(a).low[axis] != box(b).low[axis] ? box(a).low[axis] < box(b).low[axis] : a < b;
  };
  if (axis != axis_) {
    axis_ = axis;
    std::sort(order_.begin(), order_.end(), before);
    return;
  }
  for (std::size_t i = 1; i < order_.size(); ++i) {
    const std::int32_t moved = order_[i];
    std::size_t k = i;
    for (; k > 0 && before(moved, order_[k - 1]); --k) order_[k] = order_[k - 1];
    order_[k] = moved;
  }
}

const std::vector<std::pair<std::int32_t, std::int32_t>>& BroadPhase::pairs() {
  pairs_.clear();
  if (boxes_.empty()) return pairs_;
  const int axis = widestAxis(boxes_);
  sortAlong(axis);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const AxisAlignedBox& first = box(order_[i]);
    for (std::size_t k = i + 1; k < order_.size() && box(order_[k]).low[axis] <= first.high[axis];
         ++k) {
      if (first.overlaps(box(order_[k]))) {
        pairs_.emplace_back(std::min(order_[i], order_[k]), std::max(order_[i], order_[k]));
      }
    }
  }
  std::sort(pairs_.begin(), pairs_.end());
  return pairs_;
}

}  // namespace hovercraft
