#include "hovercraft_sim/sim/batch_ground.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/actuator_forces.h"
#include "hovercraft_sim/scenario/cushion_builder.h"

namespace hovercraft {
namespace {

using lanes::GroundPlan;
using lanes::PairStep;

static_assert(kMaxCells == lanes::kMostCells && kMaxHemPoints == lanes::kMostHemPoints &&
                  kMaxFans == lanes::kMostLiftFans,
              "one bound, in two rooms");

/// @returns how many there are.
std::size_t planPairs(const std::vector<MirrorPair>& pairs, PairStep* steps) {
  for (const MirrorPair& pair : pairs) {
    steps->first = static_cast<std::size_t>(pair[0]);
    steps->second = pair[1] < 0 ? PairStep::kAlone : static_cast<std::size_t>(pair[1]);
    ++steps;
  }
  return pairs.size();
}

void planCushion(const VehicleScenario& craft, const Cushion& cushion, GroundPlan& plan) {
  const CushionLayout& layout = cushion.layout();
  plan.has_cushion = true;
  plan.fan_count = layout.intakes_B.size();
  plan.cell_count = layout.cells.size();
  plan.point_count = layout.hem.size();
  for (std::size_t i = 0; i < layout.cells.size(); ++i) {
    const CushionLayout::Cell& cell = layout.cells[i];
    plan.cells[i] = {cell.fan, cell.first_point, cell.end_point};
  }
  plan.cell_pair_count = planPairs(layout.cell_pairs, plan.cell_pairs);
  plan.point_pair_count = planPairs(layout.point_pairs, plan.point_pairs);
  for (const FanDrive& drive : fanDrivesOf(craft)) plan.fans[drive.fan].actuator = drive.actuator;
}

/// Numbers one behind the other.
class NumberList {
 public:
  std::vector<double> numbers;

