#include "hovercraft_sim/world/island.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hovercraft_sim/collision/time_of_impact.h"
#include "hovercraft_sim/math/contact_tolerances.h"
#include "hovercraft_sim/math/index.h"

namespace hovercraft {
namespace {

/// Whether the squares of its velocities and accelerations are numbers.
bool isFinite(const StepMotion& motion) {
  return std::isfinite(squaredNorm(motion.v_WB) + squaredNorm(motion.a_WB) +
                       squaredNorm(motion.w_WB) + squaredNorm(motion.alpha_WB));
}

}  // namespace

void Island::begin(const std::vector<std::int32_t>& bodies, const std::vector<ScenePair>& pairs,
                   const std::vector<BodyState>& states, const std::vector<BodyState>& ends,
                   const std::vector<ContactCache>& contacts) {
  s_.slots.resize(scene_.bodies().size());
  s_.members.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    IslandMember& member = s_.members[k];
    member.index = bodies[k];
    member.state = states[at(bodies[k])];
    member.end = ends[at(bodies[k])];
    member.ends_freely = true;
    member.pose = poseOf(member.state);
    member.travelled = Vector3::Zero();
    s_.slots[at(bodies[k])] = static_cast<std::int32_t>(k + 1);  // 0: what is fixed
  }
  s_.links.resize(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    IslandLink& link = s_.links[k];
    const auto [a, b] = pairs[k];
    const auto known = std::lower_bound(
        contacts.begin(), contacts.end(), pairs[k], [](const ContactCache& m, const auto& pair) {
          return m.a < pair.first || (m.a == pair.first && m.b < pair.second);
        });
    const bool found = known != contacts.end() && known->a == a && known->b == b;
    link.cache = found ? *known : ContactCache();
    link.cache.a = a;
    link.cache.b = b;
    link.material = scene_.lawOf(pairs[k]);
    link.impacts = 0;
    link.rested = link.cache.resting;
    link.slot_a = s_.slots[at(a)];
    link.slot_b = scene_.isFixed(b) ? 0 : s_.slots[at(b)];
  }
}

const Pose& Island::poseOfIndex(std::int32_t index) const {
  if (scene_.isFixed(index)) return scene_.fixedPose(index);
  return s_.members[at(s_.slots[at(index)] - 1)].pose;
}

const StepMotion& Island::motionOfIndex(std::int32_t index) const {
  if (scene_.isFixed(index)) return scene_.fixedMotion(index);
  return s_.members[at(s_.slots[at(index)] - 1)].motion;
}

/// The approach that a pair may have and still not bounce, m/s.
double Island::restSpeed(const IslandLink& link) const {
  const bool is_spent = plastic_ || link.impacts >= kMaxBounces;
  if (is_spent && link.material.restitution < 1.0) return std::numeric_limits<double>::infinity();
  if (link.cache.resting) {
    return std::max(scene_.config().rest_speed,
                    kRestGap * scene_.config().tolerance / scene_.config().step);
  }
  return std::max(kStillSpeed, (1.0 - link.material.restitution) * scene_.config().rest_speed);
}

/// Closest features of every pair, and the points of those that touch.
void Island::updateContacts(double left) {
  const WorldConfig& config = scene_.config();
  const double band = config.tolerance + 2.0 * config.rest_speed * left;
  for (IslandLink& link : s_.links) {
    const std::int32_t a = link.cache.a;
    const std::int32_t b = link.cache.b;
    closestNow(link);
    if (link.closest.distance > kLostContact * config.tolerance) link.cache.resting = false;
    link.touching = link.closest.distance <= config.tolerance;
    if (!link.touching) continue;
    link.manifold = contactManifold(scene_.hullOf(a), poseOfIndex(a), scene_.hullOf(b),
                                    poseOfIndex(b), link.closest, band);
  }
}

/// Sets bodies apart again whose gap is nearly used up, by shifts of a part of the
/// tolerance, as their masses share them. All of it is undone if some pair would be left without a
/// gap. @returns whether bodies were moved.
bool Island::correctPositions() {
  const double tolerance = scene_.config().tolerance;
  const double wanted = kRestGap * tolerance;
  double least = wanted;
  for (const IslandLink& link : s_.links) {
    if (link.touching) least = std::min(least, link.closest.distance);
  }
  if (least >= (stuck_ ? kFairRestGap : kLeastRestGap) * tolerance) return false;
  for (IslandMember& member : s_.members) {
    member.end = member.state;
    member.ends_freely = false;
  }
  for (int sweep = 0; sweep < kMaxCorrectionSweeps && correctionSweep(); ++sweep) {
  }
  double left = wanted;
  for (IslandLink& link : s_.links) left = std::min(left, closestNow(link).distance);
  if (left > least) return true;
  for (IslandMember& member : s_.members) {
    member.state = member.end;
    member.pose = poseOf(member.state);
  }
  for (IslandLink& link : s_.links) closestNow(link);
  return false;
}

/// @returns whether some pair was set apart.
bool Island::correctionSweep() {
  const double tolerance = scene_.config().tolerance;
  bool moved_any = false;
  for (IslandLink& link : s_.links) {
    const double gap = closestNow(link).distance;
    if (gap >= kFairRestGap * tolerance) continue;
    moved_any = shiftApart(link, kRestGap * tolerance - gap) || moved_any;
  }
  return moved_any;
}

ClosestFeatures Island::closestNow(IslandLink& link) {
  const std::int32_t a = link.cache.a;
  const std::int32_t b = link.cache.b;
  link.closest = closestFeatures(scene_.hullOf(a), poseOfIndex(a), scene_.hullOf(b), poseOfIndex(b),
                                 link.cache.features);
  return link.closest;
}

