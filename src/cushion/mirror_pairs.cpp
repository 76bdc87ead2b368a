#include "hovercraft_sim/cushion/mirror_pairs.h"

namespace hovercraft {
namespace {

Vector3 mirrored(const Vector3& p, int axis) {
  Vector3 image = p;
  image[axis] = -image[axis];
  return image;
}

/// The first element that is still free and the image of another one; -1: none.
int freeImage(const std::vector<PlacedElement>& elements, const std::vector<bool>& taken,
              const PlacedElement& original, int axis) {
  const Vector3 image = mirrored(original.p, axis);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (taken[i] || elements[i].size != original.size) continue;
    if ((elements[i].p - image).cwiseAbs().maxCoeff() == 0.0) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

std::vector<MirrorPair> mirrorPairs(const std::vector<PlacedElement>& elements) {
  std::vector<MirrorPair> pairs;
  std::vector<bool> taken(elements.size(), false);
  const auto take = [&](int first) {
    taken[static_cast<std::size_t>(first)] = true;
    const int second = freeImage(elements, taken, elements[static_cast<std::size_t>(first)], 1);
    if (second >= 0) taken[static_cast<std::size_t>(second)] = true;
    pairs.push_back({first, second});
  };
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (taken[i]) continue;
    take(static_cast<int>(i));
    const int opposite = freeImage(elements, taken, elements[i], 0);
    if (opposite >= 0) take(opposite);
  }
  return pairs;
}

}  // namespace hovercraft
