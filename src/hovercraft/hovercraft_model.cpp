#include "hovercraft_sim/hovercraft/hovercraft_model.h"

namespace hovercraft {

RigidBodyState<Quaternion> integrationStep(Integrator integrator,
                                           const RigidBodyState<Quaternion>& y,
                                           const DrivenHovercraft& f, double h) {
  return integrationStep<Quaternion, DrivenHovercraft>(integrator, y, f, h);
}

RigidBodyState<Matrix3> integrationStep(Integrator integrator, const RigidBodyState<Matrix3>& y,
                                        const DrivenHovercraft& f, double h) {
  return integrationStep<Matrix3, DrivenHovercraft>(integrator, y, f, h);
}

}  // namespace hovercraft
