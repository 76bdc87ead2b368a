#include <algorithm>
#include <array>
#include <limits>

#include "hovercraft_sim/contact/active_set_tolerances.h"
#include "hovercraft_sim/contact/entry_normal.h"
#include "hovercraft_sim/math/contact_tolerances.h"
#include "hovercraft_sim/math/index.h"
#include "hovercraft_sim/world/island.h"

/// The forces of the resting contacts of an island.

namespace hovercraft {
namespace {

/// Pushes both bodies of a pair with a force (N, on B) at a point.
void pushBoth(const IslandLink& link, const Vector3& force, const Vector3& p_WC,
              std::vector<IslandMember>& members) {
  const std::int32_t slots[2] = {link.slot_a, link.slot_b};
  for (int side = 0; side < 2; ++side) {
    if (slots[side] == 0) continue;
    IslandMember& member = members[at(slots[side] - 1)];
    const Vector3 on_body = (side == 0 ? -1.0 : 1.0) * force;
    member.contact = member.contact + wrenchOfForceAt(on_body, p_WC, member.pose.p_AB);
  }
}

/// The forces of the last step, from which the solve of this one starts.
class CachedForces {
 public:
  /// @param near m, how far from a point of this step one of the last may be.
  CachedForces(const ContactCache& cache, const Pose& X_WA, double near)
      : cache_(cache), near_(near) {
    for (int k = 0; k < cache.count; ++k) points_[at(k)] = transform(X_WA, cache.p_AC[at(k)]);
  }

  /// The force that was remembered nearest to a point, N on B; each is taken once.
  Vector3 take(const Vector3& p_WC) {
    double closest = near_ * near_;
    int matched = -1;
    for (int k = 0; k < cache_.count; ++k) {
      if (used_[at(k)]) continue;
      const double away = squaredNorm(points_[at(k)] - p_WC);
      if (away >= closest) continue;
      closest = away;
      matched = k;
    }
    if (matched < 0) return Vector3::Zero();
    used_[at(matched)] = true;
    return cache_.force_B_W[at(matched)];
  }

