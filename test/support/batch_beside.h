#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "hovercraft_sim/sim/batch.h"
#include "hovercraft_sim/sim/simulation.h"

#include "same_bits.h"

namespace hovercraft::testing {

/// A batch of one instruction set beside a Simulation of each of its runs.
class Beside {
 public:
  Beside(const std::vector<Scenario>& scenarios, InstructionSet set, int threads = 1)
      : batch_(scenarios, {threads, set}) {
    for (const Scenario& scenario : scenarios) simulations_.emplace_back(scenario);
    lost_.resize(scenarios.size());
  }

  Batch& batch() { return batch_; }

  void push(std::size_t run, Command command) {
    batch_.push(run, command);
    if (!lost_[run]) simulations_[run].push(command);
  }

  /// Makes ticks on both sides. @returns how many runs are not the same to the last bit then.
  std::size_t differingAfter(Tick ticks) {
    batch_.run(ticks);
    std::size_t differing = 0;
    for (std::size_t run = 0; run < simulations_.size(); ++run) {
      step(run, ticks);
      if (!isSame(run)) ++differing;
    }
    return differing;
  }

  std::ptrdiff_t lostCount() const { return std::count(lost_.begin(), lost_.end(), true); }

 private:
  void step(std::size_t run, Tick ticks) {
    for (Tick i = 0; i < ticks && !lost_[run]; ++i) {
      try {
        simulations_[run].step();
      } catch (const std::runtime_error&) {
        lost_[run] = true;
      }
    }
  }

  bool isSame(std::size_t run) const {
    const Simulation& one = simulations_[run];
    return batch_.divergedAt(run).has_value() == lost_[run] && batch_.hash(run) == one.hash() &&
           batch_.tickOf(run) == one.tick() && bitsOf(batch_.motion(run)) == bitsOf(one.motion(0));
  }

  Batch batch_;
  std::vector<Simulation> simulations_;
  std::vector<bool> lost_;
};

inline const std::vector<Integrator>& integrators() {
  static const std::vector<Integrator> all = {Integrator::kEuler, Integrator::kSemiImplicitEuler,
                                              Integrator::kHeun, Integrator::kRungeKutta4,
                                              Integrator::kLie4};
  return all;
}

/// Each instruction set of this machine, model and integrator.
template <class Check>
void withEveryKind(Check check) {
  for (const InstructionSet set : availableInstructionSets()) {
    for (const BodyModel model : {BodyModel::kPlanar, BodyModel::kSpatial}) {
      for (const Integrator integrator : integrators()) check(integrator, model, set);
    }
  }
}

}  // namespace hovercraft::testing
