#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/batch.h"
#include "hovercraft_sim/sim/simulation.h"

#include "../support/random_craft.h"

namespace hovercraft {
namespace {

using testing::RandomCraft;

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

  std::size_t lostCount() const {
    return static_cast<std::size_t>(std::count(lost_.begin(), lost_.end(), true));
  }

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
           batch_.tickOf(run) == one.tick();
  }

  Batch batch_;
  std::vector<Simulation> simulations_;
  std::vector<bool> lost_;
};

/// Random craft whose commands come at ticks of their own; each tick is compared.
void expectSameBits(RandomCraft craft, InstructionSet set, Tick ticks) {
  std::vector<Scenario> scenarios;
  constexpr std::size_t kRuns = 21;  // not a whole number of blocks
  for (std::size_t run = 0; run < kRuns; ++run) scenarios.push_back(craft.scenario());
  Beside both(scenarios, set);
  for (Tick tick = 0; tick < ticks; ++tick) {
    for (std::size_t run = 0; run < kRuns; ++run) {
      if (auto command = craft.command(tick)) both.push(run, *command);
    }
    ASSERT_EQ(both.differingAfter(1), 0U)
        << craft.name() << ", " << instructionSetName(set) << ", tick " << tick;
  }
}

const std::vector<Integrator>& integrators() {
  static const std::vector<Integrator> all = {Integrator::kEuler, Integrator::kSemiImplicitEuler,
                                              Integrator::kHeun, Integrator::kRungeKutta4};
  return all;
}

// ---- the bits of Simulation ---------------------------------------------------------------------

TEST(Batch, EveryRunHasTheBitsOfItsSimulationAtEveryTick) {
  for (const InstructionSet set : availableInstructionSets()) {
    for (const BodyModel model : {BodyModel::kPlanar, BodyModel::kSpatial}) {
      for (const Integrator integrator : integrators()) {
        expectSameBits(RandomCraft(integrator, model, 1), set, 400);
      }
    }
  }
}

}  // namespace
}  // namespace hovercraft
