#include "hovercraft_sim/sim/simulation.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/scenario/air_parser.h"
#include "hovercraft_sim/scenario/cushion_builder.h"
#include "hovercraft_sim/scenario/sensor_builder.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/sim/divergence.h"
#include "hovercraft_sim/sim/run_observer.h"
#include "hovercraft_sim/sim/state_hash.h"

namespace hovercraft {
namespace {

bool isRotation(const Quaternion& q_WB) {
  // Components beyond 1e154 have an infinite norm, and end as 0 when they are divided by it.
  return std::abs(squaredNorm(q_WB) - 1.0) < kUnitLength;
}
bool isRotation(const Matrix3& R_WB) {
  return !std::isnan(R_WB(0, 0));  // renormalized() gives a rotation, or NaN
}

template <class Orientation>
bool isFinite(const RigidBodyState<Orientation>& body) {
  // A number that is not finite makes the sum so.
  const Vector3 sum = (body.p_WB + body.momentum_W) + body.angular_momentum_W;
  return std::isfinite((sum.x() + sum.y()) + sum.z()) && isRotation(body.orientation);
}

/// Chosen without a branch: in a planar craft half of the components are always 0.
inline void flushDenormals(Vector3& momentum) {
  for (int i = 0; i < 3; ++i) {
    momentum(i) = std::abs(momentum(i)) < kSettledMomentum ? 0.0 : momentum(i);
  }
}

/// Ends what drag left of the momenta before it becomes denormal numbers.
/// @returns false if the state is not finite.
template <class Orientation>
bool flushDenormals(RigidBodyState<Orientation>& body) {
  flushDenormals(body.momentum_W);
  flushDenormals(body.angular_momentum_W);
  return isFinite(body);
}

}  // namespace

std::string divergenceText(const std::string& body, Tick tick, double step) {
  return fmt::format(
      "{}: the motion diverges (it is not finite after tick {}): step_size = {} s is too long for "
      "these forces",
      body, tick, step);
}

Simulation::Simulation(Scenario scenario)
    : scenario_(std::move(scenario)),
      world_(worldOf(scenario_)),
      ground_(groundOf(scenario_)),
      bare_ground_(bareGroundOf(scenario_)) {
  const FloatingPointEnvironment environment;
  for (const VehicleScenario& vehicle : scenario_.vehicles) {
    engine_dynamics_.emplace_back(parametersOf(vehicle), scenario_.step_ns);
    fan_drives_.push_back(fanDrivesOf(vehicle));
  }
  inputs_.resize(world_.scene().bodies().size());
  for (StepInputs& inputs : inputs_) {
    inputs.environment.ground = ground_.get();
    inputs.environment.bare_ground = bare_ground_.get();
  }
  gusts_ = gustsOf(scenario_);
  sensors_ = sensorSuiteOf(scenario_);
  reset(scenario_.seed);
}

void Simulation::reset(std::int64_t seed) {
  const FloatingPointEnvironment environment;
  state_ = SimulationState();
  steady_until_.assign(engine_dynamics_.size(), 0);
  state_.seed = seed;
  for (const VehicleScenario& vehicle : scenario_.vehicles) {
    state_.engines.push_back(initialActuators(vehicle));
  }
  const auto start = [this](const VehicleScenario& body) {
    state_.bodies.push_back(initialState(scenario_, body, modelOf(state_.bodies.size()).mobility));
  };
  for (const VehicleScenario& vehicle : scenario_.vehicles) start(vehicle);
  if (scenario_.world) {
    for (const VehicleScenario& body : scenario_.world->bodies) start(body);
    world_.separateTouching(state_.bodies);
  }
  state_.wind_W = scenario_.wind;
  for (std::size_t body = 0; gusts_ && body < state_.bodies.size(); ++body) {
    state_.gusts.push_back(gusts_->start(body, seed));
  }
  refreshWind();
  if (sensors_) state_.sensors = sensors_->start(seed, state_.tick, sensedBodies());
}

void Simulation::restore(const SimulationState& state) {
  const FloatingPointEnvironment environment;
  demand(state.bodies.size() == inputs_.size() && state.engines.size() == vehicleCount(),
         "a state must come from the same scenario");
  demand(state.gusts.size() == (gusts_ ? inputs_.size() : 0) && state.wind_W.allFinite(),
         "what gusts remember must come from the same scenario");
  demand(!sensors_ || sensors_->fits(state.sensors, state.tick),
         "what sensors remember must come from the same scenario");
  state_ = state;
  steady_until_.assign(engine_dynamics_.size(), 0);
  refreshWind();
}

void Simulation::setMotion(std::size_t vehicle, const Vector3& p_WB, const Quaternion& q_WB,
                           const Twist& twist) {
  const FloatingPointEnvironment environment;
  demand(vehicle < vehicleCount(), "a motion must name a vehicle of the scenario");
  state_.bodies[vehicle] = placed(vehicle, p_WB, q_WB, twist);
  if (scenario_.world) {
    const auto index = static_cast<std::int32_t>(vehicle);
    auto& contacts = state_.contacts;
    contacts.erase(std::remove_if(contacts.begin(), contacts.end(),
                                  [index](const ContactCache& contact) {
                                    return contact.a == index || contact.b == index;
                                  }),
                   contacts.end());
    world_.separateTouching(state_.bodies, index);
  }
  if (!sensors_) return;
  sensors_->relocate(vehicle, state_.seed, state_.tick, sensedBodies(), state_.sensors);
}

/// The state of a craft that moves so, its rotors as they turn.
BodyState Simulation::placed(std::size_t vehicle, const Vector3& p_WB, const Quaternion& q_WB,
                             const Twist& twist) const {
  const HovercraftModel& model = modelOf(vehicle);
  const auto at = [&](const auto& orientation) -> BodyState {
    if (model.rotors.empty()) return model.mobility.stateOfMotion(p_WB, orientation, twist);
    return model.mobility.stateOfMotion(p_WB, orientation, twist, rotorsOf(vehicle));
  };
  if (scenario_.orientation == OrientationKind::kQuaternion) return at(renormalized(q_WB));
  return at(renormalized(rotationMatrix(q_WB)));
}

std::optional<WorldOverlap> Simulation::overlapAt(std::size_t vehicle, const Vector3& p_WB,
                                                  const Quaternion& q_WB) const {
  const FloatingPointEnvironment environment;
  if (!scenario_.world) return std::nullopt;
  std::vector<BodyState> states = state_.bodies;
  states.at(vehicle) = placed(vehicle, p_WB, q_WB, Twist());
  const auto index = static_cast<int>(vehicle);
  if (auto overlap = world_.overlap(states, index)) return overlap;
  world_.separateTouching(states, index);
  return world_.tooClose(states, index);
}

void Simulation::applyWrench(const ExternalWrench& wrench) {
  demand(wrench.vehicle < vehicleCount(), "a wrench must name a vehicle of the scenario");
  state_.wrenches.push_back(wrench);
}

void Simulation::endWrenches() {
  auto& wrenches = state_.wrenches;
  if (wrenches.empty()) return;
  wrenches.erase(std::remove_if(wrenches.begin(), wrenches.end(),
                                [this](const ExternalWrench& wrench) {
                                  return wrench.end_tick <= state_.tick;
                                }),
                 wrenches.end());
}

void Simulation::push(const Command& command) {
  demand(command.tick >= state_.tick, "a command must not lie in the past");
  demand(command.vehicle < vehicleCount(), "a command must name a vehicle of the scenario");
  demand(allFinite(command.thrusts), "a thrust must be checked before it becomes a command");
  demand(command.engines >> state_.engines[command.vehicle].size() == 0,
         "a command must be for actuators of the craft");
  state_.commands.push(command);
}

void Simulation::applyDueCommands() {
  while (const Command* command = state_.commands.takeDue(state_.tick)) {
    EngineStates& engines = state_.engines[command->vehicle];
    steady_until_[command->vehicle] = 0;
    for (std::size_t i = 0; i < engines.size(); ++i) {
      if ((command->engines & maskOf(i)) == 0) continue;
      EngineState& engine = engines[i];
      engine.commanded = command->thrusts[i];
      engine.command_tick = state_.tick;
    }
    if (observer_ != nullptr) observer_->applied(*command);
  }
}

/// What acts on each body in the step that begins now.
void Simulation::prepareInputs() {
  std::size_t vehicle = 0;
  for (const EngineStates& engines : state_.engines) {
    StepInputs& inputs = inputs_[vehicle];
    if (state_.tick >= steady_until_[vehicle]) {
      steady_until_[vehicle] =
          engine_dynamics_[vehicle].course(engines, state_.tick, inputs.thrusts);
      inputs.is_steady = steady_until_[vehicle] > state_.tick;
    }
    inputs.is_loaded = false;
    if (modelOf(vehicle).ground_forces != nullptr) turnFans(vehicle);
    ++vehicle;
  }
  for (const ExternalWrench& external : state_.wrenches) {
    StepInputs& inputs = inputs_[external.vehicle];
    if (!inputs.is_loaded) inputs.load = ExternalLoad();
    inputs.is_loaded = true;
    ExternalLoad& load = inputs.load;
    Wrench& sum = external.frame == ExternalWrench::Frame::kWorld ? load.in_world : load.in_body;
    sum = sum + external.wrench;
  }
}

void Simulation::failAsDiverged(std::size_t body) const {
  const char* const list = body < vehicleCount() ? "vehicles" : "world.bodies";
  throw std::runtime_error(
      divergenceText(fmt::format("{}.{}", list, world_.scene().bodies()[body].name), state_.tick,
                     scenario_.stepSize()));
}

void Simulation::step() {
  applyDueCommands();
  endWrenches();
  {
    // Read here, as the observer may have changed it, which finds that of the caller.
    const FloatingPointEnvironment environment;
    prepareInputs();
    const int lost = world_.step(inputs_, state_.bodies, state_.contacts, result_);
    if (lost != World::kNone) failAsDiverged(static_cast<std::size_t>(lost));
    takeResult();
  }
  ++state_.tick;
  if (gusts_) blow();
  if (observer_ != nullptr) {
    sortRecords();
    for (const ContactRecord& record : result_.records) observer_->contact(eventOf(record));
  }
  if (sensors_) readSensors();
}

/// Makes what the step ended with the state, if all of it is sound.
void Simulation::takeResult() {
  const bool bodies_meet = scenario_.world.has_value();
  std::size_t body = 0;
  for (BodyState& state : result_.states) {
    const bool is_finite = std::visit([](auto& moved) { return flushDenormals(moved); }, state);
    if (!is_finite) failAsDiverged(body);
    ++body;
  }
  state_.bodies.swap(result_.states);
  if (bodies_meet) state_.contacts.swap(result_.contacts);
  auto inputs = inputs_.cbegin();
  for (EngineStates& engines : state_.engines) {
    const ActuatorArray<double>& thrusts = (inputs++)->thrusts.end;
    for (std::size_t i = 0; i < engines.size(); ++i) engines[i].thrust = thrusts[i];
  }
}

void Simulation::sortRecords() {
  const FloatingPointEnvironment environment;
  // Few and nearly sorted; std::stable_sort would take memory.
  const auto is_earlier = [](const ContactRecord& x, const ContactRecord& y) {
    return x.time < y.time;
  };
  auto& records = result_.records;
  for (auto next = records.begin(); next != records.end(); ++next) {
    std::rotate(std::upper_bound(records.begin(), next, *next, is_earlier), next, next + 1);
  }
}

/// What the observer is told of a record of the step that just ended.
ContactEvent Simulation::eventOf(const ContactRecord& record) const {
  const FloatingPointEnvironment environment;
  const std::int64_t begin_ns = (state_.tick - 1) * scenario_.step_ns;
  ContactEvent event;
  event.kind = record.kind;
  event.time_ns = begin_ns + std::llround(record.time * static_cast<double>(kNanosecondsPerSecond));
  event.time = toSeconds(begin_ns) + record.time;
  event.tick = state_.tick;
  event.a = world_.scene().nameOf(record.a);
  event.b = world_.scene().nameOf(record.b);
  event.p_WC = record.p_WC;
  event.nhat_AB_W = record.nhat_AB_W;
  event.impulse_B_W = record.impulse_B_W;
  return event;
}

Motion Simulation::motion(std::size_t vehicle) const {
  const FloatingPointEnvironment environment;
  return motionOf(vehicle, state_.bodies[vehicle]);
}

Motion Simulation::motionAfterSetting(std::size_t vehicle, const Vector3& p_WB,
                                      const Quaternion& q_WB, const Twist& twist) const {
  const FloatingPointEnvironment environment;
  return motionOf(vehicle, placed(vehicle, p_WB, q_WB, twist));
}

Motion Simulation::bodyMotion(std::size_t body) const {
  const FloatingPointEnvironment environment;
  return motionOf(vehicleCount() + body, state_.bodies[vehicleCount() + body]);
}

EngineReport Simulation::engineReport(std::size_t vehicle, int engine) const {
  const FloatingPointEnvironment environment;
  const EngineState& state = state_.engines[vehicle][static_cast<std::size_t>(engine)];
  const EngineDynamics& dynamics = engine_dynamics_[vehicle];
  const std::int64_t age_ns = dynamics.commandAge(state, state_.tick);
  return {state.commanded,
          state.thrust,
          dynamics.isSaturated(engine, state),
          dynamics.isTimedOut(engine, state, state_.tick),
          age_ns < 0 ? -1.0 : toSeconds(age_ns),
          state.efficiency,
          state.stuck};
}

std::uint64_t Simulation::hash(std::size_t vehicle) const {
  StateHash hash;
  hash.add(state_.tick);
  hash.add(state_.bodies[vehicle]);
  hash.add(state_.engines[vehicle]);
  for (const ExternalWrench& wrench : state_.wrenches) {
    if (wrench.vehicle == vehicle) hash.add(wrench);
  }
  addAir(hash, vehicle, vehicle + 1);
  addFaults(hash, vehicle, vehicle + 1);
  return hash.value();
}

std::uint64_t Simulation::hash() const {
  StateHash hash;
  hash.add(state_.tick);
  for (std::size_t i = 0; i < vehicleCount(); ++i) {
    hash.add(state_.bodies[i]);
    hash.add(state_.engines[i]);
  }
  for (const ExternalWrench& wrench : state_.wrenches) hash.add(wrench);
  for (std::size_t i = vehicleCount(); i < state_.bodies.size(); ++i) hash.add(state_.bodies[i]);
  for (const ContactCache& contact : state_.contacts) hash.add(contact);
  addAir(hash, 0, state_.bodies.size());
  addFaults(hash, 0, vehicleCount());
  return hash.value();
}

}  // namespace hovercraft
