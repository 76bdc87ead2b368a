#include "hovercraft_sim/records/simulate.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/io/input_file.h"
#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/io/output_file.h"
#include "hovercraft_sim/io/progress_bar.h"
#include "hovercraft_sim/io/steady_clock.h"
#include "hovercraft_sim/math/files_read.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/records/actuators_csv.h"
#include "hovercraft_sim/records/commands_csv.h"
#include "hovercraft_sim/records/contacts_csv.h"
#include "hovercraft_sim/records/cushion_csv.h"
#include "hovercraft_sim/records/sensors_csv.h"
#include "hovercraft_sim/records/states_csv.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/sim/craft_pilots.h"
#include "hovercraft_sim/sim/run_outputs.h"

namespace hovercraft {

namespace fs = std::filesystem;

namespace {

Tick ticksOfDuration(const std::string& text, const Scenario& scenario) {
  const FloatingPointEnvironment environment;
  const auto fail = [&](const std::string& rule) {
    throw std::invalid_argument(fmt::format("--duration = {}: {}", text, rule));
  };
  const ParsedNumber seconds = parseNumber(text);
  if (seconds.syntax != NumberSyntax::kNumber) fail("must be a number of seconds");
  if (!(seconds.value > 0.0)) fail("must be greater than 0");
  const double most = kMaxNanoseconds * 1e-9;
  if (seconds.value > most) fail(fmt::format("must be at most {:.0f} s", most));
  const std::int64_t duration_ns = parseNanoseconds(text);
  if (duration_ns == 0) fail("must be at least a nanosecond, 1e-9 s");
  return firstTickAt(duration_ns, scenario.step_ns);
}

/// Reads the commands once to find where they end: a file is then known to be good before anything
/// is written.
Tick ticksOfCommands(const std::string& path, const Scenario& scenario, RosFiles& ros) {
  if (!fs::is_regular_file(path)) {
    throw std::invalid_argument(
        path + ": the duration is missing: commands that do not come from a file need --duration");
  }
  const auto source = openCommands(path, scenario, ros);
  Tick last = 0;
  bool found = false;
  for (; const auto command = source->next(); found = true) last = command->tick;
  if (!found) throw std::invalid_argument(path + ": there are no commands in it; use --duration");
  return last + firstTickAt(kAfterLastCommandNs, scenario.step_ns);
}

void checkEvery(const char* option, Tick every, const char* of, const std::string& file) {
  if (every < 0)
    throw std::invalid_argument(fmt::format("{} = {}: must be 1 or greater", option, every));
  if (every > 0 && file.empty()) {
    throw std::invalid_argument(fmt::format("{}: has a meaning with {} only", option, of));
  }
}

std::vector<OutputOption> outputsOf(const SimulateRequest& request) {
  return {{"--output", request.output},
          {"--contacts", request.contacts},
          {"--actuators", request.actuators},
          {"--cushion", request.cushion}};
}

void checkRequest(const SimulateRequest& request, RosFiles& ros) {
  if (request.every < 1) {
    throw std::invalid_argument(fmt::format("--every = {}: must be 1 or greater", request.every));
  }
  checkEvery("--actuators-every", request.actuators_every, "--actuators", request.actuators);
  checkEvery("--cushion-every", request.cushion_every, "--cushion", request.cushion);
  if (request.commands.empty() && request.pilots.empty() && request.duration.empty()) {
    throw std::invalid_argument(
        "--duration is missing: without --commands and --pilot it must be given");
  }
  if (!request.commands.empty() && !request.pilots.empty()) {
    throw std::invalid_argument("--pilot: must not stand beside --commands");
  }
  if (request.truth_odom != kDefaultTruthOdom) {
    ros.checkTruthOdom(request.truth_odom);
    if (fs::path(request.output).extension() != ".bag") {
      throw std::invalid_argument(
          "--truth-odom: has a meaning with an --output that is a bag only");
    }
  }
  std::vector<std::string> inputs = {request.scenario, request.commands};
  inputs.insert(inputs.end(), request.pilots.begin(), request.pilots.end());
  checkOutputs(outputsOf(request), inputs);
}

/// Hands everything on to another observer, and counts the wall time that this one takes.
class TimedObserver : public RunObserver {
 public:
  explicit TimedObserver(std::unique_ptr<RunObserver> next) : next_(std::move(next)) {}

