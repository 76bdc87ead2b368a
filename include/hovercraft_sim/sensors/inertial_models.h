#pragma once

#include "hovercraft_sim/sensors/sensor_mount.h"

namespace hovercraft {

/// Angular velocity at the sample, and specific force over the interval since the last one, both in
/// S. The force is that of the change of momentum, so that impacts and contact forces are in it:
///   f_B = R_mᵀ (Δv/Δt - g) + Δω/Δt × p + ω × (ω × p),
/// R_m being halfway between the orientations at both ends, Δω in B, and the last term the mean of
/// both ends. A body that turns steadily about z feels -ω² p exactly.
class ImuModel : public SensorModel {
 public:
  ImuModel(const ImuParameters& parameters, const SensorMount& mount);

  std::size_t memorySize() const override { return kSize; }
  std::size_t sampleSize() const override { return 6; }
  void start(const SensedInstant& instant, double* memory) const override;
  void measure(const SensedInstant& instant, double* memory, double* sample) override;
  void relocate(const SensedInstant& instant, double* memory) const override;

 private:
  // Memory: two channels, then the last sample: tick, v_WB, ω in B, q_WB.
  static constexpr std::size_t kTick = 2 * NoiseProcess::kMemorySize;
  static constexpr std::size_t kVelocity = kTick + 1;
  static constexpr std::size_t kSpin = kVelocity + 3;
  static constexpr std::size_t kOrientation = kSpin + 3;
  static constexpr std::size_t kSize = kOrientation + 4;

  Vector3 specificForce(const SensedInstant& instant, const Vector3& w_B,
                        const double* memory) const;

  NoiseProcess gyroscope_;
  NoiseProcess accelerometer_;
  Vector3 gravity_W_;
  Matrix3 R_BS_;
  Vector3 p_BS_;
  double step_;
};

/// Latitude, longitude (deg), height (m) and velocity (m/s; east, north, up) of the antenna, by the
/// radii of curvature at the origin of W: the plane that touches the ellipsoid of WGS 84 there.
class GnssModel : public SensorModel {
 public:
  GnssModel(const GnssParameters& parameters, const SensorMount& mount);

  std::size_t memorySize() const override { return 2 * NoiseProcess::kMemorySize; }
  std::size_t sampleSize() const override { return 6; }
  void start(const SensedInstant& instant, double* memory) const override;
  void measure(const SensedInstant& instant, double* memory, double* sample) override;

 private:
  NoiseProcess position_;
  NoiseProcess velocity_;
  Vector3 origin_;        // deg, deg, m
  double degrees_north_;  // per m
  double degrees_east_;   // per m
  Vector3 p_BS_;
};

/// The magnetic field of W, in S.
class MagnetometerModel : public SensorModel {
 public:
  MagnetometerModel(const MagnetometerParameters& parameters, const SensorMount& mount);

  std::size_t memorySize() const override { return NoiseProcess::kMemorySize; }
  std::size_t sampleSize() const override { return 3; }
  void start(const SensedInstant& instant, double* memory) const override;
  void measure(const SensedInstant& instant, double* memory, double* sample) override;

 private:
  NoiseProcess noise_;
  Vector3 field_W_;
  Matrix3 R_BS_;
};

}  // namespace hovercraft
