#include "hovercraft_sim/hovercraft/gusts.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/elementary.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/noise.h"

namespace hovercraft {
namespace {

// Tick 0 begins a run: its draws are those of the start.
constexpr Tick kStart = 0;
constexpr std::array<const char*, 3> kChannels = {"along", "across", "vertical"};

/// e^-y times what the series of e^y has from its term y^n/n! on, for y in [0, 2]: a sum of
/// positive terms, so that nothing cancels where y is small.
double tailOfExponential(int n, double y) {
  constexpr int kMostTerms = 40;  // 2^40/40! is below 1e-35
  double term = 1.0;
  for (int j = 1; j <= n; ++j) term = term * y / j;
  double sum = 0.0;
  for (int j = n + 1; j <= n + kMostTerms; ++j) {
    sum += term;
    term = term * y / j;
  }
  return exactExp(-y) * sum;
}

}  // namespace

Gusts::Axis Gusts::firstOrder(const GustAxis& gust, double tau, double step) {
  Axis axis;
  axis.blows = gust.sigma > 0.0;
  axis.decay = exactExp(-step / tau);
  axis.l11 = gust.sigma * std::sqrt(tailOfExponential(1, 2.0 * step / tau));
  axis.s11 = gust.sigma;
  axis.c1 = 1.0;
  return axis;
}

Gusts::Axis Gusts::doublePole(const GustAxis& gust, double tau, double step) {
  const double a = 1.0 / tau;
  const double y = 2.0 * a * step;
  const double q22 = tailOfExponential(1, y) / (2.0 * a);
  const double q12 = tailOfExponential(2, y) / (4.0 * a * a);
  const double q11 = tailOfExponential(3, y) / (4.0 * a * a * a);
  Axis axis;
  axis.blows = gust.sigma > 0.0;
  axis.is_double = true;
  axis.decay = exactExp(-a * step);
  axis.coupling = step;
  axis.l11 = std::sqrt(q11);
  axis.l21 = q12 / axis.l11;
  axis.l22 = std::sqrt(q22 - axis.l21 * axis.l21);
  axis.s11 = std::sqrt(1.0 / (4.0 * a * a * a));
  axis.s21 = 1.0 / (4.0 * a * a) / axis.s11;
  axis.s22 = std::sqrt(1.0 / (4.0 * a));
  axis.c1 = gust.sigma * (a * std::sqrt(a)) * (1.0 - std::sqrt(3.0));
  axis.c2 = gust.sigma * std::sqrt(3.0 * a);
  return axis;
}

std::array<std::string, 3> Gusts::channelsOf(const std::string& body) {
  std::array<std::string, 3> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = body + "/gust/" + kChannels[i];
  return names;
}

Gusts::Gusts(const GustParameters& parameters, double speed, double step,
             const std::vector<std::string>& bodies) {
  const FloatingPointEnvironment environment;
  const double carried = std::max(speed, kLeastSpeed);
  const std::array<GustAxis, 3> gusts = {parameters.along, parameters.across, parameters.vertical};
  for (std::size_t i = 0; i < gusts.size(); ++i) {
    if (!(gusts[i].sigma > 0.0)) continue;
    const double tau = gusts[i].length / carried;
    demand(tau >= step, "a time constant of gusts must be checked before");
    const bool is_double = i > 0 && parameters.model == GustModel::kDryden;
    axes_[i] = is_double ? doublePole(gusts[i], tau, step) : firstOrder(gusts[i], tau, step);
  }
  NoiseStreams names;
  for (const std::string& body : bodies) {
    auto& streams = streams_.emplace_back();
    const auto channels = channelsOf(body);
    std::transform(channels.begin(), channels.end(), streams.begin(),
                   [&names](const std::string& name) { return names.add(name); });
  }
}

GustState Gusts::start(std::size_t body, std::int64_t seed) const {
  const FloatingPointEnvironment environment;
  GustState state{};
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Axis& axis = axes_[i];
    if (!axis.blows) continue;
    const auto xi = NoiseChannel(seed, streams_[body][i]).normals(kStart, 0);
    state[2 * i] = axis.s11 * xi[0];
    if (axis.is_double) state[2 * i + 1] = axis.s21 * xi[0] + axis.s22 * xi[1];
  }
  return state;
}

bool Gusts::canBe(const GustState& state) const {
  constexpr double kMostDeviations = 100.0;  // a normal variate is below 9
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double most_1 = kMostDeviations * axes_[i].s11;
    const double most_2 = kMostDeviations * (std::abs(axes_[i].s21) + std::abs(axes_[i].s22));
    const bool is_near = std::abs(state[2 * i]) <= most_1 && std::abs(state[2 * i + 1]) <= most_2;
    if (!is_near) return false;
  }
  return true;
}

void Gusts::advance(std::size_t body, std::int64_t seed, Tick tick, GustState& state) const {
  const FloatingPointEnvironment environment;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Axis& axis = axes_[i];
    if (!axis.blows) continue;
    const NoiseChannel channel(seed, streams_[body][i]);
    double& x1 = state[2 * i];
    if (!axis.is_double) {
      x1 = axis.decay * x1 + axis.l11 * channel.normal(tick);
      continue;
    }
    double& x2 = state[2 * i + 1];
    const auto xi = channel.normals(tick, 0);
    x1 = axis.decay * (x1 + axis.coupling * x2) + axis.l11 * xi[0];
    x2 = axis.decay * x2 + (axis.l21 * xi[0] + axis.l22 * xi[1]);
  }
}

Vector3 gustInWorld(const Vector3& mean_W, const Vector3& velocity) {
  const FloatingPointEnvironment environment;
  const double speed = std::sqrt(mean_W.x() * mean_W.x() + mean_W.y() * mean_W.y());
  const double cosine = speed > 0.0 ? mean_W.x() / speed : 1.0;
  const double sine = speed > 0.0 ? mean_W.y() / speed : 0.0;
  return {cosine * velocity.x() - sine * velocity.y(), sine * velocity.x() + cosine * velocity.y(),
          velocity.z()};
}

}  // namespace hovercraft
