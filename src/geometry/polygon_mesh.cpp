#include "hovercraft_sim/geometry/polygon_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <numeric>
#include <stdexcept>

#include "hovercraft_sim/geometry/coordinates.h"
#include "hovercraft_sim/geometry/face_point.h"
#include "hovercraft_sim/geometry/mesh_edges.h"
#include "hovercraft_sim/geometry/shells.h"
#include "hovercraft_sim/geometry/volume_moments.h"
#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

/// What a shell encloses, and the box around it.
struct Solid {
  double volume = 0.0;       // m³
  double surface = 0.0;      // m²
  double uncertainty = 0.0;  // m³: by rounded coordinates, or by the sum itself
  double greatest = 0.0;     // coordinate, m
  Vector3 low;               // corners of the box, m
  Vector3 high;
};

/// What the sum of signedVolume() may be off by, m³: each product of three lengths by the roundings
/// of its factors. It counts where faces are small beside their distance from the middle: slivers,
/// or polygons that go there and back.
double roundingOfSum(const PolygonMesh& mesh, const Vector3& middle) {
  double products = 0.0;
  for (const std::vector<int>& face : mesh.faces) {
    const double a = norm(mesh.vertices[static_cast<std::size_t>(face[0])] - middle);
    double b = norm(mesh.vertices[static_cast<std::size_t>(face[1])] - middle);
    for (std::size_t i = 2; i < face.size(); ++i) {
      const double c = norm(mesh.vertices[static_cast<std::size_t>(face[i])] - middle);
      products += a * b * c;
      b = c;
    }
  }
  return kDoubleRounding * products / 6.0;
}

Solid measure(const PolygonMesh& mesh) {
  Solid solid;
  solid.volume = signedVolume(mesh);
  solid.low = solid.high = mesh.vertices.front();
  for (const Vector3& p : mesh.vertices) {
    solid.low = solid.low.cwiseMin(p);
    solid.high = solid.high.cwiseMax(p);
  }
  solid.greatest = greatestCoordinate(mesh);
  for (const std::vector<int>& face : mesh.faces) {
    solid.surface += 0.5 * norm(twiceArea(mesh, face));
  }
  const Vector3 middle = solid.low + 0.5 * (solid.high - solid.low);
  solid.uncertainty =
      std::max(solid.surface * solid.greatest * mesh.rounding, roundingOfSum(mesh, middle));
  return solid;
}

void checkVolume(const Solid& solid, double rounding, const std::string& name) {
  if (solid.volume < -solid.uncertainty) {
    refuseSurface(
        name,
        fmt::format("inside out: its volume is {:.12g} m^3: seen from outside, the vertices of "
                    "each face must run counter-clockwise",
                    solid.volume));
  }
  if (!(solid.volume > 0.0 && solid.uncertainty <= kMeshVolume * solid.volume)) {
    refuseSurface(
        name,
        fmt::format(
            "volume = {:.12g} m^3 with an uncertainty of {:.12g} m^3, as coordinates of {:.12g} m "
            "are rounded to {:g} of themselves: must be known to {:g} %",
            solid.volume, solid.uncertainty, solid.greatest, rounding, 100.0 * kMeshVolume));
  }
}

bool contains(const Solid& solid, const Vector3& point) {
  return (solid.low.array() <= point.array()).all() && (point.array() <= solid.high.array()).all();
}

/// How far behind the surface a shell is compared with the others, in kMeshCoordinate of the
/// greatest coordinate (-): beyond what rounding does to the common face of touching parts.
constexpr double kSampleDepth = 10.0;

/// The same, of the thickness of a plate of that volume and surface (-): within the thinnest shell.
constexpr double kSampleShare = 0.125;

/// How many faces are tried for a sample: behind an edge where two of them meet at a sharp angle it
/// may miss the shell.
constexpr std::size_t kSampleFaces = 8;

