#include "hovercraft_sim/world/island.h"

#include <algorithm>
#include <limits>

#include "hovercraft_sim/collision/time_of_impact.h"
#include "hovercraft_sim/math/contact_tolerances.h"
#include "hovercraft_sim/math/index.h"
#include "hovercraft_sim/world/world.h"

namespace hovercraft {
namespace {

/// The thrusts at a share x of the step: the parabola through its start, middle and end, which is
/// exact there and off by the cube of the step over the lag in between.
Vector3 thrustAt(const ThrustCourse& course, double x) {
  const double start = (1.0 - x) * (1.0 - 2.0 * x);
  const double middle = 4.0 * x * (1.0 - x);
  const double end = x * (2.0 * x - 1.0);
  return (start * course.start + middle * course.middle) + end * course.end;
}

}  // namespace

void Island::begin(const std::vector<std::int32_t>& bodies,
                   const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs,
                   const std::vector<BodyState>& states, const std::vector<ContactMemory>& memory) {
  s_.slots.resize(world_.bodies_.size());
  s_.members.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    IslandMember& member = s_.members[k];
    member.index = bodies[k];
    member.state = states[at(bodies[k])];
    member.pose = poseOf(member.state);
    member.travelled = 0.0;
    s_.slots[at(bodies[k])] = static_cast<std::int32_t>(k + 1);  // 0: what is fixed
  }
  s_.links.resize(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    IslandLink& link = s_.links[k];
    const auto [a, b] = pairs[k];
    const auto known = std::lower_bound(
        memory.begin(), memory.end(), pairs[k], [](const ContactMemory& m, const auto& pair) {
          return m.a < pair.first || (m.a == pair.first && m.b < pair.second);
        });
    const bool found = known != memory.end() && known->a == a && known->b == b;
    link.memory = found ? *known : ContactMemory();
    link.memory.a = a;
    link.memory.b = b;
    link.material = world_.rules_.pair(world_.materialOf(a), world_.materialOf(b));
    link.impacts = 0;
    link.slot_a = s_.slots[at(a)];
    link.slot_b = world_.isFixed(b) ? 0 : s_.slots[at(b)];
  }
}

const Pose& Island::poseOfIndex(std::int32_t index) const {
  if (world_.isFixed(index)) return world_.obstacles_[at(index) - world_.bodies_.size()].X_WO;
  return s_.members[at(s_.slots[at(index)] - 1)].pose;
}

StepMotion Island::motionOfIndex(std::int32_t index) const {
  if (!world_.isFixed(index)) return s_.members[at(s_.slots[at(index)] - 1)].motion;
  const Pose& X_WO = poseOfIndex(index);
  StepMotion still;
  still.p_WB = X_WO.p_AB;
  still.q_WB = quaternionFromMatrix(X_WO.R_AB);
  return still;
}

/// The approach that a pair may have and still not bounce, m/s.
double Island::restSpeed(const IslandLink& link) const {
  if (plastic_ || link.impacts >= kMaxBounces) return std::numeric_limits<double>::infinity();
  if (link.memory.resting) return world_.rules_.rest_speed;
  return std::max(kStillSpeed, (1.0 - link.material.restitution) * world_.rules_.rest_speed);
}

/// Closest features of every pair, and the points of those that touch.
void Island::look(double left) {
  const WorldRules& rules = world_.rules_;
  const double band = rules.tolerance + 2.0 * rules.rest_speed * left;
  for (IslandLink& link : s_.links) {
    const std::int32_t a = link.memory.a;
    const std::int32_t b = link.memory.b;
    closestNow(link);
    if (link.closest.distance > kLostContact * rules.tolerance) link.memory.resting = false;
    link.touching = link.closest.distance <= rules.tolerance;
    if (!link.touching) continue;
    link.manifold = contactManifold(world_.hullOf(a), poseOfIndex(a), world_.hullOf(b),
                                    poseOfIndex(b), link.closest, band);
  }
}

