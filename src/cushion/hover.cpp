#include "hovercraft_sim/cushion/hover.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/rotation.h"

namespace hovercraft {
namespace {

constexpr double kAdiabatic = 1.4;         // ratio of specific heats of air
constexpr double kAtmosphere = 101325.0;   // Pa
constexpr double kHighest = 1000.0;        // m: higher than any craft hovers
constexpr int kHalvings = 200;             // more than a double has digits
constexpr int kMostTrimSteps = 50;         // Newton's method takes some five
constexpr double kTrimmed = 1e-13;         // (-), of the weight and of its moment at the arm
constexpr double kDifferenceShare = 1e-4;  // (-), of the gap and of the rate that pumps all flow

/// Height, pitch and roll of a craft, and their rates: m, rad; m/s, rad/s.
using Attitude = std::array<double, kHoverMotions>;

/// Force along the vertical, moments of pitch and roll; N, N m.
using Loads = std::array<double, kHoverMotions>;

class HoverPoint {
 public:
  HoverPoint(const Cushion& cushion, const HoverBody& body, const FanSpeeds& speeds)
      : cushion_(cushion), body_(body), speeds_(speeds), ground_(GroundPlane()) {}

  BodyMotion motionOf(const Attitude& at, const Attitude& rate) const {
    BodyMotion motion;
    motion.R_WB = rotationFromRpy({at[2], at[1], 0.0});
    motion.p_WB = Vector3(0.0, 0.0, at[0]);
    motion.v_WB_B = transposeTimes(motion.R_WB, Vector3(0.0, 0.0, rate[0]));
    motion.w_WB_B = Vector3(rate[2], rate[1], 0.0);
    motion.u_B = motion.v_WB_B;
    return motion;
  }
  Loads loadsAt(const Attitude& at, const Attitude& rate) const {
    const BodyMotion motion = motionOf(at, rate);
    const Wrench wrench = cushion_.wrenchInBody(motion, speeds_, ground_);
    return {times(motion.R_WB, wrench.force).z() - body_.mass * body_.gravity, wrench.torque.y(),
            wrench.torque.x()};
  }
  std::vector<CellReport> cellsAt(const Attitude& at) const {
    std::vector<CellReport> cells(cushion_.cellCount());
    cushion_.report(motionOf(at, Attitude{}), speeds_, ground_, cells.data());
    return cells;
  }
  const Cushion& cushion() const { return cushion_; }
  const HoverBody& body() const { return body_; }
  const FanSpeeds& speeds() const { return speeds_; }

 private:
  const Cushion& cushion_;
  const HoverBody& body_;
  const FanSpeeds& speeds_;
  PlaneGround ground_;
};

/// The height at which a level craft is carried: the force falls as it rises. @param low, high
/// bracket it.
double levelHeight(const HoverPoint& point, double low, double high) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) break;
    (point.loadsAt({middle, 0.0, 0.0}, {})[0] > 0.0 ? low : high) = middle;
  }
  return low;
}

using Slopes = std::array<Loads, kHoverMotions>;  // [of what][by what]

/// Central differences of the loads by attitude, or by its rate. @param by steps.
Slopes slopesOf(const HoverPoint& point, const Attitude& at, const Attitude& by, bool of_rates) {
  Slopes slopes{};
  for (std::size_t j = 0; j < kHoverMotions; ++j) {
    Attitude more = of_rates ? Attitude{} : at;
    Attitude less = more;
    more[j] += by[j];
    less[j] -= by[j];
    const Loads above = of_rates ? point.loadsAt(at, more) : point.loadsAt(more, {});
    const Loads below = of_rates ? point.loadsAt(at, less) : point.loadsAt(less, {});
    for (std::size_t i = 0; i < kHoverMotions; ++i) {
      slopes[i][j] = (above[i] - below[i]) / (more[j] - less[j]);
    }
  }
  return slopes;
}

/// Arms of the cells about B: the mean of |x| and of |y| by area, m; not 0.
std::array<double, 2> armsOf(const Cushion& cushion) {
  double area = 0.0;
  double x = 0.0;
  double y = 0.0;
  for (const CushionCell& cell : cushion.parameters().cells) {
    area += cell.area;
    for (const HemPoint& hem : cell.hem) {
      x = std::max(x, std::abs(hem.p_HK.x()));
      y = std::max(y, std::abs(hem.p_HK.y()));
    }
  }
  const double least = 0.01 * std::sqrt(area);
  return {std::max(x, least), std::max(y, least)};
}

