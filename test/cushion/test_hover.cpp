#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "hovercraft_sim/cushion/gap.h"

#include "flown_craft.h"

namespace hovercraft {
namespace {

using testing::allAt;
using testing::kGravity;
using testing::onePlenum;
using testing::rc5Body;
using testing::rc5Cushion;

const HoverMode& modeOf(const Hover& hover, HoverMotion motion) {
  return hover.modes[static_cast<std::size_t>(motion)];
}

/// G and K of one of n equal cells that carry a craft, by (9), from the equilibrium in closed form.
struct ClosedForm {
  double pressure, flow, open_gap, G, K;

  /// @param length of the hem of a cell, m.
  ClosedForm(const HoverBody& body, const CushionParameters& parameters, double length) {
    const double S = parameters.cells[0].area;
    const FanCurve& fan = parameters.fans[0].curve;
    pressure = body.mass * body.gravity / (S * static_cast<double>(parameters.cells.size()));
    flow = std::sqrt((fan.shutoff - pressure) / fan.curve);
    const double A = flow / (parameters.discharge * std::sqrt(2.0 * pressure / 1.225));
    const double under_hem = A / std::sqrt(1.0 - (A / S) * (A / S));
    open_gap = under_hem / length;
    const double d = parameters.residual_gap;
    const double gap = open_gap - 0.25 * d * d / open_gap;
    G = flow / (2.0 * (fan.shutoff - pressure)) + flow / (2.0 * pressure);
    K = flow / A * leakAreaSlope(under_hem, S) * length * openGapSlope(gap, d);
  }
};

TEST(Hover, Rc5StandsOnThePressureThatCarriesIt) {
  const Cushion cushion(rc5Cushion(), Vector3::Zero());
  const Hover hover = hoverOf(cushion, rc5Body(), allAt(1.0));
  ASSERT_EQ(hover.status, HoverStatus::kHovers);
  const double weight = 5.15 * kGravity;
  EXPECT_NEAR(hover.pressure * 0.108, weight, 1e-12 * weight);
  EXPECT_NEAR(hover.gap, 3.0e-3, 1e-6);
  EXPECT_NEAR(hover.flow, 0.0656, 1e-4);
  EXPECT_NEAR(hover.power, 30.7, 0.05);
  EXPECT_EQ(hover.roll, 0.0);
  EXPECT_EQ(hover.pitch, 0.0);
  EXPECT_NEAR(hover.lift_off_speed, std::sqrt(weight / (935.264 * 0.108)), 1e-15);
}

TEST(Hover, FourCellsSwingAsTheLinearisationSays) {
  // (13b) and (10), with arms of the cells 0.09, 0.075 m and of the leaks 0.13091, 0.11591 m.
  const CushionParameters parameters = rc5Cushion();
  const HoverBody body = rc5Body();
  const ClosedForm cell(body, parameters, 0.33);
  const double S = 0.027;
  const Hover hover = hoverOf(Cushion(parameters, Vector3::Zero()), body, allAt(1.0));
  // What the fans take in damps heave too: its intake lies at the centre of mass. (24)
  const double mass_flow = 4.0 * 1.225 * cell.flow;
  const auto check = [&](HoverMotion motion, double inertia, double arm, double leak_arm) {
    const double omega = std::sqrt(4.0 * S * arm * cell.K * leak_arm / (cell.G * inertia));
    const double damping =
        4.0 * (S * arm) * (S * arm) / cell.G + (motion == HoverMotion::kHeave ? mass_flow : 0.0);
    const double zeta = damping / (inertia * 2.0 * omega);
    EXPECT_NEAR(modeOf(hover, motion).frequency(), omega, 1e-6 * omega);
    EXPECT_NEAR(modeOf(hover, motion).dampingRatio(), zeta, 1e-6 * zeta);
  };
  check(HoverMotion::kHeave, 5.15, 1.0, 1.0);
  check(HoverMotion::kPitch, 0.04, 0.09, (0.15 * 0.18 + 0.18 * 0.09) / 0.33);
  check(HoverMotion::kRoll, 0.03, 0.075, (0.15 * 0.075 + 0.18 * 0.15) / 0.33);
  EXPECT_NEAR(modeOf(hover, HoverMotion::kPitch).frequency(), 70.35, 1e-4 * 70.35);
  EXPECT_NEAR(modeOf(hover, HoverMotion::kPitch).dampingRatio(), 0.120, 5e-4);
  EXPECT_NEAR(modeOf(hover, HoverMotion::kRoll).frequency(), 69.8, 0.05);
  EXPECT_NEAR(modeOf(hover, HoverMotion::kRoll).dampingRatio(), 0.112, 5e-4);
  EXPECT_NEAR(modeOf(hover, HoverMotion::kHeave).frequency(), 57.3, 0.01 * 57.3);
  EXPECT_NEAR(modeOf(hover, HoverMotion::kHeave).dampingRatio(), 0.142, 0.01 * 0.142);
}

TEST(Hover, MarginIsThatOfTheCubicOfCompressibleAir) {
  // C m s³ + m G s² + S² s + S K = 0 swings by itself if M = G S/(C K) < 1. (12)
  const Hover rc5 = hoverOf(Cushion(rc5Cushion(), Vector3::Zero()), rc5Body(), allAt(1.0));
  EXPECT_NEAR(modeOf(rc5, HoverMotion::kHeave).margin, 18.2, 0.01 * 18.2);
  // Of pitch it is smaller by x_c/x_l.
  EXPECT_NEAR(modeOf(rc5, HoverMotion::kPitch).margin / modeOf(rc5, HoverMotion::kHeave).margin,
              0.09 / 0.130909, 1e-3);
  // The plenum of 8 t: 20 m² at 3,923 Pa, H 1.2 m, over 50 and 20 mm; stable and not. Its fan is
  // chosen so that phi = 1 there.
  for (const auto& [gap, margin] : {std::pair(0.050, 1.57), std::pair(0.020, 0.63)}) {
    CushionParameters parameters;
    CushionCell cell;
    cell.area = 20.0;
    cell.height = 1.2;
    cell.hem = {{Vector3::Zero(), 18.0}};
    parameters.cells = {cell};
    const double pressure = 8000.0 * kGravity / 20.0;
    const double flow = 0.6 * leakArea(18.0 * gap, 20.0) * std::sqrt(2.0 * pressure / 1.225);
    parameters.fans = {{"lift", {2.0 * pressure, 0.0, pressure / (flow * flow)}}};
    const Hover hover = hoverOf(Cushion(parameters, Vector3::Zero()),
                                {8000.0, Matrix3::Identity(), kGravity}, allAt(1.0));
    ASSERT_EQ(hover.status, HoverStatus::kHovers);
    EXPECT_NEAR(hover.gap, gap, 1e-6);
    EXPECT_NEAR(modeOf(hover, HoverMotion::kHeave).margin, margin, 0.02 * margin);
  }
}

TEST(Hover, OnePlenumIsNotHeldInPitchAndRollByItsPressure) {
  const Hover hover = hoverOf(Cushion(onePlenum(), Vector3::Zero()), rc5Body(), allAt(1.0));
  ASSERT_EQ(hover.status, HoverStatus::kHovers);
  EXPECT_NEAR(modeOf(hover, HoverMotion::kHeave).frequency(), 57.3, 0.01 * 57.3);
  EXPECT_NEAR(modeOf(hover, HoverMotion::kPitch).stiffness, 0.0, 1e-9);
  EXPECT_EQ(modeOf(hover, HoverMotion::kPitch).frequency(), 0.0);
}

TEST(Hover, FanThatIsTooWeakDoesNotLiftAndOneWithoutEndDoesNotLetDown) {
  const Cushion cushion(rc5Cushion(), Vector3::Zero());
  HoverBody body = rc5Body();
  EXPECT_EQ(hoverOf(cushion, body, allAt(0.70)).status, HoverStatus::kTooHeavy);
  EXPECT_EQ(hoverOf(cushion, body, allAt(0.71)).status, HoverStatus::kHovers);
  body.mass = 0.001;
  EXPECT_EQ(hoverOf(cushion, body, allAt(1.0)).status, HoverStatus::kTooLight);
}

TEST(Hover, CraftWithItsCentreOfMassAheadHoversBowDown) {
  // The centre of pressure must come under the centre of mass: the bow's cells carry more.
  const Vector3 p_HB(0.004, 0.0, 0.0);
  const Cushion cushion(rc5Cushion(), p_HB);
  const Hover hover = hoverOf(cushion, rc5Body(), allAt(1.0));
  ASSERT_EQ(hover.status, HoverStatus::kHovers);
  EXPECT_GT(hover.pitch, 1e-4);  // about y: bow down
  EXPECT_NEAR(hover.roll, 0.0, 1e-12);
  double moment = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    moment += (rc5Cushion().cells[i].p_HC.x() - p_HB.x()) * hover.cells[i].force;
  }
  EXPECT_NEAR(moment, 0.0, 1e-9);
  EXPECT_EQ(hoverOf(Cushion(rc5Cushion(), Vector3(0.12, 0.0, 0.0)), rc5Body(), allAt(1.0)).status,
            HoverStatus::kNotLevel);
}

TEST(LongestStableStep, IsWhereTheAmplificationOfEachIntegratorReachesOne) {
  const HoverMode mode = {2.0, 2.0 * 2.0 * 0.12 * 70.0, 2.0 * 70.0 * 70.0, 10.0};
  EXPECT_NEAR(mode.frequency(), 70.0, 1e-12);
  EXPECT_NEAR(mode.dampingRatio(), 0.12, 1e-15);
  EXPECT_NEAR(longestStableStep(Integrator::kEuler, mode), 2.0 * 0.12 / 70.0, 1e-12);
  EXPECT_NEAR(longestStableStep(Integrator::kSemiImplicitEuler, mode),
              2.0 / 70.0 * (std::sqrt(1.0 + 0.12 * 0.12) - 0.12), 1e-14);
  // Real roots: 2, 2 and 2.785 over the fastest.
  const HoverMode slow = {1.0, 100.0, 0.0, 0.0};
  EXPECT_NEAR(longestStableStep(Integrator::kEuler, slow), 0.02, 1e-12);
  EXPECT_NEAR(longestStableStep(Integrator::kHeun, slow), 0.02, 1e-12);
  EXPECT_NEAR(longestStableStep(Integrator::kRungeKutta4, slow), 0.027852935634, 1e-13);
  // Without damping RK4 reaches 2 sqrt 2, and Euler and Heun never decay.
  const HoverMode undamped = {1.0, 0.0, 100.0, 0.0};
  EXPECT_EQ(longestStableStep(Integrator::kEuler, undamped), 0.0);
  EXPECT_EQ(longestStableStep(Integrator::kHeun, undamped), 0.0);
  EXPECT_NEAR(longestStableStep(Integrator::kSemiImplicitEuler, undamped), 0.2, 1e-12);
  EXPECT_NEAR(longestStableStep(Integrator::kRungeKutta4, undamped), 0.28284271, 1e-8);
  EXPECT_EQ(longestStableStep(Integrator::kHeun, {1.0, 0.0, 0.0, 0.0}),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(longestStableStep(Integrator::kHeun, {1.0, 1.0, -1.0, 0.0}), 0.0);
}

TEST(LongestStableStep, IsFlown) {
  // A linear oscillator by the steppers themselves, a little below and above.
  struct Oscillator {
    Mobility mobility = Mobility::spatial(1.0, Matrix3::Identity());
    StateDerivative<Quaternion> derivative(const RigidBodyState<Quaternion>& state,
                                           Stage /*stage*/) const {
      const Vector3 v = mobility.velocity(state.momentum_W);
      return {v, Quaternion{0.0, Vector3::Zero()}, -25.0 * state.p_WB - 0.8 * v, Vector3::Zero()};
    }
    Twist twist(const RigidBodyState<Quaternion>& state) const { return mobility.twist(state); }
  };
  const HoverMode mode = {1.0, 0.8, 25.0, 0.0};
  for (const Integrator integrator : {Integrator::kEuler, Integrator::kSemiImplicitEuler,
                                      Integrator::kHeun, Integrator::kRungeKutta4}) {
    for (const double share : {0.98, 1.02}) {
      const double h = share * longestStableStep(integrator, mode);
      RigidBodyState<Quaternion> state;
      state.p_WB = Vector3(1.0, 0.0, 0.0);
      for (int i = 0; i < 20000; ++i) state = integrationStep(integrator, state, Oscillator(), h);
      const double size = norm(state.p_WB) + norm(state.momentum_W);
      EXPECT_EQ(size < 1.0, share < 1.0) << static_cast<int>(integrator) << ", " << size;
    }
  }
}

}  // namespace
}  // namespace hovercraft