  void add(std::initializer_list<double> more) {
    numbers.insert(numbers.end(), more.begin(), more.end());
  }
  void add(const Vector3& v) { numbers.insert(numbers.end(), v.data(), v.data() + 3); }
  void add(const GroundSpring& spring) {
    add({spring.damping, spring.friction, spring.slip_speed * spring.slip_speed});
  }
};

/// @param load m g along z, N, of the planar model.
void addCushion(const Cushion& cushion, double load, NumberList& list) {
  const CushionParameters& parameters = cushion.parameters();
  const CushionLayout& layout = cushion.layout();
  list.add({parameters.residual_gap * parameters.residual_gap, layout.outflow_factor,
            parameters.air_density, load, load / layout.total_area, layout.total_length});
  list.add(parameters.skirt.spring);
  list.add({parameters.skirt.stiffness});
  for (std::size_t i = 0; i < parameters.fans.size(); ++i) {
    const FanCurve& curve = parameters.fans[i].curve;
    list.add({curve.shutoff, std::sqrt(curve.shutoff), curve.slope, curve.curve});
    list.add(layout.intakes_B[i]);
  }
  for (const CushionLayout::Cell& cell : layout.cells) {
    list.add(cell.p_BC);
    list.add({cell.area});
  }
  for (std::size_t k = 0; k < layout.hem.size(); ++k) {
    list.add(layout.hem.at(k));
    list.add({layout.hem.length[k], layout.hem.stiffness[k]});
  }
}

void addPads(const Pads& pads, NumberList& list) {
  list.add(pads.middle());
  list.add(pads.halfExtent());
  list.add({pads.stiffness()});
  list.add(pads.spring());
  for (const Vector3& vertex : pads.vertices()) list.add(vertex);
}

bool isSame(const PairStep& a, const PairStep& b) {
  return a.first == b.first && a.second == b.second;
}

bool areMirroredAlike(const GroundPlan& a, const GroundPlan& b) {
  return std::equal(a.cell_pairs, a.cell_pairs + a.cell_pair_count, b.cell_pairs,
                    b.cell_pairs + b.cell_pair_count, isSame) &&
         std::equal(a.point_pairs, a.point_pairs + a.point_pair_count, b.point_pairs,
                    b.point_pairs + b.point_pair_count, isSame);
}

bool haveSameCells(const GroundPlan& a, const GroundPlan& b) {
  const auto is_same = [](const lanes::CellStep& x, const lanes::CellStep& y) {
    return x.fan == y.fan && x.first_point == y.first_point && x.end_point == y.end_point;
  };
  return std::equal(a.cells, a.cells + a.cell_count, b.cells, b.cells + b.cell_count, is_same);
}

bool haveSameFans(const GroundPlan& a, const GroundPlan& b) {
  const auto is_same = [](const lanes::LiftFanStep& x, const lanes::LiftFanStep& y) {
    return x.actuator == y.actuator;
  };
  return std::equal(a.fans, a.fans + a.fan_count, b.fans, b.fans + b.fan_count, is_same);
}

}  // namespace

void requireBatchableGround(const Scenario& scenario) {
  if (scenario.ground && std::holds_alternative<HeightMapScenario>(scenario.ground->surface)) {
    throw std::invalid_argument("ground.height_map: a batch has planes alone: must not be");
  }
  const VehicleScenario& craft = scenario.vehicles.front();
  if (craft.cushion && scenario.model == BodyModel::kSpatial && !scenario.ground) {
    throw std::invalid_argument(fmt::format(
        "vehicles.{}.cushion: must have a ground in a batch of model: spatial", craft.name));
  }
}

lanes::GroundPlan groundPlanOf(const Scenario& scenario, const HovercraftModel& model) {
  GroundPlan plan;
  if (model.ground_forces == nullptr) return plan;
  const GroundForces& forces = *model.ground_forces;
  plan.is_planar = forces.planarLoad().has_value();
  if (forces.cushion()) planCushion(scenario.vehicles.front(), *forces.cushion(), plan);
  plan.has_pads = !forces.pads().empty();
  plan.vertex_count = forces.pads().vertices().size();
  plan.paired_count = forces.pads().pairedCount();
  return plan;
}

std::vector<double> groundNumbersOf(const Scenario& scenario, const HovercraftModel& model) {
  const FloatingPointEnvironment environment;
  if (model.ground_forces == nullptr) return {};
  const GroundForces& forces = *model.ground_forces;
  NumberList list;
  const std::shared_ptr<const Ground> ground = groundOf(scenario);
  GroundPlane plane;
  if (ground != nullptr) {
    demand(ground->plane() != nullptr, "what is no plane is refused");
    plane = *ground->plane();
  }
  list.add(plane.nhat_W);
  list.add({plane.offset});
  if (forces.cushion()) addCushion(*forces.cushion(), forces.planarLoad().value_or(0.0), list);
  if (!forces.pads().empty()) addPads(forces.pads(), list);
  return list.numbers;
}

void requireSameGround(const lanes::GroundPlan& plan, const lanes::GroundPlan& first,
                       const std::string& name) {
  const auto require = [&name](bool is_same, const char* what) {
    if (is_same) return;
    throw std::invalid_argument(
        fmt::format("{}: {}: must be that of the first run of the batch", name, what));
  };
  require(plan.has_cushion == first.has_cushion && haveSameCells(plan, first),
          "the cells of the cushion: their hems and fans");
  require(haveSameFans(plan, first), "which actuators turn fans of the cushion");
  require(areMirroredAlike(plan, first),
          "what of the cushion is symmetric about the centre of mass");
  require(plan.vertex_count == first.vertex_count && plan.paired_count == first.paired_count,
          "the vertices of the hull on the ground: their number, and how many are symmetric");
}

bool fansFollowTime(const Cushion& cushion) {
  const std::vector<CushionFan>& fans = cushion.parameters().fans;
  return std::any_of(fans.begin(), fans.end(),
                     [](const CushionFan& fan) { return !fan.speeds.empty(); });
}

void writeFanSpeeds(const Cushion& cushion, Tick tick, std::int64_t step_ns, std::size_t lane,
                    lanes::Row* rows) {
  const double start = toSeconds(tick * step_ns);
  const double h = toSeconds(step_ns);
  const std::size_t count = cushion.parameters().fans.size();
  for (const double time : {start, start + 0.5 * h, start + h}) {
    const FanSpeeds speeds = cushion.describedSpeeds(time);
    for (std::size_t i = 0; i < count; ++i) rows[i].of[lane] = speeds[i];
    rows += count;
  }
}

}  // namespace hovercraft
