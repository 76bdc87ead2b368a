#include "hovercraft_sim/geometry/shells.h"

#include <cmath>
#include <cstddef>
#include <numeric>

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

std::vector<TriangleMesh> shellsOf(const TriangleMesh& mesh) {
  Groups groups(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) {
    groups.unite(static_cast<std::size_t>(triangle[0]), static_cast<std::size_t>(triangle[1]));
    groups.unite(static_cast<std::size_t>(triangle[0]), static_cast<std::size_t>(triangle[2]));
  }
  constexpr int none = -1;
  std::vector<TriangleMesh> shells;
  std::vector<int> shell_of_group(mesh.vertices.size(), none);
  std::vector<int> index_in_shell(mesh.vertices.size(), none);
  for (const auto& triangle : mesh.triangles) {
    int& number = shell_of_group[groups.of(static_cast<std::size_t>(triangle[0]))];
    if (number == none) {
      number = static_cast<int>(shells.size());
      shells.emplace_back();
    }
    TriangleMesh& shell = shells[static_cast<std::size_t>(number)];
    std::array<int, 3> renumbered{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto vertex = static_cast<std::size_t>(triangle[i]);
      if (index_in_shell[vertex] == none) {
        index_in_shell[vertex] = static_cast<int>(shell.vertices.size());
        shell.vertices.push_back(mesh.vertices[vertex]);
      }
      renumbered[i] = index_in_shell[vertex];
    }
    shell.triangles.push_back(renumbered);
  }
  return shells;
}

double windingNumber(const TriangleMesh& surface, const Vector3& point) {
  double angle = 0.0;
  for (const auto& triangle : surface.triangles) {
    angle += signedSolidAngle(surface.vertices[static_cast<std::size_t>(triangle[0])] - point,
                              surface.vertices[static_cast<std::size_t>(triangle[1])] - point,
                              surface.vertices[static_cast<std::size_t>(triangle[2])] - point);
  }
  return angle / (4.0 * kPi);
}

}  // namespace hovercraft
