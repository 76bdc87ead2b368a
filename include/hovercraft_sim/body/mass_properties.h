#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/geometry/triangle_mesh.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// Mass, centre of mass and inertia of a rigid body described in the frame H (of a hull, a part or
/// a mesh file); B is at the centre of mass, its axes parallel to those of H.
struct MassProperties {
  double mass = 0.0;                  // kg
  Vector3 p_HB = Vector3::Zero();     // centre of mass, m
  Matrix3 I_BBo_B = Matrix3::Zero();  // tensor (21) about the centre of mass, kg m²
};

/// Volumes of solids, m³; lengths in m, as below.
HOVERCRAFT_PUBLIC double boxVolume(const Vector3& size);
HOVERCRAFT_PUBLIC double sphereVolume(double radius);
HOVERCRAFT_PUBLIC double cylinderVolume(double radius, double length);
HOVERCRAFT_PUBLIC double coneVolume(double radius, double length);

/// Homogeneous solids, centred on the origin of H unless said otherwise; lengths in m, mass in kg,
/// all > 0. With the volume as the mass, the density is 1 kg/m³.
/// @throws std::invalid_argument naming the number that is not positive and finite.
HOVERCRAFT_PUBLIC MassProperties boxMassProperties(double mass, const Vector3& size);
/// A solid ball.
HOVERCRAFT_PUBLIC MassProperties sphereMassProperties(double mass, double radius);
/// Axis along z.
HOVERCRAFT_PUBLIC MassProperties cylinderMassProperties(double mass, double radius, double length);
/// Axis along z, apex up; the origin of H is the middle of the axis, so that the centre of mass
/// lies at z = -length/4.
HOVERCRAFT_PUBLIC MassProperties coneMassProperties(double mass, double radius, double length);

/// The homogeneous solid inside a closed surface (it passes checkClosed()); H is the frame of the
/// mesh. @param mass kg. @throws std::invalid_argument if it is not positive and finite.
HOVERCRAFT_PUBLIC MassProperties meshMassProperties(const TriangleMesh& mesh, double mass);
/// Likewise. @param density kg/m³.
HOVERCRAFT_PUBLIC MassProperties meshMassPropertiesOfDensity(const TriangleMesh& mesh,
                                                             double density);

/// The same solid in a frame G from which H is turned by R_GH and moved by p_GH.
HOVERCRAFT_PUBLIC MassProperties placed(const MassProperties& part, const Matrix3& R_GH,
                                        const Vector3& p_GH);

/// Several parts in one frame as one body, by the parallel-axis theorem (Huygens-Steiner). A
/// single part comes back to the last bit.
/// @throws std::invalid_argument if there are none.
HOVERCRAFT_PUBLIC MassProperties composed(const std::vector<MassProperties>& parts);

/// Checks that a tensor can belong to a rigid body: finite, symmetric, positive definite, and no
/// principal moment larger than the sum of the other two.
/// @throws std::invalid_argument that begins with `name` and names the rule and the number that
/// breaks it.
HOVERCRAFT_PUBLIC void checkInertia(const Matrix3& I_BBo_B, const std::string& name);

/// Principal moments and axes of a tensor.
struct PrincipalInertia {
  Vector3 moments;  // kg m², ascending
  Matrix3 axes;     // column i: unit axis of moments[i], in B; right-handed
};
/// The sign of the first two axes is chosen so that their first component beyond ±0.57 is positive;
/// the third is the cross product of those. Where moments are equal, any axes in their plane or
/// space may come back. For display: the last bits depend on the processor.
/// @param I_BBo_B passes checkInertia().
HOVERCRAFT_PUBLIC PrincipalInertia principalInertia(const Matrix3& I_BBo_B);

}  // namespace hovercraft
