#include "hovercraft_sim/sim/batch_builder.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

#include "hovercraft_sim/hovercraft/planar_step.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/sim/batch_ground.h"

namespace hovercraft {
namespace {

using lanes::ForceKind;
using lanes::Row;

static_assert(PlanarCraft::kLargest == lanes::kMostOfPlanar, "one bound, in two rooms");

void refuse(bool is_there, const std::string& key, const std::string& rule) {
  if (is_there) throw std::invalid_argument(fmt::format("{}: {}", key, rule));
}

/// What Batch is not for.
void requireBatchable(const Scenario& scenario) {
  refuse(scenario.world.has_value(), "world", "a batch has craft that meet nothing: must not be");
  refuse(scenario.vehicles.size() != 1, "vehicles", "a run of a batch must have one craft");
  const VehicleScenario& craft = scenario.vehicles.front();
  const std::string key = "vehicles." + craft.name;
  requireBatchableGround(scenario);
  refuse(!craft.sensors.empty(), key + ".sensors", "a batch reads no sensors: must not be");
  refuse(scenario.orientation != OrientationKind::kQuaternion, "orientation",
         "must be quaternion in a batch");
}

lanes::Method methodOf(Integrator integrator) {
  switch (integrator) {
    case Integrator::kEuler:
      return lanes::Method::kEuler;
    case Integrator::kSemiImplicitEuler:
      return lanes::Method::kSemiImplicitEuler;
    case Integrator::kHeun:
      return lanes::Method::kHeun;
    case Integrator::kRungeKutta4:
      return lanes::Method::kRungeKutta4;
    case Integrator::kLie4:
      return lanes::Method::kLie4;
  }
  demand(false, "a batch must be of a method that it has");
  return lanes::Method::kHeun;
}

/// Writes numbers of one lane into rows, one below the other.
class LaneWriter {
 public:
  /// @param end of the lanes that get them; those behind the first have no run yet.
  LaneWriter(Row* rows, std::size_t lane, std::size_t end) : row_(rows), lane_(lane), end_(end) {}
  LaneWriter(Row* rows, std::size_t lane) : LaneWriter(rows, lane, lane + 1) {}

  void number(double value) {
    std::fill(row_->of + lane_, row_->of + end_, value);
    ++row_;
  }
  void vector(const Vector3& v) {
    for (int i = 0; i < 3; ++i) number(v[i]);
  }
  void matrix(const Matrix3& A) {
    for (int column = 0; column < 3; ++column) vector(Vector3(A.col(column)));
  }

 private:
  Row* row_;
  std::size_t lane_;
  std::size_t end_;
};

/// A force as a step of a plan, and the numbers of one, in one order. One kind is one function here
/// and one in lanes/lane_forces.h.
class ForceNumbers {
 public:
  std::vector<double> numbers;

  lanes::ForceStep operator()(const FanForce& fan) {
    place(fan.place);
    numbers.push_back(fan.inverse_free_speed);
    return {ForceKind::kFan, ForceKind::kNone, fan.id, 0, 0};
  }
  lanes::ForceStep operator()(const PropellerForce& propeller) {
    place(propeller.place);
    for (const double number :
         {propeller.diameter, propeller.thrust_scale, propeller.torque_scale}) {
      numbers.push_back(number);
    }
    vector(propeller.thrust_coefficients);
    vector(propeller.torque_coefficients);
    return {ForceKind::kPropeller, ForceKind::kNone, propeller.id, 0, 0};
  }
  lanes::ForceStep operator()(const RudderForce& rudder) {
    place(rudder.place);
    vector(rudder.across);
    for (const double number : {rudder.half_density_area, rudder.lift_slope, rudder.drag_at_rest,
                                rudder.drag_growth, rudder.inverse_density_disc}) {
      numbers.push_back(number);
    }
    lanes::ForceStep fan;
    if (const auto* found = std::get_if<FanForce>(&rudder.fan)) fan = (*this)(*found);
    if (const auto* found = std::get_if<PropellerForce>(&rudder.fan)) fan = (*this)(*found);
    return {ForceKind::kRudder, fan.kind, rudder.id, fan.id, 0};
  }
  lanes::ForceStep operator()(const DragForce& force) { return std::visit(*this, force.law); }
  lanes::ForceStep operator()(const DragPolar& polar) {
    for (const double number : {polar.air_density, polar.area_x, polar.area_y, polar.length}) {
      numbers.push_back(number);
    }
    for (const auto* terms : {&polar.surge, &polar.sway, &polar.yaw}) {
      numbers.insert(numbers.end(), terms->begin(), terms->end());
    }
    return {ForceKind::kPolar, ForceKind::kNone, 0, 0, 0};
  }
  /// Any other kind. @throws std::invalid_argument
  template <class Other>
  lanes::ForceStep operator()(const Other& /*force*/) {
    throw std::invalid_argument("vehicles: a craft has a force that a batch has not");
  }

