#include "hovercraft_sim/hovercraft/planar_step.h"

#include <cmath>
#include <cstdint>
#include <cstring>

#include "hovercraft_sim/math/demand.h"

namespace hovercraft {
namespace {

constexpr std::uint64_t kSignBit = std::uint64_t{1} << 63;

std::uint64_t bitsOf(double number) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  return bits;
}

bool isNegativeZero(double number) {
  return bitsOf(number) == kSignBit;
}

bool isModerate(const Vector3& v) {
  return (v.array().abs() <= PlanarCraft::kLargest).all();
}

/// Of the thrusts of the engines; false of NaN too.
bool areModerate(const ActuatorArray<double>& thrusts) {
  return (std::abs(thrusts[0]) + std::abs(thrusts[1])) + std::abs(thrusts[2]) <=
         PlanarCraft::kLargest;
}

}  // namespace

std::optional<PlanarCraft> PlanarCraft::of(const HovercraftModel& model) {
  if (!model.mobility.isPlanar() || model.hasMoreForces()) return std::nullopt;
  const Drag& drag = model.drag;
  bool moderate = isModerate(model.weight_W);
  for (const Vector3* law :
       {&drag.linear, &drag.quadratic, &drag.angular_linear, &drag.angular_quadratic}) {
    moderate = moderate && isModerate(*law);
  }
  PlanarCraft craft;
  for (int i = 0; i < kEngineCount; ++i) {
    const Vector3 force = model.engines.forceMap().col(i);
    const Vector3 torque = model.engines.torqueMap().col(i);
    moderate = moderate && isModerate(force) && isModerate(torque);
    craft.engines_[i] = {force.x(), force.y(), torque.z()};
  }
  if (!moderate) return std::nullopt;
  craft.inverse_mass_ = model.mobility.inverseMass().x();
  craft.inverse_inertia_ = model.mobility.inverseInertia(Matrix3::Identity())(2, 2);
  craft.linear_ = {drag.linear.x(), drag.linear.y(), drag.angular_linear.z()};
  craft.quadratic_ = {drag.quadratic.x(), drag.quadratic.y(), drag.angular_quadratic.z()};
  craft.weight_W_ = {model.weight_W.x(), model.weight_W.y(), 0.0};
  return craft;
}

bool PlanarCraft::takes(const RigidBodyState<Quaternion>& y, const DrivenBody& f) const {
  const Vector3& v = y.orientation.v;
  const Vector3& p = y.p_WB;
  const Vector3& P = y.momentum_W;
  const Vector3& L = y.angular_momentum_W;
  const std::uint64_t held =
      (bitsOf(v.x()) | bitsOf(v.y())) | (bitsOf(P.z()) | bitsOf(L.x())) | bitsOf(L.y());
  const bool negative_zero = isNegativeZero(p.x()) || isNegativeZero(p.y()) ||
                             isNegativeZero(y.orientation.s) || isNegativeZero(v.z()) ||
                             isNegativeZero(P.x()) || isNegativeZero(P.y()) ||
                             isNegativeZero(L.z());
  // A thrust that lags lies between its start and end.
  return f.load == nullptr && held == 0 && !negative_zero && areModerate(f.thrusts.start) &&
         areModerate(f.thrusts.end) && std::abs(f.environment.wind_W.z()) <= kLargest;
}

PlanarCraft::Planar PlanarCraft::wrenchOf(const ActuatorArray<double>& thrusts) const {
  const auto sum = [&](double Planar::*part) {
    return (engines_[0].*part * thrusts[0] + engines_[1].*part * thrusts[1]) +
           engines_[2].*part * thrusts[2];
  };
  return {sum(&Planar::x), sum(&Planar::y), sum(&Planar::yaw)};
}

