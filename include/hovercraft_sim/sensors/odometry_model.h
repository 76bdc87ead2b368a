#pragma once

#include "hovercraft_sim/sensors/sensor_mount.h"

namespace hovercraft {

/// The rotation by a vector phi, rad: [cos |phi|/2, sin(|phi|/2) phi/|phi|], by Taylor series and
/// doubling, to rounding.
HOVERCRAFT_PUBLIC Quaternion quaternionOfRotationVector(const Vector3& phi);

/// The twist of base_link with noise, and the pose that it adds up to: from the identity at the
/// start, by the mean of the twists at both ends of an interval. The covariance of that pose is
/// what the white noise makes of it (first order, axes of the odometry frame).
class OdometryModel : public SensorModel {
 public:
  OdometryModel(const OdometryParameters& parameters, const SensorMount& mount);

  std::size_t memorySize() const override { return kSize; }
  std::size_t sampleSize() const override { return 34; }
  void start(const SensedInstant& instant, double* memory) const override;
  void measure(const SensedInstant& instant, double* memory, double* sample) override;
  void relocate(const SensedInstant& instant, double* memory) const override;

 private:
  // Memory: two channels; the last twist, linear and angular; position, quaternion; covariance:
  // of the position (3 x 3), of position with rotation (3 x 3), of the rotation (3 x 3), by
  // columns.
  static constexpr std::size_t kLinear = 2 * NoiseProcess::kMemorySize;
  static constexpr std::size_t kAngular = kLinear + 3;
  static constexpr std::size_t kPosition = kAngular + 3;
  static constexpr std::size_t kOrientation = kPosition + 3;
  static constexpr std::size_t kCovariance = kOrientation + 4;
  static constexpr std::size_t kSize = kCovariance + 27;

  void integrate(const Vector3& linear, const Vector3& angular, double* memory) const;
  void spread(const Vector3& way, double* memory) const;

  NoiseProcess linear_;
  NoiseProcess angular_;
  Vector3 linear_axes_;  // 1 where there is noise
  Vector3 angular_axes_;
  Vector3 p_BH_;
  double period_;
};

}  // namespace hovercraft
