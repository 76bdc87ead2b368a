#include "hovercraft_sim/sensors/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hovercraft {
namespace {

/// What rounding may take from the cosine of an angle: a beam that only grazes the ball around a
/// target is looked at.
constexpr double kGrazing = 1e-12;

/// The beam along (c, s) against half spaces of S, from the origin of S.
double hit(const std::vector<HalfSpace>& faces, std::size_t count, double c, double s) {
  constexpr double kNoHit = std::numeric_limits<double>::infinity();
  double enters = 0.0;
  double leaves = kNoHit;
  for (std::size_t i = 0; i < count; ++i) {
    const double speed = faces[i].normal.x() * c + faces[i].normal.y() * s;
    const double room = faces[i].offset;
    if (speed < 0.0) {
      enters = std::max(enters, room / speed);
    } else if (speed > 0.0) {
      leaves = std::min(leaves, room / speed);
    } else if (room < 0.0) {
      return kNoHit;
    }
  }
  return enters <= leaves ? enters : kNoHit;
}

}  // namespace

RayTarget::RayTarget(const ConvexPolyhedron& polyhedron, std::int32_t moving_body,
                     const Pose& place)
    : moving(moving_body), X_WT(place), center_T(polyhedron.data().center) {
  faces.reserve(polyhedron.data().faces.size());
  for (const PolyhedronData::Face& face : polyhedron.data().faces) {
    faces.push_back({face.normal, face.offset});
  }
  for (const PolyhedronData::Vertex& vertex : polyhedron.data().vertices) {
    radius = std::max(radius, norm(vertex.p - center_T));
  }
}

// NOLINTNEXTLINE(readability-function-size): the place for the turned faces is the caller's.
void castBeams(const BeamFan& fan, const Pose& X_WS, const RayTarget& target, const Pose& X_WT,
               double farthest, std::vector<HalfSpace>& faces, double* ranges) {
  const double radius = target.radius * (1.0 + kGrazing);
  const Vector3 center_S = inverseTransform(X_WS, transform(X_WT, target.center_T));
  // The disc in which the plane of the beams cuts the ball.
  const double disc_squared = (radius - center_S.z()) * (radius + center_S.z());
  if (disc_squared < 0.0) return;
  const double distance_squared = center_S.x() * center_S.x() + center_S.y() * center_S.y();
  const double distance = std::sqrt(distance_squared);
  const double reach = farthest + std::sqrt(disc_squared);
  if (distance > reach) return;
  // A beam meets the disc if its angle with the direction of the middle is no greater than that of
  // the tangent; from within, each does.
  const bool is_inside = distance_squared <= disc_squared;
  const double tangent =
      is_inside ? 0.0 : std::sqrt(distance_squared - disc_squared) * (1.0 - kGrazing);
  const Vector3 p_TS = inverseTransform(X_WT, X_WS.p_AB);
  const std::size_t count = target.faces.size();
  for (std::size_t i = 0; i < count; ++i) {
    const HalfSpace& face = target.faces[i];
    faces[i].normal = transposeTimes(X_WS.R_AB, times(X_WT.R_AB, face.normal));
    faces[i].offset = face.offset - dot(face.normal, p_TS);
  }
  for (std::size_t beam = 0; beam < fan.cosines.size(); ++beam) {
    const double c = fan.cosines[beam];
    const double s = fan.sines[beam];
    if (!is_inside && c * center_S.x() + s * center_S.y() < tangent) continue;
    ranges[beam] = std::min(ranges[beam], hit(faces, count, c, s));
  }
}

}  // namespace hovercraft
