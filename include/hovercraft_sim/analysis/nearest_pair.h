#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hovercraft_sim/collision/closest_features.h"
#include "hovercraft_sim/geometry/convex_polyhedron.h"
#include "hovercraft_sim/geometry/pose.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft {

/// The closest points of the two bodies of a scenario that are nearest to each other.
struct NearestPair {
  std::string a;          // a craft or a loose body
  std::string b;          // one of these, or an obstacle
  double distance = 0.0;  // m, negative: depth
  Vector3 p_WCa;
  Vector3 p_WCb;
};

/// Finds the nearest pair of a scenario with a world, to show it: it moves nothing. Every query
/// starts from the features of the last one.
class HOVERCRAFT_PUBLIC NearestPairFinder {
 public:
  /// Without a world there is never a pair.
  explicit NearestPairFinder(const Scenario& scenario);

  /// Those that move: craft, then loose bodies, in the order of the scenario.
  const std::vector<std::string>& moving() const { return moving_; }
  /// @param X_WH where base_link of each of moving() is; none: not known, it is left out. Finite,
  /// rotations orthonormal.
  [[nodiscard]] std::optional<NearestPair> find(const std::vector<std::optional<Pose>>& X_WH);
  /// How far one of moving() is from the nearest of those that are named, m; negative: depth.
  /// @param a its index. @param names of moving ones and obstacles; empty: all others.
  /// @param X_WH as in find(). @returns none if there is no other, or a is not known.
  [[nodiscard]] std::optional<double> clearance(std::size_t a, const std::set<std::string>& names,
                                                const std::vector<std::optional<Pose>>& X_WH);

 private:
  struct Solid {
    std::string name;
    ConvexPolyhedron hull;  // in B; of an obstacle in W
    Vector3 p_HB = Vector3::Zero();
    Vector3 center = Vector3::Zero();  // of a ball around it, m
    double radius = 0.0;
  };

  /// Of the body frame.
  [[nodiscard]] std::optional<Pose> poseOf(std::size_t solid,
                                           const std::vector<std::optional<Pose>>& X_WH) const;
  /// Takes the pair if it is nearer than the nearest one.
  void compare(std::size_t a, const Pose& X_WA, std::size_t b, const Pose& X_WB,
               std::optional<NearestPair>& nearest);
  void add(const std::string& name, ConvexPolyhedron hull, const Vector3& p_HB);

  std::vector<std::string> moving_;
  std::vector<Solid> solids_;       // moving ones, then obstacles
  std::vector<FeaturePair> pairs_;  // by moving one and solid
};

}  // namespace hovercraft
