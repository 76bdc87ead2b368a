#pragma once

#include "hovercraft_sim/lanes/lane_cushion.h"

/// What the ground does to packs of craft: the operations of GroundForces and Pads, in their order.

namespace hovercraft::lanes {

/// The skirt's force at a point of the hem, and its moment.
template <class Isa>
[[gnu::always_inline]] inline Wrench<Isa> skirtWrenchAt(const PackCushion<Isa>& cushion,
                                                        const GroundSpring<Isa>& spring,
                                                        const Vector<Isa>& nhat_B, std::size_t k) {
  const Vector<Isa> p_BK = cushion.numbers.from(cushion.plan.pointRow(k)).template vector<Isa>(0);
  Vector<Isa> velocity = cushion.motion.velocityAt(p_BK);
  if (cushion.plan.is_planar) velocity.z = NumberOf<Isa>{};
  const Vector<Isa> force = spring.force(cushion.elastic[k], nhat_B, velocity);
  return {force, cross(p_BK, force)};
}

/// Sums them up in mirrored pairs. @param sum to which they are added.
template <class Isa>
[[gnu::always_inline]] inline void addSkirt(const PackCushion<Isa>& cushion,
                                            const Vector<Isa>& nhat_B, Wrench<Isa>& sum) {
  const GroundPlan& plan = cushion.plan;
  const GroundSpring<Isa> spring = GroundSpring<Isa>::of(cushion.common.from(6));
  for (std::size_t i = 0; i < plan.point_pair_count; ++i) {
    const PairStep& pair = plan.point_pairs[i];
    Wrench<Isa> both = skirtWrenchAt<Isa>(cushion, spring, nhat_B, pair.first);
    if (pair.second != PairStep::kAlone) {
      both = both + skirtWrenchAt<Isa>(cushion, spring, nhat_B, pair.second);
    }
    sum = sum + both;
  }
}

template <class Isa>
[[gnu::always_inline]] inline Wrench<Isa> chosen(MaskOf<Isa> mask, const Wrench<Isa>& yes,
                                                 const Wrench<Isa>& no) {
  return {chosen<Isa>(mask, yes.force, no.force), chosen<Isa>(mask, yes.torque, no.torque)};
}

/// Of a cushion in space.
template <class Isa>
[[gnu::always_inline]] inline Wrench<Isa> cushionWrench(PackCushion<Isa>& cushion,
                                                        const PlaneProbe<Isa>& probe,
                                                        const StageAir<Isa>& air) {
  NumberOf<Isa> flows[kMostLiftFans];
  cushion.blow(probe, air.fans, flows);
  const Wrench<Isa> blown = pressureWrench<Isa>(cushion.plan, cushion.numbers, cushion.pressures) +
                            cushion.momentumDrag(flows);
  const MaskOf<Isa> carries = cushion.common.template at<Isa>(9) > NumberOf<Isa>{};
  if (Isa::allOf(~carries)) return blown;
  Wrench<Isa> skirt = {};
  addSkirt<Isa>(cushion, probe.nhat_B, skirt);
  return chosen<Isa>(carries, blown + skirt, blown);
}

/// Of a cushion in the planar model.
template <class Isa>
[[gnu::always_inline]] inline Wrench<Isa> planarCushionWrench(PackCushion<Isa>& cushion,
                                                              const StageAir<Isa>& air) {
  using Number = NumberOf<Isa>;
  const GroundPlan& plan = cushion.plan;
  const Wrench<Isa> drag = cushion.momentumDrag(air.flows);
  const MaskOf<Isa> grinds = air.left > Number{};
  if (Isa::allOf(~grinds)) return drag;
  const Number per_metre = air.left / cushion.common.template at<Isa>(5);
  for (std::size_t k = 0; k < plan.point_count; ++k) {
    cushion.elastic[k] = per_metre * cushion.numbers.from(plan.pointRow(k)).template at<Isa>(3);
  }
  Wrench<Isa> sum = drag;
  addSkirt<Isa>(cushion, {Number{}, Number{}, same<Isa>(1.0)}, sum);
  return chosen<Isa>(grinds, sum, drag);
}

/// The fans of a pack at a stage: at the levels of actuators, or as they are described.
template <class Isa>
[[gnu::noinline]] void turnFans(const GroundPlan& plan, const Numbers& numbers, const Row* speeds,
                                const NumberOf<Isa>* levels, StageAir<Isa>& air) {
  for (std::size_t i = 0; i < plan.fan_count; ++i) {
    const std::size_t id = plan.fans[i].actuator;
    const NumberOf<Isa> speed = id == LiftFanStep::kDescribed ? load<Isa>(speeds[i], numbers.first)
                                                              : notNegative<Isa>(levels[id]);
    air.fans[i] = atSpeed<Isa>(numbers.rows + GroundPlan::fanRow(i), numbers.first, speed);
  }
  if (plan.is_planar) blowInPlane<Isa>(plan, numbers, air);
}

/// The vertices of hulls as springs.
template <class Isa>
struct PackPads {
  using Number = NumberOf<Isa>;

