#pragma once

#include <optional>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/body/steppers.h"
#include "hovercraft_sim/hovercraft/step_inputs.h"
#include "hovercraft_sim/math/vector.h"

/// A step of a planar craft without what is zero in it: the bits of integrationStep() with a planar
/// Mobility, for a third of the arithmetic.
///
/// Why the bits are the same. While q.x, q.y, P.z, L.x and L.y are +0, each term that is left out
/// is a zero or a sum with one, and a factor that is left out is 1: neither rounds. What is left
/// out decides at most the sign of a zero in a slope, and Y + h k takes no notice of that, unless a
/// component of Y is -0. A sum is never -0 if one of its terms is not, so +0 and "not -0" last.
/// takes() looks whether all this holds of a state; where it does not, the step is made in full.

namespace hovercraft {

/// What a step needs of a planar craft on which nothing but engines, drag and weight acts.
class PlanarCraft {
 public:
  /// @returns nothing of another craft, and of one whose constants are so large (kLargest) that a
  /// part which is left out might overflow.
  [[nodiscard]] static std::optional<PlanarCraft> of(const HovercraftModel& model);

  /// Of which methods it has the steps.
  static bool has(Integrator integrator) { return integrator != Integrator::kLie4; }

  /// Whether step() gives the bits of a step in full: neither load nor roll, pitch or -0.
  bool takes(const RigidBodyState<Quaternion>& y, const DrivenBody& f) const;

  /// One step of length h (s) by a method that it has(). The inputs are those that takes() was
  /// asked of.
  void step(Integrator integrator, const RigidBodyState<Quaternion>& y, const DrivenBody& f,
            double h, RigidBodyState<Quaternion>& end) const;

  static constexpr double kLargest = 1e100;  // SI units; the product of three is finite

 private:
  /// A component along x and y of W or B, and one about z: of a force and moment, or drag.
  struct Planar {
    double x = 0.0;
    double y = 0.0;
    double yaw = 0.0;
  };
  /// (x, y; s, z of the quaternion; P_x, P_y; L_z), or its rate.
  struct State {
    double x, y, s, z, px, py, l;
  };
  PlanarCraft() = default;
  Planar wrenchOf(const ActuatorArray<double>& thrusts) const;
  State slope(const State& y, const Planar& engines_B, const Vector3& wind_W) const;
  State stepped(Integrator integrator, const State& y, const DrivenBody& f, double h) const;
  static State moved(const State& y, double h, const State& k);
  static State sum(const State& a, const State& b);

  double inverse_mass_ = 0.0;     // 1/kg
  double inverse_inertia_ = 0.0;  // 1/I_zz, 1/(kg m²)
  Planar engines_[kEngineCount];  // of 1 N
  Planar linear_;                 // of drag, N s/m and N m s
  Planar quadratic_;              // N s²/m² and N m s²
  Planar weight_W_;               // N
};

}  // namespace hovercraft
