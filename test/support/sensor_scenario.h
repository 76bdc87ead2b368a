#pragma once

#include <string>

#include "scenarios.h"

/// Sensors of every kind, as keys of a vehicle of a scenario of 1 kHz.

namespace hovercraft::testing {

inline const std::string& allSensors() {
  static const std::string text = R"(    tf: odometry
    sensors:
      imu: {kind: imu, rate: 200, latency: 0.003, drop: 0.1, position: [0.1, -0.05, 0.02], rpy: [0.1, 0.2, 0.3], gyroscope_noise_density: 3.394e-4, gyroscope_random_walk: 3.8785e-5, gyroscope_bias_correlation_time: 1000, gyroscope_turn_on_bias_sigma: 0.0087, accelerometer_noise_density: 0.004, accelerometer_random_walk: 0.006, accelerometer_bias_correlation_time: 300, accelerometer_turn_on_bias_sigma: 0.196, accelerometer_scale: 0.001, accelerometer_offset: [0.01, 0, -0.02]}
      gps: {kind: gnss, rate: 5, latency: 0.25, position: [-0.1, 0, 0.2], latitude_deg: 52.2, longitude_deg: 21, altitude: 110, position_gaussian_noise: 0.5, position_drift: 1, position_drift_frequency: 0.01, velocity_gaussian_noise: 0.05}
      wheel: {kind: odometry, rate: 50, linear_gaussian_noise: 0.02, linear_scale: 0.01, angular_noise_density: 0.001, angular_random_walk: 0.0001}
      compass: {kind: magnetometer, rate: 20, rpy: [0, 0, 1.5], field: [1e-6, 1.9e-5, -4.6e-5], field_gaussian_noise: 1e-7}
)";
  return text;
}

inline const std::string& laserSensor() {
  static const std::string text =
      "      lidar: {kind: laser, rate: 10, latency: 0.02, position: [0.1, 0, 0.03], rpy: [0, 0, "
      "0.1], angle_min: -2.3561944901923448, angle_max: 2.3561944901923448, beams: 271, "
      "range_min: 0.05, range_max: 12, range_gaussian_noise: 0.01, range_offset: 0.002}\n";
  return text;
}

/// A craft of 0.5 m before a wall, with these keys of the vehicle.
inline std::string sensedCraftYaml(const std::string& sensors, const std::string& seed = "1") {
  return "step_size: 0.001\nmodel: planar\nseed: " + seed +
         "\nworld: {obstacles: {wall: {box: {size: [0.2, 8, 2]}, position: [3, 0, 0]}}}\n"
         "vehicles:\n" +
         craftYaml("craft") + "    hull: {box: {size: [0.5, 0.5, 0.5]}}\n" + sensors;
}

}  // namespace hovercraft::testing
