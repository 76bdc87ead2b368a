#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/body/steppers.h"

#include "../support/free_body.h"
#include "../support/free_flight.h"
#include "../support/orientations.h"

namespace hovercraft {
namespace {

using testing::Brick;
using testing::freeFlight;
using testing::FreeSystem;
using testing::stateOf;

constexpr std::array<Integrator, 5> kIntegrators = {
    Integrator::kEuler, Integrator::kSemiImplicitEuler, Integrator::kHeun, Integrator::kRungeKutta4,
    Integrator::kLie4};
constexpr std::array<int, 5> kOrders = {1, 1, 2, 4, 4};
constexpr double kOrderTolerance = 0.1;

/// A body pushed and turned by forces that are fixed in it and change with time, and held back by
/// one that grows with the square of the speed: every argument of a derivative counts.
struct DrivenSystem {
  const Mobility& mobility;
  double start;  // of the step, s
  double h;      // s

  template <class Orientation>
  StateDerivative<Orientation> derivative(const RigidBodyState<Orientation>& state,
                                          Stage stage) const {
    const double t = start + h * (stage == Stage::kStart ? 0.0 : stage == Stage::kMiddle ? 0.5 : 1);
    const Twist velocities = twist(state);
    const Matrix3 R_WB = rotationMatrix(state.orientation);
    const Vector3 force_B(2.0 * std::cos(3.0 * t), 0.5 + std::sin(t), -0.3);
    const Vector3 torque_B(0.8 * std::sin(2.0 * t), -0.4, 0.9 * std::cos(t));
    const Vector3 drag_W = (-0.2 * norm(velocities.v_WB)) * velocities.v_WB;
    return {velocities.v_WB, orientationRate(velocities.w_WB, state.orientation),
            times(R_WB, force_B) + drag_W, times(R_WB, torque_B)};
  }
  template <class Orientation>
  Twist twist(const RigidBodyState<Orientation>& state) const {
    return mobility.twist(state);
  }
};

template <class Orientation>
RigidBodyState<Orientation> drivenFlight(Integrator integrator, double duration, int steps) {
  Matrix3 inertia;
  inertia << 1.0, 0.1, -0.2,  //
      0.1, 2.0, 0.15,         //
      -0.2, 0.15, 2.5;
  const Mobility mobility = Mobility::spatial(1.5, inertia);
  auto state = stateOf<Orientation>(mobility, rotationFromRpy({0.3, -0.7, 1.9}), {1.0, -0.5, 0.2},
                                    {0.4, 1.5, 0.9});
  const double h = duration / steps;
  for (int n = 0; n < steps; ++n) {
    state = integrationStep(integrator, state, DrivenSystem{mobility, n * h, h}, h);
  }
  return state;
}

/// Distance of two states: positions, momenta and the angle between the attitudes, in SI.
template <class A, class B>
double distance(const RigidBodyState<A>& a, const RigidBodyState<B>& b) {
  const double angle = angleBetween(toQuaternion(a.orientation), toQuaternion(b.orientation));
  return std::sqrt(squaredNorm(a.p_WB - b.p_WB) + squaredNorm(a.momentum_W - b.momentum_W) +
                   squaredNorm(a.angular_momentum_W - b.angular_momentum_W) + angle * angle);
}

/// Steps of the coarser of two runs: few enough that the method's error stands out from rounding,
/// enough that the leading term of the error does from the next one.
int coarseSteps(int order) {
  return order == 1 ? 4000 : order == 2 ? 400 : 100;
}

template <class T>
class Steppers : public ::testing::Test {};

TYPED_TEST_SUITE(Steppers, testing::Orientations, testing::OrientationName);

// Halving h divides the error by 2^order. Free asymmetric body, attitude against the closed form.
TYPED_TEST(Steppers, HaveTheirOrderOnAFreeAsymmetricBody) {
  constexpr double duration = 2.0;
  const Brick brick;
  const Matrix3 exact =
      testing::FreeBody(brick.moments, brick.w_WB_B, brick.R_WB).attitude(duration);
  const auto error = [&](Integrator integrator, int steps) {
    const auto state = freeFlight<TypeParam>(integrator, brick, duration, steps);
    return angleBetween(toQuaternion(state.orientation), quaternionFromMatrix(exact));
  };
  for (std::size_t i = 0; i < kIntegrators.size(); ++i) {
    const int steps = coarseSteps(kOrders[i]);
    const double measured =
        std::log2(error(kIntegrators[i], steps) / error(kIntegrators[i], 2 * steps));
    EXPECT_NEAR(measured, kOrders[i], kOrderTolerance) << "integrator " << i;
    this->RecordProperty("order_" + std::to_string(i), std::to_string(measured));
  }
}

// Driven body with forces that depend on time: against RK4 with steps 40 times shorter than the
// finer run of RK4, whose own error is 40^4 times smaller.
TYPED_TEST(Steppers, HaveTheirOrderOnADrivenBody) {
  constexpr double duration = 2.0;
  constexpr int reference_steps = 2 * 40 * 100;
  const auto reference =
      drivenFlight<Quaternion>(Integrator::kRungeKutta4, duration, reference_steps);
  for (std::size_t i = 0; i < kIntegrators.size(); ++i) {
    const int steps = coarseSteps(kOrders[i]);
    const double coarse =
        distance(drivenFlight<TypeParam>(kIntegrators[i], duration, steps), reference);
    const double fine =
        distance(drivenFlight<TypeParam>(kIntegrators[i], duration, 2 * steps), reference);
    const double measured = std::log2(coarse / fine);
    EXPECT_NEAR(measured, kOrders[i], kOrderTolerance) << "integrator " << i;
    this->RecordProperty("order_" + std::to_string(i), std::to_string(measured));
  }
}

// dL/dt = 0 and dP/dt = 0 exactly: momenta are the state.
TYPED_TEST(Steppers, FreeBodyKeepsItsMomentaToTheLastBit) {
  const Brick brick;
  const Mobility mobility = brick.mobility();
  for (const Integrator integrator : kIntegrators) {
    auto state = stateOf<TypeParam>(mobility, brick.R_WB, Vector3(0.1, 0.2, 0.3), brick.w_WB_B);
    const auto first = state;
    for (int n = 0; n < 10000; ++n) {
      state = integrationStep(integrator, state, FreeSystem{mobility}, 1e-3);
    }
    EXPECT_EQ(state.momentum_W, first.momentum_W);
    EXPECT_EQ(state.angular_momentum_W, first.angular_momentum_W);
    EXPECT_GT(angleBetween(toQuaternion(state.orientation), toQuaternion(first.orientation)), 0.1);
  }
}

// Energy is not exact: it drifts as the attitude's error does, h^order (RK4: h^4 or better).
TYPED_TEST(Steppers, EnergyDriftShrinksWithTheOrderOfTheMethod) {
  constexpr double duration = 4.0;
  const Brick brick;
  const Mobility mobility = brick.mobility();
  const double energy = 0.5 * dot(brick.w_WB_B, brick.moments.cwiseProduct(brick.w_WB_B));
  const auto drift = [&](Integrator integrator, int steps) {
    const auto state = freeFlight<TypeParam>(integrator, brick, duration, steps);
    return std::abs(kineticEnergy(state, mobility) - energy);
  };
  for (std::size_t i = 0; i < kIntegrators.size(); ++i) {
    const int steps = coarseSteps(kOrders[i]);
    const double measured =
        std::log2(drift(kIntegrators[i], steps) / drift(kIntegrators[i], 2 * steps));
    EXPECT_GT(measured, kOrders[i] - kOrderTolerance) << "integrator " << i;
  }
}

double distanceFromRotation(const Quaternion& q) {
  return std::abs(norm(q) - 1.0);
}
double distanceFromRotation(const Matrix3& R) {
  return orthogonalityError(R);
}

// One rounding of each entry, whatever the number of steps: 1e5 at 1 ms, the spin by far too fast
// for Euler to be accurate.
TYPED_TEST(Steppers, OrientationStaysARotationOver100000Steps) {
  const Brick brick;
  const Mobility mobility = brick.mobility();
  for (const Integrator integrator : kIntegrators) {
    auto state = stateOf<TypeParam>(mobility, brick.R_WB, Vector3::Zero(), 20.0 * brick.w_WB_B);
    double worst = 0.0;
    for (int n = 0; n < 100000; ++n) {
      state = integrationStep(integrator, state, FreeSystem{mobility}, 1e-3);
      worst = std::max(worst, distanceFromRotation(state.orientation));
    }
    EXPECT_LT(worst, 2e-15);
  }
}

// Both representations integrate the same motion: they differ by less than either errs.
TEST(Steppers, MatrixAndQuaternionAgree) {
  constexpr double duration = 2.0;
  const auto exact = drivenFlight<Quaternion>(Integrator::kRungeKutta4, duration, 8000);
  for (std::size_t i = 0; i < kIntegrators.size(); ++i) {
    const int steps = coarseSteps(kOrders[i]);
    const auto by_quaternion = drivenFlight<Quaternion>(kIntegrators[i], duration, steps);
    const auto by_matrix = drivenFlight<Matrix3>(kIntegrators[i], duration, steps);
    const double error = std::max(distance(by_quaternion, exact), distance(by_matrix, exact));
    EXPECT_LT(distance(by_quaternion, by_matrix), error) << "integrator " << i;
    EXPECT_GT(distance(by_quaternion, by_matrix), 0.0) << "integrator " << i;
  }
}

// A state that moves only by its own new velocity: semi-implicit Euler takes x += h (v + h a),
// explicit Euler x += h v. a = 2 m/s², h = 0.5 s, v = 3 m/s.
TEST(Steppers, SemiImplicitEulerUsesTheNewVelocityAndEulerTheOldOne) {
  struct Falling {
    const Mobility& mobility;
    StateDerivative<Quaternion> derivative(const RigidBodyState<Quaternion>& state,
                                           Stage /*stage*/) const {
      return {mobility.velocity(state.momentum_W), Quaternion{0.0, Vector3::Zero()},
              Vector3(2.0, 0.0, 0.0), Vector3::Zero()};
    }
    Twist twist(const RigidBodyState<Quaternion>& state) const { return mobility.twist(state); }
  };
  const Mobility mobility = Mobility::spatial(1.0, Matrix3::Identity());
  const auto state =
      stateOf<Quaternion>(mobility, Matrix3::Identity(), {3.0, 0.0, 0.0}, Vector3::Zero());
  const auto next = [&](Integrator integrator) {
    return integrationStep(integrator, state, Falling{mobility}, 0.5);
  };
  EXPECT_EQ(next(Integrator::kEuler).p_WB.x(), 1.5);
  EXPECT_EQ(next(Integrator::kSemiImplicitEuler).p_WB.x(), 2.0);
  EXPECT_EQ(next(Integrator::kHeun).p_WB.x(), 1.75);
  EXPECT_EQ(next(Integrator::kHeun).momentum_W.x(), 4.0);
}

// The same of the turn: from rest by a torque of 2 N m about each axis in its turn, 1 kg m², h =
// 0.5 s. The new rate is w = h 2 = 1 rad/s; q + h/2 w q = (1, 0.25), and half of that for Heun's
// mean of the slopes at w = 0 and at w = 1.
TEST(Steppers, SemiImplicitEulerTurnsByTheNewRateAndEulerByTheOldOne) {
  struct Turning {
    const Mobility& mobility;
    Vector3 torque_W;
    StateDerivative<Quaternion> derivative(const RigidBodyState<Quaternion>& state,
                                           Stage /*stage*/) const {
      const Twist twist = mobility.twist(state);
      return {twist.v_WB, orientationRate(twist.w_WB, state.orientation), Vector3::Zero(),
              torque_W};
    }
    Twist twist(const RigidBodyState<Quaternion>& state) const { return mobility.twist(state); }
  };
  const Mobility mobility = Mobility::spatial(1.0, Matrix3::Identity());
  const auto state =
      stateOf<Quaternion>(mobility, Matrix3::Identity(), Vector3::Zero(), Vector3::Zero());
  for (int axis = 0; axis < 3; ++axis) {
    const auto ratio = [&](Integrator integrator) {
      const Turning turning{mobility, 2.0 * Vector3::Unit(axis)};
      const Quaternion q = integrationStep(integrator, state, turning, 0.5).orientation;
      EXPECT_EQ(q.v[(axis + 1) % 3], 0.0);
      EXPECT_EQ(q.v[(axis + 2) % 3], 0.0);
      return q.v[axis] / q.s;
    };
    EXPECT_EQ(ratio(Integrator::kEuler), 0.0);
    EXPECT_NEAR(ratio(Integrator::kSemiImplicitEuler), 0.25, 1e-15);
    EXPECT_NEAR(ratio(Integrator::kHeun), 0.125, 1e-15);
  }
}

TEST(Integrators, OfFirstOrderAreBothEulers) {
  EXPECT_TRUE(isEuler(Integrator::kEuler));
  EXPECT_TRUE(isEuler(Integrator::kSemiImplicitEuler));
  EXPECT_FALSE(isEuler(Integrator::kHeun));
  EXPECT_FALSE(isEuler(Integrator::kRungeKutta4));
  EXPECT_FALSE(isEuler(Integrator::kLie4));
}

}  // namespace
}  // namespace hovercraft
