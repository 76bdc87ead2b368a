/// fly FOLDER: what a program of a user computes, whatever it was compiled with
/// (scripts/check_user_flags): flies the runs of FOLDER/hashes.txt to tick 10000 and steps a craft
/// by itself with integrationStep().
/// @returns 0 if all hashes are as recorded, and the craft moves as in a Simulation.

#include <exception>
#include <iostream>
#include <limits>

#include "hovercraft_sim/body/steppers.h"
#include "hovercraft_sim/hovercraft/step_inputs.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/state_hash.h"

#include "../determinism/recorded_runs.h"

namespace {

using namespace hovercraft;

constexpr Tick kTicks = 10000;

/// Keeps an instance of a template in this program, as one does that does not inline it: a symbol
/// of the name that the library has for its own.
template <class Function>
void keep(Function* function) {
  static Function* volatile kept;
  kept = function;
}

template <class Orientation>
void keepInstances() {
  using State = RigidBodyState<Orientation>;
  using Rate = StateDerivative<Orientation>;
  keep(&integrationStep<Orientation, DrivenBody>);
  keep(&eulerStep<Orientation, DrivenBody>);
  keep(&semiImplicitEulerStep<Orientation, DrivenBody>);
  keep(&heunStep<Orientation, DrivenBody>);
  keep(&rungeKutta4Step<Orientation, DrivenBody>);
  keep(&moved<Orientation>);
  keep(static_cast<Rate (*)(const Rate&, const Rate&)>(&operator+<Orientation>));
  keep(static_cast<double (*)(const State&, const Mobility&)>(&kineticEnergy<Orientation>));
  keep(static_cast<Matrix3 (*)(const Matrix3&, const Matrix3&)>(&product));
  keep(static_cast<Vector3 (*)(const Matrix3&, const Vector3&)>(&times));
  keep(static_cast<Quaternion (*)(const Vector3&, const Quaternion&)>(&quaternionRateWorld));
}

bool fliesAsRecorded(const std::string& folder) {
  bool all_equal = true;
  for (const auto& run : testing::readRecordedRuns(folder)) {
    const std::string difference = testing::firstDifference(run, testing::fly(folder, run, kTicks));
    if (difference.empty()) continue;
    all_equal = false;
    std::cout << "DIFFERENT " << difference << '\n';
  }
  return all_equal;
}

/// The first craft of a scenario under thrusts that hold, by integrationStep() and by Simulation.
template <class Orientation>
bool movesAsInSimulation(Scenario scenario) {
  VehicleScenario& craft = scenario.vehicles.front();
  for (EngineParameters& engine : craft.engines) {
    engine.time_constant = 0.0;
    engine.timeout_ns = 0;
  }
  scenario.vehicles.resize(1);
  Simulation simulation(scenario);
  const Vector3 thrusts(1.3, 0.4, 0.7);
  simulation.push({0, 0, kAllEngines, thrusts});
  const HovercraftModel model = modelOf(scenario, craft);
  auto body = std::get<RigidBodyState<Orientation>>(initialState(scenario, craft, model.mobility));
  const ThrustCourse course = {thrusts, thrusts, thrusts};
  const Environment environment = {scenario.wind};
  const DrivenBody system = {model, course, environment};
  for (Tick tick = 0; tick < kTicks; ++tick) {
    body = integrationStep(scenario.integrator, body, system, scenario.stepSize());
    simulation.step();
  }
  StateHash by_itself;
  by_itself.add(BodyState(body));
  StateHash simulated;
  simulated.add(simulation.state().bodies.front());
  if (by_itself.value() == simulated.value()) return true;
  std::cout << "DIFFERENT " << craft.name << ": integrationStep() and Simulation part\n";
  return false;
}

bool stepsAsSimulation(const std::string& folder) {
  Scenario scenario = loadScenario(folder + "/scenarios/spatial.yaml");
  bool all_equal = true;
  for (const Integrator integrator : {Integrator::kEuler, Integrator::kSemiImplicitEuler,
                                      Integrator::kHeun, Integrator::kRungeKutta4}) {
    scenario.integrator = integrator;
    scenario.orientation = OrientationKind::kQuaternion;
    all_equal = movesAsInSimulation<Quaternion>(scenario) && all_equal;
    scenario.orientation = OrientationKind::kMatrix;
    all_equal = movesAsInSimulation<Matrix3>(scenario) && all_equal;
  }
  return all_equal;
}

/// An error of the library is caught by its type.
bool catchesErrors() {
  try {
    parseScenario(treeOf("{step_size: -1}", "text"), {"text", "", {}});
  } catch (const std::invalid_argument&) {
    return true;
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2) return 2;
    keepInstances<Quaternion>();
    keepInstances<Matrix3>();
    volatile double least = std::numeric_limits<double>::min();
    std::cout << (least / 2.0 > 0.0 ? "" : "flush-to-zero is set; ");
    const bool as_recorded = fliesAsRecorded(argv[1]);
    const bool as_simulated = stepsAsSimulation(argv[1]);
    const bool catches = catchesErrors();
    std::cout << (as_recorded && as_simulated && catches ? "identical\n" : "DIFFERENT\n");
    return as_recorded && as_simulated && catches ? 0 : 1;
  } catch (const std::exception& error) {
    std::cout << "fly: " << error.what() << '\n';
  }
  return 2;
}
