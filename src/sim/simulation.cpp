#include "hovercraft_sim/sim/simulation.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/body/steppers.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/sim/sensor_builder.h"
#include "hovercraft_sim/sim/state_hash.h"
#include "hovercraft_sim/sim/world_builder.h"

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
bool isSound(const RigidBodyState<Orientation>& body) {
  // A number that is not finite makes the sum so.
  const Vector3 sum = (body.p_WB + body.momentum_W) + body.angular_momentum_W;
  return std::isfinite((sum.x() + sum.y()) + sum.z()) && isRotation(body.orientation);
}

/// The wrenches on one craft, each added up in its frame; false if there are none.
bool sumWrenches(const std::vector<ExternalWrench>& wrenches, std::size_t vehicle,
                 ExternalLoad& load) {
  bool any = false;
  for (const ExternalWrench& external : wrenches) {
    if (external.vehicle != vehicle) continue;
    any = true;
    Wrench& sum = external.frame == ExternalWrench::Frame::kWorld ? load.in_world : load.in_body;
    sum = sum + external.wrench;
  }
  return any;
}

/// Ends what drag left of the momenta before it becomes denormal numbers.
/// @returns false if the state is not finite.
template <class Orientation>
bool settle(RigidBodyState<Orientation>& body) {
  for (Vector3* momentum : {&body.momentum_W, &body.angular_momentum_W}) {
    for (int i = 0; i < 3; ++i) {
      if (std::abs((*momentum)(i)) < kSettledMomentum) (*momentum)(i) = 0.0;
    }
  }
  return isSound(body);
}

}  // namespace

Simulation::Simulation(Scenario scenario) : scenario_(std::move(scenario)) {
  const FloatingPointEnvironment environment;
  h_ = scenario_.stepSize();
  for (const VehicleScenario& vehicle : scenario_.vehicles) {
    models_.push_back(modelOf(scenario_, vehicle));
    engine_dynamics_.emplace_back(vehicle.engines, scenario_.step_ns);
  }
  if (scenario_.world) {
    world_.emplace(worldOf(scenario_));
    drives_.resize(world_->bodies().size());
  }
  sensors_ = sensorSuiteOf(scenario_);
  before_.reserve(models_.size());
  reset(scenario_.seed);
}

void Simulation::reset(std::int64_t seed) {
  const FloatingPointEnvironment environment;
  state_ = SimulationState();
  state_.seed = seed;
  for (std::size_t i = 0; i < models_.size(); ++i) {
    state_.vehicles.push_back(
        {initialState(scenario_, scenario_.vehicles[i], models_[i].mobility), {}});
  }
  if (world_) {
    for (std::size_t i = 0; i < scenario_.world->bodies.size(); ++i) {
      const Mobility& mobility = world_->bodies()[models_.size() + i].model.mobility;
      state_.bodies.push_back(initialState(scenario_, scenario_.world->bodies[i], mobility));
    }
    partTouching(-1);
  }
  startSensors();
}

void Simulation::restore(const SimulationState& state) {
  demand(state.vehicles.size() == models_.size() &&
             state.bodies.size() == (world_ ? scenario_.world->bodies.size() : 0),
         "a state must come from the same scenario");
  demand(!sensors_ || sensors_->fits(state.sensors, state.tick),
         "what sensors remember must come from the same scenario");
  state_ = state;
}

void Simulation::setMotion(std::size_t vehicle, const Vector3& p_WB, const Quaternion& q_WB,
                           const Twist& twist) {
  const FloatingPointEnvironment environment;
  state_.vehicles.at(vehicle).body = placed(p_WB, q_WB, twist, models_[vehicle].mobility);
  if (world_) {
    const auto index = static_cast<std::int32_t>(vehicle);
    auto& contacts = state_.contacts;
    contacts.erase(std::remove_if(contacts.begin(), contacts.end(),
                                  [index](const ContactMemory& contact) {
                                    return contact.a == index || contact.b == index;
                                  }),
                   contacts.end());
    partTouching(index);
  }
  relocateSensors(vehicle);
}

BodyState Simulation::placed(const Vector3& p_WB, const Quaternion& q_WB, const Twist& twist,
                             const Mobility& mobility) const {
  if (scenario_.orientation == OrientationKind::kQuaternion) {
    return mobility.stateOfMotion(p_WB, renormalized(q_WB), twist);
  }
  return mobility.stateOfMotion(p_WB, renormalized(rotationMatrix(q_WB)), twist);
}

std::optional<WorldOverlap> Simulation::overlapAt(std::size_t vehicle, const Vector3& p_WB,
                                                  const Quaternion& q_WB) const {
  const FloatingPointEnvironment environment;
  if (!world_) return std::nullopt;
  std::vector<BodyState> states = worldStates();
  states.at(vehicle) = placed(p_WB, q_WB, Twist(), models_[vehicle].mobility);
  const auto index = static_cast<int>(vehicle);
  if (auto overlap = world_->overlap(states, index)) return overlap;
  world_->partTouching(states, index);
  return world_->squeezed(states, index);
}

