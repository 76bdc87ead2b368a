#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/contact_tolerances.h"
#include "hovercraft_sim/math/index.h"
#include "hovercraft_sim/world/island.h"

/// The impacts of the bodies of an island.

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
  const std::size_t end = link.first_point + at(link.point_count);
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
    member.ends_freely = false;
    applyImpulse(member.state, scene.mobilityOf(member.index), impulse, point.p_WC);
  }
}
}  // namespace

/// The impact of all points that touch now. @param now s, from the start of the step.
void Island::solveImpacts(double now) {
  for (IslandLink& link : s_.links) {
    if (link.touching) updateEntryNormal(link, false);
  }
  if (!hasImpact()) return;
  addImpactPoints();
  addBodies(false);
  slowBounces();
  s_.impact.resolve(s_.solver, s_.impact_points, slowApproach());
  for (const ImpactPoint& point : s_.impact_points) {
    if (squaredNorm(point.impulse) > 0.0) applyToBoth(point, scene_, s_.members);
  }
  updateTwists();
  recordImpacts(now);
}

/// All points that touch now.
void Island::addImpactPoints() {
  s_.impact_points.clear();
  for (IslandLink& link : s_.links) {
    link.first_point = s_.impact_points.size();
    link.point_count = 0;
    if (!link.touching) continue;
    for (int i = 0; i < link.manifold.count; ++i) {
      const ContactPoint& contact = link.manifold.points[at(i)];
      if (contact.gap > scene_.config().tolerance) continue;
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
}

/// What a step without contact does to the points of a pair.
Island::FreeStep Island::freeStepOf(const IslandLink& link, const ImpactPoint& point) const {
  FreeStep step;
  const double h = scene_.config().step;
  for (const std::int32_t slot : {link.slot_a, link.slot_b}) {
    if (slot == 0) continue;
    const Vector3 gained = velocityAtEnd(slot, point.p_WC) - velocityNow(slot, point.p_WC);
    step.pressed = std::max(step.pressed, std::abs(dot(point.nhat_AB_W, gained)) / h);
  }
  if (scene_.config().integrator == Integrator::kEuler) step.gain = step.pressed * h;
  return step;
}

/// What of an approach does not bounce, of pairs that come to rest some time. A flight that would
/// not come out of the tolerance again is none: such would go on for ever, as the gap that is used
/// up there is corrected. And with explicit Euler each flight ends faster than it began.
void Island::slowBounces() {
  const bool any = std::any_of(s_.links.begin(), s_.links.end(), [](const IslandLink& link) {
    const double e = link.material.restitution;
    return link.point_count > 0 && e > 0.0 && e < 1.0;
  });
  if (!any) return;
  for (IslandMember& member : s_.members) endFreely(member, 0.0);
  for (const IslandLink& link : s_.links) {
    const double e = link.material.restitution;
    if (!(e > 0.0 && e < 1.0)) continue;
    for (std::size_t k = link.first_point; k < link.first_point + at(link.point_count); ++k) {
      ImpactPoint& point = s_.impact_points[k];
      const FreeStep step = freeStepOf(link, point);
      const double rise = kRestGap * scene_.config().tolerance;
      // What it fell below the gap that is kept, and is lifted by again, is no height of fall.
      const Vector3 v = velocityNow(link.slot_b, point.p_WC) - velocityNow(link.slot_a, point.p_WC);
      const double u = std::max(0.0, -dot(point.nhat_AB_W, v));
      const double below = 2.0 * step.pressed * std::max(0.0, rise - link.found);
      point.gain = step.gain + (u - std::sqrt(std::max(0.0, u * u - below)));
      point.plastic_speed = std::max(point.plastic_speed, std::sqrt(2.0 * step.pressed * rise) / e);
    }
  }
}

/// The approach that a resting contact stops by itself, m/s.
double Island::slowApproach() const {
  return kRestApproach * kRestGap * scene_.config().tolerance / scene_.config().step;
}

/// Whether some pair that touches approaches faster than its resting contact stops by itself.
bool Island::hasImpact() const {
  return std::any_of(s_.links.begin(), s_.links.end(),
                     [this](const IslandLink& link) { return link.touching && hasImpact(link); });
}

bool Island::hasImpact(const IslandLink& link) const {
  const double bound = link.cache.resting ? slowApproach() : kStillSpeed;
  for (int i = 0; i < link.manifold.count; ++i) {
    const ContactPoint& contact = link.manifold.points[at(i)];
    if (contact.gap > scene_.config().tolerance) continue;
    const Vector3 v =
        velocityNow(link.slot_b, contact.p_WC) - velocityNow(link.slot_a, contact.p_WC);
    if (dot(link.manifold.nhat_AB_W, v) < -bound) return true;
  }
  return false;
}

/// A record for each pair that met faster than what counts as rest.
void Island::recordImpacts(double now) {
  for (IslandLink& link : s_.links) {
    const PairImpact sum = sumOf(link, s_.impact_points);
    if (sum.weight == 0.0) continue;
    ++link.impacts;
    if (!sum.bounced && sum.approach < scene_.config().rest_speed) continue;  // comes to rest
    ContactRecord record;
    record.kind = sum.bounced ? ContactKind::kBounce : ContactKind::kStick;
    record.a = link.cache.a;
    record.b = link.cache.b;
    record.time = now;
    record.p_WC = sum.moment / sum.weight;
    record.nhat_AB_W = link.manifold.nhat_AB_W;
    record.impulse_B_W = sum.impulse;
    records_.push_back(record);
  }
}
}  // namespace hovercraft