/// @param by m. @returns whether either body can move that way.
bool Island::shiftApart(const IslandLink& link, double by) {
  const auto shifts =
      scene_.shiftsApart({link.cache.a, link.cache.b}, link.closest.nhat_AB_W, by, -1);
  if (!shifts) return false;
  const std::int32_t slots[2] = {link.slot_a, link.slot_b};
  for (std::size_t side = 0; side < 2; ++side) {
    if (slots[side] == 0) continue;
    IslandMember& member = s_.members[at(slots[side] - 1)];
    const Vector3& shift = (*shifts)[side];
    std::visit([&](auto& body) { body.p_WB += shift; }, member.state);
    member.pose.p_AB += shift;
  }
  return true;
}

BodyState Island::moved(const IslandMember& member, double from, double to,
                        const Wrench& contact) const {
  return scene_.moved(at(member.index), member.state, inputs_[at(member.index)],
                      {from, to, touched_}, contact);
}

/// The earliest impact in a piece of `duration`. @param share of the distance that counts as one.
bool Island::firstImpact(double duration, double share, double& time) const {
  const double tolerance = kRestGap * scene_.config().tolerance;
  bool any = false;
  time = duration;
  for (const IslandLink& link : s_.links) {
    // Two bodies that touch may come no nearer than half of what they are.
    const double within = share * std::min(tolerance, 0.5 * link.closest.distance);
    if (!(within > 0.0)) continue;
    const std::int32_t a = link.cache.a;
    const std::int32_t b = link.cache.b;
    const StepMotion& motion_a = motionOfIndex(a);
    const StepMotion& motion_b = motionOfIndex(b);
    const ImpactSearch search = {time, within, ImpactMethod::kAdvance};
    if (isClear(scene_.hullOf(a), motion_a, scene_.hullOf(b), motion_b, link.closest, search)) {
      continue;
    }
    const TimeOfImpact impact =
        timeOfImpact(scene_.hullOf(a), motion_a, scene_.hullOf(b), motion_b, search);
    if (impact.status == ImpactStatus::kNone || impact.time >= time) continue;
    any = true;
    time = impact.time;
    if (!(time > 0.0)) break;
  }
  return any;
}

/// Flies all bodies over a piece of the step: their ends, and the motions between. @returns false
/// if one of these is not finite: its body is lost.
bool Island::flyPiece(double from, double to) {
  const double duration = to - from;
  for (IslandMember& member : s_.members) {
    const StepInputs& inputs = inputs_[at(member.index)];
    member.end = moved(member, from, to, member.contact);
    member.ends_freely = false;
    member.motion = motionBetween(member.pose.p_AB, orientationOf(member.state),
                                  positionOf(member.end), orientationOf(member.end), duration);
    const Twist before = scene_.twistAt(member.index, member.state, inputs, from);
    const Twist after = scene_.twistAt(member.index, member.end, inputs, to);
    member.motion.bend(after.v_WB - before.v_WB, after.w_WB - before.w_WB, duration);
    if (isFinite(member.motion)) continue;
    lost_ = member.index;
    return false;
  }
  return true;
}

/// Goes on from the ends of a piece. @param duration of it, s.
void Island::takeEnds(double duration) {
  for (IslandMember& member : s_.members) {
    member.travelled += scene_.motionBoundOf(at(member.index), member.state, member.end, duration);
    member.state = member.end;
    member.pose = poseOf(member.state);
  }
}

/// Moves all bodies until the end of the step or the first impact. @returns the time then, s.
double Island::advance(double now) {
  double to = scene_.config().step;
  double share = 1.0;
  for (int cut = 0; cut < kMaxCuts; ++cut) {
    const double duration = to - now;
    if (!(duration > 0.0) || !flyPiece(now, to)) return now;
    double time = duration;
    if (!firstImpact(duration, share, time)) {
      takeEnds(duration);
      return to;
    }
    to = now + (cut < kImpactCuts ? time : std::min(time, 0.5 * duration));
    share *= kCutShare;
  }
  return now;
}

bool Island::isTouched() const {
  return std::any_of(s_.links.begin(), s_.links.end(),
                     [](const IslandLink& link) { return link.touching; });
}

/// Where bodies touch, both Eulers give way: the end of the whole step is another one.
void Island::leaveEuler() {
  if (!isEuler(scene_.config().integrator)) return;
  for (IslandMember& member : s_.members) member.ends_freely = false;
}

/// Nothing touches: no forces.
void Island::clearForces() {
  for (IslandMember& member : s_.members) member.contact = Wrench();
  for (IslandLink& link : s_.links) link.cache.count = 0;
}

bool Island::run() {
  const double h = scene_.config().step;
  const int bound = kMaxEvents + kMaxEventsPerPair * static_cast<int>(s_.links.size());
  plastic_ = false;
  stuck_ = false;
  double now = 0.0;
  for (int event = 0; event < 2 * bound; ++event) {
    plastic_ = event >= bound;
    now_ = now;
    updateContacts(h - now);
    for (IslandLink& link : s_.links) link.found = link.closest.distance;
    if (correctPositions()) updateContacts(h - now);
    touched_ = isTouched();
    if (touched_) {
      leaveEuler();
      updateTwists();
      solveImpacts(now);
      solveRestingContacts(now);
    } else {
      clearForces();
    }
    const double then = advance(now);
    if (lost_ >= 0) return false;
    stuck_ = !(then > now);
    now = then;
    if (now >= h) return true;
  }
  return false;
}

}  // namespace hovercraft
