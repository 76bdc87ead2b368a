#pragma once

#include <cstddef>
#include <string>

#include "hovercraft_sim/scenario/scenario.h"

#include "random_craft.h"

namespace hovercraft::testing {

/// What random craft on cushions have in common.
struct CushionKind {
  std::size_t cells = 4;  // or 1
  bool is_symmetric = false;
  bool has_hull = false;
  bool is_turned = false;     // one of two fans, by the actuator "lift"
  bool follows_time = false;  // the other one's speed
  bool has_cushion = true;    // else it has a hull alone

  std::string name() const {
    return std::to_string(cells) + " cells" + (is_symmetric ? ", symmetric" : "") +
           (has_hull ? ", hull" : "") + (is_turned ? ", turned" : "") +
           (follows_time ? ", follows time" : "") + (has_cushion ? "" : ", no cushion");
  }
};

/// Puts random craft on cushions over a plane, each with numbers of its own: hovering, falling,
/// pressed on the ground, tilted.
class RandomCushion {
 public:
  RandomCushion(RandomCraft& random, const CushionKind& kind) : random_(random), kind_(kind) {}

  void putUnder(Scenario& scenario) {
    VehicleScenario& craft = scenario.vehicles.front();
    scenario.gravity = {0.0, 0.0, -uniform(5.0, 12.0)};
    Vector3& p_HB = craft.mass_properties.p_HB;
    p_HB.head<2>() *= kind_.is_symmetric ? 0.0 : 0.1;
    if (kind_.has_cushion) {
      craft.cushion = cushion(craft.mass_properties.mass * -scenario.gravity.z());
      for (CushionCell& cell : craft.cushion->cells) {
        for (HemPoint& point : cell.hem) point.p_HK.z() += p_HB.z();
      }
    }
    if (kind_.is_turned) craft.actuators.push_back(liftFan());
    if (kind_.has_hull) {
      craft.hull = HullScenario{BoxShape{{0.36, 0.3, 0.09}}, {0.0, 0.0, 0.003}, Vector3::Zero()};
    }
    if (scenario.model == BodyModel::kPlanar) return;
    PlaneScenario plane = {uniform(-0.1, 0.1), {uniform(-0.03, 0.03), uniform(-0.03, 0.03), 1.0}};
    plane.normal = plane.normal / norm(plane.normal);
    scenario.ground = GroundScenario{plane, {}};
    scenario.ground->pads.spring.friction = uniform(0.0, 1.0);
    start(plane, craft);
  }

 private:
  double uniform(double least, double most) { return random_.uniform(least, most); }

  CushionParameters cushion(double weight) {
    CushionParameters parameters;
    parameters.discharge = uniform(0.5, 0.7);
    parameters.residual_gap = uniform(5e-5, 5e-4);
    parameters.air_density = uniform(1.0, 1.3);
    parameters.skirt.stiffness = random_.chance(0.2) ? 0.0 : uniform(500.0, 5000.0);
    parameters.skirt.spring = {uniform(0.0, 5.0), random_.chance(0.2) ? 0.0 : uniform(0.0, 1.0),
                               uniform(0.01, 0.05)};
    const double needed = weight / 0.108;
    for (const char* name : {"first", "second"}) {
      const double curve = uniform(1e5, 2e6) / (kind_.cells == 1 ? 16.0 : 1.0);
      const double slope = random_.chance(0.5) ? 0.0 : -uniform(0.0, 3000.0);
      const FanCurve fan = {needed * uniform(0.8, 2.0), slope, curve};
      parameters.fans.push_back({name, fan, {uniform(-0.1, 0.1), 0.0, 0.05}, uniform(0.7, 1.1)});
    }
    if (kind_.is_turned) parameters.fans[0].lift_fan = "lift";
    if (kind_.follows_time && random_.chance(0.7)) {
      parameters.fans[1].speeds = {{0.02, 0.9}, {uniform(0.03, 0.08), 0.2}, {0.1, 1.0}};
    }
    addCells(parameters);
    return parameters;
  }

  void addCells(CushionParameters& parameters) {
    const double z = -0.05 + uniform(-0.01, 0.01);
    const double length = kind_.is_symmetric ? 1.0 : uniform(0.9, 1.1);
    CushionCell whole;
    whole.area = 0.108;
    whole.height = 0.05;
    for (const double x : {1.0, -1.0}) {
      for (const double y : {1.0, -1.0}) {
        CushionCell cell;
        cell.p_HC = Vector3(0.09 * x, 0.075 * y, z);
        cell.area = 0.027 * (y > 0.0 ? length : 1.0);
        cell.height = 0.05;
        cell.fan = x > 0.0 ? 0 : 1;
        cell.hem = {{Vector3(0.18 * x, 0.075 * y, z), 0.15},
                    {Vector3(0.09 * x, 0.15 * y, z), 0.18 * length}};
        whole.hem.insert(whole.hem.end(), cell.hem.begin(), cell.hem.end());
        if (kind_.cells > 1) parameters.cells.push_back(cell);
      }
    }
    if (kind_.cells == 1) parameters.cells = {whole};
  }

  ActuatorScenario liftFan() {
    ActuatorScenario fan;
    fan.name = "lift";
    fan.kind = ActuatorKind::kLiftFan;
    fan.motion.min_thrust = random_.chance(0.3) ? -0.2 : 0.0;  // below 0 the fan stands
    fan.motion.max_thrust = uniform(0.9, 1.2);
    fan.motion.time_constant = random_.chance(0.3) ? 0.0 : uniform(0.01, 0.2);
    fan.motion.timeout_ns = random_.chance(0.5) ? 0 : 50000000;
    fan.initial = uniform(0.0, 0.9);
    return fan;
  }

  /// Near the plane; some of them far above or within it.
  void start(const PlaneScenario& plane, VehicleScenario& craft) {
    Vector3& p = craft.initial_p_WB;
    const Vector3& n = plane.normal;
    p.x() = uniform(-1.0, 1.0);
    const double ground = plane.height - (n.x() * p.x() + n.y() * p.y()) / n.z();
    p.z() = ground + (random_.chance(0.8) ? uniform(0.045, 0.06) : uniform(-0.02, 0.5));
    craft.initial_rpy = {uniform(-0.05, 0.05), uniform(-0.05, 0.05), uniform(-3.0, 3.0)};
    craft.initial_v_WB.z() = random_.chance(0.7) ? uniform(-0.1, 0.1) : uniform(-3.0, 3.0);
    craft.initial_w_WB = {uniform(-0.3, 0.3), uniform(-0.3, 0.3), uniform(-2.0, 2.0)};
  }

  RandomCraft& random_;
  CushionKind kind_;
};

}  // namespace hovercraft::testing
