#include "hovercraft_sim/geometry/volume_moments.h"

#include <cstddef>
#include <vector>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

/// Integrals over the volume of 1, x and x xᵀ, x from some point.
struct Moments {
  double zeroth = 0.0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();
};

/// a bᵀ
Matrix3 outer(const Vector3& a, const Vector3& b) {
  Matrix3 result;
  for (int column = 0; column < 3; ++column) result.col(column) = a * b(column);
  return result;
}

Vector3 middleOfBoundingBox(const PolygonMesh& mesh) {
  if (mesh.vertices.empty()) return Vector3::Zero();
  Vector3 low = mesh.vertices.front();
  Vector3 high = low;
  for (const Vector3& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return low + 0.5 * (high - low);
}

/// For a tetrahedron (0, a, b, c) with D = a · (b × c) and s = a + b + c:
/// ∫ dV = D/6, ∫ x dV = D/24 s, ∫ x xᵀ dV = D/120 (a aᵀ + b bᵀ + c cᵀ + s sᵀ).
Moments momentsAbout(const Vector3& point, const PolygonMesh& mesh) {
  Moments sum;
  for (const std::vector<int>& face : mesh.faces) {
    const Vector3 a = mesh.vertices[static_cast<std::size_t>(face[0])] - point;
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      const Vector3 b = mesh.vertices[static_cast<std::size_t>(face[i])] - point;
      const Vector3 c = mesh.vertices[static_cast<std::size_t>(face[i + 1])] - point;
      const double six_volumes = dot(a, cross(b, c));
      const Vector3 s = (a + b) + c;
      sum.zeroth += six_volumes;
      sum.first += six_volumes * s;
      sum.second += six_volumes * (((outer(a, a) + outer(b, b)) + outer(c, c)) + outer(s, s));
    }
  }
  return {sum.zeroth / 6.0, sum.first / 24.0, sum.second / 120.0};
}

}  // namespace

VolumeMoments volumeMoments(const PolygonMesh& mesh) {
  const FloatingPointEnvironment environment;
  const Vector3 middle = middleOfBoundingBox(mesh);
  const Moments rough = momentsAbout(middle, mesh);
  demand(rough.zeroth > 0.0, "moments of a mesh that was not checked");
  // About the centroid, but for its rounding: what is left to shift is too small to cancel.
  const Vector3 point = middle + rough.first / rough.zeroth;
  const Moments moments = momentsAbout(point, mesh);
  const Vector3 rest = moments.first / moments.zeroth;
  return {moments.zeroth, point + rest, moments.second - moments.zeroth * outer(rest, rest)};
}

double signedVolume(const PolygonMesh& mesh) {
  const FloatingPointEnvironment environment;
  return FloatingPointEnvironment::computed(momentsAbout(middleOfBoundingBox(mesh), mesh).zeroth);
}

}  // namespace hovercraft
