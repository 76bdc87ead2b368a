#include "hovercraft_sim/body/rigid_body.h"

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {

Mobility Mobility::spatial(double mass, const Matrix3& I_BBo_B) {
  const FloatingPointEnvironment environment;
  demand(mass > 0.0 && determinant(I_BBo_B) > 0.0, "mass and inertia must be checked before");
  Mobility mobility;
  mobility.mass_ = mass;
  mobility.inertia_B_ = I_BBo_B;
  mobility.inverse_mass_ = 1.0 / mass;
  mobility.inverse_inertia_B_ = inverse(I_BBo_B);
  return mobility;
}

Mobility Mobility::planar(double mass, const Matrix3& I_BBo_B) {
  const FloatingPointEnvironment environment;
  demand(mass > 0.0 && I_BBo_B(2, 2) > 0.0, "mass and inertia must be checked before");
  Mobility mobility;
  mobility.mass_ = mass;
  mobility.inertia_B_ = I_BBo_B;
  mobility.inverse_mass_ = 1.0 / mass;
  mobility.inverse_inertia_B_(2, 2) = 1.0 / I_BBo_B(2, 2);
  mobility.free_translation_ = {1.0, 1.0, 0.0};
  mobility.free_rotation_ = {0.0, 0.0, 1.0};
  return mobility;
}

}  // namespace hovercraft
