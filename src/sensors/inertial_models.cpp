#include "hovercraft_sim/sensors/inertial_models.h"

#include <cmath>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/elementary.h"

namespace hovercraft {
namespace {

constexpr double kEquatorialRadius = 6378137.0;            // m, WGS 84
constexpr double kSquaredEccentricity = 6.69437999014e-3;  // WGS 84
constexpr double kDegree = kPi / 180.0;

/// The rotation halfway between two.
Matrix3 halfway(const Quaternion& a, const Quaternion& b) {
  const double cosine = a.s * b.s + dot(a.v, b.v);
  const Quaternion sum = cosine < 0.0 ? a + -1.0 * b : a + b;
  return rotationMatrix(normalized(sum));
}

Vector3 centripetal(const Vector3& w, const Vector3& p) {
  return cross(w, cross(w, p));
}

}  // namespace

ImuModel::ImuModel(const ImuParameters& parameters, const SensorMount& mount)
    : gyroscope_(parameters.gyroscope, mount.period, mount.channels[0]),
      accelerometer_(parameters.accelerometer, mount.period, mount.channels[1]),
      gravity_W_(parameters.gravity_W),
      R_BS_(mount.R_BS),
      p_BS_(mount.positionInBody()),
      step_(mount.step) {}

void ImuModel::start(const SensedInstant& instant, double* memory) const {
  startChannel(gyroscope_, instant.seed, memory);
  startChannel(accelerometer_, instant.seed, memory + NoiseProcess::kMemorySize);
  relocate(instant, memory);
}

void ImuModel::relocate(const SensedInstant& instant, double* memory) const {
  memory[kTick] = static_cast<double>(instant.tick);
  storeVector(instant.twist.v_WB, memory + kVelocity);
  storeVector(transposeTimes(instant.R_WB, instant.twist.w_WB), memory + kSpin);
  storeQuaternion(instant.q_WB, memory + kOrientation);
}

Vector3 ImuModel::specificForce(const SensedInstant& instant, const Vector3& w_B,
                                const double* memory) const {
  const double dt = (static_cast<double>(instant.tick) - memory[kTick]) * step_;
  const Vector3 last_w_B = loadVector(memory + kSpin);
  const Vector3 dv_W = instant.twist.v_WB - loadVector(memory + kVelocity);
  const Matrix3 R_WM = halfway(loadQuaternion(memory + kOrientation), instant.q_WB);
  const Vector3 at_center = transposeTimes(R_WM, dv_W / dt - gravity_W_);
  const Vector3 turning = cross((w_B - last_w_B) / dt, p_BS_);
  return (at_center + turning) + 0.5 * (centripetal(last_w_B, p_BS_) + centripetal(w_B, p_BS_));
}

void ImuModel::measure(const SensedInstant& instant, double* memory, double* sample) {
  const Vector3 w_B = transposeTimes(instant.R_WB, instant.twist.w_WB);
  // Put elsewhere at this very tick, it has felt nothing since.
  const bool has_moved = static_cast<double>(instant.tick) > memory[kTick];
  const Vector3 force_B = has_moved ? specificForce(instant, w_B, memory)
                                    : transposeTimes(instant.R_WB, Vector3(-gravity_W_));
  storeVector(measureChannel(gyroscope_, instant, transposeTimes(R_BS_, w_B), memory), sample);
  storeVector(measureChannel(accelerometer_, instant, transposeTimes(R_BS_, force_B),
                             memory + NoiseProcess::kMemorySize),
              sample + 3);
  relocate(instant, memory);
}

GnssModel::GnssModel(const GnssParameters& parameters, const SensorMount& mount)
    : position_(parameters.position, mount.period, mount.channels[0]),
      velocity_(parameters.velocity, mount.period, mount.channels[1]),
      origin_(parameters.latitude_deg, parameters.longitude_deg, parameters.altitude),
      p_BS_(mount.positionInBody()) {
  const double latitude = parameters.latitude_deg * kDegree;
  const double sine = exactSin(latitude);
  const double w2 = 1.0 - kSquaredEccentricity * sine * sine;
  const double across = kEquatorialRadius / std::sqrt(w2);
  const double along = across * (1.0 - kSquaredEccentricity) / w2;
  degrees_north_ = 1.0 / (kDegree * (along + parameters.altitude));
  degrees_east_ = 1.0 / (kDegree * ((across + parameters.altitude) * exactCos(latitude)));
}

void GnssModel::start(const SensedInstant& instant, double* memory) const {
  startChannel(position_, instant.seed, memory);
  startChannel(velocity_, instant.seed, memory + NoiseProcess::kMemorySize);
}

void GnssModel::measure(const SensedInstant& instant, double* memory, double* sample) {
  const Vector3 arm_W = times(instant.R_WB, p_BS_);
  const Vector3 p_W = measureChannel(position_, instant, instant.p_WB + arm_W, memory);
  const Vector3 v_W =
      measureChannel(velocity_, instant, instant.twist.v_WB + cross(instant.twist.w_WB, arm_W),
                     memory + NoiseProcess::kMemorySize);
  sample[0] = origin_[0] + p_W.y() * degrees_north_;
  sample[1] = origin_[1] + p_W.x() * degrees_east_;
  if (sample[1] > 180.0) sample[1] -= 360.0;
  if (sample[1] < -180.0) sample[1] += 360.0;
  sample[2] = origin_[2] + p_W.z();
  storeVector(v_W, sample + 3);
}

MagnetometerModel::MagnetometerModel(const MagnetometerParameters& parameters,
                                     const SensorMount& mount)
    : noise_(parameters.field, mount.period, mount.channels[0]),
      field_W_(parameters.field_W),
      R_BS_(mount.R_BS) {}

void MagnetometerModel::start(const SensedInstant& instant, double* memory) const {
  startChannel(noise_, instant.seed, memory);
}

void MagnetometerModel::measure(const SensedInstant& instant, double* memory, double* sample) {
  const Vector3 field_S = transposeTimes(R_BS_, transposeTimes(instant.R_WB, field_W_));
  storeVector(measureChannel(noise_, instant, field_S, memory), sample);
}

}  // namespace hovercraft
