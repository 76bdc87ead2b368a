#include "hovercraft_sim/world/world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hovercraft_sim/math/contact_tolerances.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/index.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

bool holds(const AxisAlignedBox& outer, const AxisAlignedBox& inner) {
  return outer.low.x() <= inner.low.x() && inner.high.x() <= outer.high.x() &&
         outer.low.y() <= inner.low.y() && inner.high.y() <= outer.high.y() &&
         outer.low.z() <= inner.low.z() && inner.high.z() <= outer.high.z();
}

/// How far two boxes are apart along the axis on which they are farthest, m; negative: they
/// overlap.
double gapOf(const AxisAlignedBox& a, const AxisAlignedBox& b) {
  double gap = -std::numeric_limits<double>::max();
  for (int axis = 0; axis < 3; ++axis) {
    gap = std::max(gap, std::max(a.low[axis] - b.high[axis], b.low[axis] - a.high[axis]));
  }
  return gap;
}

/// kNone if all are within.
int firstOutOfReach(const std::vector<BodyState>& states) {
  const auto found = std::find_if(states.begin(), states.end(),
                                  [](const BodyState& state) { return !isInReach(state); });
  return found == states.end() ? World::kNone : static_cast<int>(found - states.begin());
}

}  // namespace

World::World(WorldConfig config, std::vector<WorldBody> bodies,
             std::vector<WorldObstacle> obstacles)
    : scene_(std::move(config), std::move(bodies), std::move(obstacles)),
      extents_(scene_.bodies().size()),
      poses_(extents_.size()),
      boxes_(extents_.size()),
      has_box_(extents_.size()) {}

/// How far from its centre of mass a body can be near something in this step, m.
Vector3 World::reachOf(std::size_t body) const {
  return extents_[body].motion_bound +
         Vector3::Constant(scene_.radiusOf(body) + kLostContact * scene_.config().tolerance);
}

/// The boxes within which the list of neighbours stays complete. A body that is far from all others
/// gets half of the way to the nearest.
void World::makeFatBoxes(const std::vector<BodyState>& states) {
  const std::size_t count = scene_.bodies().size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3 reach = reachOf(i);
    const Vector3& p = positionOf(states[i]);
    extents_[i].fat_box = {p - reach, p + reach};
  }
  margins_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    double clear = std::numeric_limits<double>::max();
    for (std::size_t j = 0; j < count; ++j) {
      if (j != i) clear = std::min(clear, gapOf(extents_[i].fat_box, extents_[j].fat_box));
    }
    for (std::size_t j = 0; j < scene_.obstacles().size(); ++j) {
      clear = std::min(clear, gapOf(extents_[i].fat_box, scene_.fixedBox(j)));
    }
    margins_[i] = std::max(
        kFatBoxMargin * scene_.radiusOf(i) + kStepsAhead * extents_[i].motion_bound.maxCoeff(),
        std::min(kFarMargin, 0.5 * clear));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3 margin = Vector3::Constant(margins_[i]);
    extents_[i].fat_box = {extents_[i].fat_box.low - margin, extents_[i].fat_box.high + margin};
  }
}

/// Brings the list of neighbours up to date. @returns whether there are any.
bool World::findNeighbours(const std::vector<BodyState>& states) {
  const std::size_t count = scene_.bodies().size();
  bool inside = knows_neighbours_;
  for (std::size_t i = 0; i < count && inside; ++i) {
    const Vector3 reach = reachOf(i);
    const Vector3& p = positionOf(states[i]);
    inside = holds(extents_[i].fat_box, {p - reach, p + reach});
  }
  if (!inside) collectNeighbours(states);
  return !neighbours_.empty();
}

void World::collectNeighbours(const std::vector<BodyState>& states) {
  const std::size_t count = scene_.bodies().size();
  neighbours_.clear();
  makeFatBoxes(states);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      if (!extents_[i].fat_box.overlaps(extents_[j].fat_box)) continue;
      neighbours_.push_back({{static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)}});
    }
    for (std::size_t j = 0; j < scene_.obstacles().size(); ++j) {
      if (!extents_[i].fat_box.overlaps(scene_.fixedBox(j))) continue;
      neighbours_.push_back({{static_cast<std::int32_t>(i), static_cast<std::int32_t>(count + j)}});
      Neighbour& known = neighbours_.back();
      (void)scene_.findSideOutside(i, poseOf(states[i]), extents_[i].motion_bound,
                                   known.pair.second, known.side);
    }
  }
  knows_neighbours_ = true;
  has_clearances_ = false;
}

/// The pairs whose boxes, widened by the bounds on their motion, overlap.
void World::findNearPairs(const std::vector<BodyState>& states) {
  near_.clear();
  if (!findNeighbours(states)) return;
  updatePoses(states);
  for (Neighbour& neighbour : neighbours_) {
    if (!areApart(neighbour)) near_.push_back(neighbour.pair);
  }
}

