#include "hovercraft_sim/body/mass_properties.h"

#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

#include <Eigen/Eigenvalues>

#include "hovercraft_sim/geometry/volume_moments.h"
#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

constexpr const char* kAxisNames = "xyz";
/// Bound on a component of a unit vector (-): just below 1/√3, so that one is always beyond it.
/// Common directions, at multiples of 15° in a coordinate plane or along a diagonal, have none so
/// near to it that rounding would decide.
constexpr double kLargeComponent = 0.57;

void requirePositive(double value, const char* name, const char* unit) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw std::invalid_argument(
      fmt::format("{} = {:.12g} {}: must be positive and finite", name, value, unit));
}

Matrix3 diagonal(double xx, double yy, double zz) {
  Matrix3 result = Matrix3::Zero();
  result(0, 0) = xx;
  result(1, 1) = yy;
  result(2, 2) = zz;
  return result;
}

/// The tensor (21), (23) from the second moments ∫ x xᵀ dm, whose lower triangle is used.
Matrix3 inertiaFromSecondMoments(const Matrix3& second) {
  Matrix3 inertia = diagonal(second(1, 1) + second(2, 2), second(2, 2) + second(0, 0),
                             second(0, 0) + second(1, 1));
  inertia(0, 1) = inertia(1, 0) = -second(1, 0);
  inertia(0, 2) = inertia(2, 0) = -second(2, 0);
  inertia(1, 2) = inertia(2, 1) = -second(2, 1);
  return inertia;
}

/// The tensor of a mass (kg) in the point d (m) from the centre.
Matrix3 inertiaOfPoint(double mass, const Vector3& d) {
  Matrix3 second;
  for (int column = 0; column < 3; ++column) second.col(column) = mass * (d(column) * d);
  return inertiaFromSecondMoments(second);
}

std::string entryOf(const Matrix3& I_BBo_B, int row, int column) {
  return fmt::format("i{}{} = {:.12g} kg m^2", kAxisNames[row], kAxisNames[column],
                     I_BBo_B(row, column));
}

void requireFinite(const Matrix3& I_BBo_B, const std::string& name) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (std::isfinite(I_BBo_B(i, j))) continue;
      throw std::invalid_argument(
          fmt::format("{}: {}: must be finite", name, entryOf(I_BBo_B, i, j)));
    }
  }
}

void requireSymmetric(const Matrix3& I_BBo_B, const std::string& name) {
  const double slack = kInertiaSlack * I_BBo_B.cwiseAbs().maxCoeff();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < i; ++j) {
      if (std::abs(I_BBo_B(i, j) - I_BBo_B(j, i)) <= slack) continue;
      throw std::invalid_argument(fmt::format("{}: must be symmetric, but {} and {}", name,
                                              entryOf(I_BBo_B, j, i), entryOf(I_BBo_B, i, j)));
    }
  }
}

/// The first component of a unit vector beyond ±kLargeComponent.
double firstLargeComponent(const Vector3& axis) {
  for (int i = 0; i < 2; ++i) {
    if (std::abs(axis(i)) > kLargeComponent) return axis(i);
  }
  return axis(2);
}

}  // namespace

double boxVolume(const Vector3& size) {
  const FloatingPointEnvironment environment;
  return FloatingPointEnvironment::computed(size.x() * size.y() * size.z());
}

double sphereVolume(double radius) {
  const FloatingPointEnvironment environment;
  const double r = FloatingPointEnvironment::computed(radius);
  return FloatingPointEnvironment::computed(4.0 / 3.0 * kPi * (r * r * r));
}

double cylinderVolume(double radius, double length) {
  const FloatingPointEnvironment environment;
  const double r = FloatingPointEnvironment::computed(radius);
  return FloatingPointEnvironment::computed(kPi * (r * r) * length);
}

double coneVolume(double radius, double length) {
  const FloatingPointEnvironment environment;
  return FloatingPointEnvironment::computed(cylinderVolume(radius, length) / 3.0);
}

MassProperties boxMassProperties(double mass, const Vector3& size) {
  const FloatingPointEnvironment environment;
  requirePositive(mass, "mass", "kg");
  for (int axis = 0; axis < 3; ++axis) requirePositive(size(axis), "size", "m");
  const double xx = size.x() * size.x();
  const double yy = size.y() * size.y();
  const double zz = size.z() * size.z();
  return {mass, Vector3::Zero(), (mass / 12.0) * diagonal(yy + zz, zz + xx, xx + yy)};
}

MassProperties sphereMassProperties(double mass, double radius) {
  const FloatingPointEnvironment environment;
  requirePositive(mass, "mass", "kg");
  requirePositive(radius, "radius", "m");
  const double moment = 0.4 * mass * (radius * radius);
  return {mass, Vector3::Zero(), diagonal(moment, moment, moment)};
}