/// HovercraftModel::derivative() of what is not zero.
inline PlanarCraft::State PlanarCraft::slope(const State& y, const Planar& engines_B,
                                             const Vector3& wind_W) const {
  const double z2 = y.z + y.z;
  const double c = 1.0 - z2 * y.z;  // of R_WB = [c, -n; n, c]
  const double n = z2 * y.s;
  const double vx = inverse_mass_ * y.px;
  const double vy = inverse_mass_ * y.py;
  const double w = inverse_inertia_ * y.l;
  const double ax = vx - wind_W.x();
  const double ay = vy - wind_W.y();
  const double ux = c * ax + n * ay;
  const double uy = c * ay - n * ax;
  const double fx = engines_B.x - (linear_.x + quadratic_.x * std::abs(ux)) * ux;
  const double fy = engines_B.y - (linear_.y + quadratic_.y * std::abs(uy)) * uy;
  const double m = engines_B.yaw - (linear_.yaw + quadratic_.yaw * std::abs(w)) * w;
  return {vx,
          vy,
          -0.5 * (w * y.z),
          0.5 * (y.s * w),
          (c * fx - n * fy) + weight_W_.x,
          (n * fx + c * fy) + weight_W_.y,
          m};
}

inline PlanarCraft::State PlanarCraft::moved(const State& y, double h, const State& k) {
  return {y.x + h * k.x,   y.y + h * k.y,   y.s + h * k.s, y.z + h * k.z,
          y.px + h * k.px, y.py + h * k.py, y.l + h * k.l};
}

inline PlanarCraft::State PlanarCraft::sum(const State& a, const State& b) {
  return {a.x + b.x, a.y + b.y, a.s + b.s, a.z + b.z, a.px + b.px, a.py + b.py, a.l + b.l};
}

/// The steppers of steppers.h, before the orientation is brought back to a rotation.
inline PlanarCraft::State PlanarCraft::stepped(Integrator integrator, const State& y,
                                               const DrivenBody& f, double h) const {
  const Vector3& wind = f.environment.wind_W;
  const Planar start = wrenchOf(f.thrusts.start);
  State k1 = slope(y, start, wind);
  switch (integrator) {
    case Integrator::kEuler:
      return moved(y, h, k1);
    case Integrator::kSemiImplicitEuler: {
      const double w = inverse_inertia_ * (y.l + h * k1.l);
      k1.x = inverse_mass_ * (y.px + h * k1.px);
      k1.y = inverse_mass_ * (y.py + h * k1.py);
      k1.s = -0.5 * (w * y.z);
      k1.z = 0.5 * (y.s * w);
      return moved(y, h, k1);
    }
    case Integrator::kHeun: {
      const Planar end = f.is_steady ? start : wrenchOf(f.thrusts.end);
      const State k2 = slope(moved(y, h, k1), end, wind);
      return moved(y, 0.5 * h, sum(k1, k2));
    }
    case Integrator::kRungeKutta4: {
      const Planar middle = f.is_steady ? start : wrenchOf(f.thrusts.middle);
      const Planar end = f.is_steady ? start : wrenchOf(f.thrusts.end);
      const State k2 = slope(moved(y, 0.5 * h, k1), middle, wind);
      const State k3 = slope(moved(y, 0.5 * h, k2), middle, wind);
      const State k4 = slope(moved(y, h, k3), end, wind);
      const State both = sum(k2, k3);
      return moved(y, h / 6.0, sum(sum(k1, k4), sum(both, both)));
    }
    case Integrator::kLie4:
      break;
  }
  demand(false, "a planar step by this method must be made in full");
  return y;
}

void PlanarCraft::step(Integrator integrator, const RigidBodyState<Quaternion>& y,
                       const DrivenBody& f, double h, RigidBodyState<Quaternion>& end) const {
  const State moved = stepped(integrator,
                              {y.p_WB.x(), y.p_WB.y(), y.orientation.s, y.orientation.v.z(),
                               y.momentum_W.x(), y.momentum_W.y(), y.angular_momentum_W.z()},
                              f, h);
  const double scale = 1.0 / std::sqrt(moved.s * moved.s + moved.z * moved.z);
  // + 0: what a velocity of 0 adds, which makes +0 of -0.
  end.p_WB = {moved.x, moved.y, y.p_WB.z() + 0.0};
  end.orientation = {scale * moved.s, {0.0, 0.0, scale * moved.z}};
  end.momentum_W = {moved.px, moved.py, 0.0};
  end.angular_momentum_W = {0.0, 0.0, moved.l};
}

}  // namespace hovercraft
