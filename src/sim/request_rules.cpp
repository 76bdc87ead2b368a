#include "hovercraft_sim/sim/request_rules.h"

#include <fmt/format.h>
#include <stdexcept>

#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

void refuseUnless(bool holds, const char* name, const char* rule) {
  if (!holds) throw std::invalid_argument(fmt::format("{}: {}", name, rule));
}

void requireWithin(const Vector3& v, double most, const char* name, const char* rule) {
  refuseUnless(v.allFinite(), name, "must be finite");
  refuseUnless(v.cwiseAbs().maxCoeff() <= most, name, rule);
}

}  // namespace

void requireSettable(const Twist& twist, const RequestNames& names) {
  const FloatingPointEnvironment environment;
  requireWithin(twist.v_WB, kFastestSet, names.linear, "must be at most 1e6 m/s, of either sign");
  requireWithin(twist.w_WB, kFastestSet, names.angular,
                "must be at most 1e6 rad/s, of either sign");
}

void requireApplicable(const Wrench& wrench, BodyModel model, const RequestNames& names) {
  const FloatingPointEnvironment environment;
  requireWithin(wrench.force, kStrongestApplied, names.linear,
                "must be at most 1e11 N, of either sign");
  requireWithin(wrench.torque, kStrongestApplied, names.angular,
                "must be at most 1e11 N m, of either sign");
  if (model != BodyModel::kPlanar) return;
  refuseUnless(wrench.force.z() == 0.0, names.linear, "the model is planar: z must be 0");
  refuseUnless(wrench.torque.x() == 0.0 && wrench.torque.y() == 0.0, names.angular,
               "the model is planar: x and y must be 0");
}

}  // namespace hovercraft
