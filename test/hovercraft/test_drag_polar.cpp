#include <cmath>

#include <gtest/gtest.h>

#include "hovercraft_sim/hovercraft/drag_polar.h"

#include "../support/numbers.h"

namespace hovercraft {
namespace {

using testing::kRounding;

/// JEFF(B), as fitted to its model.
DragPolar jeffB() {
  DragPolar polar;
  polar.area_x = 77.7;
  polar.area_y = 297.3;
  polar.length = 23.46;
  polar.surge = {-.0634, .519, -.0256, .0435, .0967, .0178};
  polar.sway = {.6438, -.0005, .0241, -.0002, .0053, -.0002};
  polar.yaw = {-.0052, .0800, .0043, -.0212, -.0028, .0015};
  return polar;
}

TEST(DragPolar, IsTheSumOfCosinesAndSines) {
  const DragPolar polar = jeffB();
  const double speed = 12.0;
  const double pressure = 0.5 * 1.225 * speed * speed;
  for (int degree = -180; degree <= 180; degree += 7) {
    const double beta = degree * 3.14159265358979323846 / 180.0;
    double surge = 0.0;
    double sway = 0.0;
    double yaw = 0.0;
    for (std::size_t k = 0; k < 6; ++k) {
      const auto n = static_cast<double>(k);
      surge += polar.surge[k] * std::cos(n * beta);
      sway += polar.sway[k] * std::sin((n + 1.0) * beta);
      yaw += polar.yaw[k] * std::sin((n + 1.0) * beta);
    }
    const Wrench wrench = polar.wrenchInBody({speed * std::cos(beta), speed * std::sin(beta), 3.0});
    const double scale = pressure * 297.3 * 23.46;
    EXPECT_NEAR(wrench.force.x(), -pressure * 77.7 * surge, kRounding * scale) << degree;
    EXPECT_NEAR(wrench.force.y(), -pressure * 297.3 * sway, kRounding * scale) << degree;
    EXPECT_EQ(wrench.force.z(), 0.0);
    EXPECT_EQ(wrench.torque.x(), 0.0);
    EXPECT_EQ(wrench.torque.y(), 0.0);
    EXPECT_NEAR(wrench.torque.z(), -pressure * 297.3 * 23.46 * yaw, kRounding * scale) << degree;
  }
}

// a_0 alone is the same force whatever the direction, b_1 = a_1 the quadratic law of a sphere.
TEST(DragPolar, OfOneTermIsAKnownLaw) {
  DragPolar polar;
  polar.area_x = polar.area_y = 2.0;
  polar.surge[1] = polar.sway[0] = 0.5;
  const Vector3 u(3.0, -4.0, 0.0);
  const Wrench wrench = polar.wrenchInBody(u);
  EXPECT_LT(norm(wrench.force + 0.5 * 1.225 * 2.0 * 0.5 * 5.0 * u), 16.0 * kRounding);
}

// Ahead by 1 m/s: half the density times area and coefficient; a coefficient that drives is none.
TEST(DragPolar, QuadraticDragIsThatOfEachAxisByItself) {
  DragPolar polar = jeffB();
  const double surge = -.0634 + .519 - .0256 + .0435 + .0967 + .0178;
  const double sway = .6438 - .0241 + .0053;  // sin(k pi/2) of odd k
  const Vector3 drag = polar.quadraticDrag();
  EXPECT_NEAR(drag.x(), 0.5 * 1.225 * 77.7 * surge, 1e-12);
  EXPECT_NEAR(drag.y(), 0.5 * 1.225 * 297.3 * sway, 1e-12);
  EXPECT_EQ(drag.z(), 0.0);
  polar.surge = {-1.0};
  polar.sway = {-1.0};
  EXPECT_EQ(polar.quadraticDrag(), Vector3(0.0, 0.0, 0.0));
}

TEST(DragPolar, MirroredAirMirrorsTheWrenchToTheLastBit) {
  const DragPolar polar = jeffB();
  for (int i = 0; i < 100; ++i) {
    const Vector3 u(std::cos(1.7 * i), std::sin(0.3 * i), 0.1 * i);
    const Wrench left = polar.wrenchInBody(u);
    const Wrench right = polar.wrenchInBody({u.x(), -u.y(), u.z()});
    EXPECT_EQ(left.force.x(), right.force.x());
    EXPECT_EQ(left.force.y(), -right.force.y());
    EXPECT_EQ(left.torque.z(), -right.torque.z());
  }
}

TEST(DragPolar, IsNothingInAirThatStands) {
  for (const double speed : {0.0, -0.0, 1e-300}) {
    const Wrench wrench = jeffB().wrenchInBody({speed, speed, 5.0});
    EXPECT_EQ(norm(wrench.force) + norm(wrench.torque), 0.0);
  }
}

}  // namespace
}  // namespace hovercraft