  void state(const Simulation& simulation) override {
    timed([&] { next_->state(simulation); });
  }
  void applied(const Command& command) override {
    timed([&] { next_->applied(command); });
  }
  void contact(const ContactEvent& event) override {
    timed([&] { next_->contact(event); });
  }
  void sample(const SensorSample& sample) override {
    timed([&] { next_->sample(sample); });
  }
  void flown(const FlownManoeuvre& manoeuvre, std::size_t vehicle, Tick tick) override {
    timed([&] { next_->flown(manoeuvre, vehicle, tick); });
  }
  void close() override {
    timed([&] { next_->close(); });
  }

  std::int64_t spentNs() const { return spent_ns_; }

 private:
  template <class Call>
  void timed(const Call& call) {
    const std::int64_t begin = steadyNow();
    call();
    spent_ns_ += steadyNow() - begin;
  }

  std::unique_ptr<RunObserver> next_;
  std::int64_t spent_ns_ = 0;
};

/// What a step cost, without the output, and what the whole run took.
void reportTime(const Simulation& simulation, std::int64_t wall_ns, std::int64_t output_ns,
                std::ostream& messages) {
  const auto ticks = static_cast<double>(simulation.tick());
  const auto stepping = static_cast<double>(std::max<std::int64_t>(wall_ns - output_ns, 1));
  const double wall = static_cast<double>(std::max<std::int64_t>(wall_ns, 1));
  const auto simulated = static_cast<double>(simulation.timeNs());
  messages << fmt::format("a step cost {:.0f} ns, {:.3g} x real time, without the output\n",
                          stepping / ticks, simulated / stepping);
  messages << fmt::format("simulated {} s in {} ticks, wall time {:.3f} s, {:.0f} x real time, ",
                          secondsText(simulation.timeNs()), simulation.tick(), 1e-9 * wall,
                          simulated / wall);
}

void reportTimeouts(const RunSummary& summary, const Scenario& scenario, std::ostream& messages) {
  for (const EngineTimeout& timeout : summary.timeouts) {
    const VehicleScenario& vehicle = scenario.vehicles[timeout.vehicle];
    const auto id = static_cast<std::size_t>(timeout.engine);
    const bool is_engine = id < kFirstActuator;
    const bool is_newton = is_engine && vehicle.engines[id].command.isPlain();
    messages << fmt::format(
        "{}: {} {} timed out at {} s: {:g}{} were commanded, and then nothing for {} s",
        vehicle.name, is_engine ? "engine" : "actuator", actuatorName(vehicle, id),
        secondsText(timeout.first_tick * scenario.step_ns), timeout.first_commanded,
        is_newton ? " N" : "", secondsText(parametersOf(vehicle)[id].timeout_ns));
    if (timeout.count > 1) messages << fmt::format(" (the first of {} times)", timeout.count);
    messages << "; --hold keeps commands\n";
  }
}

Tick lastTickOf(const SimulateRequest& request, const Scenario& scenario, const CraftPilots& pilots,
                RosFiles& ros) {
  if (!request.duration.empty()) return ticksOfDuration(request.duration, scenario);
  if (!request.pilots.empty()) return pilots.lastTick();
  return ticksOfCommands(request.commands, scenario, ros);
}

/// What each manoeuvre came to; one that is flown when the run ends as well.
void reportManoeuvres(const CraftPilots& pilots, const Scenario& scenario, std::ostream& messages) {
  for (const CraftPilot& pilot : pilots.pilots()) {
    const std::string whose =
        scenario.vehicles.size() > 1 ? scenario.vehicles[pilot.vehicle()].name + ": " : "";
    for (const FlownManoeuvre& flown : pilot.flown()) {
      messages << whose << toText(flown);
    }
    if (!pilot.isFlown()) messages << whose << "the run ended before the last manoeuvre did\n";
  }
}

}  // namespace

Scenario loadScenarioFile(const std::string& path, const OverrideList& overrides, RosFiles& ros) {
  return loadScenario(
      path, [&ros](const std::string& package) { return ros.packagePath(package); }, overrides,
      [](const std::string& note) { std::cerr << note << '\n'; });
}

std::unique_ptr<CommandSource> openCommands(const std::string& path, const Scenario& scenario,
                                            RosFiles& ros) {
  if (isBag(path)) return ros.openCommands(path, scenario);
  return std::make_unique<CsvCommandSource>(path, scenario, InputKind::kFileOrStream);
}

std::unique_ptr<RunObserver> openOutput(const std::string& path, const Scenario& scenario,
                                        const std::string& truth_odom, RosFiles& ros) {
  const std::string extension = fs::path(path).extension().string();
  if (extension == ".bag") return ros.openOutput(path, scenario, truth_odom);
  if (extension != ".csv" && path != "-") {
    throw std::invalid_argument(
        fmt::format("--output = {}: must end in .csv or .bag, or be - for CSV on the standard "
                    "output",
                    path));
  }
  return std::make_unique<StatesCsvWriter>(path, scenario);
}

/// What else it writes, and all that was read: what the files of sensors must leave as it is.
std::vector<std::string> filesOf(const SimulateRequest& request,
                                 const std::vector<std::string>& read) {
  std::vector<std::string> files = read;
  for (const OutputOption& output : outputsOf(request)) files.push_back(output.path);
  return files;
}

/// The output and the CSV files beside it.
/// @param read files that must stay.
std::unique_ptr<RunOutputs> openOutputs(const SimulateRequest& request, const Scenario& scenario,
                                        const std::vector<std::string>& read, RosFiles& ros) {
  checkOutputs(outputsOf(request), read);
  auto outputs = std::make_unique<RunOutputs>();
  outputs->add(openOutput(request.output, scenario, request.truth_odom, ros), request.every);
  if (!request.contacts.empty()) {
    outputs->add(std::make_unique<ContactsCsvWriter>(request.contacts), request.every);
  }
  if (!request.actuators.empty()) {
    const Tick every = request.actuators_every > 0 ? request.actuators_every : request.every;
    outputs->add(std::make_unique<ActuatorsCsvWriter>(request.actuators, scenario), every);
  }
  if (!request.cushion.empty()) {
    const Tick every = request.cushion_every > 0 ? request.cushion_every : request.every;
    outputs->add(std::make_unique<CushionCsvWriter>(request.cushion, scenario), every);
  }
  if (!request.sensors.empty()) {
    outputs->add(
        std::make_unique<SensorsCsvWriter>(request.sensors, scenario, filesOf(request, read)),
        request.every);
  }
  return outputs;
}

/// No engine and no other actuator times out.
void holdCommands(Scenario& scenario) {
  for (VehicleScenario& vehicle : scenario.vehicles) {
    for (EngineParameters& engine : vehicle.engines) engine.timeout_ns = 0;
    for (auto& actuator : vehicle.actuators) actuator.motion.timeout_ns = 0;
  }
}

RunSummary simulate(const SimulateRequest& request, std::ostream& messages, RosFiles& ros) {
  checkRequest(request, ros);
  const FilesRead read;
  Scenario scenario = loadScenarioFile(request.scenario, {"--set", request.sets}, ros);
  if (request.hold) holdCommands(scenario);
  CraftPilots pilots(request.pilots, scenario);
  RunPlan plan;
  plan.last_tick = lastTickOf(request, scenario, pilots, ros);
  const std::unique_ptr<CommandSource> commands =
      request.commands.empty() ? std::make_unique<NoCommands>()
                               : openCommands(request.commands, scenario, ros);
  std::unique_ptr<RunOutputs> outputs = openOutputs(request, scenario, read.paths(), ros);
  plan.every = outputs->every();
  Simulation simulation(scenario);

  std::optional<ProgressBar> bar;
  if (request.shows_progress) {
    bar.emplace(messages, plan.last_tick);
    plan.on_progress = [&bar](Tick tick) { bar->show(tick); };
  }
  TimedObserver timed(std::move(outputs));
  if (!request.pilots.empty()) {
    // With a duration it is the end, else that of the last pilot.
    plan.steer = [&](Simulation& now) {
      return pilots.steer(now, timed) || !request.duration.empty();
    };
  }
  const std::int64_t begin = steadyNow();
  RunSummary summary = run(simulation, *commands, timed, plan);
  const std::int64_t wall_ns = steadyNow() - begin;
  bar.reset();

  reportTimeouts(summary, scenario, messages);
  reportManoeuvres(pilots, scenario, messages);
  if (simulation.world() && simulation.world()->stalls() > 0) {
    messages << fmt::format(
        "contact: {} times the rest of a step was cut off, as more happened in it than its bounds "
        "allow (doc/contact.md)\n",
        simulation.world()->stalls());
  }
  reportTime(simulation, wall_ns, timed.spentNs(), messages);
  messages << fmt::format("state hash {:016x}\n", summary.hash);
  return summary;
}

}  // namespace hovercraft
