#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/world/island.h"
#include "hovercraft_sim/world/world_types.h"

namespace hovercraft {

/// Moving bodies and fixed obstacles, and one step of all of them (doc/contact.md).
///
/// Invariant: two bodies of a state that starts without overlap never overlap in a later one. Every
/// piece of a step ends before the time of impact of each pair near it, or at it.
/// The same states give the same bits, whatever was stepped before: what is kept between steps
/// besides the memory of contacts is a list of neighbours that only saves time.
class HOVERCRAFT_PUBLIC World {
 public:
  static constexpr int kNone = -1;

  World(WorldRules rules, std::vector<WorldBody> bodies, std::vector<WorldObstacle> obstacles);

  /// One step of all bodies. @param states in the order of the bodies; replaced. @param memory of
  /// the last step; replaced. @param records what happened is appended, in the order of time within
  /// each group of bodies that are near each other.
  /// @returns the first body that would come out of reach (isInReach(), kFarthest), for which
  /// nothing is changed; kNone.
  int step(const std::vector<BodyDrive>& drives, std::vector<BodyState>& states,
           std::vector<ContactMemory>& memory, std::vector<ContactRecord>& records);

  /// The deepest overlap beyond the tolerance, if there is one. @param body only its pairs; -1:
  /// all.
  std::optional<WorldOverlap> overlap(const std::vector<BodyState>& states, int body = -1) const;

  /// Two bodies without the least gap that a step can start from, if there are some: those that
  /// partTouching() could not part. @param body only its pairs; -1: all.
  std::optional<WorldOverlap> squeezed(const std::vector<BodyState>& states, int body = -1) const;

  /// The least distance of any two bodies (negative: depth), m; for tests and reports.
  double leastGap(const std::vector<BodyState>& states) const;

  /// Moves bodies that touch, or overlap by no more than the tolerance, apart to half the
  /// tolerance: a stack may be described as touching. @param body only its pairs; -1: all.
  void partTouching(std::vector<BodyState>& states, int body = -1) const;

  const WorldRules& rules() const { return rules_; }
  const std::vector<WorldBody>& bodies() const { return bodies_; }
  const std::vector<WorldObstacle>& obstacles() const { return obstacles_; }
  const std::string& nameOf(std::int32_t index) const;
  const ConvexPolyhedron& hullOf(std::int32_t index) const;
  int materialOf(std::int32_t index) const;
  /// How often a bound cut off the rest of a step: on its events, or on how often it is begun anew
  /// because bodies came farther than was looked.
  std::int64_t stalls() const { return stalls_; }

 private:
  friend class Island;
  using Pair = std::pair<std::int32_t, std::int32_t>;

  /// What the neighbour search knows of a body.
  struct Extent {
    Vector3 center_B = Vector3::Zero();  // m, of the box around the hull
    Vector3 half_B = Vector3::Zero();
    double radius = 0.0;      // m, from B
    double spin_per_L = 0.0;  // bound on |w| / |L|, 1/(kg m²)
    double travel = 0.0;      // m: how far its points can come in this step
    AxisAlignedBox roomy;     // its neighbours are known as long as it stays inside
  };

  double reachOf(std::size_t body) const;
  double travelOf(std::size_t body, const BodyState& from, const BodyState& to, double h) const;
  void makeRoom(const std::vector<BodyState>& states);
  bool findNeighbours(const std::vector<BodyState>& states);
  void findNearPairs(const std::vector<BodyState>& states);
  void collectGroups();
  bool listGroup(std::int32_t group);
  bool takeIsland();
  ClosestFeatures closestOf(const std::vector<BodyState>& states, const Pair& pair) const;
  std::optional<WorldOverlap> deepest(const std::vector<BodyState>& states, int body,
                                      double allowed) const;
  /// The displacements, m, that take the two bodies `by` metres apart along nhat_AB_W, each in
  /// proportion to its mobility. @param only the one body that may move; -1: both. @returns nothing
  /// if neither can move that way.
  std::optional<std::array<Vector3, 2>> shiftsApart(const Pair& pair, const Vector3& nhat_AB_W,
                                                    double by, int only) const;
  bool partPair(std::vector<BodyState>& states, const Pair& pair, double wanted, int only) const;
  bool stepGroups(const std::vector<BodyDrive>& drives, const std::vector<BodyState>& states,
                  const std::vector<ContactMemory>& memory, std::vector<ContactRecord>& records);
  AxisAlignedBox boxOf(std::size_t body, const Pose& pose, double margin) const;
  bool isFixed(std::int32_t index) const {
    return static_cast<std::size_t>(index) >= bodies_.size();
  }
  Pose poseIn(const std::vector<BodyState>& states, std::int32_t index) const;
  std::vector<Pair> allPairs(int body) const;

  WorldRules rules_;
  std::vector<WorldBody> bodies_;
  std::vector<WorldObstacle> obstacles_;
  std::vector<AxisAlignedBox> obstacle_boxes_;
  std::vector<Extent> extents_;
  bool knows_neighbours_ = false;
  std::vector<Pair> neighbours_;     // may come near, ascending
  std::vector<double> rooms_;        // m, of each body
  std::vector<Pair> near_;           // may meet in this step, ascending
  std::vector<std::int32_t> group_;  // of each body: the least index in its group
  std::vector<BodyState> ends_;
  std::vector<ContactMemory> next_memory_;
  std::vector<Pair> group_pairs_;
  std::vector<std::int32_t> group_bodies_;
  std::vector<AxisAlignedBox> boxes_;
  IslandScratch scratch_;
  std::int64_t stalls_ = 0;
  std::int64_t cut_off_ = 0;  // islands of this step that their bound cut off
};

}  // namespace hovercraft
