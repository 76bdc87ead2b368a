#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <vector>

#include "hovercraft_sim/cushion/gap.h"
#include "hovercraft_sim/cushion/hover.h"
#include "hovercraft_sim/scenario/cushion_builder.h"
#include "hovercraft_sim/scenario/cushion_parser.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/world_builder.h"

namespace hovercraft {
namespace {

/// Margin of stability (-) below which compressible air decides whether a craft swings: its damping
/// is less by 1 - 1/M, and quasi-static pressure is no model of it. (12)
constexpr double kLeastMargin = 3.0;

/// Margin from which on a tenth of the damping at most is missing.
constexpr double kFairMargin = 10.0;

/// Share of the weight that the skirt may carry when the hull stands on the ground: the rest is for
/// the pads, which hold it.
constexpr double kMostSkirtLoad = 0.8;

class CushionCheck {
 public:
  CushionCheck(const ConfigReader& reader, const ScenarioSource& source, const Scenario& scenario,
               const VehicleScenario& vehicle)
      : reader_(reader),
        source_(source),
        scenario_(scenario),
        vehicle_(vehicle),
        cushion_(*vehicle.cushion),
        weight_(-vehicle.mass_properties.mass * scenario.gravity.z()) {}

  void run() const {
    if (!(weight_ > 0.0)) {
      reader_.fail("", "needs gravity: its third number must be less than 0");
    }
    checkFriction();
    if (scenario_.model == BodyModel::kPlanar) {
      checkLift();
      return;
    }
    if (!scenario_.ground && (!scenario_.world || scenario_.world->obstacles.empty())) {
      reader_.fail("",
                   "needs something to blow on in model: spatial: a ground: or a world: with "
                   "obstacles");
    }
    if (cushion_.cells.size() == 1 && cushion_.skirt.stiffness == 0.0) {
      reader_.fail("",
                   "has one cell, whose pressure holds neither pitch nor roll: needs more "
                   "cells, or a skirt with stiffness");
    }
    checkFooting();
    const Cushion cushion(cushion_, vehicle_.mass_properties.p_HB);
    checkHover(hoverOf(cushion, hoverBodyOf(scenario_, vehicle_), cushion.fullSpeeds()));
  }

 private:
  void note(const std::string& text) const {
    if (source_.note) source_.note(reader_.where("") + ": " + text);
  }

  double fullForce() const {
    double force = 0.0;
    for (const CushionCell& cell : cushion_.cells) {
      const CushionFan& fan = cushion_.fans[cell.fan];
      force += (fan.fullSpeed() * fan.fullSpeed()) * fan.curve.shutoff * cell.area;
    }
    return force;
  }
  void checkLift() const {
    if (fullForce() >= weight_) return;
    note(
        fmt::format("its fans carry at most {:.4g} N of the weight of {:.4g} N: it does not lift "
                    "off",
                    fullForce(), weight_));
  }

  /// (16) is stiff: a step takes away more than all of the velocity if mu g h > v_s.
  void checkFriction() const {
    const GroundSpring& spring = cushion_.skirt.spring;
    const double g = -scenario_.gravity.z();
    const double share = scenario_.stepSize() * spring.friction * g / spring.slip_speed;
    if (share <= 1.0) return;
    note(
        fmt::format("step_size × skirt.friction × gravity / skirt.slip_speed is {:.3g}: at most 1 "
                    "keeps friction from trembling",
                    share));
  }

  void checkFooting() const {
    if (!vehicle_.hull && vehicle_.parts.empty()) {
      if (cushion_.skirt.stiffness > 0.0) return;
      note(
          "the craft has neither a hull nor a skirt with stiffness to stand on: without its fans "
          "it falls for ever");
      return;
    }
    double lowest = std::numeric_limits<double>::infinity();
    const std::vector<Vector3> points =
        vehicle_.hull ? hullPoints(*vehicle_.hull) : partPoints(vehicle_.parts);
    for (const Vector3& p : points) lowest = std::min(lowest, p.z());
    double load = 0.0;
    for (const CushionCell& cell : cushion_.cells) {
      for (const HemPoint& hem : cell.hem) {
        const double gap = hem.p_HK.z() - lowest;
        load +=
            cushion_.skirt.stiffness * hem.length * hemGap(gap, cushion_.residual_gap).compression;
      }
    }
    if (load <= kMostSkirtLoad * weight_) return;
    note(
        fmt::format("pressed in up to the hull the skirt carries {:.4g} N, {:.3g} of the weight: "
                    "more than {} and the craft does not stand on its hull, and creeps on slopes",
                    load, load / weight_, kMostSkirtLoad));
  }

  void checkHover(const Hover& hover) const {
    switch (hover.status) {
      case HoverStatus::kTooHeavy:
        checkLift();
        return;
      case HoverStatus::kTooLight:
        note("its fans carry it at any height: it does not come down");
        return;
      case HoverStatus::kNotLevel:
        note(
            fmt::format("no attitude within {} rad of level balances its moments: the centre of "
                        "mass is too far from the middle of the cells",
                        kMostTrim));
        return;
      case HoverStatus::kHovers:
        break;
    }
    for (std::size_t i = 0; i < kHoverMotions; ++i) {
      checkMode(kHoverMotionNames[i], hover.modes[i]);
    }
  }

