#pragma once

#include <random>
#include <vector>

#include "hovercraft_sim/collision/closest_features.h"
#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/math/quaternion.h"

namespace hovercraft {

/// Seeded random bodies and poses for tests, benchmarks and checks.
class RandomBodies {
 public:
  explicit RandomBodies(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1));
  }
  Vector3 unitVector() {
    for (;;) {
      const Vector3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      const double square = dot(v, v);
      if (square > 1e-4 && square <= 1.0) return v / std::sqrt(square);
    }
  }
  Quaternion orientation() {
    for (;;) {
      const Quaternion q{uniform(-1, 1), {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}};
      const double square = squaredNorm(q);
      if (square > 1e-4 && square <= 1.0) return normalized(q);
    }
  }
  /// The hull of n points on an ellipsoid with the given semi-axes: n vertices.
  ConvexPolyhedron ellipsoidHull(int n, const Vector3& axes) {
    std::vector<Vector3> points;
    points.reserve(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) points.emplace_back(unitVector().cwiseProduct(axes));
    return convexHull(points, "random hull");
  }
  Pose pose(double reach) { return {rotationMatrix(orientation()), Vector3(reach * unitVector())}; }

 private:
  std::mt19937 engine_;
};

}  // namespace hovercraft
