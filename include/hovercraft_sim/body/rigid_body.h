#pragma once

#include <limits>
#include <optional>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/math/rotation.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// State of a rigid body, Y = (x, q or R, P, L) of (24). W is the world, B the body frame at the
/// centre of mass.
///
/// The momenta are the state and velocities are derived from it: dP/dt = F and dL/dt = M are then
/// exact, and a free body keeps both to the last bit.
/// @tparam Orientation Quaternion (unit) or Matrix3 (rotation), B -> W.
template <class Orientation>
struct RigidBodyState {
  Vector3 p_WB = Vector3::Zero();                // m
  Orientation orientation;                       // B -> W
  Vector3 momentum_W = Vector3::Zero();          // P, kg m/s
  Vector3 angular_momentum_W = Vector3::Zero();  // L about the centre of mass, kg m^2/s
};

/// Resultant force (N) and moment about the centre of mass (N m), in W unless a name says
/// otherwise.
struct Wrench {
  Vector3 force = Vector3::Zero();
  Vector3 torque = Vector3::Zero();
};

inline Wrench operator+(const Wrench& a, const Wrench& b) {  // component by component
  return {a.force + b.force, a.torque + b.torque};
}

/// Velocity of the centre of mass (m/s) and angular velocity (rad/s), in W.
struct Twist {
  Vector3 v_WB = Vector3::Zero();
  Vector3 w_WB = Vector3::Zero();
};

/// dY/dt of (24).
template <class Orientation>
struct StateDerivative {
  Vector3 v_WB;                  // in W, m/s
  Orientation orientation_rate;  // not a rotation: ½[0,w]q or skew(w)R
  Vector3 force_W;               // N
  Vector3 torque_W;              // N m
};

/// Wrench about the centre of mass of the force f_W that acts at the world point p_WP (10), all in
/// W.
inline Wrench wrenchOfForceAt(const Vector3& f_W, const Vector3& p_WP, const Vector3& p_WB) {
  return {f_W, cross(p_WP - p_WB, f_W)};
}

/// Velocity in W of the body point at p_WP: v + w × (p - x) (physics.md 1; the source leaves the
/// second term out).
inline Vector3 velocityOfPoint(const Twist& twist, const Vector3& p_WP, const Vector3& p_WB) {
  return twist.v_WB + cross(twist.w_WB, p_WP - p_WB);
}

inline Matrix3 rotationMatrix(const Matrix3& R_WB) {  // of an orientation, B -> W
  return R_WB;
}

inline Quaternion orientationRate(const Vector3& w_WB, const Quaternion& q_WB) {  // dq/dt, 1/s
  return quaternionRateWorld(w_WB, q_WB);
}
inline Matrix3 orientationRate(const Vector3& w_WB, const Matrix3& R_WB) {  // dR/dt, likewise
  return rotationRate(w_WB, R_WB);
}

/// Back onto the unit sphere, the shortest way: that is no farther than the result is off it, which
/// is O(h^(p+1)) after a stepper of order p. So the order survives.
inline Quaternion renormalized(const Quaternion& q) {
  return normalized(q);
}
/// Back onto SO(3), likewise; NaN where a step was so long that no rotation is near.
inline Matrix3 renormalized(const Matrix3& R) {
  const std::optional<Matrix3> nearest = findNearestRotation(R);
  return nearest ? *nearest : Matrix3(Matrix3::Constant(std::numeric_limits<double>::quiet_NaN()));
}

inline Quaternion toQuaternion(const Quaternion& q_WB) {  // of the same rotation
  return q_WB;
}
inline Quaternion toQuaternion(const Matrix3& R_WB) {  // likewise
  return quaternionFromMatrix(R_WB);
}

/// How a body answers forces: m⁻¹ and Î⁻¹ in B, both restricted to the motions of its model.
class HOVERCRAFT_PUBLIC Mobility {
 public:
  /// Six degrees of freedom. @param mass kg, > 0. @param I_BBo_B about B, kg m², positive definite.
  static Mobility spatial(double mass, const Matrix3& I_BBo_B);

  /// The same body held to (x, y, yaw): force and velocity keep x and y, moment and angular
  /// velocity keep z. The bearing that holds roll and pitch takes what products of inertia would
  /// turn, hence w_z = L_z / I_zz.
  static Mobility planar(double mass, const Matrix3& I_BBo_B);

  /// The part of a wrench (in W) that moves the body.
  Wrench project(const Wrench& wrench) const {
    return {wrench.force.cwiseProduct(free_translation_),
            wrench.torque.cwiseProduct(free_rotation_)};
  }

  /// v = P/m.
  Vector3 velocity(const Vector3& momentum_W) const { return inverse_mass_ * momentum_W; }

