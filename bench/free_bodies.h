#pragma once

#include <cstdint>
#include <fmt/format.h>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "hovercraft_sim/body/rigid_body.h"

#include "test/support/free_body.h"

namespace hovercraft::bench {

/// A body without forces, whose motion is known in closed form; it starts with B along W.
struct FreeCase {
  const char* name;
  double mass;      // kg
  Vector3 moments;  // principal moments along the axes of B, kg m²
  Vector3 w_WB_B;   // rad/s at t = 0
  double duration;  // s

  Mobility mobility() const { return Mobility::spatial(mass, moments.asDiagonal()); }
  testing::FreeBody exact() const { return {moments, w_WB_B, Matrix3::Identity()}; }
};

/// Three different moments, and a spin about no principal axis: it tumbles.
inline FreeCase asymmetricBody() {
  return {"free asymmetric body", 1.0, {0.4, 0.7, 1.0}, {0.5, 1.25, 0.75}, 10.0};
}

/// Check-case 2, "tumbling brick, no damping", of NASA/TM-2015-218675 (2015), "Check-cases for
/// verification of 6-degree-of-freedom flight vehicle simulations": 0.155404754 slug; 0.00189422,
/// 0.006211019 and 0.007194665 slug ft²; p, q, r = 10, 20, 30 deg/s.
inline FreeCase tumblingBrick() {
  constexpr double slug = 14.593902937206364;      // kg: lbf s²/ft, exact pound and foot
  constexpr double slug_ft2 = 1.3558179483314004;  // kg m²
  constexpr double degree = 0.017453292519943295;  // rad
  return {"tumbling brick", 0.155404754 * slug,
          slug_ft2 * Vector3(0.00189422, 0.006211019, 0.007194665),
          degree * Vector3(10.0, 20.0, 30.0), 30.0};
}

/// Step sizes of every comparison, s, in whole nanoseconds.
inline std::vector<std::int64_t> comparedStepsNs() {
  return {10000000, 5000000, 2000000, 1000000};
}

/// The angle between an attitude at the end of the case and the exact one, rad.
inline double attitudeError(const FreeCase& body, const Quaternion& q_WB) {
  return angleBetween(quaternionFromMatrix(body.exact().attitude(body.duration)), q_WB);
}

/// The table of errors that plot_accuracy.py reads: a file with its header, or nowhere if `path` is
/// null. @throws std::invalid_argument if it cannot be written.
inline std::ofstream errorTable(const char* path) {
  std::ofstream csv;
  if (path != nullptr) {
    csv.open(path);
    if (!csv) throw std::invalid_argument(fmt::format("{}: cannot be written", path));
  }
  csv << "body,engine,method,step_size,attitude_error,energy_drift\n";
  return csv;
}

}  // namespace hovercraft::bench
