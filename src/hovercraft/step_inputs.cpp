#include "hovercraft_sim/hovercraft/step_inputs.h"

#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {

RigidBodyState<Quaternion> integrationStep(Integrator integrator,
                                           const RigidBodyState<Quaternion>& y, const DrivenBody& f,
                                           double h) {
  const FloatingPointEnvironment environment;
  return bodyStep<Quaternion>(integrator, y, f, h);
}

RigidBodyState<Matrix3> integrationStep(Integrator integrator, const RigidBodyState<Matrix3>& y,
                                        const DrivenBody& f, double h) {
  const FloatingPointEnvironment environment;
  return bodyStep<Matrix3>(integrator, y, f, h);
}

}  // namespace hovercraft
