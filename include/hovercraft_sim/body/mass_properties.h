#pragma once

#include <vector>

#include "hovercraft_sim/geometry/triangle_mesh.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// Mass, centre of mass and inertia of a rigid body described in the frame H (of a hull, a part or
/// a mesh file); B is at the centre of mass, its axes parallel to those of H.
struct MassProperties {
  double mass = 0.0;                  // kg
  Vector3 p_HB = Vector3::Zero();     // centre of mass, m
  Matrix3 I_BBo_B = Matrix3::Zero();  // tensor (21) about the centre of mass, kg m²
};

/// Homogeneous solids, centred on the origin of H unless said otherwise; lengths in m, mass in kg,
/// all > 0.
/// @throws std::invalid_argument naming the number that is not positive and finite.
MassProperties boxMassProperties(double mass, const Vector3& size);
/// A solid ball.
MassProperties sphereMassProperties(double mass, double radius);
/// Axis along z.
MassProperties cylinderMassProperties(double mass, double radius, double length);
/// Axis along z, apex up; the origin of H is the middle of the axis, so that the centre of mass
/// lies at z = -length/4.
MassProperties coneMassProperties(double mass, double radius, double length);

/// Volumes of the solids above, m³.
double boxVolume(const Vector3& size);
double sphereVolume(double radius);
double cylinderVolume(double radius, double length);
double coneVolume(double radius, double length);

/// The homogeneous solid inside a closed mesh, in the frame of the mesh: of a total mass in kg, or
/// of a density in kg/m³.
MassProperties meshMassProperties(const TriangleMesh& mesh, double mass);
MassProperties meshMassPropertiesOfDensity(const TriangleMesh& mesh, double density);

/// The same solid in a frame G from which H is turned by R_GH and moved by p_GH.
MassProperties placed(const MassProperties& part, const Matrix3& R_GH, const Vector3& p_GH);

/// Several parts in one frame as one body, by the parallel-axis theorem (Huygens-Steiner).
/// @throws std::invalid_argument if there are none.
MassProperties composed(const std::vector<MassProperties>& parts);

/// Checks that a tensor can belong to a rigid body: finite, symmetric, positive definite, and no
/// principal moment larger than the sum of the other two.
/// @throws std::invalid_argument that begins with `name` and names the rule and the number that
/// breaks it.
void checkInertia(const Matrix3& I_BBo_B, const char* name);

/// Principal moments in ascending order and the axes they belong to (columns, right-handed).
struct PrincipalInertia {
  Vector3 moments;  // kg m²
  Matrix3 axes;     // column i: unit axis of moments[i], in B
};
PrincipalInertia principalInertia(const Matrix3& I_BBo_B);

}  // namespace hovercraft
