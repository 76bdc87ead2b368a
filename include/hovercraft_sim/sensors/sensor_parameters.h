#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// The error of one measured quantity of unit u, per axis (doc/sensors.md):
///   measured = truth (1 + scale) + offset + turn-on bias + bias + white noise.
/// The white noise and the bias each have kalibr's parameters or hector's, never both.
struct NoiseParameters {
  double noise_density = 0.0;          // u/√Hz: white, sigma = noise_density / √period
  double gaussian_noise = 0.0;         // u: white, sigma of a sample
  double random_walk = 0.0;            // u/s/√Hz: of the bias
  double bias_correlation_time = 0.0;  // s; 0: the bias walks for ever, from 0
  double drift = 0.0;                  // u: sigma of the bias
  double drift_frequency = 0.0;        // 1/s: 1 / correlation time of that bias
  double turn_on_bias_sigma = 0.0;     // u: drawn once in a run
  double scale = 0.0;                  // relative
  Vector3 offset = Vector3::Zero();    // u
};

struct ImuParameters {
  NoiseParameters gyroscope;            // rad/s
  NoiseParameters accelerometer;        // m/s²
  Vector3 gravity_W = Vector3::Zero();  // m/s²: what a body at rest does not fall with

  std::vector<NoiseParameters> noises() const { return {gyroscope, accelerometer}; }  // by channel
};

/// Latitude and longitude in degrees, as NavSatFix has them.
struct GnssParameters {
  double latitude_deg = 0.0;   // of the origin of W, whose x is east and y north
  double longitude_deg = 0.0;  // of the same
  double altitude = 0.0;       // m above the ellipsoid, of the same
  NoiseParameters position;    // m
  NoiseParameters velocity;    // m/s

  std::vector<NoiseParameters> noises() const { return {position, velocity}; }  // by channel
};

struct OdometryParameters {
  NoiseParameters linear;   // m/s
  NoiseParameters angular;  // rad/s
  bool planar = false;      // noise in x, y and yaw only

  std::vector<NoiseParameters> noises() const { return {linear, angular}; }  // by channel
};

struct MagnetometerParameters {
  Vector3 field_W = Vector3::Zero();  // T
  NoiseParameters field;              // T

  std::vector<NoiseParameters> noises() const { return {field}; }  // by channel
};

/// Beams in the xy plane of the sensor, from angle_min to angle_max, counter-clockwise.
struct LaserParameters {
  double angle_min = 0.0;  // rad
  double angle_max = 0.0;  // rad, >= angle_min
  std::int32_t beams = 1;  // how many
  double range_min = 0.0;  // m
  double range_max = 0.0;  // m
  NoiseParameters range;   // m; each beam has a white noise of its own, all share one bias

  /// rad, from one beam to the next.
  double increment() const { return beams > 1 ? (angle_max - angle_min) / (beams - 1) : 0.0; }
  std::vector<NoiseParameters> noises() const { return {range}; }  // by channel
};

/// In the order of the alternatives of SensorParameters::model. The noises() of each are those of
/// the channels of its traits, in their order.
enum class SensorKind { kImu, kGnss, kOdometry, kMagnetometer, kLaser };

/// What of its place a sensor is told.
enum class SensorPlace { kNone, kPosition, kPositionAndAxes };

/// What is said of a kind. Names in one text have a space between them.
struct SensorTraits {
  const char* name;                      // in scenarios; none: there is no such kind
  const char* topic;                     // of the first one of a craft, relative to its namespace
  SensorPlace place;                     // which keys it has
  const char* channels;                  // of its noise, those with keys of their own
  const char* fields;                    // the numbers of a sample; empty: sampleFields() says
  const char* velocity_topic = nullptr;  // of a second message, its velocity; none
};

/// One kind is one line here.
constexpr SensorTraits traitsOf(SensorKind kind) {
  switch (kind) {
    case SensorKind::kImu:
      return {"imu", "imu/data", SensorPlace::kPositionAndAxes, "gyroscope accelerometer",
              "wx wy wz ax ay az"};
    case SensorKind::kGnss:
      return {"gnss",
              "fix",
              SensorPlace::kPosition,
              "position velocity",
              "latitude longitude altitude v_east v_north v_up",
              "fix_velocity"};
    case SensorKind::kOdometry:
      return {"odometry", "odometry", SensorPlace::kNone, "linear angular", ""};
    case SensorKind::kMagnetometer:
      return {"magnetometer", "magnetic_field", SensorPlace::kPositionAndAxes, "field", "mx my mz"};
    case SensorKind::kLaser:
      return {"laser", "scan", SensorPlace::kPositionAndAxes, "range", ""};
  }
  return {nullptr, nullptr, SensorPlace::kNone, nullptr, nullptr};
}

/// One sensor of a craft, checked when it was read (sensor_parser.h).
struct SensorParameters {
  std::string name;
  double rate = 0.0;               // Hz
  Tick period = 1;                 // steps from one sample to the next
  std::int64_t latency_ns = 0;     // from measurement to delivery, at the first tick not before
  double drop = 0.0;               // probability that a sample is lost
  Vector3 p_HS = Vector3::Zero();  // m, where it is in the hull frame H
  Vector3 rpy = Vector3::Zero();   // rad, of its axes S in H
  /// What it is, and how good.
  std::variant<ImuParameters, GnssParameters, OdometryParameters, MagnetometerParameters,
               LaserParameters>
      model;

  /// By the alternative of `model`.
  SensorKind kind() const { return static_cast<SensorKind>(model.index()); }
};

/// The topics of the first sensor of each kind, and of its velocity, relative to the craft's
/// namespace.
HOVERCRAFT_PUBLIC std::vector<std::string> sensorTopics();

/// The channels of a kind that have keys, in the order of noises().
std::vector<std::string> noiseChannels(SensorKind kind);

/// The numbers of one sample of a kind, by name: the columns of its CSV file. Of a laser the
/// ranges.
HOVERCRAFT_PUBLIC std::vector<std::string> sampleFields(const SensorParameters& sensor);

/// The names of the noise channels of a sensor: "vehicle/sensor/channel". They are part of the
/// contract: the noise depends on them.
HOVERCRAFT_PUBLIC std::vector<std::string> channelNames(const std::string& vehicle,
                                                        const SensorParameters& sensor);

}  // namespace hovercraft
