#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/world/island.h"
#include "hovercraft_sim/world/scene.h"
#include "hovercraft_sim/world/world_types.h"

namespace hovercraft {

/// What one step made of the bodies.
struct StepResult {
  std::vector<BodyState> states;       // at its end
  std::vector<ContactCache> contacts;  // of pairs that are near, ascending
  std::vector<ContactRecord> records;  // in the order of time within each group of near bodies
};

/// Moving bodies and fixed obstacles, and one step of all of them (doc/contact.md): the only way in
/// which bodies move. Where they do not meet, each is stepped by itself.
///
/// Invariant: two bodies of a state that starts without overlap never overlap in a later one. Every
/// piece of a step ends before the time of impact of each pair near it, or at it.
/// The same states give the same bits, whatever was stepped before: what is kept between steps
/// besides the cache of contacts is a list of neighbours that only saves time.
class HOVERCRAFT_PUBLIC World {
 public:
  /// No body: what step() returns when all is well.
  static constexpr int kNone = -1;

  /// Bodies and obstacles as the scenario has checked them.
  World(WorldConfig config, std::vector<WorldBody> bodies, std::vector<WorldObstacle> obstacles);

  /// One step of all bodies. @param inputs, states in the order of the bodies. @param contacts
  /// those of the last step. @param result replaced; its memory is kept from step to step, so that
  /// nothing is allocated. It must not hold the states or the contacts that are passed in.
  /// @returns the first body that would come out of reach (isInReach(), kFarthest) where bodies
  /// meet; kNone. The result holds nothing to go on from then.
  [[nodiscard]] int step(const std::vector<StepInputs>& inputs,
                         const std::vector<BodyState>& states,
                         const std::vector<ContactCache>& contacts, StepResult& result);

  /// The deepest overlap beyond the tolerance, if there is one. @param body only its pairs; -1:
  /// all.
  [[nodiscard]] std::optional<WorldOverlap> overlap(const std::vector<BodyState>& states,
                                                    int body = -1) const;

  /// Two bodies without the least gap that a step can start from, if there are some: those that
  /// separateTouching() could not part. @param body only its pairs; -1: all.
  [[nodiscard]] std::optional<WorldOverlap> tooClose(const std::vector<BodyState>& states,
                                                     int body = -1) const;

  /// The least distance of any two bodies (negative: depth), m; for tests and reports.
  double leastGap(const std::vector<BodyState>& states) const;

  /// Moves bodies that touch, or overlap by no more than the tolerance, apart to half the
  /// tolerance: a stack may be described as touching. @param body only its pairs; -1: all.
  void separateTouching(std::vector<BodyState>& states, int body = -1) const;

  /// Whether the bodies come near nothing in so many steps if they move on as they do now, or up to
  /// twice as fast: for one who waits meanwhile. Forces may let them meet all the same. False where
  /// that is more than a few hundred pairs to look at.
  [[nodiscard]] bool isClearAhead(const std::vector<BodyState>& states, double steps) const;

  /// What is in the world, and its laws.
  const Scene& scene() const { return scene_; }
  /// How often a bound cut off the rest of a step: on its events, or on how often it is begun anew
  /// because a body went farther than its motion bound.
  std::int64_t stalls() const { return stalls_; }

 private:
  /// What the neighbour search knows of a body.
  struct Extent {
    Vector3 motion_bound = Vector3::Zero();  // m: how far its points can come in this step
    Scene::KeptMotionBound bound;            // kept from step to step
    AxisAlignedBox fat_box;                  // its neighbours are known while it stays inside
    // What isClear() showed holds on while the bound does, the centre of mass is at home, it turned
    // by less than this from there, and its neighbours' planes say so.
    AxisAlignedBox home;
    BodyState seen;
    double turn = 0.0;  // (-), squared difference of quaternions
  };

  struct Neighbour {
    ScenePair pair;
    int side = 0;                      // of an obstacle: where the body was outside last
    Vector3 normal = Vector3::Zero();  // the body is clear of it while normal · p_WB >= least
    double least = 0.0;                // m
  };

  bool isClear(const std::vector<BodyState>& states, const std::vector<BodyState>& ends);
  int updateMotionBounds(const std::vector<BodyState>& states, const std::vector<BodyState>& ends);
  Vector3 reachOf(std::size_t body) const;
  void makeFatBoxes(const std::vector<BodyState>& states);
  bool findNeighbours(const std::vector<BodyState>& states);
  void collectNeighbours(const std::vector<BodyState>& states);
  bool stayClear(const std::vector<BodyState>& states) const;
  void makeClearances(const std::vector<BodyState>& states, const std::vector<BodyState>& ends);
  bool makeClearance(Neighbour& neighbour);
  void findNearPairs(const std::vector<BodyState>& states);
  void updatePoses(const std::vector<BodyState>& states);
  const AxisAlignedBox& boxOf(std::size_t body);
  bool areApart(Neighbour& neighbour);
  void collectGroups();
  bool listGroup(std::int32_t group);
  bool collectIsland(StepResult& result);
  [[nodiscard]] std::optional<WorldOverlap> deepest(const std::vector<BodyState>& states, int body,
                                                    double allowed) const;
  bool separatePair(std::vector<BodyState>& states, const ScenePair& pair, double wanted,
                    int only) const;
  bool stepGroups(const std::vector<StepInputs>& inputs, const std::vector<BodyState>& states,
                  const std::vector<ContactCache>& contacts, StepResult& result);
  std::vector<ScenePair> allPairs(int body) const;

  Scene scene_;
  std::vector<Extent> extents_;
  bool knows_neighbours_ = false;
  bool has_clearances_ = false;        // those of the list of neighbours and the bounds
  int wait_ = 0;                       // steps until clearances are made again
  bool was_clear_ = true;              // no pair was near in the last step
  std::vector<Neighbour> neighbours_;  // may come near, ascending
  std::vector<double> margins_;        // m, of each body
  std::vector<ScenePair> near_;        // may meet in this step, ascending
  std::vector<std::int32_t> group_;    // of each body: the least index in its group
  std::vector<ScenePair> group_pairs_;
  std::vector<std::int32_t> group_bodies_;
  std::vector<Pose> poses_;  // of bodies at the start of the step
  std::vector<AxisAlignedBox> boxes_;
  std::vector<char> has_box_;  // 1: boxes_ has its box of this step
  IslandScratch scratch_;
  std::int64_t stalls_ = 0;
  std::int64_t cut_off_ = 0;  // islands of this step that their bound cut off
  int lost_ = kNone;          // a body that was lost in one of them
};

}  // namespace hovercraft
