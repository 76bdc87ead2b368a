#include <algorithm>
#include <array>
#include <limits>

#include "hovercraft_sim/math/contact_tolerances.h"
#include "hovercraft_sim/math/index.h"
#include "hovercraft_sim/world/island.h"

/// What the bodies of an island do to each other: impacts, and the forces of resting contacts.

namespace hovercraft {
namespace {

void applyImpulse(BodyState& state, const Mobility& mobility, const Vector3& impulse,
                  const Vector3& p_WC) {
  std::visit(
      [&](auto& body) {
        const Wrench kick = mobility.project({impulse, cross(p_WC - body.p_WB, impulse)});
        body.momentum_W += kick.force;
        body.angular_momentum_W += kick.torque;
      },
      state);
}

/// What the points of one pair got in an impact.
struct PairImpact {
  Vector3 impulse = Vector3::Zero();  // N s, on B
  Vector3 moment = Vector3::Zero();   // N s m: points by the size of their impulses
  double weight = 0.0;                // N s
  double approach = 0.0;              // m/s
  bool bounced = false;
};

PairImpact sumOf(const IslandLink& link, const std::vector<ImpactPoint>& points) {
  PairImpact sum;
  const std::size_t end = link.first_point + static_cast<std::size_t>(link.point_count);
  for (std::size_t k = link.first_point; k < end; ++k) {
    const ImpactPoint& point = points[k];
    const double size = norm(point.impulse);
    if (size == 0.0) continue;
    sum.impulse += point.impulse;
    sum.moment += size * point.p_WC;
    sum.weight += size;
    sum.approach = std::max(sum.approach, point.approach);
    sum.bounced = sum.bounced || point.bounced;
  }
  return sum;
}

/// Gives both bodies of a point its impulse.
void applyToBoth(const ImpactPoint& point, const Scene& scene, std::vector<IslandMember>& members) {
  const std::int32_t slots[2] = {point.a, point.b};
  for (int side = 0; side < 2; ++side) {
    if (slots[side] == 0) continue;
    IslandMember& member = members[at(slots[side] - 1)];
    const Vector3 impulse = (side == 0 ? -1.0 : 1.0) * point.impulse;
    applyImpulse(member.state, scene.mobilityOf(member.index), impulse, point.p_WC);
  }
}

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

using UsedPoints = std::array<bool, ContactManifold::kMaxPoints>;

/// The force that was remembered nearest to a point, N on B; each is taken once.
Vector3 rememberedForce(const ContactMemory& memory, const Pose& X_WA, const Vector3& p_WC,
                        double near, UsedPoints& used) {
  double closest = near * near;
  int matched = -1;
  for (int k = 0; k < memory.count; ++k) {
    const auto slot = static_cast<std::size_t>(k);
    const double away = squaredNorm(transform(X_WA, memory.p_AC[slot]) - p_WC);
    if (used[slot] || away >= closest) continue;
    closest = away;
    matched = k;
  }
  if (matched < 0) return Vector3::Zero();
  used[static_cast<std::size_t>(matched)] = true;
  return memory.force_B_W[static_cast<std::size_t>(matched)];
}

}  // namespace

/// Velocity of a body's point at a time from the start of the step, m/s; 0 for what is fixed.
Vector3 Island::velocityNow(std::int32_t slot, const Vector3& p_WC, double now) const {
  if (slot == 0) return Vector3::Zero();
  const IslandMember& member = s_.members[at(slot - 1)];
  const Twist twist = scene_.twistAt(member.index, member.state, inputs_[at(member.index)], now);
  return velocityOfPoint(twist, p_WC, member.pose.p_AB);
}

/// The bodies of the island for the solver, 0 what is fixed. @param now s, from the start of the
/// step. @param at_end with the velocities at its end without contact.
void Island::addBodies(double now, bool at_end) {
  s_.solver.clear();
  s_.solver.add(ContactBody());
  for (const IslandMember& member : s_.members) {
    const Mobility& mobility = scene_.mobilityOf(member.index);
    s_.solver.add({member.pose.p_AB, mobility.inverseMass(),
                   mobility.inverseInertia(member.pose.R_AB),
                   scene_.twistAt(member.index, at_end ? member.end : member.state,
                                  inputs_[at(member.index)], at_end ? scene_.rules().step : now)});
  }
}

/// The impact of all points that touch now. @param now s, from the start of the step.
void Island::strike(double now) {
  s_.impact_points.clear();
  for (IslandLink& link : s_.links) {
    link.first_point = s_.impact_points.size();
    link.point_count = 0;
    if (!link.touching) continue;
    for (int i = 0; i < link.manifold.count; ++i) {
      const ContactPoint& contact = link.manifold.points[static_cast<std::size_t>(i)];
      if (contact.gap > scene_.rules().tolerance) continue;
      ImpactPoint point;
      point.a = link.slot_a;
      point.b = link.slot_b;
      point.nhat_AB_W = link.manifold.nhat_AB_W;
      point.p_WC = contact.p_WC;
      point.material = link.material;
      point.plastic_speed = restSpeed(link);
      s_.impact_points.push_back(point);
      ++link.point_count;
    }
  }
  if (s_.impact_points.empty()) return;
  addBodies(now, false);
  if (!isStruck()) return;
  s_.impact.resolve(s_.solver, s_.impact_points, slowApproach());
  for (const ImpactPoint& point : s_.impact_points) {
    if (squaredNorm(point.impulse) > 0.0) applyToBoth(point, scene_, s_.members);
  }
  report(now);
}

/// The approach that a resting contact stops by itself, m/s.
double Island::slowApproach() const {
  return kRestApproach * kRestGap * scene_.rules().tolerance / scene_.rules().step;
}

/// Whether some pair that touches approaches faster than its resting contact stops by itself.
bool Island::isStruck() const {
  for (const IslandLink& link : s_.links) {
    const double bound = link.memory.resting ? slowApproach() : kStillSpeed;
    for (std::size_t k = link.first_point;
         k < link.first_point + static_cast<std::size_t>(link.point_count); ++k) {
      const ImpactPoint& point = s_.impact_points[k];
      const ContactBody& A = s_.solver.bodies()[at(point.a)];
      const ContactBody& B = s_.solver.bodies()[at(point.b)];
      const Vector3 v = velocityOfPoint(B.twist, point.p_WC, B.p_WB) -
                        velocityOfPoint(A.twist, point.p_WC, A.p_WB);
      if (dot(point.nhat_AB_W, v) < -bound) return true;
    }
  }
  return false;
}

/// A record for each pair that met faster than what counts as rest.
void Island::report(double now) {
  for (IslandLink& link : s_.links) {
    const PairImpact sum = sumOf(link, s_.impact_points);
    if (sum.weight == 0.0) continue;
    ++link.impacts;
    if (!sum.bounced && sum.approach < scene_.rules().rest_speed) continue;  // comes to rest
    ContactRecord record;
    record.kind = sum.bounced ? ContactKind::kBounce : ContactKind::kStick;
    record.a = link.memory.a;
    record.b = link.memory.b;
    record.time = now;
    record.p_WC = sum.moment / sum.weight;
    record.nhat_AB_W = link.manifold.nhat_AB_W;
    record.impulse_B_W = sum.impulse;
    records_.push_back(record);
  }
}

/// Asks the points of a pair to stay apart until the end of the piece. @returns whether it has any.
bool Island::addRestPoints(IslandLink& link, double left) {
  const WorldRules& rules = scene_.rules();
  link.first_point = s_.solver.pointCount();
  link.point_count = 0;
  if (!link.touching) return false;
  const double still = restSpeed(link);
  const double wanted = kRestGap * rules.tolerance;
  UsedPoints used{};
  const Pose& X_WA = poseOfIndex(link.memory.a);
  const double near = kKnownPoint * scene_.hullOf(link.memory.a).data().radius;
  for (int i = 0; i < link.manifold.count; ++i) {
    const ContactPoint& contact = link.manifold.points[static_cast<std::size_t>(i)];
    const double now = rules.step - left;
    const Vector3 v =
        velocityNow(link.slot_b, contact.p_WC, now) - velocityNow(link.slot_a, contact.p_WC, now);
    const double speed = dot(link.manifold.nhat_AB_W, v);
    // What parts flies on its own; what comes fast is an impact, in its time.
    if (speed > still || (contact.gap > rules.tolerance && speed < -still)) continue;
    ContactDemand asked;
    asked.a = link.slot_a;
    asked.b = link.slot_b;
    asked.nhat_AB_W = link.manifold.nhat_AB_W;
    asked.p_WC = contact.p_WC;
    const double missing = wanted - contact.gap;
    // One linear law for all points that touch: else the four of a face would ask for what no
    // motion of two rigid bodies can give, and the sweeps would creep. A pair that does not rest
    // yet is not pushed apart: if nothing presses it, it would fly on with that speed.
    const double recovery = kGapRecovery * missing / rules.step;
    asked.target = contact.gap > rules.tolerance ? (rules.tolerance - contact.gap) / left
                   : link.memory.resting         ? recovery
                                                 : std::min(0.0, recovery);
    asked.friction =
        link.material.stick ? std::numeric_limits<double>::infinity() : link.material.friction;
    asked.start = left * rememberedForce(link.memory, X_WA, contact.p_WC, near, used);
    s_.solver.add(asked);
    ++link.point_count;
  }
  return link.point_count > 0;
}

/// The constant forces that hold touching bodies apart over the rest of the step.
void Island::press(double now) {
  const double left = scene_.rules().step - now;
  bool any_touch = false;
  for (const IslandLink& link : s_.links) any_touch = any_touch || link.touching;
  for (IslandMember& member : s_.members) {
    member.contact = Wrench();
    if (!any_touch) continue;
    member.end = moved(member, now, scene_.rules().step, Wrench());
  }
  if (!any_touch) {
    for (IslandLink& link : s_.links) link.memory.count = 0;
    return;
  }
  addBodies(now, true);
  bool any = false;
  for (IslandLink& link : s_.links) any = addRestPoints(link, left) || any;
  const auto points = static_cast<int>(s_.solver.pointCount());
  if (any) {
    s_.solver.solve({std::max(kMinRestSweeps, kMaxRestRelaxations / points), kLeastRestSweeps,
                     kRestResidual * kRestGap * scene_.rules().tolerance / scene_.rules().step});
  }
  takeForces(now, left);
}

void Island::takeForces(double now, double left) {
  const double per_time = 1.0 / left;
  for (IslandLink& link : s_.links) {
    ContactMemory& memory = link.memory;
    memory.count = 0;
    ContactRecord record;
    double weight = 0.0;
    double stopped = 0.0;  // m/s
    for (std::size_t k = link.first_point;
         k < link.first_point + static_cast<std::size_t>(link.point_count); ++k) {
      const Vector3 impulse = s_.solver.impulse(k);
      const double size = norm(impulse);
      if (size == 0.0) continue;
      const Vector3 p_WC = s_.solver.positionOf(k);
      const Vector3 force = per_time * impulse;
      const auto slot = static_cast<std::size_t>(memory.count++);
      memory.p_AC[slot] = inverseTransform(poseOfIndex(memory.a), p_WC);
      memory.force_B_W[slot] = force;
      pushBoth(link, force, p_WC, s_.members);
      record.impulse_B_W += impulse;
      record.p_WC += size * p_WC;
      weight += size;
      stopped = std::max(stopped, s_.solver.stoppedSpeed(k));
    }
    if (memory.resting || !(stopped > kStillSpeed)) continue;
    memory.resting = true;
    record.kind = ContactKind::kRest;
    record.a = memory.a;
    record.b = memory.b;
    record.time = now;
    record.p_WC = record.p_WC / weight;
    record.nhat_AB_W = link.manifold.nhat_AB_W;
    records_.push_back(record);
  }
}

}  // namespace hovercraft
