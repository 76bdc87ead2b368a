/// Time of one step of a craft on its cushion, at 1 kHz, against the same craft without: rc5 as one
/// cell (with and without the stiffness of its skirt) and as four cells, with 8 and 16 points of
/// hem, over a plane and over a floor of the world, at 0.2, 2 and 10 m/s. Without a cushion it
/// flies at the same speeds and height where nothing pulls it down.

#include <benchmark/benchmark.h>
#include <string>
#include <vector>

#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft::bench {
namespace {

struct Case {
  std::string integrator;
  std::string cushion;  // none, one_cell, one_cell_bare, four_cells_8, four_cells_16, ..._bare
  std::string ground;   // plane, floor
  double speed;         // m/s
};

/// Sets of a scenario, by their keys.
std::vector<std::string> setsOf(const Case& which) {
  const std::string vehicle = "vehicles.rc5.";
  std::vector<std::string> sets = {
      "integrator=" + which.integrator, vehicle + "drag.linear=[0, 0, 0]",
      vehicle + "initial.velocity=[" + std::to_string(which.speed) + ", 0, 0]"};
  if (which.ground == "floor") {
    sets.emplace_back(
        "world={obstacles: {floor: {box: {size: [1e5, 100, 1]}, position: [0, 0, "
        "-0.5]}}}");
  }
  if (which.cushion.rfind("one_cell", 0) == 0) {
    sets.push_back(vehicle + "cushion.rectangle.columns=1");
    sets.push_back(vehicle + "cushion.rectangle.rows=1");
    sets.push_back(vehicle + "cushion.fans.lift.curve=108581.25");  // a sixteenth
  }
  if (which.cushion.rfind("four_cells_16", 0) == 0) {
    sets.push_back(vehicle + "cushion.rectangle.points_per_side=2");
  }
  return sets;
}

Scenario scenarioOf(const Case& which) {
  Scenario scenario = loadScenario("config/rc5.yaml", {}, {"--set", setsOf(which)});
  if (which.ground == "floor") scenario.ground.reset();
  // Refused in a scenario for one cell: it cannot be held level. In the bench nothing tilts it.
  if (which.cushion.find("bare") != std::string::npos) {
    scenario.vehicles[0].cushion->skirt.stiffness = 0.0;
  }
  if (which.cushion == "none") {
    scenario.vehicles[0].cushion.reset();
    scenario.ground.reset();
    scenario.gravity = Vector3::Zero();
  }
  return scenario;
}

void step(benchmark::State& state, const Case& which) {
  Simulation simulation(scenarioOf(which));
  for (int i = 0; i < 2000; ++i) simulation.step();  // it settles
  while (state.KeepRunning()) simulation.step();
  auto last = simulation.motion(0);
  benchmark::DoNotOptimize(last);
}

void registerAll() {
  for (const std::string integrator : {"heun", "rk4"}) {
    for (const std::string ground : {"plane", "floor"}) {
      for (const double speed : {0.2, 2.0, 10.0}) {
        for (const std::string cushion : {"none", "one_cell", "one_cell_bare", "four_cells_8",
                                          "four_cells_16", "four_cells_16_bare"}) {
          std::string name = integrator;
          name.append("/").append(ground).append("/").append(cushion).append("/").append(
              std::to_string(speed).substr(0, 4));
          const Case which = {integrator, cushion, ground, speed};
          benchmark::RegisterBenchmark(name.c_str(),
                                       [which](benchmark::State& state) { step(state, which); });
        }
      }
    }
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
