#include "hovercraft_sim/sensors/odometry_model.h"

#include <array>
#include <cmath>

#include "hovercraft_sim/math/rotation.h"

namespace hovercraft {
namespace {

Matrix3 loadMatrix(const double* numbers) {
  Matrix3 A;
  for (Eigen::Index column = 0; column < 3; ++column) {
    A.col(column) = loadVector(numbers + 3 * column);
  }
  return A;
}
void storeMatrix(const Matrix3& A, double* numbers) {
  for (Eigen::Index column = 0; column < 3; ++column) {
    storeVector(A.col(column), numbers + 3 * column);
  }
}

}  // namespace

Quaternion quaternionOfRotationVector(const Vector3& phi) {
  // Half the angle, halved again until its series end at rounding: 0.5^16/16! = 7e-19.
  Vector3 half = 0.5 * phi;
  int doublings = 0;
  for (; squaredNorm(half) > 0.25 && doublings < 64; ++doublings) half = 0.5 * half;
  const double x = squaredNorm(half);
  double cosine = 1.0;
  double sine_over_angle = 1.0;
  for (int n = 14; n > 0; n -= 2) {
    cosine = 1.0 - x / ((n - 1) * n) * cosine;
    sine_over_angle = 1.0 - x / (n * (n + 1)) * sine_over_angle;
  }
  Quaternion q = {cosine, sine_over_angle * half};
  for (; doublings > 0; --doublings) q = q * q;
  return normalized(q);
}

OdometryModel::OdometryModel(const OdometryParameters& parameters, const SensorMount& mount)
    : linear_(parameters.linear, mount.period, mount.channels[0]),
      angular_(parameters.angular, mount.period, mount.channels[1]),
      linear_axes_(1.0, 1.0, parameters.planar ? 0.0 : 1.0),
      angular_axes_(parameters.planar ? Vector3(0.0, 0.0, 1.0) : Vector3(1.0, 1.0, 1.0)),
      p_BH_(-mount.p_HB),
      period_(mount.period) {}

namespace {

/// Velocity of the origin of base_link in its own axes.
Vector3 linearOf(const SensedInstant& instant, const Vector3& p_BH) {
  const Vector3 arm_W = times(instant.R_WB, p_BH);
  return transposeTimes(instant.R_WB, instant.twist.v_WB + cross(instant.twist.w_WB, arm_W));
}
Vector3 angularOf(const SensedInstant& instant) {
  return transposeTimes(instant.R_WB, instant.twist.w_WB);
}

/// The measured value where there is noise, the truth elsewhere.
Vector3 chosen(const Vector3& axes, const Vector3& measured, const Vector3& truth) {
  Vector3 result = truth;
  for (int i = 0; i < 3; ++i) {
    if (axes[i] != 0.0) result[i] = measured[i];
  }
  return result;
}

}  // namespace

void OdometryModel::start(const SensedInstant& instant, double* memory) const {
  for (std::size_t i = 0; i < kSize; ++i) memory[i] = 0.0;
  startChannel(linear_, instant.seed, memory);
  startChannel(angular_, instant.seed, memory + NoiseProcess::kMemorySize);
  storeQuaternion(Quaternion::identity(), memory + kOrientation);
  relocate(instant, memory);
}

void OdometryModel::relocate(const SensedInstant& instant, double* memory) const {
  storeVector(linearOf(instant, p_BH_), memory + kLinear);
  storeVector(angularOf(instant), memory + kAngular);
}

void OdometryModel::measure(const SensedInstant& instant, double* memory, double* sample) {
  const Vector3 v = linearOf(instant, p_BH_);
  const Vector3 w = angularOf(instant);
  const Vector3 linear = chosen(linear_axes_, measureChannel(linear_, instant, v, memory), v);
  const Vector3 angular = chosen(
      angular_axes_, measureChannel(angular_, instant, w, memory + NoiseProcess::kMemorySize), w);
  integrate(linear, angular, memory);
  for (std::size_t i = 0; i < 7; ++i) sample[i] = memory[kPosition + i];
  storeVector(linear, sample + 7);
  storeVector(angular, sample + 10);
  const double* blocks = memory + kCovariance;
  double* entry = sample + 13;
  for (std::size_t row = 0; row < 6; ++row) {
    for (std::size_t column = row; column < 6; ++column) {
      const std::size_t block = (row < 3 ? 0U : 1U) + (column < 3 ? 0U : 1U);
      *entry++ = blocks[9 * block + 3 * (column % 3) + row % 3];
    }
  }
}

void OdometryModel::integrate(const Vector3& linear, const Vector3& angular, double* memory) const {
  const Vector3 v = 0.5 * (loadVector(memory + kLinear) + linear);
  const Vector3 w = 0.5 * (loadVector(memory + kAngular) + angular);
  const Quaternion q = loadQuaternion(memory + kOrientation);
  const Quaternion q_middle = q * quaternionOfRotationVector(0.5 * period_ * w);
  const Vector3 way = rotate(normalized(q_middle), Vector3(period_ * v));
  spread(way, memory);
  storeVector(loadVector(memory + kPosition) + way, memory + kPosition);
  storeQuaternion(normalized(q * quaternionOfRotationVector(period_ * w)), memory + kOrientation);
  storeVector(linear, memory + kLinear);
  storeVector(angular, memory + kAngular);
}

/// P <- F P Fᵀ + Q with F = [1, A; 0, 1], A = -skew(way): an error of the orientation turns the way
/// that is left.
void OdometryModel::spread(const Vector3& way, double* memory) const {
  double* blocks = memory + kCovariance;
  const Matrix3 R = rotationMatrix(loadQuaternion(memory + kOrientation));
  const auto added = [&](double sigma, const Vector3& axes) {
    const double variance = sigma * sigma * period_ * period_;
    Matrix3 spread_W = Matrix3::Zero();
    for (int i = 0; i < 3; ++i) {
      const Vector3 axis = R.col(i);
      if (axes[i] == 0.0) continue;
      for (int column = 0; column < 3; ++column) {
        spread_W.col(column) += (variance * axis[column]) * axis;
      }
    }
    return spread_W;
  };
  const Matrix3 A = -skew(way);
  const Matrix3 pp = loadMatrix(blocks);
  const Matrix3 pr = loadMatrix(blocks + 9);
  const Matrix3 rr = loadMatrix(blocks + 18);
  const Matrix3 turned = product(A, pr.transpose());
  const Matrix3 back = product(product(A, rr), Matrix3(A.transpose()));
  const Matrix3 both = turned + turned.transpose();
  storeMatrix((pp + both) + (back + added(linear_.white(), linear_axes_)), blocks);
  storeMatrix(pr + product(A, rr), blocks + 9);
  storeMatrix(rr + added(angular_.white(), angular_axes_), blocks + 18);
}

}  // namespace hovercraft
