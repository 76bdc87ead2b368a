#include "hovercraft_sim/python/stepped_batch.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "hovercraft_sim/lanes/instruction_set.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/python/held_scenario.h"
#include "hovercraft_sim/python/rows.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/sim/divergence.h"

namespace hovercraft_python {

using hovercraft::InstructionSet;

namespace {

/// Steps of one craft between two looks at whether a call is to end: some 50 ms.
constexpr std::size_t kCraftStepsPerLook = 2000000;

hovercraft::BatchOptions optionsOf(const BatchWay& way) {
  hovercraft::BatchOptions options;
  options.threads = way.threads;
  if (way.instruction_set.empty()) return options;
  std::string names;
  for (const InstructionSet set : hovercraft::availableInstructionSets()) {
    if (way.instruction_set == instructionSetName(set)) options.instruction_set = set;
    names += (names.empty() ? "" : ", ") + std::string(instructionSetName(set));
  }
  if (!options.instruction_set) {
    throw std::invalid_argument(
        fmt::format("instruction_set = {}: must be one of: {}", way.instruction_set, names));
  }
  return options;
}

const hovercraft::Scenario& firstOf(const std::vector<ScenarioPointer>& scenarios) {
  if (scenarios.empty()) throw std::invalid_argument("scenarios: must be at least one");
  return *scenarios.front();
}

}  // namespace

SteppedBatch::SteppedBatch(const std::vector<ScenarioPointer>& scenarios,
                           const std::optional<std::vector<std::int64_t>>& seeds,
                           const BatchWay& way)
    : batch_(firstOf(scenarios), 0, optionsOf(way)) {
  if (seeds && seeds->size() != scenarios.size()) {
    throw std::invalid_argument(
        fmt::format("seeds: must be as many as runs, {}", scenarios.size()));
  }
  scenario_ = scenarios.front();
  actuator_count_ = parametersOf(scenario_->vehicles.front()).size();
  for (std::size_t run = 0; run < scenarios.size(); ++run) {
    if (!seeds || (*seeds)[run] == scenarios[run]->seed) {
      batch_.add(*scenarios[run]);
      continue;
    }
    hovercraft::Scenario seeded = *scenarios[run];
    seeded.seed = (*seeds)[run];
    batch_.add(seeded);
  }
  for (const ScenarioPointer& one : scenarios) names_.push_back(one->vehicles.front().name);
  last_ticks_.assign(batch_.size(), 0);
}

/// A call has the batch for itself.
class SteppedBatch::Lock : public CallLock {
 public:
  explicit Lock(SteppedBatch& of)
      : CallLock(of.mutex_, "the batch is stepping: a signal handler must leave it alone") {}
};

void SteppedBatch::requireTime(std::int64_t count) const {
  const auto most = static_cast<std::int64_t>(hovercraft::kMaxNanoseconds) / batch_.stepNs();
  if (count < 0) throw std::invalid_argument(fmt::format("n = {}: must be 0 or greater", count));
  if (count > most - batch_.tick()) {
    throw std::invalid_argument(fmt::format("n = {}: must not go beyond {:.0f} s", count,
                                            hovercraft::kMaxNanoseconds * 1e-9));
  }
}

void SteppedBatch::makeSteps(std::int64_t count, const SteppedSimulation::Interrupt& interrupt) {
  const auto at_once = static_cast<std::int64_t>(
      std::max<std::size_t>(1, kCraftStepsPerLook / std::max<std::size_t>(1, batch_.size())));
  for (std::int64_t made = 0; made < count; made += at_once) {
    if (made > 0) interrupt();
    batch_.run(std::min(at_once, count - made));
  }
}

void SteppedBatch::step(std::int64_t count, const SteppedSimulation::Interrupt& interrupt) {
  const Lock lock(*this);
  requireTime(count);
  makeSteps(count, interrupt);
}

void SteppedBatch::record(std::vector<BatchRecording>& recordings) const {
  for (std::size_t run = 0; run < batch_.size(); ++run) {
    if (batch_.divergedAt(run)) continue;
    BatchRecording& recording = recordings[run];
    recording.states.push_back(stateRow(batch_.tick(), batch_.stepNs(), batch_.motion(run)));
    for (std::size_t id = 0; id < actuator_count_; ++id) {
      recording.actuators.push_back(actuatorRow(batch_.actuatorReport(run, id)));
    }
  }
}

std::vector<BatchRecording> SteppedBatch::fly(
    const std::vector<std::vector<hovercraft::Command>>& commands, std::int64_t count,
    std::int64_t every, const SteppedSimulation::Interrupt& interrupt) {
  const Lock lock(*this);
  requireTime(count);
  if (every < 1 || commands.size() != batch_.size()) {
    throw std::invalid_argument("fly: must have a list of commands for each run, and every >= 1");
  }
  for (std::size_t run = 0; run < commands.size(); ++run) {
    for (const hovercraft::Command& command : commands[run]) push(run, command);
  }
  std::vector<BatchRecording> recordings(batch_.size());
  record(recordings);
  for (std::int64_t made = 0; made < count; made += every) {
    makeSteps(std::min(every, count - made), interrupt);
    if (count - made >= every) record(recordings);
    interrupt();
  }
  return recordings;
}

void SteppedBatch::push(std::size_t run, const hovercraft::Command& command) {
  if (command.tick < std::max(batch_.tick(), last_ticks_[run])) {
    throw std::invalid_argument(
        "commands: time: must not be before that of the batch, nor of what is scheduled already");
  }
  last_ticks_[run] = command.tick;
  batch_.push(run, command);
}

void SteppedBatch::command(const std::vector<std::size_t>& ids, const std::vector<double>& values) {
  const Lock lock(*this);
  if (values.size() != ids.size() * batch_.size()) {
    throw std::invalid_argument("command: must have a number for each run");
  }
  hovercraft::Command command{batch_.tick(), 0, 0, {}};
  command.thrusts.resize(actuator_count_);
  for (const std::size_t id : ids) {
    if (id >= actuator_count_) throw std::invalid_argument("command: no such actuator");
    command.engines = static_cast<hovercraft::EngineMask>(command.engines | hovercraft::maskOf(id));
  }
  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) {
    throw std::invalid_argument("command: must be finite");
  }
  auto value = values.begin();
  for (std::size_t run = 0; run < batch_.size(); ++run) {
    for (const std::size_t id : ids) command.thrusts[id] = *value++;
    push(run, command);
  }
}

