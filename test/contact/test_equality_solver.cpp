#include <array>

#include <gtest/gtest.h>

#include "hovercraft_sim/contact/equality_solver.h"

/// Impulses that give points velocities, against what they make of the bodies.

namespace hovercraft {
namespace {

constexpr double kExact = 1e-7;  // the method of multipliers leaves some 1e-8

EqualitySolver::Body cube() {
  return {Vector3::Constant(0.5), Matrix3(Vector3::Constant(2.0).asDiagonal())};  // 2 kg, 0.5 kg m²
}

const Vector3 kUp(0.0, 0.0, 1.0);

/// Four corners of a square of 2 m under a body that a floor (body 0) lifts by 1 m/s.
std::array<double, 4> impulsesOfFourCorners(const EqualitySolver::Body& body) {
  EqualitySolver solver;
  solver.add(EqualitySolver::Body());
  solver.add(body);
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Vector3 corner(x, y, -1.0);
      solver.add({0, 1, kUp, corner, corner, 1.0});
    }
  }
  solver.order();
  solver.solve();
  std::array<double, 4> impulses{};
  for (std::size_t i = 0; i < 4; ++i) impulses[i] = solver.rows()[i].impulse;
  return impulses;
}

// One corner would do with three others; of all ways the least is that each takes its share.
TEST(EqualitySolver, SharesAmongCornersThatDependOnEachOther) {
  for (const double impulse : impulsesOfFourCorners(cube())) EXPECT_NEAR(impulse, 0.5, kExact);
}

TEST(EqualitySolver, ABodyThatCannotTurnIsLiftedAsWell) {
  const EqualitySolver::Body plate = {Vector3::Constant(0.5), Matrix3::Zero()};
  for (const double impulse : impulsesOfFourCorners(plate)) EXPECT_NEAR(impulse, 0.5, kExact);
}

// What does not move takes no impulse, and nothing is divided by 0.
TEST(EqualitySolver, AskedOfTwoFixedBodiesNothingIsDone) {
  EqualitySolver solver;
  solver.add(EqualitySolver::Body());
  solver.add(EqualitySolver::Body());
  solver.add({0, 1, kUp, Vector3::Zero(), Vector3::Zero(), 1.0});
  EXPECT_EQ(solver.order(), 0U);
  solver.solve();
  EXPECT_EQ(solver.rows()[0].impulse, 0.0);
}

/// A chain of bodies from a fixed one, whose neighbours are asked for velocities against each
/// other along all axes at points off their centres. `name` says which index each has.
struct Chain {
  explicit Chain(const std::vector<std::int32_t>& name) : names(name) {
    bodies.resize(name.size());
    for (std::size_t i = 1; i < name.size(); ++i) {
      Matrix3 inertia;
      inertia << 2.0, 0.3, 0.1, 0.3, 1.5, -0.2, 0.1, -0.2, 1.0;
      bodies[static_cast<std::size_t>(name[i])] = {Vector3::Constant(1.0 / static_cast<double>(i)),
                                                   inertia};
    }
    for (const EqualitySolver::Body& body : bodies) solver.add(body);
    for (std::size_t i = 1; i < name.size(); ++i) join(name[i - 1], name[i]);
    work = solver.order();
    solver.solve();
  }
  void join(std::int32_t a, std::int32_t b) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-0.3, 0.2}) {
        if (axis == 0 && side > 0.0) continue;  // along the line of both points it says the same
        const double wanted = 0.1 * axis + (side > 0.0 && axis == 2 ? 0.05 : 0.0) - 0.02 * b;
        solver.add(
            {a, b, Vector3::Unit(axis), Vector3(side, 0.1, 0.5), Vector3(side, 0.1, -0.5), wanted});
      }
    }
  }
  /// The velocity that the impulses give B against A at a row.
  double reached(const EqualitySolver::Row& asked) const {
    return dot(asked.direction,
               Vector3(velocity(asked.b, asked.r_b) - velocity(asked.a, asked.r_a)));
  }
  Vector3 velocity(std::int32_t body, const Vector3& arm) const {
    const EqualitySolver::Body& moved = bodies[static_cast<std::size_t>(body)];
    Vector3 v = Vector3::Zero();
    Vector3 w = Vector3::Zero();
    for (const EqualitySolver::Row& row : solver.rows()) {
      const double sign = row.b == body ? 1.0 : row.a == body ? -1.0 : 0.0;
      const Vector3 impulse = sign * row.impulse * row.direction;
      v += moved.inverse_mass.cwiseProduct(impulse);
      w += times(moved.inverse_inertia, cross(row.b == body ? row.r_b : row.r_a, impulse));
    }
    return v + cross(w, arm);
  }

  std::vector<std::int32_t> names;
  std::vector<EqualitySolver::Body> bodies;
  EqualitySolver solver;
  std::size_t work = 0;
};

TEST(EqualitySolver, GivesEachPointOfAChainItsVelocity) {
  const Chain chain({0, 1, 2, 3, 4});
  for (const EqualitySolver::Row& row : chain.solver.rows()) {
    EXPECT_NEAR(chain.reached(row), row.wanted, kExact);
  }
}

// From the fixed one on each body has its neighbour before it, whatever they are called: four
// blocks on the diagonal and three products for each that is beside it.
TEST(EqualitySolver, OrdersBodiesByTheirDistanceFromWhatIsFixed) {
  EXPECT_EQ(Chain({0, 1, 2, 3, 4}).work, 1U + 3U * 4U);
  EXPECT_EQ(Chain({0, 3, 1, 4, 2}).work, 1U + 3U * 4U);
  const Chain last({2, 4, 0, 1, 3});
  EXPECT_EQ(last.work, 1U + 3U * 4U);
  for (const EqualitySolver::Row& row : last.solver.rows()) {
    EXPECT_NEAR(last.reached(row), row.wanted, kExact);
  }
}

// A group that touches nothing fixed is pushed apart with equal and opposite impulses.
TEST(EqualitySolver, TwoFreeBodiesPart) {
  EqualitySolver solver;
  solver.add(cube());
  solver.add(cube());
  solver.add({0, 1, kUp, Vector3::Zero(), Vector3::Zero(), 3.0});
  solver.order();
  solver.solve();
  EXPECT_NEAR(solver.rows()[0].impulse, 3.0, kExact);
}

TEST(EqualitySolver, ARowMustNameTwoBodies) {
  EqualitySolver solver;
  solver.add(cube());
  EXPECT_THROW(solver.add({0, 1, kUp, Vector3::Zero(), Vector3::Zero(), 1.0}), std::logic_error);
}

}  // namespace
}  // namespace hovercraft
