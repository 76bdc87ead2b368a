#pragma once

#include "hovercraft_sim/lanes/lane_planar.h"
#include "hovercraft_sim/lanes/lane_step.h"
#include "hovercraft_sim/math/tolerances.h"

/// What comes before and after the step of a pack: the course of the actuators
/// (EngineDynamics::course()), the unit quaternion, flushDenormals() of simulation.cpp, craft that
/// are lost.

namespace hovercraft::lanes {

/// Some columns of what a block's craft are, in registers or on the stack while steps are made.
template <class Isa>
struct PackState {
  Motion<Isa> motion;
  NumberOf<Isa> level[kMostActuators];

  [[gnu::always_inline]] void read(const BlockState& state, std::size_t first, std::size_t count) {
    motion = {loadVector<Isa>(state.p_WB, first),
              {load<Isa>(state.q_s, first), loadVector<Isa>(state.q_v, first)},
              loadVector<Isa>(state.momentum_W, first),
              loadVector<Isa>(state.angular_momentum_W, first)};
    for (std::size_t i = 0; i < count; ++i) level[i] = load<Isa>(state.level[i], first);
  }
  [[gnu::always_inline]] void write(BlockState& state, std::size_t first, std::size_t count) const {
    storeVector<Isa>(motion.p, state.p_WB, first);
    store<Isa>(motion.q.s, state.q_s, first);
    storeVector<Isa>(motion.q.v, state.q_v, first);
    storeVector<Isa>(motion.P, state.momentum_W, first);
    storeVector<Isa>(motion.L, state.angular_momentum_W, first);
    for (std::size_t i = 0; i < count; ++i) store<Isa>(level[i], state.level[i], first);
  }
};

template <class Isa>
[[gnu::always_inline]] inline PlanarMotion<Isa> chosen(MaskOf<Isa> mask,
                                                       const PlanarMotion<Isa>& yes,
                                                       const PlanarMotion<Isa>& no) {
  return {choose<Isa>(mask, yes.x, no.x),
          choose<Isa>(mask, yes.y, no.y),
          choose<Isa>(mask, yes.s, no.s),
          choose<Isa>(mask, yes.z, no.z),
          choose<Isa>(mask, yes.momentum_x, no.momentum_x),
          choose<Isa>(mask, yes.momentum_y, no.momentum_y),
          choose<Isa>(mask, yes.angular_momentum, no.angular_momentum)};
}

/// Where the mask is none what was there before.
template <class Isa>
[[gnu::always_inline]] inline void keep(MaskOf<Isa> mask, const PackState<Isa>& before,
                                        std::size_t count, PackState<Isa>& after) {
  Motion<Isa>& next = after.motion;
  const Motion<Isa>& last = before.motion;
  next = {chosen<Isa>(mask, next.p, last.p),
          {choose<Isa>(mask, next.q.s, last.q.s), chosen<Isa>(mask, next.q.v, last.q.v)},
          chosen<Isa>(mask, next.P, last.P),
          chosen<Isa>(mask, next.L, last.L)};
  for (std::size_t i = 0; i < count; ++i) {
    after.level[i] = choose<Isa>(mask, after.level[i], before.level[i]);
  }
}

/// An actuator's levels over a step. @param Loads StepLoads or PlanarLoads.
template <class Isa, class Loads>
[[gnu::always_inline]] inline void turnActuator(const Block& block, std::size_t i,
                                                std::size_t first, NumberOf<Isa> level,
                                                Loads& loads) {
  const BlockConstants& constants = block.constants;
  const NumberOf<Isa> demanded = load<Isa>(block.demand[i], first);
  NumberOf<Isa> lead = where<Isa>(load<Isa>(constants.lags[i], first), level - demanded);
  lead = where<Isa>(~(absolute<Isa>(lead) < same<Isa>(kSettledThrust)), lead);
  loads.start.levels[i] = demanded + lead;
  loads.middle.levels[i] = demanded + lead * load<Isa>(constants.half_decay[i], first);
  loads.end.levels[i] = demanded + lead * load<Isa>(constants.full_decay[i], first);
}

/// Levels over a step, and what the engines make of them.
template <class Isa, bool kHasMore>
[[gnu::always_inline]] inline void turnActuators(const PackSystem<Isa, kHasMore>& system,
                                                 const Block& block, bool has_middle,
                                                 const PackState<Isa>& state,
                                                 StepLoads<Isa>& loads) {
  const std::size_t count = kHasMore ? system.plan.actuator_count : 3;
  for (std::size_t i = 0; i < count; ++i) {
    turnActuator<Isa>(block, i, system.first, state.level[i], loads);
  }
  loads.start.engines_B = system.enginesWrench(loads.start.levels);
  if (has_middle) loads.middle.engines_B = system.enginesWrench(loads.middle.levels);
  loads.end.engines_B = system.enginesWrench(loads.end.levels);
}

/// The air of a cushion over a step.
template <class Isa>
struct StepAir {
  StageAir<Isa> start;
  StageAir<Isa> middle;
  StageAir<Isa> end;