void SteppedBatch::schedule(const std::vector<hovercraft::Command>& commands,
                            const std::vector<std::size_t>& runs) {
  const Lock lock(*this);
  for (const std::size_t run : runs) {
    if (run >= batch_.size()) {
      throw std::invalid_argument(
          fmt::format("run = {}: must be less than {}", run, batch_.size()));
    }
    for (const hovercraft::Command& command : commands) push(run, command);
  }
}

std::int64_t SteppedBatch::tick() {
  const Lock lock(*this);
  return batch_.tick();
}

std::int64_t SteppedBatch::timeNs() {
  return tick() * batch_.stepNs();
}

std::vector<StateRow> SteppedBatch::states() {
  const Lock lock(*this);
  std::vector<StateRow> rows;
  rows.reserve(batch_.size());
  for (std::size_t run = 0; run < batch_.size(); ++run) {
    rows.push_back(stateRow(batch_.tickOf(run), batch_.stepNs(), batch_.motion(run)));
  }
  return rows;
}

std::vector<ActuatorRow> SteppedBatch::actuators() {
  const Lock lock(*this);
  std::vector<ActuatorRow> rows;
  rows.reserve(batch_.size() * actuator_count_);
  for (std::size_t run = 0; run < batch_.size(); ++run) {
    for (std::size_t id = 0; id < actuator_count_; ++id) {
      rows.push_back(actuatorRow(batch_.actuatorReport(run, id)));
    }
  }
  return rows;
}

std::vector<std::int64_t> SteppedBatch::diverged() {
  const Lock lock(*this);
  std::vector<std::int64_t> ticks(batch_.size());
  for (std::size_t run = 0; run < ticks.size(); ++run) {
    ticks[run] = batch_.divergedAt(run).value_or(-1);
  }
  return ticks;
}