 private:
  void vector(const Vector3& v) { numbers.insert(numbers.end(), v.data(), v.data() + 3); }
  void place(const ForcePlace& at) {
    vector(at.p_BE);
    vector(at.direction);
  }
};
static_assert(lanes::kPolarTerms == DragPolar::kTerms && lanes::kMostActuators == kMaxActuators);

void writeConstants(const HovercraftModel& model, const EngineDynamics& dynamics,
                    std::size_t actuator_count, lanes::BlockConstants& to, std::size_t lane) {
  LaneWriter(&to.inverse_mass, lane).number(model.mobility.perMass());
  LaneWriter(to.inverse_inertia_B, lane).matrix(model.mobility.inverseInertiaInBody());
  LaneWriter(to.engine_force, lane).matrix(model.engines.forceMap());
  LaneWriter(to.engine_torque, lane).matrix(model.engines.torqueMap());
  LaneWriter(to.drag_linear, lane).vector(model.drag.linear);
  LaneWriter(to.drag_quadratic, lane).vector(model.drag.quadratic);
  LaneWriter(to.drag_angular_linear, lane).vector(model.drag.angular_linear);
  LaneWriter(to.drag_angular_quadratic, lane).vector(model.drag.angular_quadratic);
  LaneWriter(to.weight_W, lane).vector(model.weight_W);
  for (std::size_t id = 0; id < actuator_count; ++id) {
    const EngineDynamics::Rule& rule = dynamics.rule(id);
    to.half_decay[id].of[lane] = rule.half_decay;
    to.full_decay[id].of[lane] = rule.full_decay;
    to.lags[id].of[lane] = rule.lags ? -1 : 0;
  }
}

/// Whether a craft moves in the plane and each constant is within bounds (lane_planar.h).
bool isBoundedPlanar(const Scenario& scenario, const HovercraftModel& model) {
  if (scenario.model != BodyModel::kPlanar) return false;
  const auto is_bounded = [](const auto& numbers) {
    return numbers.cwiseAbs().maxCoeff() <= lanes::kMostOfPlanar;  // a comparison: not of NaN
  };
  const GustParameters gusts = scenario.gusts.value_or(GustParameters());
  const Drag& drag = model.drag;
  return is_bounded(Vector3(gusts.along.sigma, gusts.across.sigma, gusts.vertical.sigma)) &&
         is_bounded(model.engines.forceMap()) && is_bounded(model.engines.torqueMap()) &&
         is_bounded(drag.linear) && is_bounded(drag.quadratic) && is_bounded(drag.angular_linear) &&
         is_bounded(drag.angular_quadratic) && is_bounded(model.weight_W) &&
         is_bounded(scenario.wind);
}

}  // namespace

HovercraftModel batchableModelOf(const Scenario& scenario) {
  const FloatingPointEnvironment environment;
  requireBatchable(scenario);
  return modelOf(scenario, scenario.vehicles.front());
}

BatchKind batchKindOf(const Scenario& scenario, const HovercraftModel& model) {
  const FloatingPointEnvironment environment;
  const VehicleScenario& craft = scenario.vehicles.front();
  BatchKind kind;
  kind.step_ns = scenario.step_ns;
  kind.integrator = scenario.integrator;
  kind.model = scenario.model;
  kind.has_gusts = scenario.gusts.has_value();
  for (const ActuatorScenario& actuator : craft.actuators) {
    kind.actuator_names.push_back(actuator.name);
  }
  lanes::StepPlan& plan = kind.plan;
  plan.method = methodOf(scenario.integrator);
  plan.h = scenario.stepSize();
  plan.actuator_count = kFirstActuator + craft.actuators.size();
  for (int i = 0; i < 3; ++i) {
    const bool is_flat = model.mobility.isPlanar();
    plan.free_translation[i] = is_flat && i == 2 ? 0.0 : 1.0;
    plan.free_rotation[i] = is_flat && i < 2 ? 0.0 : 1.0;
  }
  refuse(model.forces.size() > lanes::kMostForces, "vehicles." + craft.name,
         fmt::format("a batch has at most {} laws of drag and actuators besides the engines",
                     lanes::kMostForces));
  ForceNumbers numbers;
  for (const Force& force : model.forces) {
    const std::size_t first = numbers.numbers.size();
    lanes::ForceStep& step = plan.forces[plan.force_count++];
    step = std::visit(numbers, force);
    step.first_row = first;
  }
  kind.rows = numbers.numbers.size();
  for (const Rotor& rotor : model.rotors) {
    plan.rotors[plan.rotor_count++] = {rotor.id, rotor.by_square_root, kind.rows};
    kind.rows += lanes::kRotorRows;
  }
  plan.ground = groundPlanOf(scenario, model);
  plan.ground.first_row = kind.rows;
  kind.rows += plan.ground.rowCount();
  return kind;
}

void requireSameKind(const BatchKind& kind, const BatchKind& first, const std::string& name) {
  const auto require = [&name](bool is_same, const char* key) {
    refuse(!is_same, name + ": " + key, "must be that of the first run of the batch");
  };
  require(kind.step_ns == first.step_ns, "step_size");
  require(kind.integrator == first.integrator, "integrator");
  require(kind.model == first.model, "model");
  require(kind.has_gusts == first.has_gusts, "gusts");
  require(kind.actuator_names == first.actuator_names, "the names of the actuators");
  const auto is_same_force = [](const lanes::ForceStep& a, const lanes::ForceStep& b) {
    return a.kind == b.kind && a.fan_kind == b.fan_kind && a.id == b.id && a.fan_id == b.fan_id;
  };
  const auto end = [](const lanes::StepPlan& plan) { return plan.forces + plan.force_count; };
  require(std::equal(kind.plan.forces, end(kind.plan), first.plan.forces, end(first.plan),
                     is_same_force),
          "actuators and polar: their kinds and fans");
  const auto is_same_rotor = [](const lanes::RotorStep& a, const lanes::RotorStep& b) {
    return a.id == b.id && a.by_square_root == b.by_square_root;
  };
  const auto last = [](const lanes::StepPlan& plan) { return plan.rotors + plan.rotor_count; };
  require(std::equal(kind.plan.rotors, last(kind.plan), first.plan.rotors, last(first.plan),
                     is_same_rotor),
          "which actuators have a rotor");
  requireSameGround(kind.plan.ground, first.plan.ground, name);
}

void writeLane(const Scenario& scenario, const HovercraftModel& model,
               const EngineDynamics& dynamics, const LanePlace& place) {
  const FloatingPointEnvironment environment;
  const VehicleScenario& craft = scenario.vehicles.front();
  const std::size_t lane = place.lane;
  const EngineStates engines = initialActuators(craft);
  writeConstants(model, dynamics, engines.size(), place.block.constants, lane);
  bool& is_planar = place.block.constants.is_planar;
  is_planar = is_planar && isBoundedPlanar(scenario, model);
  LaneWriter(place.wind_W, lane).vector(scenario.wind);
  ForceNumbers numbers;
  for (const Force& force : model.forces) std::visit(numbers, force);
  LaneWriter more(place.more, lane, lanes::kBlockLanes);  // so that nothing is divided by 0
  for (const double number : numbers.numbers) more.number(number);
  for (const Rotor& rotor : model.rotors) {
    more.number(rotor.scale);
    more.vector(rotor.axis);
  }
  for (const double number : groundNumbersOf(scenario, model)) more.number(number);
  const BodyState initial = initialState(scenario, craft, model.mobility);
  const auto* body = std::get_if<RigidBodyState<Quaternion>>(&initial);
  demand(body != nullptr, "a batch turns by quaternions");
  lanes::BlockState& state = place.block.state;
  LaneWriter(state.p_WB, lane).vector(body->p_WB);
  state.q_s.of[lane] = body->orientation.s;
  LaneWriter(state.q_v, lane).vector(body->orientation.v);
  LaneWriter(state.momentum_W, lane).vector(body->momentum_W);
  LaneWriter(state.angular_momentum_W, lane).vector(body->angular_momentum_W);
  for (std::size_t id = 0; id < engines.size(); ++id) {
    state.level[id].of[lane] = engines[id].thrust;
  }
}

lanes::Block idleBlock() {
  lanes::Block block = {};
  block.constants.is_planar = true;
  for (std::size_t lane = 0; lane < lanes::kBlockLanes; ++lane) {
    block.state.q_s.of[lane] = 1.0;
    block.state.moves.of[lane] = -1;
  }
  return block;
}

}  // namespace hovercraft
