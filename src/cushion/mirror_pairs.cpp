#include "hovercraft_sim/cushion/mirror_pairs.h"

#include <array>
#include <map>
#include <set>

namespace hovercraft {
namespace {

Vector3 mirrored(const Vector3& p, int axis) {
  Vector3 image = p;
  image[axis] = -image[axis];
  return image;
}

/// Elements that are still free, by place and size.
class FreeElements {
 public:
  explicit FreeElements(const std::vector<PlacedElement>& elements) : elements_(elements) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      indices_[keyOf(elements[i].p, elements[i].size)].insert(static_cast<int>(i));
    }
  }

  bool isFree(int index) const {
    const auto found = indices_.find(keyOf(at(index).p, at(index).size));
    return found != indices_.end() && found->second.count(index) > 0;
  }
  void take(int index) { indices_[keyOf(at(index).p, at(index).size)].erase(index); }
  /// The first one that is the image of another one; -1: none.
  int imageOf(int original, int axis) const {
    const auto found = indices_.find(keyOf(mirrored(at(original).p, axis), at(original).size));
    if (found == indices_.end() || found->second.empty()) return -1;
    return *found->second.begin();
  }

 private:
  using Key = std::array<double, 4>;
  static Key keyOf(const Vector3& p, double size) { return {p.x(), p.y(), p.z(), size}; }
  const PlacedElement& at(int index) const { return elements_[static_cast<std::size_t>(index)]; }

  const std::vector<PlacedElement>& elements_;
  std::map<Key, std::set<int>> indices_;
};

}  // namespace

std::vector<MirrorPair> mirrorPairs(const std::vector<PlacedElement>& elements) {
  std::vector<MirrorPair> pairs;
  FreeElements free(elements);
  const auto take = [&](int first) {
    free.take(first);
    const int second = free.imageOf(first, 1);
    if (second >= 0) free.take(second);
    pairs.push_back({first, second});
  };
  for (int i = 0; i < static_cast<int>(elements.size()); ++i) {
    if (!free.isFree(i)) continue;
    take(i);
    const int opposite = free.imageOf(i, 0);
    if (opposite >= 0) take(opposite);
  }
  return pairs;
}

}  // namespace hovercraft