void World::updatePoses(const std::vector<BodyState>& states) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    poses_[i] = poseOf(states[i]);
    has_box_[i] = 0;
  }
}

/// A box around where a body can be in this step.
const AxisAlignedBox& World::boxOf(std::size_t body) {
  if (has_box_[body] == 0) {
    // A resting contact that is not over is near.
    const Vector3 touch = Vector3::Constant(kLostContact * scene_.config().tolerance);
    boxes_[body] = scene_.boxOf(body, poses_[body], extents_[body].motion_bound + touch);
    has_box_[body] = 1;
  }
  return boxes_[body];
}

/// Whether the two cannot come near each other in this step. The side of an obstacle is asked
/// first: a craft that hovers over a floor is over it in each step.
bool World::areApart(Neighbour& neighbour) {
  const auto a = at(neighbour.pair.first);
  const auto b = at(neighbour.pair.second);
  if (!scene_.isFixed(neighbour.pair.second)) return !boxOf(a).overlaps(boxOf(b));
  const std::int32_t obstacle = neighbour.pair.second;
  return scene_.staysOutside(a, poses_[a], extents_[a].motion_bound, obstacle, neighbour.side) ||
         !boxOf(a).overlaps(scene_.fixedBox(b - scene_.bodies().size())) ||
         scene_.findSideOutside(a, poses_[a], extents_[a].motion_bound, obstacle, neighbour.side);
}

/// Bodies that are near each other, directly or through others, get the least index among them.
void World::collectGroups() {
  group_.resize(scene_.bodies().size());
  for (std::size_t i = 0; i < group_.size(); ++i) group_[i] = static_cast<std::int32_t>(i);
  const auto root = [this](std::int32_t i) {
    while (group_[at(i)] != i) i = group_[at(i)];
    return i;
  };
  for (const ScenePair& pair : near_) {
    if (scene_.isFixed(pair.second)) continue;
    const std::int32_t a = root(pair.first);
    const std::int32_t b = root(pair.second);
    group_[at(std::max(a, b))] = std::min(a, b);
  }
  for (std::size_t i = 0; i < group_.size(); ++i) group_[i] = root(static_cast<std::int32_t>(i));
}

/// Lists the bodies and near pairs of a group. @returns whether it has a pair.
bool World::listGroup(std::int32_t group) {
  group_pairs_.clear();
  for (const ScenePair& pair : near_) {
    if (group_[at(pair.first)] == group) group_pairs_.push_back(pair);
  }
  group_bodies_.clear();
  for (std::size_t i = 0; i < scene_.bodies().size(); ++i) {
    if (group_[i] == group) group_bodies_.push_back(static_cast<std::int32_t>(i));
  }
  return !group_pairs_.empty();
}

/// Takes over what an island did. @returns false if a body went farther than its motion bound.
bool World::collectIsland(StepResult& result) {
  bool enough = true;
  for (const IslandMember& member : scratch_.members) {
    const auto i = at(member.index);
    result.states[i] = member.state;
    const Vector3& travelled = member.travelled;
    if ((travelled.array() <= extents_[i].motion_bound.array()).all()) continue;
    extents_[i].motion_bound = extents_[i].motion_bound.cwiseMax(kMotionBoundReserve * travelled);
    enough = false;
  }
  for (const IslandLink& link : scratch_.links) result.contacts.push_back(link.cache);
  return enough;
}

/// Steps each group with a near pair. @returns false if a body went farther than its motion bound:
/// the step must begin anew, with more of it.
bool World::stepGroups(const std::vector<StepInputs>& inputs, const std::vector<BodyState>& states,
                       const std::vector<ContactCache>& contacts, StepResult& result) {
  collectGroups();
  bool enough = true;
  for (std::size_t first = 0; first < scene_.bodies().size(); ++first) {
    const auto group = static_cast<std::int32_t>(first);
    if (group_[first] != group || !listGroup(group)) continue;
    Island island(scene_, inputs, scratch_, result.records);
    island.begin(group_bodies_, group_pairs_, states, result.states, contacts);
    const bool done = island.run();
    lost_ = island.lost();
    if (lost_ != kNone) return true;
    if (!done) ++cut_off_;
    enough = collectIsland(result) && enough;
  }
  return enough;
}

/// Bounds on how far each body moves in this step. @returns the first that would come out of reach;
/// kNone.
int World::updateMotionBounds(const std::vector<BodyState>& states,
                              const std::vector<BodyState>& ends) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    // Not less than the tolerance: what rests moves by rounding, any share of which is more than
    // none.
    extents_[i].motion_bound =
        kMotionBoundReserve * scene_.motionBoundOf(i, states[i], ends[i], scene_.config().step) +
        Vector3::Constant(scene_.config().tolerance);
    if (!isInReach(ends[i]) || !(extents_[i].motion_bound.maxCoeff() <= kFarthest)) {
      return static_cast<int>(i);
    }
  }
  return kNone;
}

