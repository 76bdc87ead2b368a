#include "hovercraft_sim/sim/simulation.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/body/steppers.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/sim/state_hash.h"

namespace hovercraft {
namespace {

HovercraftModel modelOf(const Scenario& scenario, const VehicleScenario& vehicle) {
  const MassProperties& body = vehicle.mass_properties;
  const Mobility mobility = scenario.model == BodyModel::kPlanar
                                ? Mobility::planar(body.mass, body.I_BBo_B)
                                : Mobility::spatial(body.mass, body.I_BBo_B);
  return {mobility, EngineGeometry(vehicle.engines, body.p_HB), vehicle.drag,
          body.mass * scenario.gravity, scenario.wind};
}

BodyState initialState(const Scenario& scenario, const VehicleScenario& vehicle,
                       const Mobility& mobility) {
  const Twist twist = {vehicle.initial_v_WB, vehicle.initial_w_WB};
  if (scenario.orientation == OrientationKind::kQuaternion) {
    return mobility.stateOfMotion(vehicle.initial_p_WB, quaternionFromRpy(vehicle.initial_rpy),
                                  twist);
  }
  return mobility.stateOfMotion(vehicle.initial_p_WB, rotationFromRpy(vehicle.initial_rpy), twist);
}

bool isRotation(const Quaternion& q_WB) {
  // Components beyond 1e154 have an infinite norm, and end as 0 when they are divided by it.
  return std::abs(squaredNorm(q_WB) - 1.0) < kUnitLength;
}
bool isRotation(const Matrix3& /*R_WB*/) {
  return true;  // nearestRotation() returns nothing else
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

/// Ends what drag left of a momentum before it becomes a denormal number.
void settle(Vector3& momentum) {
  for (int i = 0; i < 3; ++i) {
    if (std::abs(momentum(i)) < kSettledMomentum) momentum(i) = 0.0;
  }
}

}  // namespace

Simulation::Simulation(Scenario scenario)
    : scenario_(std::move(scenario)), h_(scenario_.stepSize()) {
  for (const VehicleScenario& vehicle : scenario_.vehicles) {
    models_.push_back(modelOf(scenario_, vehicle));
    engine_dynamics_.emplace_back(vehicle.engines, scenario_.step_ns);
  }
  reset(scenario_.seed);
}

void Simulation::reset(std::int64_t seed) {
  state_ = SimulationState();
  state_.seed = seed;
  for (std::size_t i = 0; i < models_.size(); ++i) {
    state_.vehicles.push_back(
        {initialState(scenario_, scenario_.vehicles[i], models_[i].mobility), {}});
  }
  commands_ = CommandLog();
}

void Simulation::restore(const SimulationState& state) {
  demand(state.vehicles.size() == models_.size(), "a state must come from the same scenario");
  state_ = state;
  commands_ = CommandLog();
}

void Simulation::setMotion(std::size_t vehicle, const Vector3& p_WB, const Quaternion& q_WB,
                           const Twist& twist) {
  const Mobility& mobility = models_.at(vehicle).mobility;
  BodyState& body = state_.vehicles[vehicle].body;
  if (scenario_.orientation == OrientationKind::kQuaternion) {
    body = mobility.stateOfMotion(p_WB, renormalized(q_WB), twist);
  } else {
    body = mobility.stateOfMotion(p_WB, renormalized(rotationMatrix(q_WB)), twist);
  }
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
  commands_.push(command);
}

void Simulation::applyDueCommands() {
  while (const Command* command = commands_.takeDue(state_.tick)) {
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

void Simulation::stepVehicle(std::size_t vehicle) {
  VehicleState& state = state_.vehicles[vehicle];
  const ThrustCourse thrusts = engine_dynamics_[vehicle].course(state.engines, state_.tick);
  ExternalLoad load;
  const bool is_pushed = sumWrenches(state_.wrenches, vehicle, load);
  const DrivenHovercraft system = {models_[vehicle], thrusts, is_pushed ? &load : nullptr};
  std::visit(
      [&](auto& body) {
        body = integrationStep(scenario_.integrator, body, system, h_);
        settle(body.momentum_W);
        settle(body.angular_momentum_W);
        if (!isSound(body)) failAsDiverged(vehicle);
      },
      state.body);
  for (int i = 0; i < kEngineCount; ++i) {
    state.engines[static_cast<std::size_t>(i)].thrust = thrusts.end[i];
  }
}

void Simulation::failAsDiverged(std::size_t vehicle) const {
  throw std::runtime_error(fmt::format(
      "vehicles.{}: the motion diverges (it is not finite after tick {}): step_size = {} s is too "
      "long for these forces",
      scenario_.vehicles[vehicle].name, state_.tick, h_));
}

void Simulation::step() {
  applyDueCommands();
  endWrenches();
  for (std::size_t vehicle = 0; vehicle < state_.vehicles.size(); ++vehicle) stepVehicle(vehicle);
  ++state_.tick;
}

Motion Simulation::motion(std::size_t vehicle) const {
  const HovercraftModel& model = models_[vehicle];
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
      state_.vehicles[vehicle].body);
}

EngineReport Simulation::engineReport(std::size_t vehicle, int engine) const {
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
  return hash.value();
}

}  // namespace hovercraft
