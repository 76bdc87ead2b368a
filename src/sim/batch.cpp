#include "hovercraft_sim/sim/batch.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/air_parser.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/sim/batch_ground.h"
#include "hovercraft_sim/sim/state_hash.h"

namespace hovercraft {
namespace {

using lanes::kBlockLanes;
using lanes::Row;

constexpr Tick kNever = std::numeric_limits<Tick>::max();
/// Ticks of which gusts are drawn, and fans' speeds are looked up, for a block at once: some
/// kilobytes.
constexpr Tick kTicksAhead = 32;
/// Blocks that a thread takes at once: what it costs to ask for them does not count then.
constexpr std::size_t kBlocksAtOnce = 16;

Vector3 vectorOf(const Row* rows, std::size_t lane) {
  return {rows[0].of[lane], rows[1].of[lane], rows[2].of[lane]};
}

InstructionSet chosenSet(const BatchOptions& options) {
  return options.instruction_set.value_or(availableInstructionSets().back());
}

}  // namespace

Batch::Batch(const Scenario& scenario, std::size_t count, const BatchOptions& options)
    : kind_(batchKindOf(scenario, batchableModelOf(scenario))),
      threads_(options.threads),
      instruction_set_(chosenSet(options)),
      advance_(lanes::advanceBy(instruction_set_)) {
  if (options.threads < 1) {
    throw std::invalid_argument(fmt::format("threads = {}: must be 1 or greater", threads_));
  }
  for (std::size_t i = 0; i < count; ++i) add(scenario);
}

Batch::Batch(const std::vector<Scenario>& scenarios, const BatchOptions& options)
    : Batch(scenarios.empty() ? throw std::invalid_argument("a batch must have a scenario")
                              : scenarios.front(),
            0, options) {
  for (const Scenario& scenario : scenarios) add(scenario);
}

void Batch::growBlocks() {
  if (size() % kBlockLanes != 0) return;
  blocks_.push_back(idleBlock());
  wind_W_.resize(wind_W_.size() + 3, Row{});
  more_.resize(more_.size() + kind_.rows, Row{});
  fan_speeds_.resize(fan_speeds_.size() + fanRows(), Row{});
}

/// Of the run that is being added.
void Batch::addFans(const HovercraftModel& model) {
  if (!kind_.plan.ground.has_cushion) return;
  const std::size_t run = grounds_.size();
  const Cushion& cushion = *model.ground_forces->cushion();
  writeFanSpeeds(cushion, 0, kind_.step_ns, run % kBlockLanes,
                 fan_speeds_.data() + run / kBlockLanes * fanRows());
  fans_follow_time_ = fans_follow_time_ || fansFollowTime(cushion);
  grounds_.push_back(model.ground_forces);
}

/// Of the run to be added.
HovercraftModel Batch::modelOfRun(const Scenario& scenario) const {
  const std::string name = fmt::format("run {}", size());
  try {
    HovercraftModel model = batchableModelOf(scenario);
    requireSameKind(batchKindOf(scenario, model), kind_, name);
    return model;
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    throw std::invalid_argument(text.rfind(name, 0) == 0 ? text : name + ": " + text);
  }
}

void Batch::add(const Scenario& scenario) {
  const FloatingPointEnvironment environment;
  demand(tick_ == 0, "a run must be added before the first step");
  const HovercraftModel model = modelOfRun(scenario);
  const VehicleScenario& craft = scenario.vehicles.front();
  std::optional<Gusts> gusts = gustsOf(scenario);
  growBlocks();
  const std::size_t block = size() / kBlockLanes;
  const EngineDynamics dynamics(parametersOf(craft), scenario.step_ns);
  writeLane(scenario, model, dynamics,
            {blocks_[block], wind_W_.data() + 3 * block, more_.data() + block * kind_.rows,
             size() % kBlockLanes});
  addFans(model);
  const EngineStates engines = initialActuators(craft);
  for (std::size_t id = 0; id < engines.size(); ++id) {
    actuators_.push_back({dynamics.rule(id), engines[id].commanded, engines[id].command_tick});
  }
  mobilities_.push_back(model.mobility);
  next_event_.push_back(0);  // to know what is demanded before the first command
  diverged_.push_back(kNever);
  if (gusts) {
    const GustState start = gusts->start(0, scenario.seed);
    airs_.push_back({std::move(*gusts), start, scenario.seed, scenario.wind});
  }
  logs_.emplace_back();
}

std::size_t Batch::lanesOf(std::size_t block) const {
  return std::min(kBlockLanes, size() - block * kBlockLanes);
}

void Batch::push(std::size_t run, const Command& command) {
  demand(run < size() && command.vehicle == 0, "a command must name a run of the batch");
  demand(command.tick >= tick_, "a command must not lie in the past");
  demand(allFinite(command.thrusts), "a thrust must be checked before it becomes a command");
  demand(command.engines >> kind_.plan.actuator_count == 0,
         "a command must be for actuators of the craft");
  if (diverged_[run] != kNever) return;
  logs_[run].push(command);
  next_event_[run] = std::min(next_event_[run], command.tick);
}

/// Applies the commands of a run that are due, and writes what is demanded from now on.
/// @returns the tick at which that changes.
Tick Batch::takeEvents(std::size_t run, Tick tick) {
  if (next_event_[run] > tick) return next_event_[run];
  const std::size_t count = kind_.plan.actuator_count;
  LaneActuator* const actuators = actuators_.data() + run * count;
  while (const Command* command = logs_[run].takeDue(tick)) {
    for (std::size_t id = 0; id < count; ++id) {
      if ((command->engines & maskOf(id)) == 0) continue;
      actuators[id].commanded = command->thrusts[id];
      actuators[id].command_tick = tick;
    }
  }
  Tick next = logs_[run].nextTick();
  lanes::Block& block = blocks_[run / kBlockLanes];
  for (std::size_t id = 0; id < count; ++id) {
    const LaneActuator& actuator = actuators[id];
    const EngineState state = {actuator.commanded, 0.0, actuator.command_tick};
    block.demand[id].of[run % kBlockLanes] = EngineDynamics::demandOf(actuator.rule, state, tick);
    if (actuator.command_tick == EngineState::kNever) continue;
    const Tick left = actuator.rule.timeout_ticks - (tick - actuator.command_tick);
    if (left > 0 && left < kNever - tick) next = std::min(next, tick + left);
  }
  next_event_[run] = next;
  return next;
}

/// What surrounds a block's craft over some steps.
struct Batch::Around {
  std::array<Row, static_cast<std::size_t>(3 * kTicksAhead)> wind_W;  // three for each step
  std::array<GustState, kBlockLanes> before;                          // of the gusts at their begin
  std::array<Row, 3 * kMaxFans* static_cast<std::size_t>(kTicksAhead)> fan_speeds;
};

/// The wind in the steps from a tick on; gusts go on to the tick after them.
void Batch::blow(std::size_t block, Tick tick, Tick count, Around& around) {
  for (std::size_t lane = 0; lane < kBlockLanes; ++lane) {
    const std::size_t run = block * kBlockLanes + lane;
    if (run < size()) around.before[lane] = airs_[run].state;
    for (Tick i = 0; i < count; ++i) {
      Row* const step = around.wind_W.data() + 3 * i;
      Vector3 wind_W = Vector3::Zero();
      if (run < size()) {
        Air& air = airs_[run];
        wind_W = air.mean_W;
        wind_W += gustInWorld(air.mean_W, air.gusts.velocity(air.state));
        air.gusts.advance(0, air.seed, tick + i + 1, air.state);
      }
      for (int axis = 0; axis < 3; ++axis) step[axis].of[lane] = wind_W[axis];
    }
  }
}

/// The fans' speeds in the steps from a tick on.
void Batch::turnFans(std::size_t block, Tick tick, Tick count, Around& around) const {
  for (std::size_t lane = 0; lane < kBlockLanes; ++lane) {
    const std::size_t run = block * kBlockLanes + std::min(lane, lanesOf(block) - 1);
    Row* step = around.fan_speeds.data();
    for (Tick i = 0; i < count; ++i, step += fanRows()) {
      writeFanSpeeds(*grounds_[run]->cushion(), tick + i, kind_.step_ns, lane, step);
    }
  }
}

/// Gusts at craft that were lost stay as they were at that tick. @param begin of the steps.
void Batch::calm(std::size_t block, Tick begin, const Around& around) {
  for (std::size_t lane = 0; lane < lanesOf(block); ++lane) {
    const std::size_t run = block * kBlockLanes + lane;
    if (diverged_[run] == kNever) continue;
    Air& air = airs_[run];
    air.state = around.before[lane];
    for (Tick at = begin; at < diverged_[run]; ++at) {
      air.gusts.advance(0, air.seed, at + 1, air.state);
    }
  }
}

void Batch::noteLost(std::size_t block, Tick begin) {
  const lanes::BlockState& state = blocks_[block].state;
  for (std::size_t lane = 0; lane < lanesOf(block); ++lane) {
    const std::size_t run = block * kBlockLanes + lane;
    if (state.moves.of[lane] != 0 || diverged_[run] != kNever) continue;
    diverged_[run] = begin + state.lost_after[lane];
    next_event_[run] = kNever;
  }
}

/// Takes the events of a block's runs at a tick. @returns the tick of the next one, at most the
/// end.
Tick Batch::nextEvent(std::size_t block, Tick tick, Tick end) {
  const bool looks_ahead = !airs_.empty() || fans_follow_time_;
  Tick next = looks_ahead ? std::min(end, tick + kTicksAhead) : end;
  for (std::size_t lane = 0; lane < lanesOf(block); ++lane) {
    next = std::min(next, takeEvents(block * kBlockLanes + lane, tick));
  }
  return next;
}

void Batch::advanceBlock(std::size_t block, Tick end) {
  const bool has_gusts = !airs_.empty();
  Around around;
  for (Tick tick = tick_; tick < end;) {
    const Tick next = nextEvent(block, tick, end);
    lanes::BlockSteps steps = {&blocks_[block],
                               moreOf(block),
                               wind_W_.data() + 3 * block,
                               0,
                               next - tick,
                               fan_speeds_.data() + block * fanRows(),
                               0};
    if (has_gusts) {
      blow(block, tick, steps.count, around);
      steps.wind_W = around.wind_W.data();
      steps.wind_stride = 3;
    }
    if (fans_follow_time_) {
      turnFans(block, tick, steps.count, around);
      steps.fan_speeds = around.fan_speeds.data();
      steps.fan_stride = fanRows();
    }
    advance_(kind_.plan, steps);
    noteLost(block, tick);
    if (has_gusts) calm(block, tick, around);
    tick = next;
  }
}

void Batch::run(Tick ticks) {
  demand(ticks >= 0 && ticks < kNever - tick_, "a batch goes on by 0 ticks or more");
  const Tick end = tick_ + ticks;
  std::atomic<std::size_t> next_block{0};
  const auto work = [&] {
    const FloatingPointEnvironment environment;
    for (;;) {
      const std::size_t first = next_block.fetch_add(kBlocksAtOnce);
      if (first >= blocks_.size()) return;
      const std::size_t last = std::min(first + kBlocksAtOnce, blocks_.size());
      for (std::size_t block = first; block < last; ++block) advanceBlock(block, end);
    }
  };
  const std::size_t shares = (blocks_.size() + kBlocksAtOnce - 1) / kBlocksAtOnce;
  const std::size_t wanted = std::min(static_cast<std::size_t>(threads_), shares);
  std::vector<std::thread> helpers;
  const auto start_one = [&] {
    try {
      helpers.emplace_back(work);
      return true;
    } catch (const std::system_error&) {
      return false;  // no more are to be had: those that there are do all of it
    }
  };
  while (helpers.size() + 1 < wanted && start_one()) continue;
  work();
  for (std::thread& helper : helpers) helper.join();
  tick_ = end;
}

std::optional<Tick> Batch::divergedAt(std::size_t run) const {
  if (diverged_[run] == kNever) return std::nullopt;
  return diverged_[run];
}

RigidBodyState<Quaternion> Batch::body(std::size_t run) const {
  const lanes::BlockState& state = blocks_[run / kBlockLanes].state;
  const std::size_t lane = run % kBlockLanes;
  return {vectorOf(state.p_WB, lane),
          {state.q_s.of[lane], vectorOf(state.q_v, lane)},
          vectorOf(state.momentum_W, lane),
          vectorOf(state.angular_momentum_W, lane)};
}

EngineState Batch::actuatorState(std::size_t run, std::size_t id) const {
  const LaneActuator& actuator = actuators_[run * kind_.plan.actuator_count + id];
  const double level = blocks_[run / kBlockLanes].state.level[id].of[run % kBlockLanes];
  return {actuator.commanded, level, actuator.command_tick};
}

EngineStates Batch::actuators(std::size_t run) const {
  const std::size_t count = kind_.plan.actuator_count;
  EngineStates states;
  states.resize(count);
  for (std::size_t id = 0; id < count; ++id) states[id] = actuatorState(run, id);
  return states;
}

EngineReport Batch::actuatorReport(std::size_t run, std::size_t id) const {
  const FloatingPointEnvironment environment;
  const EngineState state = actuatorState(run, id);
  const EngineDynamics::Rule& rule = actuators_[run * kind_.plan.actuator_count + id].rule;
  const Tick age = tickOf(run) - state.command_tick;
  return {state.commanded,
          state.thrust,
          EngineDynamics::isSaturated(rule, state),
          EngineDynamics::isTimedOut(rule, state, tickOf(run)),
          state.command_tick == EngineState::kNever ? -1.0 : toSeconds(age * kind_.step_ns),
          state.efficiency,
          state.stuck};
}

Vector3 Batch::rotorsOf(std::size_t run) const {
  const std::size_t lane = run % kBlockLanes;
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < kind_.plan.rotor_count; ++i) {
    const lanes::RotorStep& step = kind_.plan.rotors[i];
    const Row* const rows = moreOf(run / kBlockLanes) + step.first_row;
    const Rotor rotor = {step.id, step.by_square_root, rows[0].of[lane], 0.0,
                         vectorOf(rows + 1, lane)};
    sum += rotor.angularMomentum(actuatorState(run, rotor.id).thrust) * rotor.axis;
  }
  return sum;
}

Motion Batch::motion(std::size_t run) const {
  const FloatingPointEnvironment environment;
  const RigidBodyState<Quaternion> y = body(run);
  const Mobility& mobility = mobilities_[run];
  const Vector3 weight_W =
      vectorOf(blocks_[run / kBlockLanes].constants.weight_W, run % kBlockLanes);
  const double potential = -dot(weight_W, y.p_WB);
  const bool has_rotors = kind_.plan.rotor_count > 0;
  const Vector3 rotors_B = rotorsOf(run);
  const double kinetic =
      has_rotors ? kineticEnergy(y, mobility, rotors_B) : kineticEnergy(y, mobility);
  return {y.p_WB,
          y.orientation,
          has_rotors ? mobility.twist(y, rotors_B) : mobility.twist(y),
          y.momentum_W,
          y.angular_momentum_W,
          kinetic + potential};
}

std::uint64_t Batch::hash(std::size_t run) const {
  StateHash hash;
  hash.add(tickOf(run));
  hash.add(BodyState(body(run)));
  hash.add(actuators(run));
  if (!airs_.empty()) {
    hash.add(airs_[run].mean_W);
    for (const double number : airs_[run].state) hash.add(number);
  }
  return hash.value();
}

}  // namespace hovercraft