std::vector<BodyState> Simulation::worldStates() const {
  std::vector<BodyState> states;
  states.reserve(state_.vehicles.size() + state_.bodies.size());
  for (const VehicleState& vehicle : state_.vehicles) states.push_back(vehicle.body);
  states.insert(states.end(), state_.bodies.begin(), state_.bodies.end());
  return states;
}

/// Sets bodies that were put where they touch apart by half the tolerance. @param body -1: all.
void Simulation::partTouching(int body) {
  std::vector<BodyState> states = worldStates();
  world_->partTouching(states, body);
  const std::size_t count = state_.vehicles.size();
  for (std::size_t i = 0; i < count; ++i) state_.vehicles[i].body = states[i];
  for (std::size_t i = count; i < states.size(); ++i) state_.bodies[i - count] = states[i];
}

void Simulation::applyWrench(const ExternalWrench& wrench) {
  demand(wrench.vehicle < models_.size(), "a wrench must name a vehicle of the scenario");
  state_.wrenches.push_back(wrench);
}

void Simulation::endWrenches() {
  auto& wrenches = state_.wrenches;
  wrenches.erase(std::remove_if(wrenches.begin(), wrenches.end(),
                                [this](const ExternalWrench& wrench) {
                                  return wrench.end_tick <= state_.tick;
                                }),
                 wrenches.end());
}

void Simulation::push(const Command& command) {
  demand(command.tick >= state_.tick, "a command must not lie in the past");
  demand(command.vehicle < state_.vehicles.size(), "a command must name a vehicle of the scenario");
  demand(command.thrusts.allFinite(), "a thrust must be checked before it becomes a command");
  state_.commands.push(command);
}

void Simulation::applyDueCommands() {
  while (const Command* command = state_.commands.takeDue(state_.tick)) {
    EngineStates& engines = state_.vehicles[command->vehicle].engines;
    for (int i = 0; i < kEngineCount; ++i) {
      if ((command->engines & maskOf(static_cast<EngineId>(i))) == 0) continue;
      EngineState& engine = engines[static_cast<std::size_t>(i)];
      engine.commanded = command->thrusts[i];
      engine.command_tick = state_.tick;
    }
    if (on_applied) on_applied(*command);
  }
}

/// Each craft by itself. If one diverges, those before it go back.
void Simulation::stepVehicles() {
  if (state_.vehicles.size() > 1) before_ = state_.vehicles;
  for (std::size_t vehicle = 0; vehicle < state_.vehicles.size(); ++vehicle) {
    if (stepVehicle(vehicle)) continue;
    if (vehicle > 0) state_.vehicles.swap(before_);
    failAsDiverged("vehicles", scenario_.vehicles[vehicle].name);
  }
}

/// @returns false, and nothing has changed, if the motion would not be finite.
bool Simulation::stepVehicle(std::size_t vehicle) {
  VehicleState& state = state_.vehicles[vehicle];
  const ThrustCourse thrusts = engine_dynamics_[vehicle].course(state.engines, state_.tick);
  ExternalLoad load;
  const bool is_pushed = sumWrenches(state_.wrenches, vehicle, load);
  const DrivenHovercraft system = {models_[vehicle], thrusts, is_pushed ? &load : nullptr};
  const bool is_sound = std::visit(
      [&](auto& body) {
        auto next =
            integrationStep<decltype(body.orientation)>(scenario_.integrator, body, system, h_);
        if (!settle(next)) return false;
        body = next;
        return true;
      },
      state.body);
  if (is_sound) takeThrusts(vehicle, thrusts);
  return is_sound;
}

void Simulation::takeThrusts(std::size_t vehicle, const ThrustCourse& thrusts) {
  for (int i = 0; i < kEngineCount; ++i) {
    state_.vehicles[vehicle].engines[static_cast<std::size_t>(i)].thrust = thrusts.end[i];
  }
}

void Simulation::failAsDiverged(const char* kind, const std::string& name) const {
  throw std::runtime_error(fmt::format(
      "{}.{}: the motion diverges (it is not finite after tick {}): step_size = {} s is too "
      "long for these forces",
      kind, name, state_.tick, h_));
}

void Simulation::step() {
  applyDueCommands();
  endWrenches();
  {
    // Read here, as on_applied may have changed it; the callbacks find that of the caller.
    const FloatingPointEnvironment environment;
    if (world_) {
      stepWorld();
    } else {
      stepVehicles();
    }
  }
  ++state_.tick;
  if (world_ && on_contact) {
    sortRecords();
    for (const ContactRecord& record : records_) on_contact(eventOf(record));
  }
  if (sensors_) readSensors();
}

