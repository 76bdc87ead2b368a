#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hovercraft_sim/body/body_state.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/sensors/ray_ground.h"
#include "hovercraft_sim/sensors/ray_scene.h"
#include "hovercraft_sim/sensors/sensor_parameters.h"

namespace hovercraft {

/// Where the moving bodies are: vehicles first, then loose bodies.
using BodyStates = std::vector<BodyState>;

/// The craft of a sensor at one tick, and what is around it.
struct SensedInstant {
  std::int64_t seed = 0;               // of the run
  Tick tick = 0;                       // of the sample
  Vector3 p_WB;                        // m, of the centre of mass
  Quaternion q_WB;                     // B -> W
  Matrix3 R_WB;                        // the same as a matrix
  Twist twist;                         // in W
  const BodyStates* bodies = nullptr;  // where all of them are
};

/// One sensor of a craft: a pure function of the instant and of its memory, which is an array of
/// doubles (biases, what it integrates). It never changes what it measures.
class SensorModel {
 public:
  SensorModel() = default;
  SensorModel(const SensorModel&) = delete;
  SensorModel& operator=(const SensorModel&) = delete;
  virtual ~SensorModel() = default;

  /// Doubles of its memory, and of a sample: the same for the whole life of the model.
  virtual std::size_t memorySize() const = 0;
  virtual std::size_t sampleSize() const = 0;
  /// Fills the memory at the start of a run.
  virtual void start(const SensedInstant& instant, double* memory) const = 0;
  /// One sample; the memory goes on to the instant.
  virtual void measure(const SensedInstant& instant, double* memory, double* sample) = 0;
  /// The craft was put elsewhere at this instant.
  virtual void relocate(const SensedInstant& /*instant*/, double* /*memory*/) const {}
};

/// What a sensor's model is made from.
struct SensorSite {
  std::string vehicle;                              // name
  std::int32_t body = 0;                            // index of the craft among the moving bodies
  Vector3 p_HB = Vector3::Zero();                   // m, its centre of mass in H
  double step = 0.0;                                // s, of the simulation
  const std::vector<RayTarget>* targets = nullptr;  // what lasers see; outlives the model
  const RayGround* ground = nullptr;                // the same; none: there is nothing below
};

/// The model of a sensor. @throws nothing: the parameters were checked.
HOVERCRAFT_PUBLIC std::unique_ptr<SensorModel> makeSensorModel(const SensorParameters& parameters,
                                                               const SensorSite& site);

/// The variances of a sample that messages report, constant over a run, in the unit of the channel
/// squared: of an IMU gyroscope, accelerometer; of GNSS position, velocity; of odometry linear,
/// angular; of a magnetometer field; of a laser range.
HOVERCRAFT_PUBLIC std::vector<double> sampleVariances(const SensorParameters& parameters,
                                                      double step);

}  // namespace hovercraft
