#include "recorded_runs.h"

#include <fmt/format.h>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>

#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft::testing {
namespace {

constexpr const char* kHeader =
    "# Hashes of the state (ARCHITECTURE.md) at ticks 0, 100, 10000 and 100000. They change only "
    "if "
    "the equations,\n"
    "# the order of an operation or the definition of the hash does; then: determinism --record.\n"
    "# scenario integrator orientation hashes\n";

/// Commands and pushes of a run. std::mt19937_64 is the same everywhere; the distributions of
/// <random> are not, so numbers are cut from its bits.
class Pilot {
 public:
  void act(Simulation& simulation) {
    if (simulation.tick() < next_) return;
    const Tick tick = simulation.tick();
    const std::size_t vehicle = draw(simulation.scenario().vehicles.size());
    const auto engines = draw(3) == 0 ? static_cast<EngineMask>(1 + draw(7)) : kAllEngines;
    const double rear = sixtyFourths(-64, 384);
    const double left = sixtyFourths(-64, 160);
    const double right = sixtyFourths(-64, 160);
    simulation.push({tick, vehicle, engines, {rear, left, right}});
    if (draw(8) == 0) push(simulation, vehicle);
    next_ = tick + 1 + static_cast<Tick>(draw(700));
  }

 private:
  void push(Simulation& simulation, std::size_t vehicle) {
    ExternalWrench external;
    external.vehicle = vehicle;
    external.frame = draw(2) == 0 ? ExternalWrench::Frame::kWorld : ExternalWrench::Frame::kBody;
    for (int i = 0; i < 3; ++i) external.wrench.force[i] = sixtyFourths(-64, 64);
    for (int i = 0; i < 3; ++i) external.wrench.torque[i] = sixtyFourths(-4, 4);
    external.end_tick = simulation.tick() + 1 + static_cast<Tick>(draw(300));
    simulation.applyWrench(external);
  }

  std::size_t draw(std::size_t count) { return random_() % count; }
  /// A multiple of 1/64, which every double holds exactly.
  double sixtyFourths(int low, int high) {
    const auto span = static_cast<std::size_t>(high) - static_cast<std::size_t>(low) + 1;
    return (low + static_cast<int>(draw(span))) / 64.0;
  }

  std::mt19937_64 random_{20261122};
  Tick next_ = 0;
};

/// Commands to the actuators besides the engines, and faults of all, by the tick alone. Numbers are
/// multiples of 1/8.
void exerciseActuators(Simulation& simulation) {
  constexpr Tick kPeriod = 350;
  if (simulation.tick() % kPeriod != 0) return;
  const Tick round = simulation.tick() / kPeriod;
  const std::size_t count = simulation.state().engines[0].size();
  const auto id = kFirstActuator + static_cast<std::size_t>(round) % (count - kFirstActuator);
  Command command{simulation.tick(), 0, maskOf(id), {}};
  command.thrusts.resize(count);
  command.thrusts[id] = static_cast<double>(round * 5 % 17 - 8) / 8.0;
  simulation.push(command);
  if (round % 3 != 0) return;
  simulation.setActuator(0, static_cast<std::size_t>(round / 3) % count,
                         static_cast<double>(round % 9) / 8.0, round % 7 == 0);
}

Scenario scenarioOf(const std::string& folder, const RecordedRun& run) {
  const std::string path = folder + "/scenarios/" + run.scenario + ".yaml";
  return loadScenario(
      path, {},
      {"hashes.txt:", {"integrator=" + run.integrator, "orientation=" + run.orientation}});
}

}  // namespace

std::vector<RecordedRun> readRecordedRuns(const std::string& folder) {
  const std::string path = folder + "/hashes.txt";
  std::ifstream file(path);
  std::vector<RecordedRun> runs;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    RecordedRun run;
    words >> run.scenario >> run.integrator >> run.orientation >> std::hex;
    for (std::uint64_t& hash : run.hashes) words >> hash;
    if (words.fail()) {
      throw std::invalid_argument(fmt::format(
          "{}:{}: must be scenario, integrator, orientation and {} hashes in hexadecimal digits",
          path, number, kCheckpoints.size()));
    }
    runs.push_back(run);
  }
  if (runs.empty()) throw std::invalid_argument(path + ": must be there and name a run");
  return runs;
}

std::string textOf(const std::vector<RecordedRun>& runs) {
  std::string text = kHeader;
  for (const RecordedRun& run : runs) {
    text += fmt::format("{:<8} {:<19} {:<10}", run.scenario, run.integrator, run.orientation);
    for (const std::uint64_t hash : run.hashes) text += fmt::format(" {:016x}", hash);
    text += '\n';
  }
  return text;
}

std::vector<std::uint64_t> fly(const std::string& folder, const RecordedRun& run, Tick last_tick) {
  Simulation simulation(scenarioOf(folder, run));
  Pilot pilot;
  std::vector<std::uint64_t> hashes;
  for (const Tick checkpoint : kCheckpoints) {
    if (checkpoint > last_tick) break;
    while (simulation.tick() < checkpoint) {
      pilot.act(simulation);
      if (run.scenario == "rotors") exerciseActuators(simulation);
      simulation.step();
    }
    hashes.push_back(simulation.hash());
  }
  return hashes;
}

bool hasContact(const std::string& folder, const RecordedRun& run) {
  return scenarioOf(folder, run).world.has_value();
}

std::string firstDifference(const RecordedRun& run, const std::vector<std::uint64_t>& flown) {
  for (std::size_t i = 0; i < flown.size(); ++i) {
    if (flown[i] == run.hashes[i]) continue;
    return fmt::format("{} {} {}: tick {}: hash {:016x}, recorded {:016x}", run.scenario,
                       run.integrator, run.orientation, kCheckpoints[i], flown[i], run.hashes[i]);
  }
  return "";
}

}  // namespace hovercraft::testing