/// Sets bodies apart again whose gap is nearly used up, by shifts of a part of the
/// tolerance, as their masses share them. All of it is undone if some pair would be left without a
/// gap. @returns whether bodies were moved.
bool Island::repair() {
  const double tolerance = world_.rules_.tolerance;
  const double wanted = kRestGap * tolerance;
  double least = wanted;
  for (const IslandLink& link : s_.links) {
    if (link.touching) least = std::min(least, link.closest.distance);
  }
  if (least >= (stuck_ ? kFairRestGap : kLeastRestGap) * tolerance) return false;
  for (IslandMember& member : s_.members) member.end = member.state;
  for (int sweep = 0; sweep < kMaxRepairSweeps && repairSweep(); ++sweep) {
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
bool Island::repairSweep() {
  const double tolerance = world_.rules_.tolerance;
  bool moved_any = false;
  for (IslandLink& link : s_.links) {
    const double gap = closestNow(link).distance;
    if (gap >= kFairRestGap * tolerance) continue;
    moved_any = shiftApart(link, kRestGap * tolerance - gap) || moved_any;
  }
  return moved_any;
}

ClosestFeatures Island::closestNow(IslandLink& link) {
  const std::int32_t a = link.memory.a;
  const std::int32_t b = link.memory.b;
  link.closest = closestFeatures(world_.hullOf(a), poseOfIndex(a), world_.hullOf(b), poseOfIndex(b),
                                 link.memory.features);
  return link.closest;
}

/// @param by m. @returns whether either body can move that way.
bool Island::shiftApart(const IslandLink& link, double by) {
  const auto shifts =
      world_.shiftsApart({link.memory.a, link.memory.b}, link.closest.nhat_AB_W, by, -1);
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
                        bool with_contact) const {
  const double h = world_.rules_.step;
  const BodyDrive& drive = drives_[at(member.index)];
  ThrustCourse course = drive.thrusts;
  if (from > 0.0 || to < h) {
    course.start = thrustAt(drive.thrusts, from / h);
    course.middle = thrustAt(drive.thrusts, 0.5 * (from + to) / h);
    course.end = thrustAt(drive.thrusts, to / h);
  }
  ExternalLoad load = drive.load;
  const bool pressed = with_contact && (squaredNorm(member.contact.force) > 0.0 ||
                                        squaredNorm(member.contact.torque) > 0.0);
  if (pressed) load.in_world = load.in_world + member.contact;
  const DrivenHovercraft system = {world_.bodies_[at(member.index)].model, course,
                                   drive.is_pushed || pressed ? &load : nullptr};
  return std::visit(
      [&](const auto& body) -> BodyState {
        return integrationStep<decltype(body.orientation)>(world_.rules_.integrator, body, system,
                                                           to - from);
      },
      member.state);
}

/// The earliest impact in a piece of `duration`. @param share of the distance that counts as one.
bool Island::firstImpact(double duration, double share, double& time) const {
  const double tolerance = kRestGap * world_.rules_.tolerance;
  bool any = false;
  time = duration;
  for (const IslandLink& link : s_.links) {
    // Two bodies that touch may come no nearer than half of what they are.
    const double within = share * std::min(tolerance, 0.5 * link.closest.distance);
    if (!(within > 0.0)) continue;
    const std::int32_t a = link.memory.a;
    const std::int32_t b = link.memory.b;
    const StepMotion motion_a = motionOfIndex(a);
    const StepMotion motion_b = motionOfIndex(b);
    const ImpactSearch search = {time, within, ImpactMethod::kAdvance};
    if (isClear(world_.hullOf(a), motion_a, world_.hullOf(b), motion_b, link.closest, search)) {
      continue;
    }
    const TimeOfImpact impact =
        timeOfImpact(world_.hullOf(a), motion_a, world_.hullOf(b), motion_b, search);
    if (impact.status == ImpactStatus::kNone || impact.time >= time) continue;
    any = true;
    time = impact.time;
    if (!(time > 0.0)) break;
  }
  return any;
}

/// Moves all bodies until the end of the step or the first impact. @returns the time then, s.
double Island::advance(double now) {
  const double h = world_.rules_.step;
  double to = h;
  double share = 1.0;
  for (int cut = 0; cut < kMaxCuts; ++cut) {
    const double duration = to - now;
    if (!(duration > 0.0)) return now;
    for (IslandMember& member : s_.members) {
      const Mobility& mobility = world_.bodies_[at(member.index)].model.mobility;
      member.end = moved(member, now, to, true);
      StepMotion& motion = member.motion;
      const Vector3& p_end = positionOf(member.end);
      motion = motionBetween(member.pose.p_AB, orientationOf(member.state), p_end,
                             orientationOf(member.end), duration);
      motion.a_WB =
          (twistOf(member.end, mobility).v_WB - twistOf(member.state, mobility).v_WB) / duration;
      motion.v_WB -= (0.5 * duration) * motion.a_WB;
    }
    double time = duration;
    if (!firstImpact(duration, share, time)) {
      for (IslandMember& member : s_.members) {
        member.travelled += world_.travelOf(at(member.index), member.state, member.end, duration);
        member.state = member.end;
        member.pose = poseOf(member.state);
      }
      return to;
    }
    to = now + (cut < kImpactCuts ? time : std::min(time, 0.5 * duration));
    share *= kCutShare;
  }
  return now;
}

bool Island::run() {
  const double h = world_.rules_.step;
  const int bound = kMaxEvents + kMaxEventsPerPair * static_cast<int>(s_.links.size());
  plastic_ = false;
  stuck_ = false;
  double now = 0.0;
  for (int event = 0; event < 2 * bound; ++event) {
    plastic_ = event >= bound;
    look(h - now);
    if (repair()) look(h - now);
    strike(now);
    press(now);
    const double then = advance(now);
    stuck_ = !(then > now);
    now = then;
    if (now >= h) return true;
  }
  return false;
}

}  // namespace hovercraft
