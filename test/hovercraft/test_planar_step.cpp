#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "hovercraft_sim/hovercraft/planar_step.h"

#include "../support/same_bits.h"

namespace hovercraft {
namespace {

using State = RigidBodyState<Quaternion>;

constexpr std::array<Integrator, 4> kEachMethod = {Integrator::kEuler,
                                                   Integrator::kSemiImplicitEuler,
                                                   Integrator::kHeun, Integrator::kRungeKutta4};

/// Craft and flights of any kind.
class Random {
 public:
  double within(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits_() >> 11U) * 0x1p-53);
  }
  bool once(int in) { return bits_() % static_cast<std::uint64_t>(in) == 0; }
  Vector3 vector(double largest) {
    return {within(-largest, largest), within(-largest, largest), within(-largest, largest)};
  }
  Vector3 positive(double largest) {
    return {within(0, largest), within(0, largest), within(0, largest)};
  }

  HovercraftModel model() {
    std::array<EngineParameters, kEngineCount> engines;
    for (EngineParameters& engine : engines) {
      engine.p_HE = vector(0.5);
      engine.direction = once(3) ? Vector3(1.0, 0.0, 0.0) : Vector3(vector(1.0).normalized());
    }
    Matrix3 inertia = Matrix3::Identity();
    inertia(0, 1) = inertia(1, 0) = within(-0.2, 0.2);
    inertia(0, 2) = inertia(2, 0) = within(-0.2, 0.2);
    HovercraftModel model = {Mobility::planar(within(0.5, 20.0), within(0.01, 2.0) * inertia),
                             EngineGeometry(engines, vector(0.1)),
                             {positive(2.0), positive(2.0), positive(0.3), positive(0.3)}};
    if (once(2)) model.drag = Drag();
    if (once(2)) model.weight_W = vector(40.0);
    return model;
  }
  State state(const HovercraftModel& model) {
    const double yaw = within(-3.2, 3.2);
    const Quaternion q = quaternionFromRpy({0.0, 0.0, once(4) ? 0.0 : yaw});
    Twist twist;
    if (!once(4)) twist = {vector(5.0), vector(3.0)};
    // Half of them without what the model does not have, of which -0 can stay.
    if (once(2)) twist.v_WB.z() = twist.w_WB.x() = twist.w_WB.y() = 0.0;
    return model.mobility.stateOfMotion(once(4) ? Vector3(Vector3::Zero()) : vector(100.0), q,
                                        twist);
  }
  ThrustCourse thrusts() {
    if (once(4)) return {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    const Vector3 from = vector(10.0);
    const Vector3 to = once(2) ? from : vector(10.0);
    const Vector3 middle = 0.5 * (from + to);
    return {from, middle, to};
  }

 private:
  std::mt19937_64 bits_{20261128};
};

testing::Bits bitsOf(const State& state) {
  StateHash hash;
  hash.add(BodyState(state));
  return hash.value();
}

/// A step with all of its arithmetic.
State fullStep(Integrator integrator, const State& y, const DrivenBody& system, double h) {
  return integrationStep<Quaternion, DrivenBody>(integrator, y, system, h);
}

/// A flight of 1,000 steps, the planar step against all components. @returns how often it was made.
int comparedSteps(Random& random, Integrator integrator) {
  const HovercraftModel model = random.model();
  const auto craft = PlanarCraft::of(model);
  if (!craft) return 0;
  State y = random.state(model);
  const Environment air = {random.once(3) ? Vector3(Vector3::Zero()) : random.vector(6.0)};
  const double h = random.within(1e-4, 0.02);
  ThrustCourse thrusts = random.thrusts();
  int taken = 0;
  for (int i = 0; i < 1000; ++i) {
    if (random.once(100)) thrusts = random.thrusts();
    DrivenBody system = {model, thrusts, air};
    system.is_steady = thrusts.start == thrusts.end;
    const State expected = fullStep(integrator, y, system, h);
    if (craft->takes(y, system)) {
      State found;
      craft->step(integrator, y, system, h, found);
      EXPECT_EQ(bitsOf(found), bitsOf(expected)) << "step " << i;
      ++taken;
    }
    y = expected;
  }
  return taken;
}

// 100,000 steps: 25 flights with each integrator.
TEST(PlanarCraft, StepsHaveTheBitsOfAllSixDegreesOfFreedom) {
  Random random;
  int taken = 0;
  for (int flight = 0; flight < 25 && !HasFailure(); ++flight) {
    for (const Integrator integrator : kEachMethod) taken += comparedSteps(random, integrator);
  }
  EXPECT_GT(taken, 80000);
}

// Each component as -0, each that is held as +0 turned or moved, a load: left to the full step.
TEST(PlanarCraft, LeavesOtherStatesToTheFullStep) {
  Random random;
  const HovercraftModel model = random.model();
  const auto craft = PlanarCraft::of(model);
  ASSERT_TRUE(craft.has_value());
  const Environment air;
  const ThrustCourse thrusts = {{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}};
  const State level;
  const ExternalLoad load;
  EXPECT_TRUE(craft->takes(level, {model, thrusts, air}));
  EXPECT_FALSE(craft->takes(level, {model, thrusts, air, &load}));
  const auto takes_with = [&](int component, double value) {
    State y = level;
    double* const components[] = {&y.p_WB.x(),
                                  &y.p_WB.y(),
                                  &y.orientation.s,
                                  &y.orientation.v.z(),
                                  &y.momentum_W.x(),
                                  &y.momentum_W.y(),
                                  &y.angular_momentum_W.z(),
                                  &y.orientation.v.x(),
                                  &y.orientation.v.y(),
                                  &y.momentum_W.z(),
                                  &y.angular_momentum_W.x(),
                                  &y.angular_momentum_W.y()};
    *components[component] = value;
    return craft->takes(y, {model, thrusts, air});
  };
  for (int component = 0; component < 12; ++component) {
    EXPECT_FALSE(takes_with(component, -0.0)) << component;
    EXPECT_EQ(takes_with(component, 1e-300), component < 7) << component;
  }
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double thrust : {1e101, -1e101, infinity, std::nan("")}) {
    const ThrustCourse huge = {{1.0, thrust, 3.0}, {1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}};
    const ThrustCourse later = {{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, {1.0, thrust, 3.0}};
    EXPECT_FALSE(craft->takes(level, {model, huge, air})) << thrust;
    EXPECT_FALSE(craft->takes(level, {model, later, air})) << thrust;
  }
  EXPECT_FALSE(craft->takes(level, {model, thrusts, {{0.0, 0.0, 1e101}}}));
}

TEST(PlanarCraft, IsNoneWhereMoreActsOrNumbersAreHuge) {
  Random random;
  const HovercraftModel model = random.model();
  HovercraftModel other = model;
  other.mobility = Mobility::spatial(1.0, Matrix3::Identity());
  EXPECT_FALSE(PlanarCraft::of(other).has_value());
  other = model;
  other.forces.emplace_back(FanForce());
  EXPECT_FALSE(PlanarCraft::of(other).has_value());
  other = model;
  other.weight_W.z() = -1e101;
  EXPECT_FALSE(PlanarCraft::of(other).has_value());
  std::array<EngineParameters, kEngineCount> engines;
  engines[1].p_HE.z() = 1e101;  // a moment about y of 1e101 N m for 1 N
  other = model;
  other.engines = EngineGeometry(engines, Vector3::Zero());
  EXPECT_FALSE(PlanarCraft::of(other).has_value());
  for (Vector3 Drag::*law :
       {&Drag::linear, &Drag::quadratic, &Drag::angular_linear, &Drag::angular_quadratic}) {
    other = model;
    (other.drag.*law).y() = 1e101;
    EXPECT_FALSE(PlanarCraft::of(other).has_value());
  }
}

// The height that a planar craft keeps: a velocity of +0 makes +0 of it.
TEST(PlanarCraft, AHeightOfMinusZeroBecomesZeroAsInTheFullStep) {
  Random random;
  const HovercraftModel model = random.model();
  const auto craft = PlanarCraft::of(model);
  ASSERT_TRUE(craft.has_value());
  const ThrustCourse thrusts = {{1.0, -2.0, 3.0}, {1.0, -2.0, 3.0}, {1.0, -2.0, 3.0}};
  const Environment air;
  State y;
  y.p_WB.z() = -0.0;
  const DrivenBody system = {model, thrusts, air};
  ASSERT_TRUE(craft->takes(y, system));
  State found;
  craft->step(Integrator::kHeun, y, system, 1e-3, found);
  EXPECT_EQ(bitsOf(found), bitsOf(fullStep(Integrator::kHeun, y, system, 1e-3)));
  EXPECT_FALSE(std::signbit(found.p_WB.z()));
}

}  // namespace
}  // namespace hovercraft
