/// Time of one step of one craft, at 1 kHz.
///
/// simulation: all that Simulation::step() does, with a command to all three engines every 100
/// steps. stepper: the integration step alone, with the wrench but without engine lag, limits and
/// time-outs.

#include <benchmark/benchmark.h>
#include <string>

#include "driven_craft.h"

namespace hovercraft::bench {
namespace {

constexpr Tick kCommandPeriod = 100;  // steps, 10 Hz

struct Case {
  Integrator integrator;
  OrientationKind orientation;
  BodyModel model;
};

void stepSimulation(benchmark::State& state, Case which) {
  Simulation simulation(drivenCraft(which.integrator, which.orientation, which.model));
  while (state.KeepRunning()) {
    const Tick tick = simulation.tick();
    if (tick % kCommandPeriod == 0) {
      simulation.push({tick, 0, kAllEngines, demandedThrusts()});
    }
    simulation.step();
  }
  auto last = simulation.motion(0);
  benchmark::DoNotOptimize(last);
}

template <class Orientation>
void stepAlone(benchmark::State& state, Case which) {
  const Scenario scenario = drivenCraft(which.integrator, which.orientation, which.model);
  const Simulation simulation(scenario);
  const VehicleScenario& craft = scenario.vehicles.front();
  const MassProperties& mass = craft.mass_properties;
  const Mobility mobility = which.model == BodyModel::kSpatial
                                ? Mobility::spatial(mass.mass, mass.I_BBo_B)
                                : Mobility::planar(mass.mass, mass.I_BBo_B);
  const HovercraftModel model = {mobility, EngineGeometry(craft.engines, mass.p_HB), craft.drag,
                                 Vector3::Zero()};
  const Vector3 thrusts = demandedThrusts();
  const ThrustCourse course = {thrusts, thrusts, thrusts};
  const Environment environment = {scenario.wind};
  const DrivenBody system = {model, course, environment};
  auto body = std::get<RigidBodyState<Orientation>>(simulation.state().bodies[0]);
  const double h = scenario.stepSize();
  while (state.KeepRunning()) {
    body = integrationStep(which.integrator, body, system, h);
    benchmark::ClobberMemory();
  }
  benchmark::DoNotOptimize(body);
}

void registerCase(const std::string& name, Case which) {
  benchmark::RegisterBenchmark(("simulation/" + name).c_str(), stepSimulation, which);
  if (which.orientation == OrientationKind::kQuaternion) {
    benchmark::RegisterBenchmark(("stepper/" + name).c_str(), stepAlone<Quaternion>, which);
  } else {
    benchmark::RegisterBenchmark(("stepper/" + name).c_str(), stepAlone<Matrix3>, which);
  }
}

void registerAll() {
  struct Named {
    const char* name;
    Integrator integrator;
  };
  for (const Named& method :
       {Named{"euler", Integrator::kEuler},
        Named{"semi_implicit_euler", Integrator::kSemiImplicitEuler},
        Named{"heun", Integrator::kHeun}, Named{"rk4", Integrator::kRungeKutta4},
        Named{"lie4", Integrator::kLie4}}) {
    const std::string name = method.name;
    registerCase("spatial/quaternion/" + name,
                 {method.integrator, OrientationKind::kQuaternion, BodyModel::kSpatial});
    registerCase("spatial/matrix/" + name,
                 {method.integrator, OrientationKind::kMatrix, BodyModel::kSpatial});
    registerCase("planar/quaternion/" + name,
                 {method.integrator, OrientationKind::kQuaternion, BodyModel::kPlanar});
  }
}

}  // namespace
}  // namespace hovercraft::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  hovercraft::bench::registerAll();
  benchmark::RunSpecifiedBenchmarks();  // no Shutdown() after it: Debian 11 has none
  return 0;
}
