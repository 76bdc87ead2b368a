#include "hovercraft_sim/world/world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hovercraft_sim/math/contact_tolerances.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

AxisAlignedBox boundsOf(const ConvexPolyhedron& hull, const Pose& pose) {
  AxisAlignedBox box;
  box.low = box.high = transform(pose, hull.vertex(0));
  for (int i = 1; i < hull.vertexCount(); ++i) {
    const Vector3 p = transform(pose, hull.vertex(i));
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

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

}  // namespace

World::World(WorldRules rules, std::vector<WorldBody> bodies, std::vector<WorldObstacle> obstacles)
    : rules_(std::move(rules)), bodies_(std::move(bodies)), obstacles_(std::move(obstacles)) {
  const FloatingPointEnvironment environment;
  demand(rules_.step > 0.0 && rules_.tolerance > 0.0, "a world needs a step and a tolerance");
  demand(rules_.pairs.size() == rules_.material_count * rules_.material_count,
         "a world needs a law for each pair of materials");
  for (const WorldBody& body : bodies_) {
    Extent extent;
    const AxisAlignedBox box = boundsOf(body.hull, Pose());
    extent.center_B = 0.5 * (box.low + box.high);
    extent.half_B = 0.5 * (box.high - box.low);
    extent.radius = body.hull.data().radius;
    const Matrix3 inverse_inertia = body.model.mobility.inverseInertia(Matrix3::Identity());
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) sum += inverse_inertia(i, j) * inverse_inertia(i, j);
    }
    extent.spin_per_L = std::sqrt(sum);
    extents_.push_back(extent);
  }
  for (const WorldObstacle& obstacle : obstacles_) {
    obstacle_boxes_.push_back(boundsOf(obstacle.hull, obstacle.X_WO));
  }
}

const std::string& World::nameOf(std::int32_t index) const {
  const auto i = static_cast<std::size_t>(index);
  return isFixed(index) ? obstacles_[i - bodies_.size()].name : bodies_[i].name;
}

const ConvexPolyhedron& World::hullOf(std::int32_t index) const {
  const auto i = static_cast<std::size_t>(index);
  return isFixed(index) ? obstacles_[i - bodies_.size()].hull : bodies_[i].hull;
}

int World::materialOf(std::int32_t index) const {
  const auto i = static_cast<std::size_t>(index);
  return isFixed(index) ? obstacles_[i - bodies_.size()].material : bodies_[i].material;
}

Pose World::poseIn(const std::vector<BodyState>& states, std::int32_t index) const {
  const auto i = static_cast<std::size_t>(index);
  return isFixed(index) ? obstacles_[i - bodies_.size()].X_WO : poseOf(states[i]);
}

/// Bound on the way of a body's points between two states of a piece of h seconds, m: straight,
/// curved, and turned.
double World::travelOf(std::size_t body, const BodyState& from, const BodyState& to,
                       double h) const {
  const Extent& extent = extents_[body];
  const Mobility& mobility = bodies_[body].model.mobility;
  return std::visit(
      [&](const auto& a) {
        const auto& b = std::get<std::decay_t<decltype(a)>>(to);
        const double bend = norm(mobility.velocity(b.momentum_W - a.momentum_W)) * h;
        const double spin =
            extent.spin_per_L * std::max(norm(a.angular_momentum_W), norm(b.angular_momentum_W));
        return norm(b.p_WB - a.p_WB) + bend + spin * h * extent.radius;
      },
      from);
}

AxisAlignedBox World::boxOf(std::size_t body, const Pose& pose, double margin) const {
  const Extent& extent = extents_[body];
  const Vector3 center = transform(pose, extent.center_B);
  const Vector3 half = times(pose.R_AB.cwiseAbs(), extent.half_B) + Vector3::Constant(margin);
  return {center - half, center + half};
}

/// How far from its centre of mass a body can be near something in this step, m.
double World::reachOf(std::size_t body) const {
  return extents_[body].radius + extents_[body].travel + rules_.tolerance;
}

/// The boxes within which the list of neighbours stays complete. A body that is far from all others
/// gets half of the way to the nearest.
void World::makeRoom(const std::vector<BodyState>& states) {
  const std::size_t count = bodies_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double reach = reachOf(i);
    const Vector3& p = positionOf(states[i]);
    extents_[i].roomy = {p - Vector3::Constant(reach), p + Vector3::Constant(reach)};
  }
  rooms_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    double clear = std::numeric_limits<double>::max();
    for (std::size_t j = 0; j < count; ++j) {
      if (j != i) clear = std::min(clear, gapOf(extents_[i].roomy, extents_[j].roomy));
    }
    for (const AxisAlignedBox& box : obstacle_boxes_) {
      clear = std::min(clear, gapOf(extents_[i].roomy, box));
    }
    rooms_[i] = std::max(kRoom * extents_[i].radius + kStepsAhead * extents_[i].travel,
                         std::min(kFarRoom, 0.5 * clear));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3 room = Vector3::Constant(rooms_[i]);
    extents_[i].roomy = {extents_[i].roomy.low - room, extents_[i].roomy.high + room};
  }
}

