#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <variant>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/state_hash.h"

#include "../support/scenario_text.h"

/// Simulation leaves out what gives nothing: zeros of a planar craft, and thrusts that stay as they
/// are from step to step. Here the same flights with all of it.

namespace hovercraft {
namespace {

using testing::parsed;
using testing::validScenario;

using State = RigidBodyState<Quaternion>;

/// A flight of the first craft of a scenario, each step with all of its arithmetic.
class FullFlight {
 public:
  explicit FullFlight(const Scenario& scenario)
      : scenario_(scenario),
        world_(worldOf(scenario)),
        dynamics_(parametersOf(scenario.vehicles[0]), scenario.step_ns) {
    const Simulation start(scenario);
    actuators_ = start.state().engines[0];
    y_ = std::get<State>(start.state().bodies[0]);
  }

  void command(Tick tick, const Vector3& thrusts) {
    for (std::size_t i = 0; i < kFirstActuator; ++i) {
      actuators_[i].commanded = thrusts[static_cast<Eigen::Index>(i)];
      actuators_[i].command_tick = tick;
    }
  }
  void fail(std::size_t id, double efficiency, bool stuck) {
    actuators_[id].efficiency = efficiency;
    actuators_[id].stuck = stuck;
  }
  void step(Tick tick) {
    const ThrustCourse thrusts = dynamics_.course(actuators_, tick);
    const Environment air = {scenario_.wind};
    const DrivenBody system = {world_.scene().bodies()[0].model, thrusts, air};
    y_ = integrationStep<Quaternion, DrivenBody>(scenario_.integrator, y_, system,
                                                 scenario_.stepSize());
    for (Vector3* momentum : {&y_.momentum_W, &y_.angular_momentum_W}) {
      for (double& component : *momentum) {
        if (std::abs(component) < kSettledMomentum) component = 0.0;
      }
    }
    for (std::size_t i = 0; i < actuators_.size(); ++i) actuators_[i].thrust = thrusts.end[i];
  }
  std::uint64_t hash() const {
    StateHash hash;
    hash.add(BodyState(y_));
    hash.add(actuators_);
    return hash.value();
  }

 private:
  Scenario scenario_;
  World world_;
  EngineDynamics dynamics_;
  EngineStates actuators_;
  State y_;
};

std::uint64_t hashOf(const SimulationState& state) {
  StateHash hash;
  hash.add(state.bodies[0]);
  hash.add(state.engines[0]);
  return hash.value();
}

/// A minute of commands that come, stay away until the engines time out, and come again; faults
/// come and go.
void expectSameFlight(const Scenario& scenario) {
  Simulation simulation(scenario);
  FullFlight full(scenario);
  for (Tick tick = 0; tick < 30000; ++tick) {
    const bool is_heard = tick % 7000 < 4000;
    if (is_heard && tick % 90 == 5) {
      const double share = static_cast<double>(tick / 1800 % 4) / 3.0;
      const Vector3 thrusts = {4.5 * share, 1.5 * share, tick % 3600 < 1800 ? 0.7 : 0.0};
      simulation.push({tick, 0, kAllEngines, thrusts});
      full.command(tick, thrusts);
    }
    if (tick % 9001 == 4500) {
      const bool stuck = tick > 10000;
      simulation.setActuator(0, 1, 0.5, stuck);
      full.fail(1, 0.5, stuck);
    }
    if (tick % 9001 == 6100) {
      simulation.setActuator(0, 1, 1.0, false);
      full.fail(1, 1.0, false);
    }
    simulation.step();
    full.step(tick);
    ASSERT_EQ(hashOf(simulation.state()), full.hash()) << "tick " << tick;
  }
}

class FastSteps : public ::testing::TestWithParam<std::tuple<BodyModel, Integrator, double>> {};

TEST_P(FastSteps, HaveTheBitsOfStepsWithAllOfTheirArithmetic) {
  Scenario scenario = parsed(validScenario());
  scenario.orientation = OrientationKind::kQuaternion;
  scenario.model = std::get<0>(GetParam());
  scenario.integrator = std::get<1>(GetParam());
  VehicleScenario& craft = scenario.vehicles[0];
  for (EngineParameters& engine : craft.engines) engine.time_constant = std::get<2>(GetParam());
  if (scenario.model == BodyModel::kPlanar) craft.initial_rpy = {0.0, 0.0, 0.3};
  expectSameFlight(scenario);
}

INSTANTIATE_TEST_SUITE_P(
    All, FastSteps,
    ::testing::Combine(::testing::Values(BodyModel::kPlanar, BodyModel::kSpatial),
                       ::testing::Values(Integrator::kHeun, Integrator::kRungeKutta4),
                       ::testing::Values(0.0, 0.1)));

// A state from elsewhere has other thrusts than those of the last step.
TEST(KeptThrusts, ARestoredStateFliesOnWithItsOwnThrusts) {
  const Scenario scenario = parsed(validScenario());
  Simulation flown(scenario);
  flown.push({0, 0, kAllEngines, {3.0, 0.0, 1.0}});
  for (int i = 0; i < 100; ++i) flown.step();
  const SimulationState then = flown.state();
  for (int i = 0; i < 50; ++i) flown.step();
  Simulation other(scenario);
  other.push({0, 0, kAllEngines, {0.5, 1.0, 0.0}});
  for (int i = 0; i < 200; ++i) other.step();
  other.restore(then);
  for (int i = 0; i < 50; ++i) other.step();
  EXPECT_EQ(other.hash(), flown.hash());
  other.reset(scenario.seed);
  Simulation fresh(scenario);
  for (int i = 0; i < 50; ++i) {
    other.step();
    fresh.step();
  }
  EXPECT_EQ(other.hash(), fresh.hash());
}

}  // namespace
}  // namespace hovercraft