void Simulation::stepWorld() {
  const std::size_t count = state_.vehicles.size();
  moving_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    BodyDrive& drive = drives_[i];
    drive.thrusts = engine_dynamics_[i].course(state_.vehicles[i].engines, state_.tick);
    drive.load = ExternalLoad();
    drive.is_pushed = sumWrenches(state_.wrenches, i, drive.load);
    moving_.push_back(state_.vehicles[i].body);
  }
  moving_.insert(moving_.end(), state_.bodies.begin(), state_.bodies.end());
  records_.clear();
  contacts_ = state_.contacts;
  const auto fail = [this, count](std::size_t body) {
    failAsDiverged(body < count ? "vehicles" : "world.bodies",
                   world_->nameOf(static_cast<std::int32_t>(body)));
  };
  const int lost = world_->step(drives_, moving_, contacts_, records_);
  if (lost != World::kNone) fail(static_cast<std::size_t>(lost));
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    const bool is_sound = std::visit([](auto& body) { return settle(body); }, moving_[i]);
    if (!is_sound || !isInReach(moving_[i])) fail(i);
  }
  for (std::size_t i = 0; i < count; ++i) {
    state_.vehicles[i].body = moving_[i];
    takeThrusts(i, drives_[i].thrusts);
  }
  std::copy(moving_.begin() + static_cast<std::ptrdiff_t>(count), moving_.end(),
            state_.bodies.begin());
  state_.contacts.swap(contacts_);
}

void Simulation::sortRecords() {
  const FloatingPointEnvironment environment;
  // Few and nearly sorted; std::stable_sort would take memory.
  const auto is_earlier = [](const ContactRecord& x, const ContactRecord& y) {
    return x.time < y.time;
  };
  for (auto next = records_.begin(); next != records_.end(); ++next) {
    std::rotate(std::upper_bound(records_.begin(), next, *next, is_earlier), next, next + 1);
  }
}

/// What on_contact is told of a record of the step that just ended.
ContactEvent Simulation::eventOf(const ContactRecord& record) const {
  const FloatingPointEnvironment environment;
  const std::int64_t begin_ns = (state_.tick - 1) * scenario_.step_ns;
  ContactEvent event;
  event.kind = record.kind;
  event.time_ns = begin_ns + std::llround(record.time * static_cast<double>(kNanosecondsPerSecond));
  event.time = toSeconds(begin_ns) + record.time;
  event.tick = state_.tick;
  event.a = world_->nameOf(record.a);
  event.b = world_->nameOf(record.b);
  event.p_WC = record.p_WC;
  event.nhat_AB_W = record.nhat_AB_W;
  event.impulse_B_W = record.impulse_B_W;
  return event;
}

namespace {

Motion motionOf(const HovercraftModel& model, const BodyState& state) {
  return std::visit(
      [&](const auto& body) -> Motion {
        const double potential = -dot(model.weight_W, body.p_WB);
        return {body.p_WB,
                toQuaternion(body.orientation),
                model.mobility.twist(body),
                body.momentum_W,
                body.angular_momentum_W,
                kineticEnergy(body, model.mobility) + potential};
      },
      state);
}

}  // namespace

Motion Simulation::motion(std::size_t vehicle) const {
  const FloatingPointEnvironment environment;
  return motionOf(models_[vehicle], state_.vehicles[vehicle].body);
}

Motion Simulation::motionAfterSetting(std::size_t vehicle, const Vector3& p_WB,
                                      const Quaternion& q_WB, const Twist& twist) const {
  const FloatingPointEnvironment environment;
  const HovercraftModel& model = models_.at(vehicle);
  return motionOf(model, placed(p_WB, q_WB, twist, model.mobility));
}

Motion Simulation::bodyMotion(std::size_t body) const {
  const FloatingPointEnvironment environment;
  return motionOf(world_->bodies()[models_.size() + body].model, state_.bodies[body]);
}

EngineReport Simulation::engineReport(std::size_t vehicle, int engine) const {
  const FloatingPointEnvironment environment;
  const EngineState& state = state_.vehicles[vehicle].engines[static_cast<std::size_t>(engine)];
  const EngineDynamics& dynamics = engine_dynamics_[vehicle];
  const std::int64_t age_ns = dynamics.commandAge(state, state_.tick);
  return {state.commanded, state.thrust, dynamics.isSaturated(engine, state),
          dynamics.isTimedOut(engine, state, state_.tick), age_ns < 0 ? -1.0 : toSeconds(age_ns)};
}

std::uint64_t Simulation::hash(std::size_t vehicle) const {
  StateHash hash;
  hash.add(state_.tick);
  hash.add(state_.vehicles[vehicle]);
  for (const ExternalWrench& wrench : state_.wrenches) {
    if (wrench.vehicle == vehicle) hash.add(wrench);
  }
  return hash.value();
}

std::uint64_t Simulation::hash() const {
  StateHash hash;
  hash.add(state_.tick);
  for (const VehicleState& state : state_.vehicles) hash.add(state);
  for (const ExternalWrench& wrench : state_.wrenches) hash.add(wrench);
  for (const BodyState& body : state_.bodies) hash.add(body);
  for (const ContactMemory& contact : state_.contacts) hash.add(contact);
  return hash.value();
}

}  // namespace hovercraft
