#pragma once

#include <array>
#include <utility>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// What is summed together first: an element and its mirror image across the plane y = 0, or, if
/// there is none, itself alone (second < 0).
using MirrorPair = std::array<int, 2>;

/// Something at a place, of a size (-): mirror images have equal sizes.
struct PlacedElement {
  Vector3 p;          // its place
  double size = 0.0;  // what must be equal besides the place
};

/// The order in which wrenches of elements are summed, so that those of a symmetric craft cancel to
/// the last bit: pairs of mirror images left and right, and after each pair its image across x = 0.
HOVERCRAFT_PUBLIC std::vector<MirrorPair> mirrorPairs(const std::vector<PlacedElement>& elements);

}  // namespace hovercraft
