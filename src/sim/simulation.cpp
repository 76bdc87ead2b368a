#include "hovercraft_sim/sim/simulation.h"

#include <cmath>
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

}  // namespace

Simulation::Simulation(Scenario scenario)
    : scenario_(std::move(scenario)), h_(scenario_.stepSize()) {
  for (const VehicleScenario& vehicle : scenario_.vehicles) {
    models_.push_back(modelOf(scenario_, vehicle));
    engine_dynamics_.emplace_back(vehicle.engines, scenario_.step_ns);
    states_.push_back({initialState(scenario_, vehicle, models_.back().mobility), {}});
  }
}

void Simulation::push(const Command& command) {
  demand(command.tick >= tick_, "a command must not lie in the past");
  demand(command.vehicle < states_.size(), "a command must name a vehicle of the scenario");
  demand(command.thrusts.allFinite(), "a thrust must be checked before it becomes a command");
  commands_.push(command);
}

void Simulation::applyDueCommands() {
  while (const Command* command = commands_.takeDue(tick_)) {
    EngineStates& engines = states_[command->vehicle].engines;
    for (int i = 0; i < kEngineCount; ++i) {
      if ((command->engines & maskOf(static_cast<EngineId>(i))) == 0) continue;
      EngineState& engine = engines[static_cast<std::size_t>(i)];
      engine.commanded = command->thrusts[i];
      engine.command_tick = tick_;
    }
    if (on_applied) on_applied(*command);
  }
}

void Simulation::stepVehicle(std::size_t vehicle) {
  VehicleState& state = states_[vehicle];
  const ThrustCourse thrusts = engine_dynamics_[vehicle].course(state.engines, tick_);
  const DrivenHovercraft system = {models_[vehicle], thrusts};
  std::visit(
      [&](auto& body) {
        body = integrationStep(scenario_.integrator, body, system, h_);
        demand(isSound(body), "a state is not finite after a step; the step size is too long");
      },
      state.body);
  for (int i = 0; i < kEngineCount; ++i) {
    state.engines[static_cast<std::size_t>(i)].thrust = thrusts.end[i];
  }
}

void Simulation::step() {
  applyDueCommands();
  for (std::size_t vehicle = 0; vehicle < states_.size(); ++vehicle) stepVehicle(vehicle);
  ++tick_;
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
      states_[vehicle].body);
}

EngineReport Simulation::engineReport(std::size_t vehicle, int engine) const {
  const EngineState& state = states_[vehicle].engines[static_cast<std::size_t>(engine)];
  const EngineDynamics& dynamics = engine_dynamics_[vehicle];
  const std::int64_t age_ns = dynamics.commandAge(state, tick_);
  return {state.commanded, state.thrust, dynamics.isSaturated(engine, state),
          dynamics.isTimedOut(engine, state, tick_), age_ns < 0 ? -1.0 : toSeconds(age_ns)};
}

std::uint64_t Simulation::hash(std::size_t vehicle) const {
  StateHash hash;
  hash.add(tick_);
  hash.add(states_[vehicle]);
  return hash.value();
}

std::uint64_t Simulation::hash() const {
  StateHash hash;
  hash.add(tick_);
  for (const VehicleState& state : states_) hash.add(state);
  return hash.value();
}

}  // namespace hovercraft
