#include "hovercraft_sim/world/island.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hovercraft_sim/collision/time_of_impact.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/world/world.h"

namespace hovercraft {
namespace {

std::size_t at(std::int32_t index) {
  return static_cast<std::size_t>(index);
}

/// The thrusts at a share x of the step: the parabola through its start, middle and end, which is
/// exact there and off by the cube of the step over the lag in between.
Vector3 thrustAt(const ThrustCourse& course, double x) {
  const double start = (1.0 - x) * (1.0 - 2.0 * x);
  const double middle = 4.0 * x * (1.0 - x);
  const double end = x * (2.0 * x - 1.0);
  return (start * course.start + middle * course.middle) + end * course.end;
}

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

const Vector3& positionOf(const BodyState& state) {
  return std::visit([](const auto& body) -> const Vector3& { return body.p_WB; }, state);
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

/// Sets resting bodies apart again whose gap is nearly used up, by shifts of a part of the
/// tolerance, as their masses share them. All of it is undone if some pair would be left without a
/// gap. @returns whether bodies were moved.
bool Island::repair() {
  const double tolerance = world_.rules_.tolerance;
  const double wanted = kRestGap * tolerance;
  double least = wanted;
  for (const IslandLink& link : s_.links) {
    if (link.memory.resting) least = std::min(least, link.closest.distance);
  }
  if (least >= (stuck_ ? kFairRestGap : kLeastRestGap) * tolerance) return false;
  for (IslandMember& member : s_.members) member.end = member.state;
  bool moved_any = true;
  for (int sweep = 0; sweep < kMaxRepairSweeps && moved_any; ++sweep) {
    moved_any = false;
    for (IslandLink& link : s_.links) {
      const double gap = closestNow(link).distance;
      if (gap < kFairRestGap * tolerance) moved_any = shiftApart(link, wanted - gap) || moved_any;
    }
  }
  double left = wanted;
  for (IslandLink& link : s_.links) left = std::min(left, closestNow(link).distance);
  if (left > least) return true;
  for (IslandMember& member : s_.members) {
    member.state = member.end;
    member.pose = poseOf(member.state);
  }
  return false;
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
  const Vector3& n = link.closest.nhat_AB_W;
  double share = 0.0;
  Vector3 ways[2] = {Vector3::Zero(), Vector3::Zero()};
  const std::int32_t slots[2] = {link.slot_a, link.slot_b};
  for (int side = 0; side < 2; ++side) {
    if (slots[side] == 0) continue;
    const IslandMember& member = s_.members[at(slots[side] - 1)];
    ways[side] = world_.bodies_[at(member.index)].model.mobility.inverseMass().cwiseProduct(n);
    share += dot(n, ways[side]);
  }
  if (!(share > 0.0)) return false;
  for (int side = 0; side < 2; ++side) {
    if (slots[side] == 0) continue;
    IslandMember& member = s_.members[at(slots[side] - 1)];
    const Vector3 shift = ((side == 0 ? -by : by) / share) * ways[side];
    std::visit([&](auto& body) { body.p_WB += shift; }, member.state);
    member.pose.p_AB += shift;
  }
  return true;
}

/// The bodies of the island for the solver, 0 what is fixed. @param at_end with the velocities at
/// the end of the piece without contact.
void Island::addBodies(bool at_end) {
  s_.solver.clear();
  s_.solver.add(ContactBody());
  for (const IslandMember& member : s_.members) {
    const Mobility& mobility = world_.bodies_[at(member.index)].model.mobility;
    s_.solver.add({member.pose.p_AB, mobility.inverseMass(),
                   mobility.inverseInertia(member.pose.R_AB),
                   twistOf(at_end ? member.end : member.state, mobility)});
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
      if (contact.gap > world_.rules_.tolerance) continue;
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
  addBodies(false);
  if (!isStruck()) return;
  s_.impact.resolve(s_.solver, s_.impact_points);
  for (const ImpactPoint& point : s_.impact_points) {
    if (squaredNorm(point.impulse) == 0.0) continue;
    for (const auto& [slot, sign] : {std::pair<std::int32_t, double>(point.a, -1.0),
                                     std::pair<std::int32_t, double>(point.b, 1.0)}) {
      if (slot == 0) continue;
      IslandMember& member = s_.members[at(slot - 1)];
      applyImpulse(member.state, world_.bodies_[at(member.index)].model.mobility,
                   sign * point.impulse, point.p_WC);
    }
  }
  report(now);
}

/// Whether some pair that touches approaches faster than its resting contact stops by itself.
bool Island::isStruck() const {
  const WorldRules& rules = world_.rules_;
  const double slow = kRestApproach * kRestGap * rules.tolerance / rules.step;
  for (const IslandLink& link : s_.links) {
    const double bound = link.memory.resting ? slow : kStillSpeed;
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
    ContactRecord record;
    double weight = 0.0;
    double approach = 0.0;
    bool bounced = false;
    for (std::size_t k = link.first_point;
         k < link.first_point + static_cast<std::size_t>(link.point_count); ++k) {
      const ImpactPoint& point = s_.impact_points[k];
      const double size = norm(point.impulse);
      if (size == 0.0) continue;
      record.impulse_B_W += point.impulse;
      record.p_WC += size * point.p_WC;
      weight += size;
      approach = std::max(approach, point.approach);
      bounced = bounced || point.bounced;
    }
    if (weight == 0.0) continue;
    ++link.impacts;
    const bool slow = approach <= (link.memory.resting ? world_.rules_.rest_speed : kStillSpeed);
    if (slow && !bounced) continue;
    record.kind = bounced ? ContactKind::kBounce : ContactKind::kStick;
    if (!bounced && approach < world_.rules_.rest_speed) continue;  // comes to rest
    record.a = link.memory.a;
    record.b = link.memory.b;
    record.time = now;
    record.p_WC = record.p_WC / weight;
    record.nhat_AB_W = link.manifold.nhat_AB_W;
    records_.push_back(record);
  }
}

/// How much faster a point parts at the end of the piece without contact than the same velocities
/// would have it part from where the bodies are now, m/s: a corner goes round with its body, and a
/// normal with its face.
double Island::curvature(const IslandLink& link, const Vector3& p_WC) const {
  const Vector3& n = link.manifold.nhat_AB_W;
  const int corner_of = link.manifold.face_owner == 0 ? 1 : 0;
  const std::int32_t slots[2] = {link.slot_a, link.slot_b};
  Vector3 p_end = p_WC;
  if (slots[corner_of] != 0) {
    const IslandMember& member = s_.members[at(slots[corner_of] - 1)];
    p_end = transform(member.end_pose, inverseTransform(member.pose, p_WC));
  }
  Vector3 n_end = n;
  const int owner = link.manifold.face_owner;
  if (owner >= 0 && slots[owner] != 0) {
    const IslandMember& member = s_.members[at(slots[owner] - 1)];
    n_end = times(member.end_pose.R_AB, transposeTimes(member.pose.R_AB, n));
  }
  double faster = 0.0;
  for (int side = 0; side < 2; ++side) {
    if (slots[side] == 0) continue;
    const IslandMember& member = s_.members[at(slots[side] - 1)];
    const Twist& twist = s_.solver.bodies()[at(slots[side])].twist;
    const double difference = dot(n_end, velocityOfPoint(twist, p_end, member.end_pose.p_AB)) -
                              dot(n, velocityOfPoint(twist, p_WC, member.pose.p_AB));
    faster += side == 0 ? -difference : difference;
  }
  return faster;
}

/// Asks the points of a pair to stay apart until the end of the piece. @returns whether it has any.
bool Island::addRestPoints(IslandLink& link, double left) {
  const WorldRules& rules = world_.rules_;
  link.first_point = s_.solver.pointCount();
  link.point_count = 0;
  if (!link.touching) return false;
  const double still = restSpeed(link);
  const double wanted = kRestGap * rules.tolerance;
  const ContactBody fixed;
  const auto velocityNow = [&](std::int32_t slot, const Vector3& p_WC) {
    if (slot == 0) return Vector3(Vector3::Zero());
    const IslandMember& member = s_.members[at(slot - 1)];
    const Twist twist = twistOf(member.state, world_.bodies_[at(member.index)].model.mobility);
    return velocityOfPoint(twist, p_WC, member.pose.p_AB);
  };
  std::array<bool, ContactManifold::kMaxPoints> used{};
  const Pose& X_WA = poseOfIndex(link.memory.a);
  const double near = 0.05 * world_.hullOf(link.memory.a).data().radius;
  for (int i = 0; i < link.manifold.count; ++i) {
    const ContactPoint& contact = link.manifold.points[static_cast<std::size_t>(i)];
    const double speed = dot(
        link.manifold.nhat_AB_W,
        Vector3(velocityNow(link.slot_b, contact.p_WC) - velocityNow(link.slot_a, contact.p_WC)));
    // What parts flies on its own; what comes fast is an impact, in its time.
    if (speed > still || (contact.gap > rules.tolerance && speed < -still)) continue;
    ContactDemand asked;
    asked.a = link.slot_a;
    asked.b = link.slot_b;
    asked.nhat_AB_W = link.manifold.nhat_AB_W;
    asked.p_WC = contact.p_WC;
    const double missing = wanted - contact.gap;
    // One linear law for all points that touch: else the four of a face would ask for what no
    // motion of two rigid bodies can give, and the sweeps would creep.
    asked.target = contact.gap > rules.tolerance ? (rules.tolerance - contact.gap) / left
                                                 : kGapRecovery * missing / rules.step;
    asked.friction =
        link.material.stick ? std::numeric_limits<double>::infinity() : link.material.friction;
    double closest = near * near;
    int matched = -1;
    for (int k = 0; k < link.memory.count; ++k) {
      if (used[static_cast<std::size_t>(k)]) continue;
      const Vector3 p_W = transform(X_WA, link.memory.p_AC[static_cast<std::size_t>(k)]);
      const double away = squaredNorm(p_W - contact.p_WC);
      if (away >= closest) continue;
      closest = away;
      matched = k;
    }
    if (matched >= 0) {
      used[static_cast<std::size_t>(matched)] = true;
      asked.start = left * link.memory.force_B_W[static_cast<std::size_t>(matched)];
    }
    s_.solver.add(asked);
    ++link.point_count;
  }
  return link.point_count > 0;
}

/// The constant forces that hold touching bodies apart over the rest of the step.
void Island::press(double now) {
  const double left = world_.rules_.step - now;
  bool any_touch = false;
  for (const IslandLink& link : s_.links) any_touch = any_touch || link.touching;
  for (IslandMember& member : s_.members) {
    member.contact = Wrench();
    if (!any_touch) continue;
    member.end = moved(member, now, world_.rules_.step, false);
    member.end_pose = poseOf(member.end);
  }
  if (!any_touch) {
    for (IslandLink& link : s_.links) link.memory.count = 0;
    return;
  }
  addBodies(true);
  bool any = false;
  for (IslandLink& link : s_.links) any = addRestPoints(link, left) || any;
  const auto points = static_cast<int>(s_.solver.pointCount());
  if (any) {
    s_.solver.solve({std::max(kMinRestSweeps, kMaxRestRelaxations / points), kLeastRestSweeps,
                     kRestResidual * kRestGap * world_.rules_.tolerance / world_.rules_.step});
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
      for (const auto& [body, sign] : {std::pair<std::int32_t, double>(link.slot_a, -1.0),
                                       std::pair<std::int32_t, double>(link.slot_b, 1.0)}) {
        if (body == 0) continue;
        IslandMember& member = s_.members[at(body - 1)];
        const Wrench push = wrenchOfForceAt(sign * force, p_WC, member.pose.p_AB);
        member.contact = member.contact + push;
      }
      record.impulse_B_W += impulse;
      record.p_WC += size * p_WC;
      weight += size;
    }
    if (weight == 0.0 || memory.resting) continue;
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
        return integrationStep(world_.rules_.integrator, body, system, to - from);
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
    const TimeOfImpact impact =
        timeOfImpact(world_.hullOf(a), motionOfIndex(a), world_.hullOf(b), motionOfIndex(b),
                     {time, within, ImpactMethod::kAdvance});
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
    to = now + time;
    share *= 0.7;
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