  /// w in B = Î⁻¹ Rᵀ L; R times it is the source's R Î⁻¹ Rᵀ L (after (24)).
  Vector3 angularVelocityInBody(const Vector3& angular_momentum_W, const Matrix3& R_WB) const {
    return times(inverse_inertia_B_, transposeTimes(R_WB, angular_momentum_W));
  }

  /// The same with rotors. @param rotors_B their angular momentum relative to the body, N m s.
  Vector3 angularVelocityInBody(const Vector3& angular_momentum_W, const Matrix3& R_WB,
                                const Vector3& rotors_B) const {
    return times(inverse_inertia_B_, transposeTimes(R_WB, angular_momentum_W) - rotors_B);
  }

  bool isPlanar() const { return free_translation_.z() == 0.0; }  // held to (x, y, yaw)
  double perMass() const { return inverse_mass_; }                // 1/kg
  /// 1/m along each axis of W; 0 where the model does not move.
  Vector3 inverseMass() const { return inverse_mass_ * free_translation_; }
  const Matrix3& inverseInertiaInBody() const { return inverse_inertia_B_; }  // 1/(kg m²)

  /// R Î⁻¹ Rᵀ in W, restricted to the model's rotations.
  Matrix3 inverseInertia(const Matrix3& R_WB) const {
    const Matrix3 turned = product(R_WB, inverse_inertia_B_);
    return product(turned, R_WB.transpose());
  }

  template <class Orientation>
  Twist twist(const RigidBodyState<Orientation>& state) const {  // of the centre of mass, in W
    const Matrix3 R_WB = rotationMatrix(state.orientation);
    return {velocity(state.momentum_W),
            times(R_WB, angularVelocityInBody(state.angular_momentum_W, R_WB))};
  }

  /// The same with rotors.
  template <class Orientation>
  Twist twist(const RigidBodyState<Orientation>& state, const Vector3& rotors_B) const {
    const Matrix3 R_WB = rotationMatrix(state.orientation);
    return {velocity(state.momentum_W),
            times(R_WB, angularVelocityInBody(state.angular_momentum_W, R_WB, rotors_B))};
  }

  /// The momenta that a body with the given velocities (in W) has, restricted to the model's
  /// motions.
  template <class Orientation>
  RigidBodyState<Orientation> stateOfMotion(const Vector3& p_WB, const Orientation& orientation,
                                            const Twist& twist) const {
    const Matrix3 R_WB = rotationMatrix(orientation);
    const Vector3 L_B = times(inertia_B_, transposeTimes(R_WB, twist.w_WB));
    const Wrench momenta = project({mass_ * twist.v_WB, times(R_WB, L_B)});
    return {p_WB, orientation, momenta.force, momenta.torque};
  }

  /// The same of a body with rotors.
  template <class Orientation>
  RigidBodyState<Orientation> stateOfMotion(const Vector3& p_WB, const Orientation& orientation,
                                            const Twist& twist, const Vector3& rotors_B) const {
    const Matrix3 R_WB = rotationMatrix(orientation);
    const Vector3 L_B = times(inertia_B_, transposeTimes(R_WB, twist.w_WB)) + rotors_B;
    const Wrench momenta = project({mass_ * twist.v_WB, times(R_WB, L_B)});
    return {p_WB, orientation, momenta.force, momenta.torque};
  }

 private:
  Mobility() = default;

  double mass_ = 0.0;                            // kg
  Matrix3 inertia_B_ = Matrix3::Zero();          // kg m²
  double inverse_mass_ = 0.0;                    // 1/kg
  Matrix3 inverse_inertia_B_ = Matrix3::Zero();  // 1/(kg m²)
  Vector3 free_translation_ = Vector3::Ones();   // 1 where the model moves, in W
  Vector3 free_rotation_ = Vector3::Ones();
};

/// Kinetic energy ½ P·v + ½ L·w, J.
template <class Orientation>
double kineticEnergy(const RigidBodyState<Orientation>& state, const Mobility& mobility) {
  const Twist twist = mobility.twist(state);
  return 0.5 * dot(state.momentum_W, twist.v_WB) + 0.5 * dot(state.angular_momentum_W, twist.w_WB);
}

/// The same with rotors: that of the body with its rotors at rest.
template <class Orientation>
double kineticEnergy(const RigidBodyState<Orientation>& state, const Mobility& mobility,
                     const Vector3& rotors_B) {
  const Twist twist = mobility.twist(state, rotors_B);
  const Vector3 L_W = state.angular_momentum_W - times(rotationMatrix(state.orientation), rotors_B);
  return 0.5 * dot(state.momentum_W, twist.v_WB) + 0.5 * dot(L_W, twist.w_WB);
}

}  // namespace hovercraft
