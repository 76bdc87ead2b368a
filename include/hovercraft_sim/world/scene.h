#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hovercraft_sim/collision/motion.h"
#include "hovercraft_sim/hovercraft/planar_step.h"
#include "hovercraft_sim/hovercraft/step_inputs.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/index.h"
#include "hovercraft_sim/world/world_types.h"

namespace hovercraft {

/// Two things of a scene by their indices, the first a body.
using ScenePair = std::pair<std::int32_t, std::int32_t>;

/// What does not change during a run: which bodies move, which obstacles stand, and how they meet.
/// One index counts both, bodies first.
class Scene {
 public:
  /// What is given was checked by the scenario.
  Scene(WorldConfig config, std::vector<WorldBody> bodies, std::vector<WorldObstacle> obstacles);

  /// How bodies meet.
  const WorldConfig& config() const { return config_; }
  /// Those that move, in the order of their indices.
  const std::vector<WorldBody>& bodies() const { return bodies_; }
  /// Those that never move; their indices follow on those of the bodies.
  const std::vector<WorldObstacle>& obstacles() const { return obstacles_; }

  /// Whether an index is that of an obstacle.
  bool isFixed(std::int32_t index) const { return at(index) >= bodies_.size(); }
  /// As in the scenario.
  HOVERCRAFT_PUBLIC const std::string& nameOf(std::int32_t index) const;
  /// In the body's frame B. Only where bodies meet.
  HOVERCRAFT_PUBLIC const ConvexPolyhedron& hullOf(std::int32_t index) const;
  HOVERCRAFT_PUBLIC int materialOf(std::int32_t index) const;
  /// Pieces of one wall have the same.
  std::int32_t wholeOf(std::int32_t index) const {
    if (!isFixed(index)) return index;
    const std::int32_t whole = obstacles_[obstacleAt(index)].whole;
    return whole < 0 ? index : whole + static_cast<std::int32_t>(bodies_.size());
  }
  const ContactMaterial& lawOf(const ScenePair& pair) const {
    return config_.pair(materialOf(pair.first), materialOf(pair.second));
  }
  const Mobility& mobilityOf(std::int32_t body) const { return bodies_[at(body)].model.mobility; }
  /// Velocities of a body, with its rotors as they turn at a time from the start of the step, s.
  Twist twistAt(std::int32_t body, const BodyState& state, const StepInputs& inputs,
                double time) const;
  /// Of an obstacle.
  const Pose& fixedPose(std::int32_t index) const { return obstacles_[obstacleAt(index)].X_WO; }
  const StepMotion& fixedMotion(std::int32_t index) const {
    return obstacle_motions_[obstacleAt(index)];
  }
  const AxisAlignedBox& fixedBox(std::size_t obstacle) const { return obstacle_boxes_[obstacle]; }
  Pose poseIn(const std::vector<BodyState>& states, std::int32_t index) const;

  /// The state of a body at the end of a piece of a step. @param contact a constant wrench of
  /// resting contacts, in W.
  BodyState moved(std::size_t body, const BodyState& state, const StepInputs& inputs,
                  const StepPiece& piece, const Wrench& contact) const;

  /// The states of all bodies at the end of a step without contact. @param ends not the states
  /// themselves; its memory is kept.
  void moveAll(const std::vector<BodyState>& states, const std::vector<StepInputs>& inputs,
               std::vector<BodyState>& ends) const;

  /// Bound on the way of a body's points along each axis of W between two states of a piece of h
  /// seconds, m: straight, curved, and turned.
  Vector3 motionBoundOf(std::size_t body, const BodyState& from, const BodyState& to,
                        double h) const;

  /// A bound on motionBoundOf() that needs no root, and holds for a while.
  struct KeptMotionBound {
    Vector3 straight = Vector3::Constant(-1.0);  // m: what it may go and bend along each axis
    double spin = 0.0;                           // (N m s)²: of its angular momentum
    Vector3 motion_bound = Vector3::Zero();      // m
  };

  /// A bound for steps of h seconds of a body that goes on like this one, or somewhat faster.
  KeptMotionBound keptBoundOf(std::size_t body, const BodyState& from, const BodyState& to,
                              double h) const;
  /// Whether motionBoundOf() is within the bound, along each axis.
  bool holds(const KeptMotionBound& bound, std::size_t body, const BodyState& from,
             const BodyState& to, double h) const;

