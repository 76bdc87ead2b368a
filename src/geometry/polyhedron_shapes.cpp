#include "hovercraft_sim/geometry/polyhedron_shapes.h"

#include <fmt/format.h>
#include <stdexcept>

#include "hovercraft_sim/math/elementary.h"
#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

constexpr double kTwoPi = 6.283185307179586476925286766559;

void checkLength(double value, const char* what) {
  if (!(value > 0.0) || !(value < 1e300)) {
    throw std::invalid_argument(fmt::format("{} = {} m: it must be positive", what, value));
  }
}

}  // namespace

ConvexPolyhedron boxPolyhedron(const Vector3& size) {
  const FloatingPointEnvironment environment;
  checkLength(size.x(), "box length");
  checkLength(size.y(), "box width");
  checkLength(size.z(), "box height");
  const double x = 0.5 * size.x();
  const double y = 0.5 * size.y();
  return prismPolyhedron(
      ConvexPolygon({Vector2{-x, -y}, Vector2{x, -y}, Vector2{x, y}, Vector2{-x, y}}), size.z());
}

ConvexPolyhedron prismPolyhedron(const ConvexPolygon& base, double height) {
  const FloatingPointEnvironment environment;
  checkLength(height, "prism height");
  const int n = base.vertexCount();
  std::vector<Vector3> vertices;
  std::vector<std::vector<std::int32_t>> rings(2);
  for (const double z : {-0.5 * height, 0.5 * height}) {
    for (int i = 0; i < n; ++i) vertices.emplace_back(base.vertex(i).x, base.vertex(i).y, z);
  }
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    rings[0].push_back(n - 1 - i);
    rings[1].push_back(n + i);
    rings.push_back({i, next, n + next, n + i});
  }
  return {vertices, rings};
}

ConvexPolyhedron cylinderPolyhedron(double radius, double height, int sides) {
  const FloatingPointEnvironment environment;
  checkLength(radius, "cylinder radius");
  if (sides < 3) {
    throw std::invalid_argument(fmt::format("cylinder sides = {}: at least 3", sides));
  }
  std::vector<Vector2> ring;
  for (int i = 0; i < sides; ++i) {
    const double angle = kTwoPi * i / sides;
    ring.push_back({radius * exactCos(angle), radius * exactSin(angle)});
  }
  return prismPolyhedron(ConvexPolygon(ring), height);
}

}  // namespace hovercraft