/// Steps of the differences by attitude: the hem moves by `step` at most, m; angles stay small.
Attitude attitudeSteps(double step, const std::array<double, 2>& arms) {
  return {step, std::min(step / arms[0], kMostTrim), std::min(step / arms[1], kMostTrim)};
}

/// One step of Newton's method: at -= slopes⁻¹ loads.
Attitude corrected(const Attitude& at, const Slopes& slopes, const Loads& loads) {
  Matrix3 J;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      J(i, j) = slopes[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  const Vector3 change = times(inverse(J), Vector3(loads[0], loads[1], loads[2]));
  return {at[0] - change.x(), at[1] - change.y(), at[2] - change.z()};
}

bool isBalanced(const Loads& loads, double weight, const std::array<double, 2>& arms) {
  return std::abs(loads[0]) <= kTrimmed * weight &&
         std::abs(loads[1]) <= kTrimmed * weight * arms[0] &&
         std::abs(loads[2]) <= kTrimmed * weight * arms[1];
}

/// From the height of the level craft to the attitude in which moments are balanced too.
/// @returns whether it was found.
bool trim(const HoverPoint& point, double gap, Attitude& at) {
  const double weight = point.body().mass * point.body().gravity;
  const std::array<double, 2> arms = armsOf(point.cushion());
  const double step = kDifferenceShare * gap;
  Loads loads = point.loadsAt(at, {});
  // A level symmetric craft has no moments: nothing that rounding could tilt is solved for.
  if (loads[1] == 0.0 && loads[2] == 0.0) return true;
  for (int i = 0; i < kMostTrimSteps && !isBalanced(loads, weight, arms); ++i) {
    const Slopes slopes = slopesOf(point, at, attitudeSteps(step, arms), false);
    const Attitude next = corrected(at, slopes, loads);
    if (!std::isfinite(next[0] + next[1] + next[2])) return false;
    at = next;
    if (std::abs(at[1]) > kMostTrim || std::abs(at[2]) > kMostTrim) return false;
    loads = point.loadsAt(at, {});
  }
  return std::abs(loads[1]) <= 1e-6 * weight * arms[0] &&
         std::abs(loads[2]) <= 1e-6 * weight * arms[1];
}

/// Least G/C of the cells, 1/s: how fast their pressures settle. (9)
double settlingRate(const HoverPoint& point, const std::vector<CellReport>& reports) {
  double least = std::numeric_limits<double>::infinity();
  const CushionParameters& parameters = point.cushion().parameters();
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const CushionCell& cell = parameters.cells[i];
    const FanAtSpeed fan = atSpeed(parameters.fans[cell.fan].curve, point.speeds()[cell.fan]);
    const CellReport& air = reports[i];
    const double G = fanFlowSlope(fan, air.flow) + air.flow / (2.0 * air.pressure);
    const double C = cell.area * cell.height / (kAdiabatic * (kAtmosphere + air.pressure));
    least = std::min(least, G / C);
  }
  return least;
}

void findModes(const HoverPoint& point, const Attitude& at, Hover& hover) {
  const std::array<double, 2> arms = armsOf(point.cushion());
  double area = 0.0;
  for (const CushionCell& cell : point.cushion().parameters().cells) area += cell.area;
  const double step = kDifferenceShare * hover.gap;
  const double rate = kDifferenceShare * hover.flow / area;
  const Slopes K = slopesOf(point, at, attitudeSteps(step, arms), false);
  const Slopes D = slopesOf(point, at, {rate, rate / arms[0], rate / arms[1]}, true);
  const Matrix3& I = point.body().I_BBo_B;
  const std::array<double, kHoverMotions> inertias = {point.body().mass, I(1, 1), I(0, 0)};
  const double settling = settlingRate(point, hover.cells);
  for (std::size_t i = 0; i < kHoverMotions; ++i) {
    HoverMode& mode = hover.modes[i];
    mode.inertia = inertias[i];
    mode.damping = -D[i][i];
    mode.stiffness = -K[i][i];
    mode.margin = mode.stiffness > 0.0 ? settling * mode.damping / mode.stiffness : 0.0;
  }
}

void sumUp(const HoverPoint& point, Hover& hover) {
  const CushionParameters& parameters = point.cushion().parameters();
  double area = 0.0;
  double force = 0.0;
  for (std::size_t i = 0; i < hover.cells.size(); ++i) {
    const CellReport& cell = hover.cells[i];
    area += parameters.cells[i].area;
    force += cell.force;
    hover.gap += cell.gap / static_cast<double>(hover.cells.size());
    hover.flow += cell.flow;
    hover.power += cell.pressure * cell.flow;
  }
  hover.pressure = force / area;
  hover.skirt_load = std::max(0.0, point.body().mass * point.body().gravity - force);
}

