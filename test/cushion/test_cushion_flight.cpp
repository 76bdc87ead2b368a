#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/rotation.h"

#include "flown_craft.h"

/// Craft that fly on their cushions, step by step, held against closed forms.

namespace hovercraft {
namespace {

using testing::allAt;
using testing::FlownCraft;
using testing::kGravity;
using testing::onePlenum;
using testing::rc5Body;
using testing::rc5Cushion;

using State = RigidBodyState<Quaternion>;

State flown(const FlownCraft& craft, State state, Integrator integrator, double h, int steps) {
  for (int i = 0; i < steps; ++i) state = integrationStep(integrator, state, craft, h);
  return state;
}

double hoverHeight(const FlownCraft& craft, const HoverBody& body) {
  return hoverOf(craft.cushion, body, craft.speeds).height;
}

/// Frequency and damping ratio of a decay, from its extremes: half a period apart, each by
/// exp(-pi zeta/sqrt(1 - zeta²)) smaller.
struct Decay {
  double frequency = 0.0;
  double damping_ratio = 0.0;
};

Decay decayOf(const std::vector<double>& samples, double h) {
  std::vector<double> times;
  std::vector<double> sizes;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    const double before = samples[i] - samples[i - 1];
    const double after = samples[i + 1] - samples[i];
    if (before * after >= 0.0) continue;
    const double share = before / (before - after);  // of the parabola through three samples
    times.push_back((static_cast<double>(i) - 0.5 + share) * h);
    sizes.push_back(std::abs(samples[i] + 0.5 * (share - 0.5) * (before + after)));
  }
  EXPECT_GE(times.size(), 7U);
  const double half_period = (times[6] - times[0]) / 6.0;
  const double decrement = std::log(sizes[0] / sizes[6]) / 6.0;
  const double pi = std::acos(-1.0);
  const double damped = pi / half_period;
  const double rate = decrement / half_period;
  const double omega = std::sqrt(damped * damped + rate * rate);
  return {omega, rate / omega};
}

/// The coordinate of a motion (heave, pitch, roll) while it decays from a small deviation.
std::vector<double> decayingSamples(const FlownCraft& craft, double height, std::size_t motion,
                                    double sign, double h) {
  Vector3 p_WB(0.0, 0.0, height);
  Vector3 rpy = Vector3::Zero();
  if (motion == 0) p_WB.z() += sign * 2e-5;
  if (motion == 1) rpy.y() = sign * 2e-4;
  if (motion == 2) rpy.x() = sign * 2e-4;
  State state = craft.mobility.stateOfMotion(p_WB, quaternionFromRpy(rpy), Twist());
  std::vector<double> samples;
  for (int n = 0; n < 2500; ++n) {
    const Vector3& v = state.orientation.v;
    const std::array<double, 3> coordinates = {state.p_WB.z() - height, v.y(), v.x()};
    samples.push_back(coordinates[motion]);
    state = integrationStep(Integrator::kRungeKutta4, state, craft, h);
  }
  return samples;
}

TEST(CushionFlight, HeavePitchAndRollDecayAsLinearisedInBothDirections) {
  const HoverBody body = rc5Body();
  const FlownCraft craft(rc5Cushion(), body);
  const Hover hover = hoverOf(craft.cushion, body, craft.speeds);
  const double h = 2e-4;
  for (const double sign : {1.0, -1.0}) {
    for (std::size_t i = 0; i < kHoverMotions; ++i) {
      const Decay decay = decayOf(decayingSamples(craft, hover.height, i, sign, h), h);
      SCOPED_TRACE(kHoverMotionNames[i]);
      const HoverMode& mode = hover.modes[i];
      EXPECT_NEAR(decay.frequency, mode.frequency(), 0.01 * mode.frequency());
      EXPECT_NEAR(decay.damping_ratio, mode.dampingRatio(), 0.01 * mode.dampingRatio());
    }
  }
}

TEST(CushionFlight, TenfoldGravityMakesHeaveFasterByItsRootAtTheSameGap) {
  HoverBody body = rc5Body();
  CushionParameters parameters = rc5Cushion();
  const Hover once = hoverOf(Cushion(parameters, Vector3::Zero()), body, allAt(1.0));
  body.gravity *= 10.0;
  parameters.fans[0].curve.shutoff *= 10.0;  // all pressures tenfold: flows by the root
  const Hover tenfold = hoverOf(Cushion(parameters, Vector3::Zero()), body, allAt(1.0));
  EXPECT_NEAR(tenfold.gap, once.gap, 1e-9);
  EXPECT_NEAR(tenfold.modes[0].frequency(), std::sqrt(10.0) * once.modes[0].frequency(), 1e-4);
}

TEST(CushionFlight, ComesToRestWhereThePressureCarriesItExactly) {
  const HoverBody body = rc5Body();
  const FlownCraft craft(rc5Cushion(), body);
  const State rest = flown(craft, craft.at(0.006), Integrator::kRungeKutta4, 1e-3, 10000);
  const Wrench wrench =
      craft.cushion.wrenchInBody(craft.motionOf(rest), craft.speeds, craft.ground);
  const double weight = body.mass * body.gravity;
  EXPECT_NEAR(wrench.force.z(), weight, 1e-12 * weight);
  EXPECT_NEAR(rest.p_WB.z(), hoverHeight(craft, body), 1e-14);
  EXPECT_EQ(squaredNorm(rest.angular_momentum_W), 0.0);  // no moment, ever
}

TEST(CushionFlight, EachStepperKeepsItsOrder) {
  const HoverBody body = rc5Body();
  FlownCraft craft(rc5Cushion(), body);
  craft.thrust_B = Vector3(1.0, 0.3, 0.0);
  // Clear of the kink of the hem: gaps stay above 2 mm, twenty times the residual gap.
  const State start = craft.mobility.stateOfMotion(
      Vector3(0.0, 0.0, 0.0036), quaternionFromRpy({0.001, -0.0015, 0.4}),
      {Vector3(0.4, -0.2, 0.02), Vector3(0.05, -0.03, 0.6)});
  const double duration = 0.1;
  const State exact = flown(craft, start, Integrator::kRungeKutta4, duration / 6400, 6400);
  const auto error_of = [&](Integrator integrator, int steps) {
    const State end = flown(craft, start, integrator, duration / steps, steps);
    return norm(end.p_WB - exact.p_WB) + norm(end.momentum_W - exact.momentum_W) +
           norm(end.angular_momentum_W - exact.angular_momentum_W);
  };
  const auto order_of = [&](Integrator integrator, int steps) {
    return std::log2(error_of(integrator, steps) / error_of(integrator, 2 * steps));
  };
  EXPECT_NEAR(order_of(Integrator::kEuler, 3200), 1.0, 0.1);
  EXPECT_NEAR(order_of(Integrator::kSemiImplicitEuler, 3200), 1.0, 0.1);
  EXPECT_NEAR(order_of(Integrator::kHeun, 400), 2.0, 0.1);
  EXPECT_NEAR(order_of(Integrator::kRungeKutta4, 100), 4.0, 0.15);
}

TEST(CushionFlight, EnergyChangesByTheCushionsWork) {
  // A drop through the kink of the skirt: d(kinetic + m g z) is the work of the wrench, by
  // Simpson's rule over pairs of steps.
  const HoverBody body = rc5Body();
  CushionParameters parameters = rc5Cushion();
  parameters.skirt.stiffness = 2000.0;
  parameters.skirt.spring = {0.5, 0.3, 0.02};
  const FlownCraft craft(parameters, body);
  State state =
      craft.mobility.stateOfMotion(Vector3(0.0, 0.0, 0.05), quaternionFromRpy({0.03, 0.05, 0.0}),
                                   {Vector3(0.5, 0.1, 0.0), Vector3(0.0, 0.1, 0.3)});
  const auto energy_of = [&](const State& at) {
    return kineticEnergy(at, craft.mobility) - dot(craft.weight_W, at.p_WB);
  };
  const auto power_of = [&](const State& at) {
    const BodyMotion motion = craft.motionOf(at);
    const Wrench wrench = craft.cushion.wrenchInBody(motion, craft.speeds, craft.ground);
    return dot(wrench.force, motion.v_WB_B) + dot(wrench.torque, motion.w_WB_B);
  };
  const double before = energy_of(state);
  double work = 0.0;
  double lowest = 1.0;
  const double h = 2e-5;
  for (int i = 0; i < 25000; ++i) {
    const State middle = integrationStep(Integrator::kRungeKutta4, state, craft, h);
    const State end = integrationStep(Integrator::kRungeKutta4, middle, craft, h);
    work += (2.0 * h / 6.0) * ((power_of(state) + power_of(end)) + 4.0 * power_of(middle));
    state = end;
    lowest = std::min(lowest, state.p_WB.z());
  }
  EXPECT_LT(work, -1.0);
  EXPECT_LT(lowest, 0.002);  // the hem was on the ground: it hung 9 mm below the centre
  EXPECT_NEAR(energy_of(state) - before, work, 1e-7 * before);
}

TEST(CushionFlight, StoppedFanLetsTheCraftDownOnItsSkirt) {
  const HoverBody body = rc5Body();
  CushionParameters parameters = rc5Cushion();
  parameters.skirt.stiffness = 8000.0;
  parameters.skirt.spring = {3.0, 0.3, 0.02};
  FlownCraft craft(parameters, body);
  craft.speeds = allAt(0.0);
  const State rest = flown(craft, craft.at(0.003), Integrator::kRungeKutta4, 1e-3, 5000);
  const double weight = body.mass * body.gravity;
  // l k_s c = m g, with c from (2): g = h - c = d²/(4 c) - c.
  const double compression = weight / (1.32 * 8000.0);
  EXPECT_NEAR(rest.p_WB.z(), 0.25e-8 / compression - compression, 1e-10);
  EXPECT_NEAR(norm(rest.momentum_W), 0.0, 1e-10);
  // And up again.
  craft.speeds = allAt(1.0);
  const State again = flown(craft, rest, Integrator::kRungeKutta4, 1e-3, 5000);
  EXPECT_NEAR(again.p_WB.z(), hoverHeight(craft, body), 1e-9);
}

TEST(CushionFlight, FanThatIsTooWeakNeverLifts) {
  const HoverBody body = rc5Body();
  CushionParameters parameters = rc5Cushion();
  parameters.skirt.stiffness = 8000.0;
  parameters.skirt.spring = {3.0, 0.3, 0.02};
  FlownCraft craft(parameters, body);
  // Full pressure carries 99 % of the weight, and then 101 %.
  const double lift_off = std::sqrt(body.mass * body.gravity / (935.264 * 0.108));
  craft.speeds = allAt(std::sqrt(0.99) * lift_off);
  const State weak = flown(craft, craft.at(-0.005), Integrator::kRungeKutta4, 1e-3, 10000);
  EXPECT_LT(weak.p_WB.z(), 0.1 * parameters.residual_gap);
  craft.speeds = allAt(std::sqrt(1.01) * lift_off);
  const State strong = flown(craft, craft.at(-0.005), Integrator::kRungeKutta4, 1e-3, 10000);
  EXPECT_GT(strong.p_WB.z(), 2.0 * parameters.residual_gap);
}

TEST(CushionFlight, SlidesDownASlopeAsOnRails) {
  // Parallel to the slope the cushion pushes along its normal: g sin(alpha) is left. No momentum
  // drag in air that comes along.
  const HoverBody body = rc5Body();
  FlownCraft craft(rc5Cushion(), body);
  const double alpha = 0.1;
  const Matrix3 slope = rotationFromRpy({0.0, alpha, 0.0});  // falls along x
  craft.ground = PlaneGround({slope.col(2), 0.0});
  HoverBody on_slope = body;
  on_slope.gravity *= std::cos(alpha);
  const double height = hoverOf(craft.cushion, on_slope, craft.speeds).height;
  const State start = craft.mobility.stateOfMotion(height * slope.col(2),
                                                   quaternionFromRpy({0.0, alpha, 0.0}), Twist());
  const auto rate = craft.derivative(start, Stage::kStart);
  const Vector3 expected = (body.mass * kGravity * std::sin(alpha)) * slope.col(0);
  EXPECT_NEAR(norm(rate.force_W - expected), 0.0, 1e-9 * norm(expected));
  EXPECT_NEAR(norm(rate.torque_W), 0.0, 1e-12);
  // The cushion does no work on it.
  const Wrench wrench =
      craft.cushion.wrenchInBody(craft.motionOf(start), craft.speeds, craft.ground);
  EXPECT_NEAR(dot(times(slope, wrench.force), slope.col(0)), 0.0, 1e-12);
}

TEST(CushionFlight, MomentumDragAloneEndsAtThrustOverMassFlow) {
  const HoverBody body = rc5Body();
  FlownCraft craft(onePlenum(), body);
  const Hover hover = hoverOf(craft.cushion, body, craft.speeds);
  const double mass_flow = 1.225 * hover.flow;
  craft.thrust_B = Vector3(0.16, 0.0, 0.0);
  craft.wind_W = Vector3(1.0, 0.0, 0.0);
  const double h = 1e-3;
  const int steps = 20000;
  const State state = flown(craft, craft.at(hover.height), Integrator::kRungeKutta4, h, steps);
  // v = w + T/m_dot (1 - exp(-m_dot t/m)) - w exp(-m_dot t/m). (25)
  const double left = std::exp(-mass_flow * steps * h / body.mass);
  const double expected = 1.0 + 0.16 / mass_flow * (1.0 - left) - left;
  EXPECT_NEAR(state.momentum_W.x() / body.mass, expected, 1e-8);
}

TEST(CushionFlight, SkidEndsAfterTheDistanceOfSmoothFriction) {
  // (17): [v0 sqrt(v0² + vs²) + vs² asinh(v0/vs)]/(2 mu g), on the skirt with the fan at rest.
  const HoverBody body = rc5Body();
  CushionParameters parameters = rc5Cushion();
  parameters.skirt.stiffness = 8000.0;
  parameters.skirt.spring = {3.0, 0.3, 0.02};
  // Masses and hem in one plane: friction does not pitch the craft.
  FlownCraft craft(parameters, body);
  craft.speeds = allAt(0.0);
  const State rest = flown(craft, craft.at(0.0), Integrator::kRungeKutta4, 1e-3, 5000);
  State sliding = rest;
  sliding.momentum_W.x() = body.mass * 1.5;
  const State end = flown(craft, sliding, Integrator::kRungeKutta4, 5e-4, 8000);
  const double v = 1.5;
  const double vs = 0.02;
  const double distance =
      (v * std::sqrt(v * v + vs * vs) + vs * vs * std::asinh(v / vs)) / (2.0 * 0.3 * kGravity);
  EXPECT_NEAR(end.p_WB.x(), distance, 0.01 * distance);
}

}  // namespace
}  // namespace hovercraft
