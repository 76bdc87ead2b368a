#pragma once

#include <array>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_3.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <stdexcept>

#include "hovercraft_sim/math/rotation.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft::testing {

/// Exact motion of a free rigid body with three different principal moments: Euler's equations in
/// body axes by Jacobi's elliptic functions (Landau and Lifshitz, Mechanics, §37), the attitude
/// from the constant L by Poinsot's angle of precession, an elliptic integral of the third kind.
///
/// Name the body axes a, b, c such that b has the middle moment and a is the axis that L keeps
/// circling (of the two others): a has the largest moment if L² > 2 E I_b, else the smallest. With
///   U = 2 E I_a - L² = I_b (I_a - I_b) w_b² + I_c (I_a - I_c) w_c²
///   V = L² - 2 E I_c = I_a (I_a - I_c) w_a² + I_b (I_b - I_c) w_b²
/// Euler's equations I_a w_a' = s (I_b - I_c) w_b w_c (and cyclic; s = 1 if a, b, c is an even
/// permutation of x, y, z, else -1) are solved by
///   w_a = C dn τ, w_b = B sn τ, w_c = A cn τ, τ = τ0 + λ t,
///   A² = U/(I_c (I_a - I_c)), B² = U/(I_b (I_a - I_b)), C² = V/(I_a (I_a - I_c)),
///   λ² = (I_a - I_b) V/(I_a I_b I_c), k² = (I_b - I_c) U/((I_a - I_b) V).
/// The equation of w_c reads -I_c A λ = s (I_a - I_b) B C: with A and λ positive it gives the sign
/// of B.
///
/// Axis a, seen along L, turns about L at the rate
///   ψ' = |L| (I_b w_b² + I_c w_c²)/(I_b² w_b² + I_c² w_c²)
///      = |L| (1/I_a + (1/I_c - 1/I_a)/(1 - n sn² τ)), n = -I_a (I_b - I_c)/(I_c (I_a - I_b)),
/// so that ψ = |L| (t/I_a + (1/I_c - 1/I_a) (Π(n; τ) - Π(n; τ0))/λ). L in body axes and ψ are the
/// attitude.
class FreeBody {
 public:
  /// @param moments principal moments, kg m², all different; body axes are principal axes.
  /// @param w_WB_B angular velocity at t = 0 in B, rad/s. @param R_WB attitude at t = 0.
  /// @throws std::invalid_argument if the motion has no finite period or is a plain rotation about
  /// one axis.
  FreeBody(const Vector3& moments, const Vector3& w_WB_B, const Matrix3& R_WB) : moments_(moments) {
    const Vector3 L_B = moments.cwiseProduct(w_WB_B);
    momentum_ = norm(L_B);
    nameAxes(w_WB_B);
    const double moment_a = moment(0);
    const double moment_b = moment(1);
    const double moment_c = moment(2);
    const double w_a = w_WB_B[axes_[0]];
    const double w_b = w_WB_B[axes_[1]];
    const double w_c = w_WB_B[axes_[2]];
    const double u =
        moment_b * (moment_a - moment_b) * w_b * w_b + moment_c * (moment_a - moment_c) * w_c * w_c;
    const double v =
        moment_a * (moment_a - moment_c) * w_a * w_a + moment_b * (moment_b - moment_c) * w_b * w_b;
    modulus_ = std::sqrt((moment_b - moment_c) * u / ((moment_a - moment_b) * v));
    if (!(modulus_ < 1.0) || u == 0.0) throw std::invalid_argument("free body: no finite period");
    const double parity = axes_[1] == (axes_[0] + 1) % 3 ? 1.0 : -1.0;
    const double sign_b = (w_a > 0.0) == (parity * (moment_a - moment_b) > 0.0) ? -1.0 : 1.0;
    amplitudes_ = {std::copysign(std::sqrt(v / (moment_a * (moment_a - moment_c))), w_a),
                   sign_b * std::sqrt(u / (moment_b * (moment_a - moment_b))),
                   std::sqrt(u / (moment_c * (moment_a - moment_c)))};
    lambda_ = std::sqrt((moment_a - moment_b) * v / (moment_a * moment_b * moment_c));
    characteristic_ = -moment_a * (moment_b - moment_c) / (moment_c * (moment_a - moment_b));
    quarter_period_ = boost::math::ellint_1(modulus_);
    tau_0_ =
        boost::math::ellint_1(modulus_, std::atan2(w_b / amplitudes_[1], w_c / amplitudes_[2]));
    pi_0_ = thirdKind(tau_0_);
    world_triad_ = product(R_WB, bodyTriad(w_WB_B));
  }

