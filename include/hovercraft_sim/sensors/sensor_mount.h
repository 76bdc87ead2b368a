#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/sensors/noise_process.h"
#include "hovercraft_sim/sensors/sensor_model.h"

namespace hovercraft {

/// Where a sensor S sits on its craft, and how often it is read.
struct SensorMount {
  Matrix3 R_BS = Matrix3::Identity();
  Vector3 p_HS = Vector3::Zero();     // m
  Vector3 p_HB = Vector3::Zero();     // m
  double step = 0.0;                  // s, of the simulation
  double period = 0.0;                // s, from one sample to the next
  std::vector<std::string> channels;  // as channelNames()

  Vector3 positionInBody() const { return p_HS - p_HB; }
};

/// Doubles of a memory, read and written as vectors.
inline Vector3 loadVector(const double* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}
inline void storeVector(const Vector3& v, double* numbers) {
  for (int i = 0; i < 3; ++i) numbers[i] = v[i];
}
inline Quaternion loadQuaternion(const double* numbers) {
  return {numbers[0], loadVector(numbers + 1)};
}
inline void storeQuaternion(const Quaternion& q, double* numbers) {
  numbers[0] = q.s;
  storeVector(q.v, numbers + 1);
}

/// One sample of a channel whose NoiseProcess::Memory lies at `memory`.
inline Vector3 measureChannel(const NoiseProcess& noise, const SensedInstant& instant,
                              const Vector3& truth, double* memory) {
  NoiseProcess::Memory state = {loadVector(memory), loadVector(memory + 3)};
  const Vector3 measured = noise.measure(instant.seed, instant.tick, truth, state);
  storeVector(state.bias, memory);
  return measured;
}
inline void startChannel(const NoiseProcess& noise, std::int64_t seed, double* memory) {
  const NoiseProcess::Memory state = noise.start(seed);
  storeVector(state.bias, memory);
  storeVector(state.turn_on, memory + 3);
}

}  // namespace hovercraft
