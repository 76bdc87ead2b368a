#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>

#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/command_log.h"

namespace hovercraft::testing {

/// Scenarios of one random craft each: three engines with limits, lag (some without), time-outs
/// (some never), drag of every kind, gravity, wind; and random commands. The numbers come from a
/// seed.
class RandomCraft {
 public:
  RandomCraft(Integrator integrator, BodyModel model, std::uint32_t seed)
      : random_(seed), integrator_(integrator), model_(model), seed_(seed) {}

  /// The craft get fans, propellers, rudders, a polar, rotors and commands by shares and tables.
  RandomCraft& withActuators() {
    has_actuators_ = true;
    return *this;
  }
  RandomCraft& withGusts() {
    has_gusts_ = true;
    return *this;
  }

  std::string name() const {
    return std::string(model_ == BodyModel::kPlanar ? "planar" : "spatial") + ", integrator " +
           std::to_string(static_cast<int>(integrator_)) + ", seed " + std::to_string(seed_);
  }

  double uniform(double least, double most) {
    return least + (most - least) * (static_cast<double>(random_()) / 4294967296.0);
  }
  bool chance(double share) { return uniform(0.0, 1.0) < share; }

  Scenario scenario() {
    Scenario scenario;
    scenario.step_ns = 1000000;
    scenario.integrator = integrator_;
    scenario.model = model_;
    scenario.gravity = chance(0.5) ? Vector3(Vector3::Zero()) : Vector3(0.0, 0.0, -9.81);
    scenario.wind = vector(2.0);
    scenario.seed = static_cast<std::int64_t>(random_());
    scenario.vehicles.push_back(craft());
    if (has_gusts_) {
      scenario.gusts = GustParameters();
      scenario.gusts->model = chance(0.5) ? GustModel::kDryden : GustModel::kFirstOrder;
      scenario.gusts->along = {uniform(0.1, 1.0), uniform(1.0, 20.0)};
      scenario.gusts->across = {chance(0.3) ? 0.0 : uniform(0.1, 1.0), uniform(1.0, 20.0)};
      scenario.gusts->vertical = {uniform(0.1, 1.0), uniform(1.0, 20.0)};
    }
    return scenario;
  }

  /// Of some ticks: to some of the actuators, often beyond their limits.
  std::optional<Command> command(Tick tick) {
    if (!chance(0.03)) return std::nullopt;
    const EngineMask all = has_actuators_ ? (1U << (kFirstActuator + kMoreActuators)) - 1U
                                          : static_cast<unsigned>(kAllEngines);
    Command command = {tick, 0, static_cast<EngineMask>(1 + random_() % all), {}};
    command.thrusts.resize(has_actuators_ ? kFirstActuator + kMoreActuators : kFirstActuator);
    for (double& thrust : command.thrusts) thrust = uniform(-3.0, 6.0);
    return command;
  }

 private:
  static constexpr std::size_t kMoreActuators = 5;

  Vector3 vector(double most) {
    const double x = uniform(-most, most);
    const double y = uniform(-most, most);
    return {x, y, uniform(-most, most)};
  }
  /// Some of them 0.
  Vector3 positive(double most) {
    Vector3 v;
    for (int i = 0; i < 3; ++i) v[i] = chance(0.2) ? 0.0 : uniform(0.0, most);
    return v;
  }
  Vector3 direction() {
    const Vector3 v = vector(1.0);
    return norm(v) > 0.1 ? Vector3(v / norm(v)) : Vector3::UnitX();
  }