  /// Time after which the angular velocity in B repeats itself, s.
  double period() const { return 4.0 * quarter_period_ / lambda_; }

  /// rad/s, in B.
  Vector3 angularVelocityInBody(double t) const {
    double cn = 0.0;
    double dn = 0.0;
    const double sn = boost::math::jacobi_elliptic(modulus_, tau_0_ + lambda_ * t, &cn, &dn);
    Vector3 w_WB_B;
    w_WB_B[axes_[0]] = amplitudes_[0] * dn;
    w_WB_B[axes_[1]] = amplitudes_[1] * sn;
    w_WB_B[axes_[2]] = amplitudes_[2] * cn;
    return w_WB_B;
  }

  /// R_WB.
  Matrix3 attitude(double t) const {
    const double moment_a = moment(0);
    const double moment_c = moment(2);
    const double integral = (thirdKind(tau_0_ + lambda_ * t) - pi_0_) / lambda_;
    const double psi = momentum_ * (t / moment_a + (1.0 / moment_c - 1.0 / moment_a) * integral);
    Matrix3 turn = Matrix3::Identity();  // by psi about the third axis, which is that of L
    turn(0, 0) = turn(1, 1) = std::cos(psi);
    turn(1, 0) = std::sin(psi);
    turn(0, 1) = -turn(1, 0);
    const Matrix3 body_triad = bodyTriad(angularVelocityInBody(t));
    return product(product(world_triad_, turn), Matrix3(body_triad.transpose()));
  }

 private:
  double moment(std::size_t axis) const { return moments_[axes_[axis]]; }

  void nameAxes(const Vector3& w_WB_B) {
    int largest = 0;
    int smallest = 0;
    for (int i = 1; i < 3; ++i) {
      if (moments_[i] > moments_[largest]) largest = i;
      if (moments_[i] < moments_[smallest]) smallest = i;
    }
    const int middle = 3 - largest - smallest;
    double excess = 0.0;  // L² - 2 E I_b
    for (int i = 0; i < 3; ++i) {
      excess += moments_[i] * (moments_[i] - moments_[middle]) * w_WB_B[i] * w_WB_B[i];
    }
    axes_ = excess > 0.0 ? std::array<int, 3>{largest, middle, smallest}
                         : std::array<int, 3>{smallest, middle, largest};
  }

  /// ∫ du/(1 - n sn² u) from 0 to tau: whole half periods 2K of the integrand, and the rest in
  /// [-K, K].
  double thirdKind(double tau) const {
    const double halves = std::round(tau / (2.0 * quarter_period_));
    const double rest = tau - halves * 2.0 * quarter_period_;
    double cn = 0.0;
    double dn = 0.0;
    const double sn = boost::math::jacobi_elliptic(modulus_, rest, &cn, &dn);
    const double whole = boost::math::ellint_3(modulus_, characteristic_);
    return 2.0 * halves * whole +
           boost::math::ellint_3(modulus_, characteristic_, std::atan2(sn, cn));
  }

  /// Columns: the part of axis a that is normal to L, a third axis, L; each of length 1, in B.
  Matrix3 bodyTriad(const Vector3& w_WB_B) const {
    const Vector3 l_B = moments_.cwiseProduct(w_WB_B) / momentum_;
    Vector3 a_B = Vector3::Zero();
    a_B[axes_[0]] = 1.0;
    const Vector3 normal = a_B - dot(a_B, l_B) * l_B;
    Matrix3 triad;
    triad.col(0) = normal / norm(normal);
    triad.col(1) = cross(l_B, Vector3(triad.col(0)));
    triad.col(2) = l_B;
    return triad;
  }

  Vector3 moments_;                     // kg m², along x, y, z of B
  std::array<int, 3> axes_ = {};        // which of x, y, z are a, b, c
  std::array<double, 3> amplitudes_{};  // C, B, A: of w_a, w_b, w_c, rad/s
  double momentum_ = 0.0;               // kg m²/s
  double modulus_ = 0.0;                // k
  double lambda_ = 0.0;                 // 1/s
  double characteristic_ = 0.0;         // n
  double quarter_period_ = 0.0;         // K(k)
  double tau_0_ = 0.0;
  double pi_0_ = 0.0;  // Π(n; τ0)
  Matrix3 world_triad_;
};

}  // namespace hovercraft::testing