 private:
  const ContactCache& cache_;
  double near_;
  std::array<Vector3, ContactManifold::kMaxPoints> points_;  // m, in W
  std::array<bool, ContactManifold::kMaxPoints> used_{};
};

}  // namespace

/// Velocities of all bodies as they are now.
void Island::updateTwists() {
  for (IslandMember& member : s_.members) {
    member.twist = scene_.twistAt(member.index, member.state, inputs_[at(member.index)], now_);
  }
}

/// Where a body would be at the end of the step without contact. @param from s, where it begins.
void Island::endFreely(IslandMember& member, double from) {
  const double h = scene_.config().step;
  if (!member.ends_freely) member.end = moved(member, from, h, Wrench());
  member.twist_end = scene_.twistAt(member.index, member.end, inputs_[at(member.index)], h);
}

Vector3 Island::velocityNow(std::int32_t slot, const Vector3& p_WC) const {
  if (slot == 0) return Vector3::Zero();
  const IslandMember& member = s_.members[at(slot - 1)];
  return velocityOfPoint(member.twist, p_WC, member.pose.p_AB);
}

Vector3 Island::velocityAtEnd(std::int32_t slot, const Vector3& p_WC) const {
  if (slot == 0) return Vector3::Zero();
  const IslandMember& member = s_.members[at(slot - 1)];
  return velocityOfPoint(member.twist_end, p_WC, member.pose.p_AB);
}

/// Acceleration of a body's point towards the axis about which the body turns, m/s²: what the twist
/// at the end of a piece does not tell of the point's velocity there.
Vector3 Island::centripetalNow(std::int32_t slot, const Vector3& p_WC) const {
  if (slot == 0) return Vector3::Zero();
  const IslandMember& member = s_.members[at(slot - 1)];
  const Vector3& w = member.twist.w_WB;
  return cross(w, cross(w, p_WC - member.pose.p_AB));
}

/// The normal of a pair that touches at a corner or an edge, from the motion now, or as it is at
/// the end of the piece without contact.
void Island::updateEntryNormal(IslandLink& link, bool at_end) {
  if (link.manifold.of_face) return;
  const auto side = [&](std::int32_t index, std::int32_t slot) -> MovingHull {
    Twist twist{Vector3::Zero(), Vector3::Zero()};
    if (slot != 0) {
      const IslandMember& member = s_.members[at(slot - 1)];
      twist = at_end ? member.twist_end : member.twist;
    }
    return {scene_.hullOf(index), poseOfIndex(index), twist};
  };
  turnToEntry(side(link.cache.a, link.slot_a), side(link.cache.b, link.slot_b), link.closest,
              link.manifold);
}

/// The bodies of the island for the solver, 0 what is fixed. @param at_end with the velocities at
/// the end of the piece without contact.
void Island::addBodies(bool at_end) {
  s_.solver.clear();
  s_.solver.add(ContactBody());
  for (const IslandMember& member : s_.members) {
    const Mobility& mobility = scene_.mobilityOf(member.index);
    s_.solver.add({member.pose.p_AB, mobility.inverseMass(),
                   mobility.inverseInertia(member.pose.R_AB),
                   at_end ? member.twist_end : member.twist});
  }
}

/// Asks the points of a pair to stay apart until the end of the piece. @returns whether it has any.
bool Island::addRestPoints(IslandLink& link, double left) {
  const WorldConfig& config = scene_.config();
  link.first_point = s_.solver.pointCount();
  link.point_count = 0;
  if (!link.touching) return false;
  updateEntryNormal(link, true);
  const double still = restSpeed(link);
  const double parting = std::min(still, kRestParting * config.tolerance / left);
  const double wanted = kRestGap * config.tolerance;
  const double near = kKnownPoint * scene_.hullOf(link.cache.a).data().radius;
  CachedForces forces(link.cache, poseOfIndex(link.cache.a), near);
  for (int i = 0; i < link.manifold.count; ++i) {
    const ContactPoint& contact = link.manifold.points[at(i)];
    const Vector3 v =
        velocityNow(link.slot_b, contact.p_WC) - velocityNow(link.slot_a, contact.p_WC);
    const double speed = dot(link.manifold.nhat_AB_W, v);
    // What parts flies on its own, and rests when it has come back; what comes fast is an impact,
    // in its time.
    if (speed > parting || (contact.gap > config.tolerance && speed < -still)) continue;
    ContactConstraint constraint;
    constraint.a = link.slot_a;
    constraint.b = link.slot_b;
    constraint.nhat_AB_W = link.manifold.nhat_AB_W;
    constraint.p_WC = contact.p_WC;
    const double missing = wanted - contact.gap;
    // One linear law for all points that touch: else the four of a face would ask for what no
    // motion of two rigid bodies can give, and the sweeps would creep. A pair that does not rest
    // yet is not pushed apart: if nothing presses it, it would fly on with that speed.
    const double recovery = kGapRecovery * missing / config.step;
    constraint.target = contact.gap > config.tolerance ? (config.tolerance - contact.gap) / left
                        : link.cache.resting           ? recovery
                                                       : std::min(0.0, recovery);
    const Vector3 bend =
        centripetalNow(link.slot_b, contact.p_WC) - centripetalNow(link.slot_a, contact.p_WC);
    constraint.target -= left * dot(link.manifold.nhat_AB_W, bend);
    constraint.friction =
        link.material.stick ? std::numeric_limits<double>::infinity() : link.material.friction;
    constraint.start = left * forces.take(contact.p_WC);
    s_.solver.add(constraint);
    ++link.point_count;
  }
  return link.point_count > 0;
}

/// The constant forces that hold touching bodies apart over the rest of the step.
void Island::solveRestingContacts(double now) {
  const double left = scene_.config().step - now;
  for (IslandMember& member : s_.members) {
    member.contact = Wrench();
    endFreely(member, now);
  }
  addBodies(true);
  bool any = false;
  for (IslandLink& link : s_.links) any = addRestPoints(link, left) || any;
  const auto points = static_cast<int>(s_.solver.pointCount());
  if (any) {
    const double left_over =
        kRestResidual * kRestGap * scene_.config().tolerance / scene_.config().step;
    s_.solver.solve({std::max(kMinRestSweeps, kMaxRestRelaxations / points), kLeastRestSweeps,
                     left_over, kActiveSetResidual * left_over});
  }
  applyForces(now, left);
}

/// Whether the body rests on another piece of the same wall, or did in this step: then its rest
/// goes on.
bool Island::restsOnWhole(const IslandLink& link) const {
  const std::int32_t whole = scene_.wholeOf(link.cache.b);
  return std::any_of(s_.links.begin(), s_.links.end(), [&](const IslandLink& other) {
    return other.rested && other.cache.a == link.cache.a && scene_.wholeOf(other.cache.b) == whole;
  });
}

void Island::applyForces(double now, double left) {
  const double per_time = 1.0 / left;
  for (IslandLink& link : s_.links) {
    ContactCache& cache = link.cache;
    cache.count = 0;
    ContactRecord record;
    double weight = 0.0;
    double stopped = 0.0;  // m/s
    for (std::size_t k = link.first_point; k < link.first_point + at(link.point_count); ++k) {
      const Vector3 impulse = s_.solver.impulse(k);
      const double size = norm(impulse);
      if (size == 0.0) continue;
      const Vector3 p_WC = s_.solver.positionOf(k);
      const Vector3 force = per_time * impulse;
      const auto slot = at(cache.count++);
      cache.p_AC[slot] = inverseTransform(poseOfIndex(cache.a), p_WC);
      cache.force_B_W[slot] = force;
      pushBoth(link, force, p_WC, s_.members);
      record.impulse_B_W += impulse;
      record.p_WC += size * p_WC;
      weight += size;
      stopped = std::max(stopped, s_.solver.stoppedSpeed(k));
    }
    if (cache.resting || !(stopped > kStillSpeed)) continue;
    cache.resting = true;
    const bool goes_on = restsOnWhole(link);
    link.rested = true;
    if (goes_on) continue;
    record.kind = ContactKind::kRest;
    record.a = cache.a;
    record.b = cache.b;
    record.time = now;
    record.p_WC = record.p_WC / weight;
    record.nhat_AB_W = link.manifold.nhat_AB_W;
    records_.push_back(record);
  }
}

}  // namespace hovercraft
