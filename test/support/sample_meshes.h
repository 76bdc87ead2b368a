#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "hovercraft_sim/geometry/triangle_mesh.h"

namespace hovercraft::testing {

inline const Vector3 kOne(1.0, 1.0, 1.0);

/// The box with the corners `low` and `high`.
inline TriangleMesh boxMesh(const Vector3& low, const Vector3& high) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    mesh.vertices.emplace_back((corner & 1) != 0 ? high.x() : low.x(),
                               (corner & 2) != 0 ? high.y() : low.y(),
                               (corner & 4) != 0 ? high.z() : low.z());
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

inline TriangleMesh tetrahedronMesh(const std::array<Vector3, 4>& corners) {
  return {{corners.begin(), corners.end()}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// The surface with its other side outwards.
inline TriangleMesh turnedOver(TriangleMesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

inline TriangleMesh moved(TriangleMesh mesh, const Matrix3& R, const Vector3& p) {
  for (Vector3& vertex : mesh.vertices) vertex = times(R, vertex) + p;
  return mesh;
}

inline TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const int offset = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) {
    a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  return a;
}

/// Each triangle of a mesh cut in four, the new vertices pushed out to the unit sphere.
inline TriangleMesh refinedSphere(const TriangleMesh& coarse) {
  TriangleMesh fine;
  fine.vertices = coarse.vertices;
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [entry, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)},
                                                     static_cast<int>(fine.vertices.size()));
    if (is_new) {
      const Vector3 sum =
          fine.vertices[static_cast<std::size_t>(a)] + fine.vertices[static_cast<std::size_t>(b)];
      fine.vertices.emplace_back(sum / norm(sum));
    }
    return entry->second;
  };
  for (const auto& t : coarse.triangles) {
    const int ab = middle(t[0], t[1]);
    const int bc = middle(t[1], t[2]);
    const int ca = middle(t[2], t[0]);
    fine.triangles.insert(fine.triangles.end(),
                          {{t[0], ab, ca}, {t[1], bc, ab}, {t[2], ca, bc}, {ab, bc, ca}});
  }
  return fine;
}

/// A body of 128 triangles whose surface lies at a random distance of 0.5 to 1.5 in every
/// direction from the origin: concave, but star-shaped and so without cuts through itself.
inline TriangleMesh starMesh(std::mt19937& engine) {
  TriangleMesh mesh{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  mesh = refinedSphere(refinedSphere(mesh));
  std::uniform_real_distribution<double> distance(0.5, 1.5);
  for (Vector3& vertex : mesh.vertices) vertex *= distance(engine);
  return mesh;
}

}  // namespace hovercraft::testing
