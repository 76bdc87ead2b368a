#include "hovercraft_sim/geometry/shells.h"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "hovercraft_sim/math/constants.h"

namespace hovercraft {
namespace {

/// Numbers that fall into groups (union-find).
class Groups {
 public:
  explicit Groups(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t of(std::size_t member) {
    while (parent_[member] != member) {
      parent_[member] = parent_[parent_[member]];
      member = parent_[member];
    }
    return member;
  }
  void unite(std::size_t a, std::size_t b) { parent_[of(a)] = of(b); }

 private:
  std::vector<std::size_t> parent_;
};

double signedSolidAngle(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double a_length = norm(a);
  const double b_length = norm(b);
  const double c_length = norm(c);
  const double denominator =
      ((a_length * b_length * c_length + dot(a, b) * c_length) + dot(b, c) * a_length) +
      dot(c, a) * b_length;
  const double numerator = dot(a, cross(b, c));
  // A triangle seen edge on, or one that the point lies on: half of it on either side.
  if (numerator == 0.0) return 0.0;
  return 2.0 * std::atan2(numerator, denominator);
}

}  // namespace

std::vector<PolygonMesh> shellsOf(const PolygonMesh& mesh) {
  Groups groups(mesh.vertices.size());
  for (const std::vector<int>& face : mesh.faces) {
    for (const int vertex : face) {
      groups.unite(static_cast<std::size_t>(face[0]), static_cast<std::size_t>(vertex));
    }
  }
  constexpr int none = -1;
  std::vector<PolygonMesh> shells;
  std::vector<int> shell_of_group(mesh.vertices.size(), none);
  std::vector<int> index_in_shell(mesh.vertices.size(), none);
  for (const std::vector<int>& face : mesh.faces) {
    int& number = shell_of_group[groups.of(static_cast<std::size_t>(face[0]))];
    if (number == none) {
      number = static_cast<int>(shells.size());
      shells.emplace_back();
      shells.back().rounding = mesh.rounding;
    }
    PolygonMesh& shell = shells[static_cast<std::size_t>(number)];
    std::vector<int> renumbered;
    renumbered.reserve(face.size());
    for (const int corner : face) {
      const auto vertex = static_cast<std::size_t>(corner);
      if (index_in_shell[vertex] == none) {
        index_in_shell[vertex] = static_cast<int>(shell.vertices.size());
        shell.vertices.push_back(mesh.vertices[vertex]);
      }
      renumbered.push_back(index_in_shell[vertex]);
    }
    shell.faces.push_back(std::move(renumbered));
  }
  return shells;
}

double windingNumber(const PolygonMesh& surface, const Vector3& point) {
  double angle = 0.0;
  const auto from_point = [&](int vertex) -> Vector3 {
    return surface.vertices[static_cast<std::size_t>(vertex)] - point;
  };
  for (const std::vector<int>& face : surface.faces) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      angle += signedSolidAngle(from_point(face[0]), from_point(face[i]), from_point(face[i + 1]));
    }
  }
  return angle / (4.0 * kPi);
}

}  // namespace hovercraft