  /// Radius of a body around its centre of mass, m.
  double radiusOf(std::size_t body) const { return extents_[body].radius; }
  /// A box around a body's hull, widened by a margin along each axis, m.
  AxisAlignedBox boxOf(std::size_t body, const Pose& pose, const Vector3& margin) const;
  /// Whether a body that goes no farther along the axes of W than `motion_bound` (m) stays on the
  /// outer side of a face of an obstacle, by more than a resting contact. Only obstacles of few
  /// faces are looked at (kFewFaces). @param side which.
  bool staysOutside(std::size_t body, const Pose& pose, const Vector3& motion_bound,
                    std::int32_t obstacle, int side) const;
  /// Whether it stays on the outer side of some face. @param side written: which.
  bool findSideOutside(std::size_t body, const Pose& pose, const Vector3& motion_bound,
                       std::int32_t obstacle, int& side) const;

  /// How a face of an obstacle keeps a body on its outer side.
  struct Separation {
    Vector3 normal = Vector3::Zero();  // unit, in W
    double gap = 0.0;       // m, beyond what staysOutside() asks for; negative: it is not
    double per_turn = 0.0;  // m per rad: what the body may come nearer by turning
    double size = 0.0;      // m, of the numbers in it
  };
  /// @param side of the obstacle.
  Separation separationOf(std::size_t body, const Pose& pose, const Vector3& motion_bound,
                          std::int32_t obstacle, int side) const;

  /// Closest features of a pair in these states.
  ClosestFeatures closestOf(const std::vector<BodyState>& states, const ScenePair& pair) const;

  /// The displacements, m, that take the two bodies `by` metres apart along nhat_AB_W, each in
  /// proportion to its mobility. @param only the one body that may move; -1: both. @returns nothing
  /// if neither can move that way.
  [[nodiscard]] std::optional<std::array<Vector3, 2>> shiftsApart(const ScenePair& pair,
                                                                  const Vector3& nhat_AB_W,
                                                                  double by, int only) const;

 private:
  /// Where an obstacle stands in their list. @param index in the scene.
  std::size_t obstacleAt(std::int32_t index) const { return at(index) - bodies_.size(); }

  struct Extent {
    Vector3 center_B = Vector3::Zero();  // m, of the box around the hull
    Vector3 half_B = Vector3::Zero();
    double radius = 0.0;              // m, from B
    double spin_per_L = 0.0;          // bound on |w| / |L|, 1/(kg m²)
    double rotors = 0.0;              // bound on the angular momentum of its rotors, N m s
    Vector3 turns = Vector3::Ones();  // 0 along an axis about which alone it can turn
  };

  /// What motionBoundOf() is made from.
  struct Course {
    Vector3 straight;  // m, along each axis
    double spin;       // (N m s)²
  };

  Course courseOf(std::size_t body, const BodyState& from, const BodyState& to, double h) const;
  Vector3 motionBoundOf(std::size_t body, const Course& course, double h) const;

  /// normal · x <= offset inside, in W.
  struct Side {
    Vector3 normal;
    double offset;  // m
  };

  bool isOutside(const Extent& extent, const Pose& pose, const Vector3& motion_bound,
                 const Side& side) const;
  double beyond(const Extent& extent, const Pose& pose, const Vector3& motion_bound,
                const Side& side) const;

  static Extent extentOf(const WorldBody& body);
  /// None of a hull of more than a few faces.
  static std::vector<Side> sidesOf(const WorldObstacle& obstacle);

  WorldConfig config_;
  std::vector<WorldBody> bodies_;
  std::vector<WorldObstacle> obstacles_;
  std::vector<std::optional<PlanarCraft>> planar_;  // of each body
  std::vector<Extent> extents_;                     // of each body, where bodies meet
  std::vector<AxisAlignedBox> obstacle_boxes_;
  std::vector<StepMotion> obstacle_motions_;       // standing still
  std::vector<std::vector<Side>> obstacle_sides_;  // none of those of many faces
};

}  // namespace hovercraft
