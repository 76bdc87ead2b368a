#include <algorithm>
#include <cstddef>
#include <variant>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/sim/simulation.h"

/// What a simulation knows of cushions: the speeds of their fans, and what is reported of them.

namespace hovercraft {
namespace {

/// The speed of a fan at the level of its actuator: a level may lie below its limit by rounding.
double fanSpeedAt(double level) {
  return std::max(0.0, level);
}

}  // namespace

/// The speeds of the fans of the cushion of a craft with ground forces over the step, at its
/// stages: as they are described, and of those that actuators turn the actuators' levels.
void Simulation::turnFans(std::size_t vehicle) {
  const GroundForces& forces = *modelOf(vehicle).ground_forces;
  if (!forces.cushion()) return;
  const Cushion& cushion = *forces.cushion();
  StepInputs& inputs = inputs_[vehicle];
  FanSpeedCourse& course = inputs.fan_speeds;
  const double start = toSeconds(timeNs());
  const double h = toSeconds(scenario_.step_ns);
  course.start = cushion.describedSpeeds(start);
  course.middle = cushion.describedSpeeds(start + 0.5 * h);
  course.end = cushion.describedSpeeds(start + h);
  for (const FanDrive& drive : fan_drives_[vehicle]) {
    course.start[drive.fan] = fanSpeedAt(inputs.thrusts.start[drive.actuator]);
    course.middle[drive.fan] = fanSpeedAt(inputs.thrusts.middle[drive.actuator]);
    course.end[drive.fan] = fanSpeedAt(inputs.thrusts.end[drive.actuator]);
  }
}

std::size_t Simulation::cellCount(std::size_t vehicle) const {
  const auto& forces = modelOf(vehicle).ground_forces;
  return forces != nullptr && forces->cushion() ? forces->cushion()->cellCount() : 0;
}

void Simulation::cushionReport(std::size_t vehicle, CushionReport& report) const {
  const FloatingPointEnvironment environment;
  const HovercraftModel& model = modelOf(vehicle);
  report.cells.resize(cellCount(vehicle));
  report.fan_speeds.clear();
  report.power = 0.0;
  if (report.cells.empty()) return;
  const Environment& around = inputs_[vehicle].environment;
  const BodyMotion motion = std::visit(
      [&](const auto& state) {
        return model.motionInBody(state, levelsOf(state_.engines[vehicle]), around);
      },
      state_.bodies[vehicle]);
  const GroundForces& forces = *model.ground_forces;
  FanSpeeds speeds = forces.cushion()->describedSpeeds(toSeconds(timeNs()));
  for (const FanDrive& drive : fan_drives_[vehicle]) {
    speeds[drive.fan] = fanSpeedAt(state_.engines[vehicle][drive.actuator].thrust);
  }
  forces.report(motion, around, speeds, report.cells.data());
  for (const CellReport& cell : report.cells) report.power += cell.pressure * cell.flow;
  const std::size_t fan_count = forces.cushion()->parameters().fans.size();
  report.fan_speeds.assign(speeds.begin(), speeds.begin() + static_cast<std::ptrdiff_t>(fan_count));
}

}  // namespace hovercraft