/// Brings the list of neighbours up to date. @returns whether there are any.
bool World::findNeighbours(const std::vector<BodyState>& states) {
  const std::size_t count = bodies_.size();
  bool inside = knows_neighbours_;
  for (std::size_t i = 0; i < count && inside; ++i) {
    const double reach = reachOf(i);
    const Vector3& p = positionOf(states[i]);
    const Vector3 around = Vector3::Constant(reach);
    inside = holds(extents_[i].roomy, {p - around, p + around});
  }
  if (inside) return !neighbours_.empty();
  neighbours_.clear();
  makeRoom(states);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      if (!extents_[i].roomy.overlaps(extents_[j].roomy)) continue;
      neighbours_.emplace_back(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j));
    }
    for (std::size_t j = 0; j < obstacles_.size(); ++j) {
      if (!extents_[i].roomy.overlaps(obstacle_boxes_[j])) continue;
      neighbours_.emplace_back(static_cast<std::int32_t>(i), static_cast<std::int32_t>(count + j));
    }
  }
  knows_neighbours_ = true;
  return !neighbours_.empty();
}

/// The pairs whose boxes, as far as their bodies can travel, overlap.
void World::findNearPairs(const std::vector<BodyState>& states) {
  near_.clear();
  if (!findNeighbours(states)) return;
  boxes_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    boxes_[i] = boxOf(i, poseOf(states[i]), extents_[i].travel + rules_.tolerance);
  }
  for (const Pair& pair : neighbours_) {
    const auto b = static_cast<std::size_t>(pair.second);
    const AxisAlignedBox& other =
        isFixed(pair.second) ? obstacle_boxes_[b - bodies_.size()] : boxes_[b];
    if (boxes_[static_cast<std::size_t>(pair.first)].overlaps(other)) near_.push_back(pair);
  }
}

/// Bodies that are near each other, directly or through others, get the least index among them.
void World::collectGroups() {
  group_.resize(bodies_.size());
  for (std::size_t i = 0; i < group_.size(); ++i) group_[i] = static_cast<std::int32_t>(i);
  const auto root = [this](std::int32_t i) {
    while (group_[static_cast<std::size_t>(i)] != i) i = group_[static_cast<std::size_t>(i)];
    return i;
  };
  for (const Pair& pair : near_) {
    if (isFixed(pair.second)) continue;
    const std::int32_t a = root(pair.first);
    const std::int32_t b = root(pair.second);
    group_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  for (std::size_t i = 0; i < group_.size(); ++i) group_[i] = root(static_cast<std::int32_t>(i));
}

/// Lists the bodies and near pairs of a group. @returns whether it has a pair.
bool World::listGroup(std::int32_t group) {
  group_pairs_.clear();
  for (const Pair& pair : near_) {
    if (group_[static_cast<std::size_t>(pair.first)] == group) group_pairs_.push_back(pair);
  }
  group_bodies_.clear();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (group_[i] == group) group_bodies_.push_back(static_cast<std::int32_t>(i));
  }
  return !group_pairs_.empty();
}

/// Takes over what an island did. @returns false if a body came farther than its travel.
bool World::takeIsland() {
  bool enough = true;
  for (const IslandMember& member : scratch_.members) {
    const auto i = static_cast<std::size_t>(member.index);
    ends_[i] = member.state;
    if (member.travelled <= extents_[i].travel) continue;
    extents_[i].travel = kTravelReserve * member.travelled;
    enough = false;
  }
  for (const IslandLink& link : scratch_.links) next_memory_.push_back(link.memory);
  return enough;
}

/// Steps each group with a near pair. @returns false if a body came farther than its travel: the
/// step must begin anew, with more of it.
bool World::stepGroups(const std::vector<BodyDrive>& drives, const std::vector<BodyState>& states,
                       const std::vector<ContactMemory>& memory,
                       std::vector<ContactRecord>& records) {
  collectGroups();
  bool enough = true;
  for (std::size_t first = 0; first < bodies_.size(); ++first) {
    const auto group = static_cast<std::int32_t>(first);
    if (group_[first] != group || !listGroup(group)) continue;
    Island island(*this, drives, scratch_, records);
    island.begin(group_bodies_, group_pairs_, states, memory);
    if (!island.run()) ++cut_off_;
    enough = takeIsland() && enough;
  }
  return enough;
}