  /// Whether fans turn otherwise in the next step.
  [[gnu::always_inline]] static bool changes(const GroundPlan& plan, std::size_t fan_stride) {
    bool any = fan_stride > 0;
    for (std::size_t i = 0; i < plan.fan_count; ++i) {
      any = any || plan.fans[i].actuator != LiftFanStep::kDescribed;
    }
    return any;
  }

  /// @param numbers of the plan. @param speeds as they are described, of the step.
  [[gnu::always_inline]] void turn(const GroundPlan& plan, const Numbers& numbers,
                                   const Row* speeds, StepLoads<Isa>& loads) {
    turnFans<Isa>(plan, numbers, speeds, loads.start.levels, start);
    turnFans<Isa>(plan, numbers, speeds + plan.fan_count, loads.middle.levels, middle);
    turnFans<Isa>(plan, numbers, speeds + 2 * plan.fan_count, loads.end.levels, end);
    loads.start.air = &start;
    loads.middle.air = &middle;
    loads.end.air = &end;
  }
};

template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> settled(NumberOf<Isa> momentum) {
  return where<Isa>(~(absolute<Isa>(momentum) < same<Isa>(kSettledMomentum)), momentum);
}
template <class Isa>
[[gnu::always_inline]] inline Vector<Isa> settled(const Vector<Isa>& momentum) {
  return {settled<Isa>(momentum.x), settled<Isa>(momentum.y), settled<Isa>(momentum.z)};
}

/// Renormalised and settled. @returns where the motion is sound.
template <class Isa>
[[gnu::always_inline]] inline MaskOf<Isa> finish(Motion<Isa>& motion) {
  using Number = NumberOf<Isa>;
  const Number factor = same<Isa>(1.0) / Isa::sqrt(squaredNorm(motion.q));
  motion.q = {factor * motion.q.s, scaled<Isa>(factor, motion.q.v)};
  motion.P = settled<Isa>(motion.P);
  motion.L = settled<Isa>(motion.L);
  const Vector<Isa> sum = (motion.p + motion.P) + motion.L;
  const Number finite = absolute<Isa>((sum.x + sum.y) + sum.z);
  const Number length = absolute<Isa>(squaredNorm(motion.q) - same<Isa>(1.0));
  return (finite < same<Isa>(__builtin_inf())) & (length < same<Isa>(kUnitLength));
}

/// The same in the plane. @param p_z m.
template <class Isa>
[[gnu::always_inline]] inline MaskOf<Isa> finish(PlanarMotion<Isa>& motion, NumberOf<Isa> p_z) {
  using Number = NumberOf<Isa>;
  const Number norm = Isa::sqrt(motion.s * motion.s + motion.z * motion.z);
  const Number factor = same<Isa>(1.0) / norm;
  motion.s = factor * motion.s;
  motion.z = factor * motion.z;
  motion.momentum_x = settled<Isa>(motion.momentum_x);
  motion.momentum_y = settled<Isa>(motion.momentum_y);
  motion.angular_momentum = settled<Isa>(motion.angular_momentum);
  const Number sum = (motion.x + motion.momentum_x) + (motion.y + motion.momentum_y);
  const Number finite = absolute<Isa>(sum + (p_z + motion.angular_momentum));
  const Number length = absolute<Isa>((motion.s * motion.s + motion.z * motion.z) - same<Isa>(1.0));
  return (finite < same<Isa>(__builtin_inf())) & (length < same<Isa>(kUnitLength));
}

/// Notes which craft were lost in the step after `made` ones.
template <class Isa>
[[gnu::noinline]] void noteLost(const MaskOf<Isa>& moves, std::size_t first, std::int64_t made,
                                BlockState& state) {
  for (std::size_t i = 0; i < Isa::kWidth; ++i) {
    if (moves[i] == 0 && state.moves.of[first + i] != 0) state.lost_after[first + i] = made;
  }
  store<Isa>(moves, state.moves, first);
}

}  // namespace hovercraft::lanes
