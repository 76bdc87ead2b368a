#include "hovercraft_sim/collision/motion.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

/// cos x and sin x / x, with + - * / alone so that every machine gets the same bits: the angle is
/// halved until it is small, the series is summed there, and the cosine is doubled back.
struct Turn {
  double cosine;
  double sine_over_angle;
};

Turn turn(double angle) {
  int halvings = 0;
  double x = angle;
  while (std::abs(x) > 0.25 && halvings < 60) {
    x *= 0.5;
    ++halvings;
  }
  // Taylor: the next terms are below 0.25^14 / 14! = 4e-20 of the result.
  const double y = x * x;
  double one_minus_cos =
      y * (0.5 - y * (1.0 / 24.0 - y * (1.0 / 720.0 - y * (1.0 / 40320.0 - y / 3628800.0))));
  double sine_over =
      1.0 - y * (1.0 / 6.0 -
                 y * (1.0 / 120.0 - y * (1.0 / 5040.0 - y * (1.0 / 362880.0 - y / 39916800.0))));
  for (int i = 0; i < halvings; ++i) {
    // 1 - cos 2x = 2 (1 - cos x)(1 + cos x); sin 2x / 2x = (sin x / x) cos x
    sine_over *= 1.0 - one_minus_cos;
    one_minus_cos = 2.0 * one_minus_cos * (2.0 - one_minus_cos);
  }
  return {1.0 - one_minus_cos, sine_over};
}

/// atan x for x >= 0, likewise: atan x = 2 atan(x / (1 + sqrt(1 + x²))) until it is small.
double arcTangent(double x) {
  double factor = 1.0;
  double z = x;
  while (z > 0.1) {
    z = z / (1.0 + std::sqrt(1.0 + z * z));
    factor *= 2.0;
  }
  const double y = z * z;
  double sum = 0.0;
  for (int k = 8; k >= 0; --k) sum = 1.0 / (2 * k + 1) - y * sum;
  return factor * z * sum;
}

AxisAlignedBox boxAt(const ConvexPolyhedron& body, const Pose& X_WB) {
  AxisAlignedBox box;
  for (int axis = 0; axis < 3; ++axis) {
    Vector3 direction(0.0, 0.0, 0.0);
    direction[axis] = 1.0;
    const Vector3 up = transposeTimes(X_WB.R_AB, direction);
    box.high[axis] = transform(X_WB, body.vertex(body.supportVertex(up)))[axis];
    box.low[axis] = transform(X_WB, body.vertex(body.supportVertex(-up)))[axis];
  }
  return box;
}

}  // namespace

Pose StepMotion::at(double t) const {
  const Vector3 half = (0.5 * t) * (w_WB + (0.5 * t) * alpha_WB);
  const Turn half_turn = turn(norm(half));
  const Quaternion turned = Quaternion{half_turn.cosine, half_turn.sine_over_angle * half} * q_WB;
  return {rotationMatrix(normalized(turned)), p_WB + t * (v_WB + (0.5 * t) * a_WB)};
}

Vector3 StepMotion::fastestTurn(double duration) const {
  const Vector3 w_end = angularVelocity(duration);
  return squaredNorm(w_end) > squaredNorm(w_WB) ? w_end : w_WB;
}

void StepMotion::bend(const Vector3& dv_WB, const Vector3& dw_WB, double duration) {
  a_WB = dv_WB / duration;
  v_WB -= (0.5 * duration) * a_WB;
  const Vector3& axis = squaredNorm(w_WB) > 0.0 ? w_WB : dw_WB;
  const double squared = squaredNorm(axis);
  if (!(squared > 0.0)) return;
  alpha_WB = (dot(axis, dw_WB) / (squared * duration)) * axis;
  w_WB -= (0.5 * duration) * alpha_WB;
}

StepMotion motionBetween(const Vector3& p_start, const Quaternion& q_start, const Vector3& p_end,
                         const Quaternion& q_end, double duration) {
  const FloatingPointEnvironment environment;
  demand(duration > 0.0, "a motion needs a positive duration");
  StepMotion motion;
  motion.p_WB = p_start;
  motion.q_WB = q_start;
  motion.v_WB = (p_end - p_start) / duration;
  Quaternion turned = q_end * conjugate(q_start);
  if (turned.s < 0.0) turned = -1.0 * turned;
  const double sine = norm(turned.v);
  if (sine > 0.0) {
    const double angle = 4.0 * arcTangent(sine / (norm(turned) + turned.s));
    motion.w_WB = turned.v * (angle / (sine * duration));
  }
  return motion;
}

AxisAlignedBox sweptBox(const ConvexPolyhedron& body, const StepMotion& motion, double duration) {
  const FloatingPointEnvironment environment;
  const AxisAlignedBox start = boxAt(body, motion.at(0.0));
  const AxisAlignedBox end = boxAt(body, motion.at(duration));
  // |x''| <= |a| + (|w|² + |alpha|) r; a chord of length T in t is left by at most |x''| T²/8. On
  // long turns the diameter is the better bound.
  const double r = body.data().radius;
  const double spin = norm(motion.fastestTurn(duration));
  const double turning =
      std::min(2.0 * r, (spin * spin + norm(motion.alpha_WB)) * r * duration * duration / 8.0);
  const double width = turning + norm(motion.a_WB) * duration * duration / 8.0;
  const double rounding = 1e-14 * (r + norm(motion.p_WB) + norm(motion.v_WB) * duration);
  const Vector3 margin = Vector3::Constant(width + rounding);
  return {start.low.cwiseMin(end.low) - margin, start.high.cwiseMax(end.high) + margin};
}

}  // namespace hovercraft
