#pragma once

/// What closestFeatures() is held against: every pair of features, in long double, with nothing in
/// common with the walk.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "hovercraft_sim/geometry/convex_polyhedron.h"
#include "hovercraft_sim/geometry/pose.h"

namespace hovercraft::brute_force {

using Real = long double;

struct Vec {
  Real x = 0;
  Real y = 0;
  Real z = 0;
};
inline Vec operator+(const Vec& a, const Vec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec operator-(const Vec& a, const Vec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec operator*(Real f, const Vec& a) {
  return {f * a.x, f * a.y, f * a.z};
}
inline Real dot(const Vec& a, const Vec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A polyhedron in the world, axes of W, relative to a common origin.
struct Body {
  std::vector<Vec> vertices;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::vector<int>> faces;
  std::vector<Vec> normals;
};

inline Body place(const ConvexPolyhedron& body, const Pose& X, const Vector3& origin) {
  Body result;
  for (int i = 0; i < body.vertexCount(); ++i) {
    const Vector3& p = body.vertex(i);
    std::array<Real, 3> w{};
    for (int r = 0; r < 3; ++r) {
      w[static_cast<std::size_t>(r)] = Real(X.R_AB(r, 0)) * p.x() + Real(X.R_AB(r, 1)) * p.y() +
                                       Real(X.R_AB(r, 2)) * p.z() + Real(X.p_AB[r]) -
                                       Real(origin[r]);
    }
    result.vertices.push_back({w[0], w[1], w[2]});
  }
  for (int e = 0; e < body.edgeCount(); ++e) {
    result.edges.push_back({body.edge(e).vertex[0], body.edge(e).vertex[1]});
  }
  const auto vertex = [&](int i) { return result.vertices[static_cast<std::size_t>(i)]; };
  for (int f = 0; f < body.faceCount(); ++f) {
    const std::vector<std::int32_t> ring = body.verticesOf({FeatureKind::kFace, f});
    Vec area;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
      area = area + cross(vertex(ring[i]) - vertex(ring[0]), vertex(ring[i + 1]) - vertex(ring[0]));
    }
    result.normals.push_back(1 / std::sqrt(dot(area, area)) * area);
    result.faces.emplace_back(ring.begin(), ring.end());
  }
  return result;
}

/// Squared distance of two segments p + s d, q + t e, s and t in [0, 1].
inline Real squaredSegments(const Vec& p, const Vec& d, const Vec& q, const Vec& e) {
  const Vec w = q - p;
  const Real dd = dot(d, d);
  const Real ee = dot(e, e);
  const auto clamp = [](Real x) { return std::min(Real(1), std::max(Real(0), x)); };
  Real best = std::numeric_limits<Real>::infinity();
  const auto look = [&](Real s, Real t) {
    const Vec u = w + t * e - s * d;
    best = std::min(best, dot(u, u));
  };
  for (const Real s : {Real(0), Real(1)}) look(s, clamp(dot(s * d - w, e) / ee));
  for (const Real t : {Real(0), Real(1)}) look(clamp(dot(w + t * e, d) / dd), t);
  const Vec n = cross(d, e);
  const Real nn = dot(n, n);
  if (nn > Real(1e-34) * dd * ee) {
    const Real s = dot(cross(w, e), n) / nn;
    const Real t = dot(cross(w, d), n) / nn;
    if (s > 0 && s < 1 && t > 0 && t < 1) best = std::min(best, dot(w, n) * dot(w, n) / nn);
  }
  return best;
}

/// The height of a vertex over a face, if it stands over it; else infinity.
inline Real heightOver(const Body& body, std::size_t face, const Vec& p) {
  const std::vector<int>& ring = body.faces[face];
  const auto vertex = [&](std::size_t i) {
    return body.vertices[static_cast<std::size_t>(ring[i % ring.size()])];
  };
  const Real height = dot(body.normals[face], p - vertex(0));
  if (height <= 0) return std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec inward = cross(body.normals[face], vertex(i + 1) - vertex(i));
    if (dot(inward, p - vertex(i)) < 0) return std::numeric_limits<Real>::infinity();
  }
  return height;
}

/// An edge with a ball around it.
struct Segment {
  Vec p;
  Vec d;
  Vec middle;
  Real half = 0;
};

inline std::vector<Segment> segments(const Body& body) {
  std::vector<Segment> result;
  for (const auto& e : body.edges) {
    const Vec p = body.vertices[static_cast<std::size_t>(e[0])];
    const Vec d = body.vertices[static_cast<std::size_t>(e[1])] - p;
    result.push_back({p, d, p + Real(0.5) * d, std::sqrt(dot(d, d)) / 2});
  }
  return result;
}

/// Distance of two disjoint bodies.
inline Real distance(const Body& a, const Body& b) {
  Real best = std::numeric_limits<Real>::infinity();
  const std::vector<Segment> edges_B = segments(b);
  for (const Segment& ea : segments(a)) {
    for (const Segment& eb : edges_B) {
      const Vec between = eb.middle - ea.middle;
      const Real reach = best + ea.half + eb.half;
      if (dot(between, between) > reach * reach) continue;  // the balls are farther apart
      best = std::min(best, std::sqrt(squaredSegments(ea.p, ea.d, eb.p, eb.d)));
    }
  }
  for (std::size_t f = 0; f < a.faces.size(); ++f) {
    for (const Vec& v : b.vertices) best = std::min(best, heightOver(a, f, v));
  }
  for (std::size_t f = 0; f < b.faces.size(); ++f) {
    for (const Vec& v : a.vertices) best = std::min(best, heightOver(b, f, v));
  }
  return best;
}

/// How far B must move along n to part from A; where that is not less than `bound`, any number that
/// is not either. It grows with each vertex that is looked at, so that most directions of a search
/// for the least are done after a few.
inline Real overlapAlong(const Body& a, const Body& b, const Vec& n,
                         Real bound = std::numeric_limits<Real>::infinity()) {
  Real high = -std::numeric_limits<Real>::infinity();
  Real low = -high;
  const std::size_t most = std::max(a.vertices.size(), b.vertices.size());
  for (std::size_t i = 0; i < most && !(high - low >= bound); ++i) {
    if (i < a.vertices.size()) high = std::max(high, dot(n, a.vertices[i]));
    if (i < b.vertices.size()) low = std::min(low, dot(n, b.vertices[i]));
  }
  return high - low;
}

/// The least overlap over all face normals and all cross products of edges: positive exactly if the
/// bodies overlap, and the depth then.
inline Real leastOverlap(const Body& a, const Body& b) {
  Real least = std::numeric_limits<Real>::infinity();
  const auto look = [&](const Vec& n) { least = std::min(least, overlapAlong(a, b, n, least)); };
  for (const Vec& n : a.normals) look(n);
  for (const Vec& n : b.normals) look(-1 * n);
  for (const auto& ea : a.edges) {
    const Vec d =
        a.vertices[static_cast<std::size_t>(ea[1])] - a.vertices[static_cast<std::size_t>(ea[0])];
    for (const auto& eb : b.edges) {
      const Vec e =
          b.vertices[static_cast<std::size_t>(eb[1])] - b.vertices[static_cast<std::size_t>(eb[0])];
      const Vec n = cross(d, e);
      const Real nn = dot(n, n);
      if (!(nn > Real(1e-30) * dot(d, d) * dot(e, e))) continue;
      const Vec unit = 1 / std::sqrt(nn) * n;
      look(unit);
      look(-1 * unit);
    }
  }
  return least;
}

}  // namespace hovercraft::brute_force