std::vector<std::uint64_t> SteppedBatch::hashes() {
  const Lock lock(*this);
  std::vector<std::uint64_t> hashes(batch_.size());
  for (std::size_t run = 0; run < hashes.size(); ++run) hashes[run] = batch_.hash(run);
  return hashes;
}

std::vector<std::string> SteppedBatch::divergences() {
  const Lock lock(*this);
  std::vector<std::string> texts(batch_.size());
  for (std::size_t run = 0; run < texts.size(); ++run) {
    const auto tick = batch_.divergedAt(run);
    if (!tick) continue;
    texts[run] =
        hovercraft::divergenceText("vehicles." + names_[run], *tick, scenario_->stepSize());
  }
  return texts;
}

namespace {

namespace py = pybind11;

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Table = std::tuple<std::vector<std::string>, std::vector<double>, std::vector<double>>;

std::unique_ptr<SteppedBatch> batchOf(const std::vector<const HeldScenario*>& held,
                                      const std::optional<std::vector<std::int64_t>>& seeds,
                                      int threads, const std::string& instruction_set) {
  std::vector<ScenarioPointer> scenarios;  // another thread may set() meanwhile
  scenarios.reserve(held.size());
  for (const HeldScenario* one : held) scenarios.push_back(one->scenario());
  const py::gil_scoped_release release;
  return std::make_unique<SteppedBatch>(scenarios, seeds, BatchWay{threads, instruction_set});
}

/// What a function of the batch returns, as an array; Python's other threads go on meanwhile.
template <class Row>
auto arrayFrom(std::vector<Row> (SteppedBatch::*function)()) {
  return [function](SteppedBatch& self) {
    std::vector<Row> rows;
    {
      const py::gil_scoped_release release;
      rows = (self.*function)();
    }
    return arrayOf(rows);
  };
}

}  // namespace

void bindBatch(py::module_& module, const SteppedSimulation::Interrupt& interrupt) {
  py::class_<SteppedBatch>(module, "Batch")
      .def(py::init(&batchOf))
      .def("size", &SteppedBatch::size)
      .def("instruction_set", &SteppedBatch::instructionSet)
      .def("step",
           [interrupt](SteppedBatch& self, std::int64_t count) {
             const py::gil_scoped_release release;
             self.step(count, interrupt);
           })
      .def("command",
           [](SteppedBatch& self, const std::vector<std::size_t>& ids, const Numbers& values) {
             const std::vector<double> copied(values.data(), values.data() + values.size());
             const py::gil_scoped_release release;
             self.command(ids, copied);
           })
      .def("schedule",
           [](SteppedBatch& self, const Table& table, const std::vector<std::size_t>& runs) {
             const auto& [names, times, values] = table;
             const py::gil_scoped_release release;
             self.schedule(commandsOf({{"", names, times, values}}, *self.scenario()), runs);
           })
      .def("fly",
           [interrupt](SteppedBatch& self, const std::vector<CommandRows>& rows, std::int64_t count,
                       std::int64_t every) {
             std::vector<std::vector<hovercraft::Command>> commands;
             commands.reserve(rows.size());
             for (const CommandRows& one : rows) {
               commands.push_back(commandsOf(one, *self.scenario()));
             }
             std::vector<BatchRecording> recordings;
             {
               const py::gil_scoped_release release;
               recordings = self.fly(commands, count, every, interrupt);
             }
             py::list list;
             for (const BatchRecording& one : recordings) {
               list.append(py::make_tuple(arrayOf(one.states), arrayOf(one.actuators)));
             }
             return list;
           })
      .def("divergences", &SteppedBatch::divergences, py::call_guard<py::gil_scoped_release>())
      .def("tick", &SteppedBatch::tick, py::call_guard<py::gil_scoped_release>())
      .def("time_ns", &SteppedBatch::timeNs, py::call_guard<py::gil_scoped_release>())
      .def("states", arrayFrom(&SteppedBatch::states))
      .def("actuators", arrayFrom(&SteppedBatch::actuators))
      .def("diverged", arrayFrom(&SteppedBatch::diverged))
      .def("hashes", arrayFrom(&SteppedBatch::hashes));
}

}  // namespace hovercraft_python
