#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/scenario/key_table.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/sensors/sensor_parameters.h"

/// The keys of the sensors of a craft (key_table.h).

namespace hovercraft {

constexpr double kMostNoise = 1e30;       // of any unit: its square is still a number
constexpr double kMostBeams = 20000.0;    // a turn in steps of a minute of arc
constexpr double kLongestLatency = 60.0;  // s

inline constexpr NumberRule kNoise = {[](double x) { return x >= 0.0 && x <= kMostNoise; },
                                      "must be 0 to 1e30"};
inline constexpr NumberRule kSignedNoise = {
    [](double x) { return x >= -kMostNoise && x <= kMostNoise; },
    "must be at most 1e30, of either sign"};
inline constexpr NumberRule kProbability = {[](double x) { return x >= 0.0 && x <= 1.0; },
                                            "must be a probability, 0 to 1"};
inline constexpr NumberRule kLatency = {[](double x) { return x >= 0.0 && x <= kLongestLatency; },
                                        "must be 0 to 60 s"};
inline constexpr NumberRule kLatitude = {[](double x) { return x >= -89.0 && x <= 89.0; },
                                         "must be -89 to 89 degrees"};
inline constexpr NumberRule kLongitude = {[](double x) { return x >= -180.0 && x <= 180.0; },
                                          "must be -180 to 180 degrees"};
inline constexpr NumberRule kAltitude = {[](double x) { return x >= -1e4 && x <= 1e5; },
                                         "must be -10000 to 100000 m"};
inline constexpr NumberRule kBeams = {[](double x) { return x >= 1.0 && x <= kMostBeams; },
                                      "must be 1 to 20000"};
inline constexpr NumberRule kAngle = {[](double x) { return x >= -2.0 * kPi && x <= 2.0 * kPi; },
                                      "must be within a turn, -6.2832 to 6.2832 rad"};

/// Of NoiseParameters; CHANNEL_ begins each. Units are those of a channel's u. Written are the
/// white noise and the bias by kalibr's parameters or by hector's.
inline constexpr auto kNoiseKeys = [](auto& noise, auto&& visit) {
  const bool is_hectors = noise.drift > 0.0 || noise.drift_frequency > 0.0;
  visit(optional(
            writtenIf(!(noise.gaussian_noise > 0.0), NumberKey("noise_density", "u/√Hz", kNoise))),
        noise.noise_density);
  visit(optional(writtenIf(noise.gaussian_noise > 0.0, NumberKey("gaussian_noise", "u", kNoise))),
        noise.gaussian_noise);
  visit(optional(writtenIf(!is_hectors, NumberKey("random_walk", "u/s/√Hz", kNoise))),
        noise.random_walk);
  visit(optional(writtenIf(!is_hectors, NumberKey("bias_correlation_time", "s", kNoise))),
        noise.bias_correlation_time);
  visit(optional(writtenIf(is_hectors, NumberKey("drift", "u", kNoise))), noise.drift);
  visit(optional(writtenIf(is_hectors, NumberKey("drift_frequency", "1/s", kNoise))),
        noise.drift_frequency);
  visit(optional(NumberKey("turn_on_bias_sigma", "u", kNoise)), noise.turn_on_bias_sigma);
  visit(optional(NumberKey("scale", "", kSignedNoise)), noise.scale);
  visit(optional(NumberOrVectorKey("offset", "u", kSignedNoise)), noise.offset);
};

using SensorModelParameters = decltype(SensorParameters::model);

/// The model of a kind before its keys are read.
template <std::size_t kIndex = 0>
SensorModelParameters unreadModel(SensorKind kind) {
  if constexpr (kIndex + 1 < std::variant_size_v<SensorModelParameters>) {
    if (kIndex != static_cast<std::size_t>(kind)) return unreadModel<kIndex + 1>(kind);
  }
  return SensorModelParameters(std::in_place_index<kIndex>);
}

/// Of a kind alone, besides its noise: of an alternative of SensorParameters::model.
inline constexpr auto kSensorModelKeys = [](auto& model, [[maybe_unused]] auto&& visit) {
  using Model = std::decay_t<decltype(model)>;
  if constexpr (std::is_same_v<Model, ImuParameters>) {
    visit(optional(VectorKey("gravity", "m/s²", kSignedNoise)), model.gravity_W);
  } else if constexpr (std::is_same_v<Model, GnssParameters>) {
    visit(NumberKey("latitude_deg", "°", kLatitude), model.latitude_deg);
    visit(NumberKey("longitude_deg", "°", kLongitude), model.longitude_deg);
    visit(optional(NumberKey("altitude", "m", kAltitude)), model.altitude);
  } else if constexpr (std::is_same_v<Model, MagnetometerParameters>) {
    visit(VectorKey("field", "T", kSignedNoise), model.field_W);
  } else if constexpr (std::is_same_v<Model, LaserParameters>) {
    visit(NumberKey("angle_min", "rad", kAngle), model.angle_min);
    visit(NumberKey("angle_max", "rad", kAngle), model.angle_max);
    visit(WholeNumberKey("beams", "", kBeams), model.beams);
    visit(optional(NumberKey("range_min", "m", kNotNegative)), model.range_min);
    visit(LengthKey("range_max", "m"), model.range_max);
  }
};

/// The noise of each channel of a model, in the order of noises().
struct NoisesOf {
  using Noises = std::vector<NoiseParameters*>;
  Noises operator()(ImuParameters& imu) const { return {&imu.gyroscope, &imu.accelerometer}; }
  Noises operator()(GnssParameters& gnss) const { return {&gnss.position, &gnss.velocity}; }
  Noises operator()(OdometryParameters& odometry) const {
    return {&odometry.linear, &odometry.angular};
  }
  Noises operator()(MagnetometerParameters& magnetometer) const { return {&magnetometer.field}; }
  Noises operator()(LaserParameters& laser) const { return {&laser.range}; }
};

/// Of SensorParameters whose model says of which kind it is; `kind` stands before them, the noise
/// of each channel behind them.
inline constexpr auto kSensorKeys = [](auto& sensor, auto&& visit) {
  visit(NumberKey("rate", "Hz", kPositive), sensor.rate);
  visit(optional(DurationKey("latency", kLatency)), sensor.latency_ns);
  visit(optional(NumberKey("drop", "", kProbability)), sensor.drop);
  const SensorPlace place = traitsOf(sensor.kind()).place;
  if (place != SensorPlace::kNone) {
    visit(optional(VectorKey("position", "m", kCoordinate)), sensor.p_HS);
  }
  if (place == SensorPlace::kPositionAndAxes) {
    visit(optional(VectorKey("rpy", "rad")), sensor.rpy);
  }
  std::visit([&visit](auto& model) { kSensorModelKeys(model, visit); }, sensor.model);
};

}  // namespace hovercraft