  void checkMode(const char* name, const HoverMode& mode) const {
    if (!(mode.stiffness > 0.0)) {
      note(fmt::format("nothing brings {} back: its stiffness is {:.3g}", name, mode.stiffness));
      return;
    }
    if (mode.margin < kLeastMargin) {
      reader_.fail("", fmt::format("the margin of {} is {:.3g}: below {} its air swings by itself, "
                                   "which mode: quasi_static does not model (less height of the "
                                   "cells, more gap or a lighter craft raise it)",
                                   name, mode.margin, kLeastMargin));
    }
    if (mode.margin < kFairMargin) {
      note(
          fmt::format("the margin of {} is {:.3g}: compressible air would leave {:.2g} of its "
                      "damping",
                      name, mode.margin, 1.0 - 1.0 / mode.margin));
    }
    const double longest = longestStableStep(scenario_.integrator, mode);
    if (scenario_.stepSize() <= longest) return;
    note(
        fmt::format("step_size = {} s is too long for {} ({:.4g} 1/s, damping ratio {:.3g}) with "
                    "integrator: {}: at most {:.3g} s lets it decay",
                    scenario_.stepSize(), name, mode.frequency(), mode.dampingRatio(),
                    integratorNames()[static_cast<std::size_t>(scenario_.integrator)], longest));
  }

  const ConfigReader& reader_;
  const ScenarioSource& source_;
  const Scenario& scenario_;
  const VehicleScenario& vehicle_;
  const CushionParameters& cushion_;
  double weight_;  // N
};

/// A lift fan that moves no air: an error beside a cushion, whose fan should name it, and a note
/// where there is none.
void checkLiftFan(const ConfigReader& lift_fan, const ScenarioSource& source,
                  const VehicleScenario& vehicle, const std::string& name) {
  if (!vehicle.cushion) {
    if (source.note) {
      source.note(lift_fan.where("") +
                  ": the craft has no cushion that it feeds: its level is followed and reported");
    }
    return;
  }
  const std::vector<CushionFan>& fans = vehicle.cushion->fans;
  if (std::any_of(fans.begin(), fans.end(),
                  [&](const CushionFan& fan) { return fan.lift_fan == name; })) {
    return;
  }
  lift_fan.fail("", fmt::format("feeds no cell: a fan of the cushion must say lift_fan: {}", name));
}

/// A fan of a cushion that no cell names.
void noteIdleFans(const ConfigReader& cushion, const ScenarioSource& source,
                  const CushionParameters& parameters) {
  if (!source.note) return;
  for (std::size_t fan = 0; fan < parameters.fans.size(); ++fan) {
    if (std::any_of(parameters.cells.begin(), parameters.cells.end(),
                    [&](const CushionCell& cell) { return cell.fan == fan; })) {
      continue;
    }
    source.note(cushion.map("fans").map(parameters.fans[fan].name).where("") +
                ": feeds no cell: none names it as its fan");
  }
}

/// Pads are springs: the step must be short enough for a body that stands on its lowest vertices.
/// With damping alpha N, N about the weight, heave has D/M = alpha g.
void checkPads(const ConfigReader& ground, const Scenario& scenario, const VehicleScenario& body) {
  const Pads springs = padsOf(scenario, body);
  if (springs.empty()) return;
  const PadParameters& pads = scenario.ground->pads;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3& p : springs.vertices()) lowest = std::min(lowest, p.z());
  const Matrix3& I = body.mass_properties.I_BBo_B;
  double heave = 0.0;
  double pitch = 0.0;
  double roll = 0.0;
  for (const Vector3& p : springs.vertices()) {
    if (p.z() > lowest + pads.sink) continue;
    heave += springs.stiffness() / body.mass_properties.mass;
    pitch += springs.stiffness() * p.x() * p.x() / I(1, 1);
    roll += springs.stiffness() * p.y() * p.y() / I(0, 0);
  }
  const double square = std::max({heave, pitch, roll});
  const double damping = pads.spring.damping * -scenario.gravity.z() * square / heave;
  const double longest = longestStableStep(scenario.integrator, {1.0, damping, square, 0.0});
  if (scenario.stepSize() <= longest) return;
  ground.fail("pads", fmt::format("step_size = {} s is too long for {} on its pads with "
                                  "integrator: {}: at most {:.3g} s (or a greater sink)",
                                  scenario.stepSize(), body.name,
                                  integratorNames()[static_cast<std::size_t>(scenario.integrator)],
                                  longest));
}

}  // namespace

void checkCushions(const ConfigReader& top, const ScenarioSource& source,
                   const Scenario& scenario) {
  const ConfigReader vehicles = top.map("vehicles");
  for (const VehicleScenario& vehicle : scenario.vehicles) {
    for (const ActuatorScenario& actuator : vehicle.actuators) {
      if (actuator.kind != ActuatorKind::kLiftFan) continue;
      checkLiftFan(vehicles.map(vehicle.name).map("actuators").map(actuator.name), source, vehicle,
                   actuator.name);
    }
    if (!vehicle.cushion) continue;
    const ConfigReader reader = vehicles.map(vehicle.name).map("cushion");
    noteIdleFans(reader, source, *vehicle.cushion);
    CushionCheck(reader, source, scenario, vehicle).run();
  }
  if (!scenario.ground) return;
  const ConfigReader ground = top.map("ground");
  for (const VehicleScenario& vehicle : scenario.vehicles) checkPads(ground, scenario, vehicle);
  if (!scenario.world) return;
  for (const VehicleScenario& body : scenario.world->bodies) checkPads(ground, scenario, body);
}

}  // namespace hovercraft
