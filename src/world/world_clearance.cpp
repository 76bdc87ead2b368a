#include <algorithm>
#include <cmath>
#include <limits>

#include "hovercraft_sim/math/contact_tolerances.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/index.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/world/world.h"

/// What is known from step to step of bodies that are near nothing, so that a step of a craft that
/// hovers costs little more than one without a world.

namespace hovercraft {
namespace {

bool contains(const AxisAlignedBox& box, const Vector3& p) {
  return box.low.x() <= p.x() && p.x() <= box.high.x() && box.low.y() <= p.y() &&
         p.y() <= box.high.y() && box.low.z() <= p.z() && p.z() <= box.high.z();
}

/// The squared difference of two quaternions (-); of matrices nothing that would serve.
double turnBetween(const BodyState& a, const BodyState& b) {
  const auto* from = std::get_if<RigidBodyState<Quaternion>>(&a);
  const auto* to = std::get_if<RigidBodyState<Quaternion>>(&b);
  if (from == nullptr || to == nullptr) return std::numeric_limits<double>::infinity();
  return squaredNorm(to->orientation + -1.0 * from->orientation);
}

}  // namespace

/// Whether bounds on the motion of the bodies, which are kept from step to step, show that none
/// comes near another: what the exact ones would show too.
bool World::isClear(const std::vector<BodyState>& states, const std::vector<BodyState>& ends) {
  const double h = scene_.config().step;
  for (std::size_t i = 0; i < states.size(); ++i) {
    Extent& extent = extents_[i];
    if (!isInReach(ends[i])) return false;
    if (!scene_.holds(extent.bound, i, states[i], ends[i], h)) {
      has_clearances_ = false;  // they were for less motion
      extent.bound = scene_.keptBoundOf(i, states[i], ends[i], h);
      extent.bound.motion_bound *= kMotionBoundReserve;
    }
    extent.motion_bound = extent.bound.motion_bound;
    if (!(extent.motion_bound.maxCoeff() <= kFarthest)) return false;
  }
  if (has_clearances_ && stayClear(states)) return true;
  findNearPairs(states);
  if (!near_.empty()) return false;
  makeClearances(states, ends);
  return true;
}

bool World::stayClear(const std::vector<BodyState>& states) const {
  auto state = states.begin();
  for (const Extent& extent : extents_) {
    if (!contains(extent.home, positionOf(*state))) return false;
    if (!(turnBetween(extent.seen, *state) <= extent.turn)) return false;
    ++state;
  }
  return std::all_of(neighbours_.begin(), neighbours_.end(), [&](const Neighbour& neighbour) {
    const Vector3& p_WB = positionOf(states[at(neighbour.pair.first)]);
    return dot(neighbour.normal, p_WB) >= neighbour.least;
  });
}

/// Takes down by how much the bodies may move on so that findNearPairs() would still find none.
void World::makeClearances(const std::vector<BodyState>& states,
                           const std::vector<BodyState>& ends) {
  has_clearances_ = false;
  if (wait_ > 0) {
    --wait_;
    return;
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    Extent& extent = extents_[i];
    const double size = (extent.fat_box.high - extent.fat_box.low).maxCoeff();
    const Vector3 inset = reachOf(i) + Vector3::Constant(kMarginRounding * size);
    extent.home = {extent.fat_box.low + inset, extent.fat_box.high - inset};
    extent.seen = states[i];
    extent.turn = kLongestTurn;
  }
  has_clearances_ = std::all_of(neighbours_.begin(), neighbours_.end(),
                                [this](Neighbour& neighbour) { return makeClearance(neighbour); });
  for (std::size_t i = 0; i < states.size(); ++i) {
    // The angle (rad) of a turn is less than 2.01 times the difference of its quaternions.
    const double difference = extents_[i].turn / 2.01;
    extents_[i].turn = difference * difference;
    const double now = turnBetween(states[i], ends[i]);
    if (kLeastStepsClear * kLeastStepsClear * now > extents_[i].turn) has_clearances_ = false;
  }
  if (!has_clearances_) wait_ = kStepsUntilClearances;
}

/// Half of the way to the plane is for what the body moves, half for what it turns.
/// @returns false if it is not the plane of an obstacle that keeps the two apart.
bool World::makeClearance(Neighbour& neighbour) {
  if (!scene_.isFixed(neighbour.pair.second)) return false;
  const auto body = at(neighbour.pair.first);
  const Pose& pose = poses_[body];
  const Scene::Separation apart = scene_.separationOf(body, pose, extents_[body].motion_bound,
                                                      neighbour.pair.second, neighbour.side);
  const double height = dot(apart.normal, pose.p_AB);
  const double half = 0.5 * apart.gap - kMarginRounding * (std::abs(height) + apart.size);
  if (!(half > 0.0)) return false;
  neighbour.normal = apart.normal;
  neighbour.least = height - half;
  if (apart.per_turn > 0.0) {
    extents_[body].turn = std::min(extents_[body].turn, half / apart.per_turn);
  }
  return true;
}

bool World::isClearAhead(const std::vector<BodyState>& states, double steps) const {
  const FloatingPointEnvironment environment;
  if (!scene_.config().bodies_meet) return true;
  const std::size_t count = states.size();
  const std::size_t obstacles = scene_.obstacles().size();
  if (!was_clear_ || count * (count + obstacles) > kMostPairsAhead) return false;
  const double ahead = kMotionBoundReserve * steps * scene_.config().step;  // s
  std::vector<AxisAlignedBox> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Mobility& mobility = scene_.mobilityOf(static_cast<std::int32_t>(i));
    const Vector3 motion_bound = scene_.motionBoundOf(i, states[i], states[i], ahead) +
                                 ahead * velocityOf(states[i], mobility).cwiseAbs();
    const Pose pose = poseOf(states[i]);
    boxes.push_back(scene_.boxOf(i, pose, motion_bound));
    for (std::size_t j = 0; j < obstacles; ++j) {
      int side = 0;
      if (boxes[i].overlaps(scene_.fixedBox(j)) &&
          !scene_.findSideOutside(i, pose, motion_bound, static_cast<std::int32_t>(count + j),
                                  side)) {
        return false;
      }
    }
    const auto meets = [&](const AxisAlignedBox& other) { return boxes[i].overlaps(other); };
    if (std::any_of(boxes.begin(), boxes.end() - 1, meets)) return false;
  }
  return true;
}

}  // namespace hovercraft