int World::step(const std::vector<BodyDrive>& drives, std::vector<BodyState>& states,
                std::vector<ContactMemory>& memory, std::vector<ContactRecord>& records) {
  const FloatingPointEnvironment environment;
  ends_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyDrive& drive = drives[i];
    const DrivenHovercraft system = {bodies_[i].model, drive.thrusts,
                                     drive.is_pushed ? &drive.load : nullptr};
    ends_[i] = std::visit(
        [&](const auto& body) -> BodyState {
          return integrationStep<decltype(body.orientation)>(rules_.integrator, body, system,
                                                             rules_.step);
        },
        states[i]);
    extents_[i].travel = kTravelReserve * travelOf(i, states[i], ends_[i], rules_.step);
    if (!isInReach(ends_[i]) || !(extents_[i].travel <= kFarthest)) return static_cast<int>(i);
  }
  const std::size_t recorded = records.size();
  bool done = false;
  for (int attempt = 0; attempt < kMaxRestarts && !done; ++attempt) {
    findNearPairs(states);
    next_memory_.clear();
    records.resize(recorded);
    cut_off_ = 0;
    done = near_.empty() || stepGroups(drives, states, memory, records);
  }
  stalls_ += cut_off_ + (done ? 0 : 1);
  std::sort(next_memory_.begin(), next_memory_.end(),
            [](const ContactMemory& x, const ContactMemory& y) {
              return x.a < y.a || (x.a == y.a && x.b < y.b);
            });
  memory.swap(next_memory_);
  states.swap(ends_);
  return kNone;
}

std::vector<World::Pair> World::allPairs(int body) const {
  std::vector<Pair> pairs;
  const auto count = static_cast<std::int32_t>(bodies_.size());
  const auto all = static_cast<std::int32_t>(bodies_.size() + obstacles_.size());
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
  for (const Pair& pair : allPairs(-1)) least = std::min(least, closestOf(states, pair).distance);
  return least;
}

/// @param allowed m, depth that is none.
std::optional<WorldOverlap> World::deepest(const std::vector<BodyState>& states, int body,
                                           double allowed) const {
  std::optional<WorldOverlap> worst;
  for (const Pair& pair : allPairs(body)) {
    const double depth = -closestOf(states, pair).distance;
    if (depth <= allowed || (worst && depth <= worst->depth)) continue;
    worst = WorldOverlap{nameOf(pair.first), nameOf(pair.second), depth};
  }
  return worst;
}

std::optional<WorldOverlap> World::overlap(const std::vector<BodyState>& states, int body) const {
  const FloatingPointEnvironment environment;
  return deepest(states, body, rules_.tolerance);
}

std::optional<WorldOverlap> World::squeezed(const std::vector<BodyState>& states, int body) const {
  const FloatingPointEnvironment environment;
  return deepest(states, body, -kLeastRestGap * rules_.tolerance);
}

ClosestFeatures World::closestOf(const std::vector<BodyState>& states, const Pair& pair) const {
  FeaturePair features;
  return closestFeatures(hullOf(pair.first), poseIn(states, pair.first), hullOf(pair.second),
                         poseIn(states, pair.second), features);
}

/// Moves both bodies of a pair apart, as their masses share it, if their gap is short of `wanted`.
/// @param only a body, the only one that moves; -1: both. @returns whether something was moved.
bool World::partPair(std::vector<BodyState>& states, const Pair& pair, double wanted,
                     int only) const {
  const ClosestFeatures closest = closestOf(states, pair);
  if (closest.distance >= kPartedShare * wanted) return false;
  const auto shifts = shiftsApart(pair, closest.nhat_AB_W, wanted - closest.distance, only);
  if (!shifts) return false;
  const std::int32_t sides[2] = {pair.first, pair.second};
  for (std::size_t k = 0; k < 2; ++k) {
    if (isFixed(sides[k])) continue;
    std::visit([&](auto& state) { state.p_WB += (*shifts)[k]; },
               states[static_cast<std::size_t>(sides[k])]);
  }
  return true;
}

std::optional<std::array<Vector3, 2>> World::shiftsApart(const Pair& pair, const Vector3& nhat_AB_W,
                                                         double by, int only) const {
  const std::int32_t sides[2] = {pair.first, pair.second};
  std::array<Vector3, 2> shifts = {Vector3::Zero(), Vector3::Zero()};
  double share = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    if (isFixed(sides[k]) || (only >= 0 && sides[k] != only)) continue;
    const auto i = static_cast<std::size_t>(sides[k]);
    shifts[k] = bodies_[i].model.mobility.inverseMass().cwiseProduct(nhat_AB_W);
    share += dot(nhat_AB_W, shifts[k]);
  }
  if (!(share > 0.0)) return std::nullopt;
  shifts[0] *= -by / share;
  shifts[1] *= by / share;
  return shifts;
}

void World::partTouching(std::vector<BodyState>& states, int body) const {
  const FloatingPointEnvironment environment;
  std::vector<Pair> pairs;
  for (const Pair& pair : allPairs(body)) {
    if (closestOf(states, pair).distance < kLostContact * rules_.tolerance) pairs.push_back(pair);
  }
  bool moved = true;
  for (int sweep = 0; sweep < kMaxPartingSweeps && moved; ++sweep) {
    moved = false;
    for (const Pair& pair : pairs) {
      moved = partPair(states, pair, kRestGap * rules_.tolerance, body) || moved;
    }
  }
}

}  // namespace hovercraft
