#include "hovercraft_sim/sensors/noise_process.h"

#include <cmath>

#include "hovercraft_sim/math/elementary.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/noise.h"

namespace hovercraft {
namespace {

// Tick 0 has no sample: its draws are those of the start.
constexpr Tick kStart = 0;

/// The first three of the six standard normal variates of a tick.
Vector3 firstNormals(const NoiseChannel& channel, Tick tick) {
  const auto a = channel.normals(tick, 0);
  return {a[0], a[1], channel.normal(tick, 1)};
}

/// All six: two of each draw.
std::array<Vector3, 2> sixNormals(const NoiseChannel& channel, Tick tick) {
  const auto a = channel.normals(tick, 0);
  const auto b = channel.normals(tick, 1);
  const auto c = channel.normals(tick, 2);
  return {Vector3(a[0], a[1], b[0]), Vector3(b[1], c[0], c[1])};
}

/// A bias by its decay rate, 1/s, and its stationary sigma.
struct BiasLaw {
  double decay = 1.0;
  double kick = 0.0;
  double stationary = 0.0;
};

/// 1 - e^-x for x >= 0, without cancellation: below 1e-3 by a series whose next term is x^6/720.
double lostShare(double x) {
  if (x > 1e-3) return 1.0 - exactExp(-x);
  return x * (1.0 - x / 2.0 * (1.0 - x / 3.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0))));
}

BiasLaw gaussMarkov(double stationary, double rate, double period) {
  const double decay = exactExp(-period * rate);
  return {decay, stationary * std::sqrt(lostShare(2.0 * period * rate)), stationary};
}

BiasLaw biasLaw(const NoiseParameters& p, double period) {
  if (p.drift > 0.0) return gaussMarkov(p.drift, p.drift_frequency, period);
  if (p.bias_correlation_time > 0.0) {
    return gaussMarkov(p.random_walk * std::sqrt(0.5 * p.bias_correlation_time),
                       1.0 / p.bias_correlation_time, period);
  }
  return {1.0, p.random_walk * std::sqrt(period), 0.0};
}

}  // namespace

NoiseProcess::NoiseProcess(const NoiseParameters& parameters, double period,
                           const std::string& channel)
    : stream_(streamOf(channel)) {
  const FloatingPointEnvironment environment;
  offset_ = parameters.offset;
  gain_ = 1.0 + parameters.scale;
  white_ = parameters.gaussian_noise > 0.0 ? parameters.gaussian_noise
                                           : parameters.noise_density / std::sqrt(period);
  turn_on_ = parameters.turn_on_bias_sigma;
  const BiasLaw law = biasLaw(parameters, period);
  decay_ = law.decay;
  kick_ = law.kick;
  stationary_ = law.stationary;
}

NoiseProcess::Memory NoiseProcess::start(std::int64_t seed) const {
  const FloatingPointEnvironment environment;
  const auto [turn_on, bias] = sixNormals(NoiseChannel(seed, stream_), kStart);
  return {stationary_ * bias, turn_on_ * turn_on};
}

Vector3 NoiseProcess::measure(std::int64_t seed, Tick tick, const Vector3& truth,
                              Memory& memory) const {
  Vector3 measured = gain_ * truth + (offset_ + memory.turn_on);
  if (white_ == 0.0 && kick_ == 0.0) return measured + memory.bias;
  const NoiseChannel channel(seed, stream_);
  if (kick_ == 0.0) return measured + (memory.bias + white_ * firstNormals(channel, tick));
  const auto [white, kick] = sixNormals(channel, tick);
  memory.bias = decay_ * memory.bias + kick_ * kick;
  return measured + (memory.bias + white_ * white);
}

double NoiseProcess::variance() const {
  const FloatingPointEnvironment environment;
  return FloatingPointEnvironment::computed((white_ * white_ + turn_on_ * turn_on_) +
                                            stationary_ * stationary_);
}

}  // namespace hovercraft