/// A point of the body just behind one of the largest faces of a shell, m.
Vector3 samplePoint(const PolygonMesh& shell, const Solid& solid) {
  std::vector<double> areas;
  areas.reserve(shell.faces.size());
  for (const std::vector<int>& face : shell.faces) areas.push_back(norm(twiceArea(shell, face)));
  std::vector<std::size_t> order(shell.faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t count = std::min(kSampleFaces, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&areas](std::size_t a, std::size_t b) {
                      return areas[a] != areas[b] ? areas[a] > areas[b] : a < b;
                    });
  const double plate = 2.0 * std::abs(solid.volume) / solid.surface;
  const double depth =
      std::min(kSampleDepth * kMeshCoordinate * solid.greatest, kSampleShare * plate);
  Vector3 first = Vector3::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<int>& face = shell.faces[order[i]];
    const Vector3 sample =
        pointInFace(shell, face) - (depth / areas[order[i]]) * twiceArea(shell, face);
    if (i == 0) first = sample;
    const bool is_inside = std::abs(windingNumber(shell, sample)) > 0.5;
    if (is_inside == (solid.volume > 0.0)) return sample;
  }
  return first;
}

/// How often all shells but one go round a point of that one.
double windingOfOthers(const std::vector<PolygonMesh>& shells, const std::vector<Solid>& solids,
                       std::size_t one, const Vector3& point) {
  double winding = 0.0;
  for (std::size_t j = 0; j < shells.size(); ++j) {
    if (j == one || !contains(solids[j], point)) continue;
    winding += windingNumber(shells[j], point);
  }
  return winding;
}

/// Checks that a shell in no other one faces outwards and a shell in another one (a cavity)
/// inwards, and so on for what is in a cavity.
void checkShells(const PolygonMesh& mesh, const std::string& name) {
  const std::vector<PolygonMesh> shells = shellsOf(mesh);
  if (shells.size() == 1) return;
  if (shells.size() > kMostShells) {
    refuseSurface(name, fmt::format("{} shells: must be at most {}", shells.size(), kMostShells));
  }
  std::vector<Solid> solids;
  solids.reserve(shells.size());
  for (const PolygonMesh& shell : shells) solids.push_back(measure(shell));
  for (std::size_t i = 0; i < shells.size(); ++i) {
    if (std::abs(solids[i].volume) <= solids[i].uncertainty) continue;  // adds nothing
    const Vector3 sample = samplePoint(shells[i], solids[i]);
    const bool is_inside = windingOfOthers(shells, solids, i, sample) > 0.5;
    if (is_inside == (solids[i].volume < 0.0)) continue;
    refuseSurface(
        name, fmt::format(
                  "the shell with the vertex {} m has the volume {:.12g} m^3 and lies {}: a shell "
                  "must face outwards, the wall of a cavity inwards",
                  coordinates(shells[i].vertices.front()), solids[i].volume,
                  is_inside ? "inside another" : "in no other"));
  }
}

}  // namespace

Vector3 twiceArea(const PolygonMesh& mesh, const std::vector<int>& face) {
  const Vector3& a = mesh.vertices[static_cast<std::size_t>(face[0])];
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    const Vector3& b = mesh.vertices[static_cast<std::size_t>(face[i])];
    const Vector3& c = mesh.vertices[static_cast<std::size_t>(face[i + 1])];
    sum += cross(b - a, c - a);
  }
  return sum;
}

double greatestCoordinate(const PolygonMesh& mesh) {
  double greatest = 0.0;
  for (const Vector3& p : mesh.vertices) greatest = std::max(greatest, p.cwiseAbs().maxCoeff());
  return greatest;
}

double extentOf(const PolygonMesh& mesh) {
  Vector3 low = mesh.vertices.front();
  Vector3 high = low;
  for (const Vector3& p : mesh.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).maxCoeff();
}

void checkClosed(const PolygonMesh& mesh, const std::string& name) {
  const FloatingPointEnvironment environment;
  if (mesh.faces.empty()) refuseSurface(name, "no faces");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (mesh.vertices[i].allFinite()) continue;
    refuseSurface(name,
                  fmt::format("vertex {} is not finite: {}", i, coordinates(mesh.vertices[i])));
  }
  checkEdges(mesh, name);
  checkVolume(measure(mesh), mesh.rounding, name);
  checkShells(mesh, name);
}

}  // namespace hovercraft