  const GroundPlan& plan;
  Numbers plane;
  Numbers pads;
  const BodyMotion<Isa>& motion;
  const PlaneProbe<Isa>& probe;

  /// Whether none of them presses on the ground: by the boxes around them.
  [[gnu::always_inline]] bool areClear() const {
    constexpr double kClearShare = 1e-12;  // as in pads.cpp; what it decides changes no bit
    const Vector<Isa> middle = pads.vector<Isa>(0);
    const Vector<Isa> half_extent = pads.vector<Isa>(3);
    const Number reach = dot(absoluteOf(probe.nhat_B), half_extent);
    const Number least = (probe.gap + dot(probe.nhat_B, middle)) - reach;
    const Vector<Isa> size = absoluteOf(motion.p_WB) + absoluteOf(middle) + half_extent;
    const Number all = size.x + size.y + size.z + absolute<Isa>(plane.at<Isa>(3));
    return Isa::allOf(least > same<Isa>(kClearShare) * all);
  }
  [[gnu::always_inline]] static Vector<Isa> absoluteOf(const Vector<Isa>& v) {
    return {absolute<Isa>(v.x), absolute<Isa>(v.y), absolute<Isa>(v.z)};
  }

  [[gnu::always_inline]] Wrench<Isa> wrenchAt(std::size_t vertex) const {
    const Vector<Isa> p_B = pads.vector<Isa>(kPadRows + kVertexRows * vertex);
    const Vector<Isa> p_W = times(motion.R_WB, p_B) + motion.p_WB;
    const Number gap = dot(plane.vector<Isa>(0), p_W) - plane.at<Isa>(3);
    const GroundSpring<Isa> spring = GroundSpring<Isa>::of(pads.from(7));
    const Vector<Isa> force =
        spring.force(-pads.at<Isa>(6) * gap, probe.nhat_B, motion.velocityAt(p_B));
    const Wrench<Isa> none = {};
    return chosen<Isa>(gap < Number{}, {force, cross(p_B, force)}, none);
  }

  [[gnu::always_inline]] Wrench<Isa> wrench() const {
    Wrench<Isa> sum = {};
    if (areClear()) return sum;
    for (std::size_t i = 0; i < plan.paired_count; i += 2) {
      sum = sum + (wrenchAt(i) + wrenchAt(i + 1));
    }
    for (std::size_t i = plan.paired_count; i < plan.vertex_count; ++i) sum = sum + wrenchAt(i);
    return sum;
  }
};

/// Adds the wrench of a pack's ground in B. Not inlined: once for all stages and methods.
/// @param numbers of the plan. @param air of the cushion.
template <class Isa>
[[gnu::noinline]] void addGroundWrench(const GroundPlan& plan, const Numbers& numbers,
                                       const BodyMotion<Isa>& motion, const StageAir<Isa>* air,
                                       Wrench<Isa>& wrench_B) {
  if (plan.is_planar) {
    PackCushion<Isa> cushion(plan, numbers, motion);
    wrench_B = wrench_B + planarCushionWrench<Isa>(cushion, *air);
    return;
  }
  const PlaneProbe<Isa> probe = planeProbe<Isa>(numbers, motion);
  Wrench<Isa> sum = {};
  if (plan.has_cushion) {
    PackCushion<Isa> cushion(plan, numbers, motion);
    sum = cushionWrench<Isa>(cushion, probe, *air);
  }
  if (plan.has_pads) {
    const PackPads<Isa> pads = {plan, numbers, numbers.from(plan.padRow()), motion, probe};
    const Wrench<Isa> standing = pads.wrench();
    sum = plan.has_cushion ? sum + standing : standing;
  }
  wrench_B = wrench_B + sum;
}

}  // namespace hovercraft::lanes