int World::step(const std::vector<StepInputs>& inputs, const std::vector<BodyState>& states,
                const std::vector<ContactCache>& contacts, StepResult& result) {
  const FloatingPointEnvironment environment;
  result.contacts.clear();
  result.records.clear();
  scene_.moveAll(states, inputs, result.states);
  if (!scene_.config().bodies_meet || (was_clear_ && isClear(states, result.states))) return kNone;
  const int lost = updateMotionBounds(states, result.states);
  if (lost != kNone) return lost;
  bool done = false;
  for (int attempt = 0; attempt < kMaxRestarts && !done; ++attempt) {
    if (attempt > 0) scene_.moveAll(states, inputs, result.states);
    findNearPairs(states);
    result.contacts.clear();
    result.records.clear();
    cut_off_ = 0;
    was_clear_ = near_.empty();
    done = was_clear_ || stepGroups(inputs, states, contacts, result);
  }
  if (lost_ != kNone) return std::exchange(lost_, kNone);
  stalls_ += cut_off_ + (done ? 0 : 1);
  const int out = firstOutOfReach(result.states);
  if (out != kNone) return out;
  std::sort(result.contacts.begin(), result.contacts.end(),
            [](const ContactCache& x, const ContactCache& y) {
              return x.a < y.a || (x.a == y.a && x.b < y.b);
            });
  return kNone;
}

std::vector<ScenePair> World::allPairs(int body) const {
  std::vector<ScenePair> pairs;
  const auto count = static_cast<std::int32_t>(scene_.bodies().size());
  const auto all = static_cast<std::int32_t>(scene_.bodies().size() + scene_.obstacles().size());
  for (std::int32_t a = 0; a < count; ++a) {
    for (std::int32_t b = a + 1; b < all; ++b) {
      if (body < 0 || a == body || b == body) pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

double World::leastGap(const std::vector<BodyState>& states) const {
  const FloatingPointEnvironment environment;
  double least = std::numeric_limits<double>::infinity();
  for (const ScenePair& pair : allPairs(-1))
    least = std::min(least, scene_.closestOf(states, pair).distance);
  return least;
}

/// @param allowed m, depth that is none.
std::optional<WorldOverlap> World::deepest(const std::vector<BodyState>& states, int body,
                                           double allowed) const {
  std::optional<WorldOverlap> worst;
  for (const ScenePair& pair : allPairs(body)) {
    const double depth = -scene_.closestOf(states, pair).distance;
    if (depth <= allowed || (worst && depth <= worst->depth)) continue;
    worst = WorldOverlap{scene_.nameOf(pair.first), scene_.nameOf(pair.second), depth};
  }
  return worst;
}

std::optional<WorldOverlap> World::overlap(const std::vector<BodyState>& states, int body) const {
  const FloatingPointEnvironment environment;
  return deepest(states, body, scene_.config().tolerance);
}

std::optional<WorldOverlap> World::tooClose(const std::vector<BodyState>& states, int body) const {
  const FloatingPointEnvironment environment;
  return deepest(states, body, -kLeastRestGap * scene_.config().tolerance);
}

/// Moves both bodies of a pair apart, as their masses share it, if their gap is short of `wanted`.
/// @param only a body, the only one that moves; -1: both. @returns whether something was moved.
bool World::separatePair(std::vector<BodyState>& states, const ScenePair& pair, double wanted,
                         int only) const {
  const ClosestFeatures closest = scene_.closestOf(states, pair);
  if (closest.distance >= kSeparatedShare * wanted) return false;
  const auto shifts = scene_.shiftsApart(pair, closest.nhat_AB_W, wanted - closest.distance, only);
  if (!shifts) return false;
  const std::int32_t sides[2] = {pair.first, pair.second};
  for (std::size_t k = 0; k < 2; ++k) {
    if (scene_.isFixed(sides[k])) continue;
    std::visit([&](auto& state) { state.p_WB += (*shifts)[k]; }, states[at(sides[k])]);
  }
  return true;
}

void World::separateTouching(std::vector<BodyState>& states, int body) const {
  const FloatingPointEnvironment environment;
  std::vector<ScenePair> pairs;
  for (const ScenePair& pair : allPairs(body)) {
    if (scene_.closestOf(states, pair).distance < kLostContact * scene_.config().tolerance)
      pairs.push_back(pair);
  }
  bool moved = true;
  for (int sweep = 0; sweep < kMaxSeparationSweeps && moved; ++sweep) {
    moved = false;
    for (const ScenePair& pair : pairs) {
      moved = separatePair(states, pair, kRestGap * scene_.config().tolerance, body) || moved;
    }
  }
}

}  // namespace hovercraft
