#pragma once

#include "hovercraft_sim/lanes/lane_course.h"
#include "hovercraft_sim/lanes/lane_lie4.h"

/// Steps of a block for one instruction set.

namespace hovercraft::lanes {

/// Whether a method has stages in the middle of a step.
template <Method kMethod>
constexpr bool kIsOfOrder4 = kMethod == Method::kRungeKutta4 || kMethod == Method::kLie4;

/// Whether it has steps in the plane by the numbers that are not 0.
template <Method kMethod>
constexpr bool kHasPlanar = !(kMethod == Method::kSemiImplicitEuler || kMethod == Method::kLie4);

template <class Isa, Method kMethod, bool kHasMore>
[[gnu::noinline]] void advancePack(const StepPlan& plan, const BlockSteps& steps,
                                   std::size_t first) {
  Block& block = *steps.block;
  const std::size_t count = kHasMore ? plan.actuator_count : 3;
  PackSystem<Isa, kHasMore> system = {
      plan, block.constants, {steps.more, first}, first, loadVector<Isa>(steps.wind_W, first)};
  PackState<Isa> state;
  state.read(block.state, first, count);
  MaskOf<Isa> moves = load<Isa>(block.state.moves, first);
  StepLoads<Isa> loads;
  StepAir<Isa> air;
  const bool air_changes = StepAir<Isa>::changes(plan.ground, steps.fan_stride);
  for (std::int64_t made = 0; made < steps.count; ++made) {
    const std::size_t blown = static_cast<std::size_t>(made) * steps.wind_stride;
    if (blown > 0) system.wind_W = loadVector<Isa>(steps.wind_W + blown, first);
    turnActuators(system, block, kIsOfOrder4<kMethod>, state, loads);
    if (kHasMore && plan.ground.has_cushion && (made == 0 || air_changes)) {
      air.turn(plan.ground, system.more.from(plan.ground.first_row),
               steps.fan_speeds + static_cast<std::size_t>(made) * steps.fan_stride, loads);
    }
    PackState<Isa> next;
    if constexpr (kMethod == Method::kLie4) {
      next.motion = lie4Motion(system, state.motion, loads);
    } else {
      next.motion = steppedMotion<kMethod>(system, state.motion, loads);
    }
    const MaskOf<Isa> sound = finish<Isa>(next.motion) & moves;
    for (std::size_t i = 0; i < count; ++i) next.level[i] = loads.end.levels[i];
    if (!Isa::allOf(sound)) {
      keep<Isa>(sound, state, count, next);
      noteLost<Isa>(sound, first, made, block.state);
      moves = sound;
    }
    state = next;
  }
  state.write(block.state, first, count);
}

/// advancePack() of craft that move in the plane (isPlanar()).
template <class Isa, Method kMethod>
[[gnu::noinline]] void advancePlanar(const StepPlan& plan, const BlockSteps& steps,
                                     std::size_t first) {
  using Number = NumberOf<Isa>;
  Block& block = *steps.block;
  BlockState& state = block.state;
  PlanarSystem<Isa> system = {plan, block.constants, first, load<Isa>(steps.wind_W[0], first),
                              load<Isa>(steps.wind_W[1], first)};
  Number level[3];
  for (std::size_t i = 0; i < 3; ++i) level[i] = load<Isa>(state.level[i], first);
  PlanarMotion<Isa> y = planarMotion<Isa>(state, first);
  const Number p_z = load<Isa>(state.p_WB[2], first);
  MaskOf<Isa> moves = load<Isa>(state.moves, first);
  PlanarLoads<Isa> loads;
  for (std::int64_t made = 0; made < steps.count; ++made) {
    const std::size_t blown = static_cast<std::size_t>(made) * steps.wind_stride;
    if (blown > 0) {
      system.wind_x = load<Isa>(steps.wind_W[blown], first);
      system.wind_y = load<Isa>(steps.wind_W[blown + 1], first);
    }
    for (std::size_t i = 0; i < 3; ++i) turnActuator<Isa>(block, i, first, level[i], loads);
    system.loadAll(loads, kIsOfOrder4<kMethod>);
    PlanarMotion<Isa> next = steppedMotion<kMethod>(system, y, loads);
    const MaskOf<Isa> sound = finish<Isa>(next, p_z) & moves;
    Number turned[3] = {loads.end.levels[0], loads.end.levels[1], loads.end.levels[2]};
    if (!Isa::allOf(sound)) {
      next = chosen<Isa>(sound, next, y);
      for (std::size_t i = 0; i < 3; ++i) turned[i] = choose<Isa>(sound, turned[i], level[i]);
      noteLost<Isa>(sound, first, made, state);
      moves = sound;
    }
    y = next;
    for (std::size_t i = 0; i < 3; ++i) level[i] = turned[i];
  }
  for (std::size_t i = 0; i < 3; ++i) store<Isa>(level[i], state.level[i], first);
  storeMotion(y, state, first);
}

template <class Isa, Method kMethod>
inline void advanceBlock(const StepPlan& plan, const BlockSteps& steps) {
  for (std::size_t first = 0; first < kBlockLanes; first += Isa::kWidth) {
    if constexpr (kHasPlanar<kMethod>) {
      if (!plan.hasMoreForces() && plan.actuator_count == 3 && isPlanar<Isa>(*steps.block, first)) {
        advancePlanar<Isa, kMethod>(plan, steps, first);
        continue;
      }
    }
    if (plan.hasMoreForces() || plan.actuator_count > 3) {
      advancePack<Isa, kMethod, true>(plan, steps, first);
    } else {
      advancePack<Isa, kMethod, false>(plan, steps, first);
    }
  }
}

/// An Advance.
template <class Isa>
void advance(const StepPlan& plan, const BlockSteps& steps) {
  switch (plan.method) {
    case Method::kEuler:
      return advanceBlock<Isa, Method::kEuler>(plan, steps);
    case Method::kSemiImplicitEuler:
      return advanceBlock<Isa, Method::kSemiImplicitEuler>(plan, steps);
    case Method::kHeun:
      return advanceBlock<Isa, Method::kHeun>(plan, steps);
    case Method::kRungeKutta4:
      return advanceBlock<Isa, Method::kRungeKutta4>(plan, steps);
    case Method::kLie4:
      return advanceBlock<Isa, Method::kLie4>(plan, steps);
  }
}

}  // namespace hovercraft::lanes
