#pragma once

#include <array>
#include <cstddef>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// Most actuators of one allocation: three engines and eight others.
constexpr std::size_t kMostActuators = 11;

/// Which thrusts make a wrench. A wrench in the plane is (F_x, F_y, M_z) in B: N, N, N m.
struct AllocationProblem {
  std::size_t count = 0;                        // of actuators
  std::array<Vector3, kMostActuators> columns;  // wrench of 1 N of each
  std::array<double, kMostActuators> low{};     // N
  std::array<double, kMostActuators> high{};    // N, >= low
  Vector3 weights = Vector3::Ones();            // 1/N, 1/N, 1/(N m): what an error counts
  double effort = 1e-4;                         // 1/N: what a thrust counts, > 0
};

using Thrusts = std::array<double, kMostActuators>;

/// The thrusts f within their limits that are the only ones to minimise
///   Σ_i (weights_i (B f - wrench)_i)² + effort² Σ_k f_k²
/// exactly, by an active set (bounded least squares; Stark & Parker 1995): one actuator after
/// another is set free, and held again where it would leave its limits.
HOVERCRAFT_PUBLIC Thrusts allocate(const AllocationProblem& problem, const Vector3& wrench);

/// B f.
HOVERCRAFT_PUBLIC Vector3 wrenchOf(const AllocationProblem& problem, const Thrusts& thrusts);

}  // namespace hovercraft
