#include "hovercraft_sim/hovercraft/hovercraft_model.h"

#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {

RigidBodyState<Quaternion> integrationStep(Integrator integrator,
                                           const RigidBodyState<Quaternion>& y,
                                           const DrivenHovercraft& f, double h) {
  const FloatingPointEnvironment environment;
  return integrationStep<Quaternion, DrivenHovercraft>(integrator, y, f, h);
}

RigidBodyState<Matrix3> integrationStep(Integrator integrator, const RigidBodyState<Matrix3>& y,
                                        const DrivenHovercraft& f, double h) {
  const FloatingPointEnvironment environment;
  return integrationStep<Matrix3, DrivenHovercraft>(integrator, y, f, h);
}

}  // namespace hovercraft