std::complex<double> amplification(Integrator integrator, const std::complex<double>& z) {
  switch (integrator) {
    case Integrator::kHeun:
      return 1.0 + z * (1.0 + 0.5 * z);
    case Integrator::kRungeKutta4:
    case Integrator::kLie4:  // the same where nothing turns
      return 1.0 + z * (1.0 + z * (0.5 + z * (1.0 / 6.0 + z / 24.0)));
    case Integrator::kEuler:
    case Integrator::kSemiImplicitEuler:
      break;
  }
  return 1.0 + z;
}

/// The longest step that does not let exp(root t) grow.
double longestStep(Integrator integrator, const std::complex<double>& root) {
  const auto decays = [&](double h) {
    return std::norm(amplification(integrator, h * root)) <= 1.0;
  };
  double high = 1e-3 / std::abs(root);
  if (!decays(high)) return 0.0;
  while (decays(high)) high *= 2.0;
  double low = 0.5 * high;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (decays(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace

double HoverMode::frequency() const {
  return stiffness > 0.0 ? std::sqrt(stiffness / inertia) : 0.0;
}

double HoverMode::dampingRatio() const {
  return stiffness > 0.0 ? damping / (2.0 * std::sqrt(stiffness * inertia)) : 0.0;
}

Hover hoverOf(const Cushion& cushion, const HoverBody& body, const FanSpeeds& speeds) {
  const FloatingPointEnvironment environment;
  Hover hover;
  const HoverPoint point(cushion, body, speeds);
  const CushionParameters& parameters = cushion.parameters();
  double full = 0.0;
  double most = 0.0;
  double lowest_hem = 0.0;
  for (const CushionCell& cell : parameters.cells) {
    const double carried = parameters.fans[cell.fan].curve.shutoff * cell.area;
    const double speed = speeds[cell.fan];
    full += carried;
    most += (speed * speed) * carried;
    for (const HemPoint& hem : cell.hem) lowest_hem = std::max(lowest_hem, std::abs(hem.p_HK.z()));
  }
  const double weight = body.mass * body.gravity;
  hover.lift_off_speed = std::sqrt(weight / full);
  if (!(most > weight)) return hover;
  hover.status = HoverStatus::kTooLight;
  if (point.loadsAt({kHighest, 0.0, 0.0}, {})[0] > 0.0) return hover;
  // So deep that nothing escapes any more.
  const double deep = -2.0 * (lowest_hem + kHighest * parameters.residual_gap);
  Attitude at = {levelHeight(point, std::min(deep, -1.0), kHighest), 0.0, 0.0};
  hover.cells = point.cellsAt(at);
  double gap = parameters.residual_gap;
  for (const CellReport& cell : hover.cells) gap = std::max(gap, cell.gap);
  const bool is_balanced = trim(point, gap, at);
  hover.status = is_balanced ? HoverStatus::kHovers : HoverStatus::kNotLevel;
  if (!is_balanced) return hover;
  hover.height = at[0];
  hover.pitch = at[1];
  hover.roll = at[2];
  hover.cells = point.cellsAt(at);
  sumUp(point, hover);
  findModes(point, at, hover);
  return hover;
}

double longestStableStep(Integrator integrator, const HoverMode& mode) {
  const FloatingPointEnvironment environment;
  const double rate = mode.damping / mode.inertia;
  const double square = mode.stiffness / mode.inertia;
  if (square == 0.0 && rate == 0.0) return std::numeric_limits<double>::infinity();
  if (!(square >= 0.0 && rate >= 0.0)) return 0.0;
  if (integrator == Integrator::kSemiImplicitEuler) {
    // v' = v - h (rate v + square x), x' = x + h v': decays while
    // square h² + 2 rate h < 4.
    return FloatingPointEnvironment::computed(4.0 / (rate + std::sqrt(rate * rate + 4.0 * square)));
  }
  const double inner = 0.25 * rate * rate - square;
  const double size = std::sqrt(std::abs(inner));
  const std::complex<double> root(inner > 0.0 ? size : 0.0, inner > 0.0 ? 0.0 : size);
  double longest = std::numeric_limits<double>::infinity();
  for (const std::complex<double>& lambda : {-0.5 * rate + root, -0.5 * rate - root}) {
    if (lambda == 0.0) continue;  // a displacement that nothing brings back
    longest = std::min(longest, longestStep(integrator, lambda));
  }
  return longest;
}

}  // namespace hovercraft