MassProperties cylinderMassProperties(double mass, double radius, double length) {
  const FloatingPointEnvironment environment;
  requirePositive(mass, "mass", "kg");
  requirePositive(radius, "radius", "m");
  requirePositive(length, "length", "m");
  const double across = mass / 12.0 * (3.0 * (radius * radius) + length * length);
  return {mass, Vector3::Zero(), diagonal(across, across, 0.5 * mass * (radius * radius))};
}

MassProperties coneMassProperties(double mass, double radius, double length) {
  const FloatingPointEnvironment environment;
  requirePositive(mass, "mass", "kg");
  requirePositive(radius, "radius", "m");
  requirePositive(length, "length", "m");
  const double across = 3.0 / 80.0 * mass * (4.0 * (radius * radius) + length * length);
  return {mass, Vector3(0.0, 0.0, -0.25 * length),
          diagonal(across, across, 0.3 * mass * (radius * radius))};
}

MassProperties meshMassProperties(const PolygonMesh& mesh, double mass) {
  const FloatingPointEnvironment environment;
  requirePositive(mass, "mass", "kg");
  const VolumeMoments moments = volumeMoments(mesh);
  return {mass, moments.centroid,
          (mass / moments.volume) * inertiaFromSecondMoments(moments.second_about_centroid)};
}

MassProperties meshMassPropertiesOfDensity(const PolygonMesh& mesh, double density) {
  const FloatingPointEnvironment environment;
  requirePositive(density, "density", "kg/m^3");
  const VolumeMoments moments = volumeMoments(mesh);
  return {density * moments.volume, moments.centroid,
          density * inertiaFromSecondMoments(moments.second_about_centroid)};
}

MassProperties placed(const MassProperties& part, const Matrix3& R_GH, const Vector3& p_GH) {
  const FloatingPointEnvironment environment;
  Matrix3 inertia = product(product(R_GH, part.I_BBo_B), R_GH.transpose());
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < i; ++j)
      inertia(i, j) = inertia(j, i) = 0.5 * (inertia(i, j) + inertia(j, i));
  }
  return {part.mass, times(R_GH, part.p_HB) + p_GH, inertia};
}

MassProperties composed(const std::vector<MassProperties>& parts) {
  const FloatingPointEnvironment environment;
  if (parts.empty()) throw std::invalid_argument("parts: there must be at least one");
  // Positions from the first part, so that nothing cancels far from the origin.
  const Vector3 origin = parts.front().p_HB;
  double mass = 0.0;
  Vector3 first_moment = Vector3::Zero();
  for (const MassProperties& part : parts) {
    mass += part.mass;
    first_moment += part.mass * (part.p_HB - origin);
  }
  const Vector3 center = first_moment / mass;
  Matrix3 inertia = Matrix3::Zero();
  for (const MassProperties& part : parts) {
    inertia += part.I_BBo_B + inertiaOfPoint(part.mass, (part.p_HB - origin) - center);
  }
  return {mass, origin + center, inertia};
}

void checkInertia(const Matrix3& I_BBo_B, const std::string& name) {
  const FloatingPointEnvironment environment;
  requireFinite(I_BBo_B, name);
  requireSymmetric(I_BBo_B, name);
  const Vector3 moments = principalInertia(I_BBo_B).moments;
  if (!(moments(0) > kSingularInertia * moments(2))) {
    throw std::invalid_argument(fmt::format(
        "{}: must be positive definite: its smallest principal moment is {:.12g} kg m^2", name,
        moments(0)));
  }
  const double others = moments(0) + moments(1);
  if (moments(2) - others > kInertiaSlack * moments(2)) {
    throw std::invalid_argument(fmt::format(
        "{}: its largest principal moment is {:.12g} kg m^2: must be at most {:.12g} kg m^2, the "
        "sum of the other two",
        name, moments(2), others));
  }
}

PrincipalInertia principalInertia(const Matrix3& I_BBo_B) {
  const FloatingPointEnvironment environment;
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(I_BBo_B);
  demand(solver.info() == Eigen::Success, "a tensor without principal axes");
  PrincipalInertia result{solver.eigenvalues(), solver.eigenvectors()};
  for (int column = 0; column < 2; ++column) {
    const Vector3 axis = result.axes.col(column);
    if (firstLargeComponent(axis) < 0.0) result.axes.col(column) = -axis;
  }
  const Vector3 first = result.axes.col(0);
  const Vector3 second = result.axes.col(1);
  result.axes.col(2) = cross(first, second);
  return result;
}

}  // namespace hovercraft