  EngineParameters engine() {
    EngineParameters engine;
    engine.p_HE = vector(0.4);
    engine.direction = direction();
    engine.min_thrust = chance(0.5) ? 0.0 : -uniform(0.0, 1.0);
    engine.max_thrust = uniform(0.5, 5.0);
    engine.time_constant = chance(0.3) ? 0.0 : uniform(0.001, 0.2);
    engine.timeout_ns = chance(0.3) ? 0 : 1000 * static_cast<std::int64_t>(uniform(1e3, 1e5));
    if (!has_actuators_) return engine;
    if (chance(0.4)) engine.command.unit = CommandUnit::kNormalized;
    if (chance(0.4)) engine.command.table = {{-1.0, -0.5}, {0.2, 0.1}, {uniform(0.5, 2.0), 3.0}};
    engine.rotor = {uniform(1e-4, 1e-3), uniform(100.0, 900.0), chance(0.5) ? 1.0 : -1.0};
    return engine;
  }

  ActuatorScenario actuator(const char* name, ActuatorKind kind, const char* fan = "") {
    ActuatorScenario actuator;
    actuator.name = name;
    actuator.kind = kind;
    actuator.motion = engine();
    actuator.initial = uniform(0.0, 0.4);
    actuator.free_speed = chance(0.3) ? 0.0 : uniform(2.0, 20.0);
    actuator.diameter = uniform(0.5, 1.2);
    actuator.thrust_coefficients = vector(0.5);
    actuator.torque_coefficients = vector(0.1);
    actuator.fan = fan;
    actuator.hinge = direction();
    actuator.area = uniform(0.01, 0.05);
    actuator.lift_slope = uniform(1.0, 5.0);
    actuator.drag_at_rest = uniform(0.0, 0.1);
    actuator.drag_growth = uniform(0.0, 1.0);
    return actuator;
  }

  DragPolar polar() {
    DragPolar polar;
    polar.area_x = uniform(0.1, 0.5);
    polar.area_y = uniform(0.1, 0.5);
    polar.length = uniform(0.3, 1.0);
    for (auto* terms : {&polar.surge, &polar.sway, &polar.yaw}) {
      for (double& term : *terms) term = uniform(-0.5, 0.5);
    }
    return polar;
  }

  VehicleScenario craft() {
    VehicleScenario craft;
    craft.name = "craft";
    craft.mass_properties.mass = uniform(1.0, 9.0);
    craft.mass_properties.p_HB = vector(0.05);
    const double xy = uniform(-0.01, 0.01);
    const double xz = uniform(-0.01, 0.01);
    const double xx = uniform(0.08, 0.1);
    const double yy = uniform(0.1, 0.12);
    craft.mass_properties.I_BBo_B << xx, xy, xz,  //
        xy, yy, 0.003,                            //
        xz, 0.003, uniform(0.12, 0.15);
    for (EngineParameters& one : craft.engines) one = engine();
    craft.drag.linear = positive(2.0);
    craft.drag.quadratic = positive(2.0);
    craft.drag.angular_linear = positive(0.2);
    craft.drag.angular_quadratic = positive(0.2);
    craft.initial_p_WB = vector(10.0);
    craft.initial_rpy = vector(1.5);
    craft.initial_v_WB = vector(3.0);
    craft.initial_w_WB = vector(2.0);
    if (model_ == BodyModel::kPlanar) {
      craft.initial_p_WB.z() = craft.initial_rpy.x() = craft.initial_rpy.y() = 0.0;
      craft.initial_v_WB.z() = craft.initial_w_WB.x() = craft.initial_w_WB.y() = 0.0;
    }
    if (has_actuators_) {
      craft.drag_laws = {polar()};
      craft.actuators = {actuator("a", ActuatorKind::kFan), actuator("b", ActuatorKind::kPropeller),
                         actuator("c", ActuatorKind::kRudder, "a"),
                         actuator("d", ActuatorKind::kRudder, "b"),
                         actuator("e", ActuatorKind::kRudder)};
    }
    return craft;
  }

  std::mt19937 random_;
  Integrator integrator_;
  BodyModel model_;
  std::uint32_t seed_;
  bool has_actuators_ = false;
  bool has_gusts_ = false;
};

}  // namespace hovercraft::testing
