/// Time of a step of one craft among many (Batch), against Simulation::step() in the same run: the
/// driven craft of bench_step, and rc5 on its cushion, with masses and drag of their own, at 1 kHz,
/// commands to all three engines every 100 steps. The least of some repetitions in which all take
/// turns, in processor time of one thread. From the top of the checkout:
///
///   bench_batch [CRAFT...]      numbers of craft, 1000 and 100000; of rc5 at most 1000

#include "hovercraft_sim/sim/batch.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include "hovercraft_sim/scenario/scenario_parser.h"

#include "driven_craft.h"

namespace hovercraft::bench {
namespace {

constexpr Tick kCommandPeriod = 100;  // steps, 10 Hz
constexpr double kCraftSteps = 2e6;   // of a repetition
constexpr std::size_t kMostOnCushions = 1000;
constexpr int kRepetitions = 5;

double processorTime() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// rc5 over its plane, as one cell with four points of hem or as four cells with two each.
Scenario craftOnCushion(Integrator integrator, BodyModel model, int cells) {
  std::vector<std::string> sets;
  if (cells == 1) {
    const std::string cushion = "vehicles.rc5.cushion.";
    sets = {cushion + "rectangle.columns=1", cushion + "rectangle.rows=1",
            cushion + "fans.lift.curve=108581.25"};  // a sixteenth
  }
  Scenario scenario = loadScenario("config/rc5.yaml", {}, {"--set", sets});
  scenario.integrator = integrator;
  scenario.model = model;
  return scenario;
}

Scenario varied(const Scenario& scenario, std::size_t run, std::size_t count) {
  Scenario changed = scenario;
  const double share = static_cast<double>(run) / static_cast<double>(count);
  VehicleScenario& craft = changed.vehicles.front();
  craft.mass_properties.mass *= 0.8 + 0.4 * share;
  craft.drag.linear *= 1.2 - 0.4 * share;
  craft.engines[0].time_constant *= 0.5 + share;
  return changed;
}

Batch batchOf(const Scenario& scenario, std::size_t count, InstructionSet set) {
  Batch batch(scenario, 0, {1, set});
  for (std::size_t run = 0; run < count; ++run) batch.add(varied(scenario, run, count));
  return batch;
}

/// ns of a step of one craft.
double timeOf(Batch& batch) {
  const auto craft = static_cast<double>(batch.size());
  const int periods =
      std::max(1, static_cast<int>(kCraftSteps / craft / static_cast<double>(kCommandPeriod)));
  const double begin = processorTime();
  for (int period = 0; period < periods; ++period) {
    for (std::size_t run = 0; run < batch.size(); ++run) {
      batch.push(run, {batch.tick(), 0, kAllEngines, demandedThrusts()});
    }
    batch.run(kCommandPeriod);
  }
  return 1e9 * (processorTime() - begin) / (periods * craft * kCommandPeriod);
}

double timeOf(Simulation& simulation) {
  const auto steps = static_cast<Tick>(kCraftSteps / 2);
  const double begin = processorTime();
  for (Tick i = 0; i < steps; ++i) {
    const Tick tick = simulation.tick();
    if (tick % kCommandPeriod == 0) simulation.push({tick, 0, kAllEngines, demandedThrusts()});
    simulation.step();
  }
  return 1e9 * (processorTime() - begin) / static_cast<double>(steps);
}

void measure(const char* name, const Scenario& scenario, std::size_t count) {
  Simulation simulation(scenario);
  std::vector<Batch> batches;
  for (const InstructionSet set : availableInstructionSets()) {
    batches.push_back(batchOf(scenario, count, set));
  }
  double alone = std::numeric_limits<double>::infinity();
  std::vector<double> among(batches.size(), alone);
  for (int i = 0; i < kRepetitions; ++i) {
    alone = std::min(alone, timeOf(simulation));
    for (std::size_t k = 0; k < batches.size(); ++k) {
      among[k] = std::min(among[k], timeOf(batches[k]));
    }
  }
  std::printf("%-24s %7zu craft: Simulation %6.1f ns", name, count, alone);
  for (std::size_t k = 0; k < batches.size(); ++k) {
    std::printf("; %s %5.1f (%.1f)", instructionSetName(batches[k].instructionSet()), among[k],
                alone / among[k]);
  }
  std::printf("\n");
  std::fflush(stdout);
}

struct Way {
  const char* name;
  Integrator integrator;
  BodyModel model;
};
constexpr Way kWays[] = {{"planar, Heun", Integrator::kHeun, BodyModel::kPlanar},
                         {"planar, RK4", Integrator::kRungeKutta4, BodyModel::kPlanar},
                         {"planar, lie4", Integrator::kLie4, BodyModel::kPlanar},
                         {"spatial, Heun", Integrator::kHeun, BodyModel::kSpatial},
                         {"spatial, RK4", Integrator::kRungeKutta4, BodyModel::kSpatial},
                         {"spatial, lie4", Integrator::kLie4, BodyModel::kSpatial}};

void measureAll(std::size_t count) {
  for (const Way& way : kWays) {
    measure(way.name, drivenCraft(way.integrator, OrientationKind::kQuaternion, way.model), count);
  }
  if (count > kMostOnCushions) return;
  for (const int cells : {1, 4}) {
    for (const Way& way : kWays) {
      const std::string name = std::to_string(cells) + " cells, " + way.name;
      measure(name.c_str(), craftOnCushion(way.integrator, way.model, cells), count);
    }
  }
}

}  // namespace
}  // namespace hovercraft::bench

int main(int argc, char** argv) {
  using namespace hovercraft;
  std::vector<std::size_t> counts;
  for (int i = 1; i < argc; ++i) counts.push_back(std::strtoul(argv[i], nullptr, 10));
  if (counts.empty()) counts = {1000, 100000};
  for (const std::size_t count : counts) bench::measureAll(count);
  return 0;
}
