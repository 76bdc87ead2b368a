#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/pilot/pilot.h"
#include "hovercraft_sim/pilot/turning.h"

namespace hovercraft {
namespace {

constexpr double kDegree = kPi / 180.0;
constexpr double kPeriod = 0.001;  // s: fine, so that closed forms are met closely

/// A craft of one throttle and one rudder: Nomoto's law of first order, T dr/dt + r = -K δ (δ to
/// starboard, r to port), steady speed ahead; each decision's rudder angle in deg is exact.
class Nomoto {
 public:
  double gain = 0.8;  // 1/s
  double lag = 0.5;   // s
  double speed = 2.0;
  double thrust_gain = 0.0;  // (m/s)/level: with it the speed follows channel 0 by speed_lag
  double speed_lag = 1.0;    // s
  PlanarMotion motion;

  void step(const Levels& levels) {
    const double steady = -gain * levels[1] * kDegree;
    const double decay = std::exp(-kPeriod / lag);
    const double turn = steady * kPeriod + (motion.yaw_rate - steady) * lag * (1.0 - decay);
    const double middle = motion.heading + 0.5 * turn;
    motion.surge = thrust_gain == 0.0
                       ? speed
                       : thrust_gain * levels[0] + (motion.surge - thrust_gain * levels[0]) *
                                                       std::exp(-kPeriod / speed_lag);
    motion.x += motion.surge * kPeriod * std::cos(middle);
    motion.y += motion.surge * kPeriod * std::sin(middle);
    motion.heading += turn;
    motion.yaw_rate = steady + (motion.yaw_rate - steady) * decay;
    ++steps_;
    motion.time = kPeriod * steps_;
  }

 private:
  int steps_ = 0;
};

PilotPlan planOf(const Manoeuvre& manoeuvre) {
  PilotPlan plan;
  plan.period = kPeriod;
  plan.helm = {35.0, {0.0, -35.0}, {0.0, 35.0}};
  plan.manoeuvres = {manoeuvre};
  return plan;
}

template <class Task>
Manoeuvre manoeuvreOf(const Task& task) {
  Manoeuvre manoeuvre;
  manoeuvre.name = "it";
  manoeuvre.throttle = {1.0, 0.0};
  manoeuvre.longest = 100.0;
  manoeuvre.task = task;
  return manoeuvre;
}

FlownManoeuvre fly(const Manoeuvre& manoeuvre, Nomoto craft) {
  Pilot pilot(planOf(manoeuvre));
  craft.motion.surge = craft.speed;
  for (int i = 0; i < 200000; ++i) {
    const Levels& levels = pilot.decide(craft.motion);
    if (levels.empty()) break;
    craft.step(levels);
  }
  EXPECT_TRUE(pilot.isDone());
  return pilot.flown().at(0);
}

double measure(const FlownManoeuvre& flown, const std::string& name) {
  for (const Measure& measure : flown.measures) {
    if (measure.name == name) return measure.value;
  }
  ADD_FAILURE() << "no measure " << name << " in\n" << toText(flown);
  return 0.0;
}

bool has(const FlownManoeuvre& flown, const std::string& name) {
  return std::any_of(flown.measures.begin(), flown.measures.end(),
                     [&](const Measure& measure) { return measure.name == name; });
}

/// When a craft of Nomoto's, at rest, has turned by an angle with the rudder hard over: bisection
/// of K δ (t - T (1 - e^(-t/T))).
double timeToTurn(const Nomoto& craft, double helm_deg, double angle) {
  double low = 0.0;
  double high = 100.0;
  for (int i = 0; i < 100; ++i) {
    const double t = 0.5 * (low + high);
    const double turned_by =
        craft.gain * helm_deg * kDegree * (t - craft.lag * (1.0 - std::exp(-t / craft.lag)));
    (turned_by < angle ? low : high) = t;
  }
  return low;
}

class ZigZags : public ::testing::TestWithParam<double> {};

TEST_P(ZigZags, OfNomotosLawHasItsClosedForm) {
  // From the second execute on, r(t) = -R + (r2 + R) e^(-t/T) with R = K δ and r2 the rate then: 0
  // at t = T ln((r2 + R)/R), where the heading has gone on by T r2 - R t.
  const double angle = GetParam();
  const Nomoto craft;
  const FlownManoeuvre flown = fly(manoeuvreOf(ZigZag{angle, angle, 5, Side::kStarboard}), craft);
  ASSERT_TRUE(flown.is_complete) << flown.reason;
  const double R = craft.gain * angle * kDegree;
  const double initial = timeToTurn(craft, angle, angle * kDegree);
  const double r2 = R * (1.0 - std::exp(-initial / craft.lag));
  const double check = craft.lag * std::log((r2 + R) / R);
  EXPECT_NEAR(measure(flown, "initial turning time"), initial, 2.0 * kPeriod);
  EXPECT_NEAR(measure(flown, "first overshoot angle"), (craft.lag * r2 - R * check) / kDegree,
              0.02);
  EXPECT_NEAR(measure(flown, "first time to check yaw"), check, 2.0 * kPeriod);
  // All that follow are alike but the first: each begins at the same rate, nearly.
  EXPECT_NEAR(measure(flown, "third overshoot angle"), measure(flown, "second overshoot angle"),
              0.3);
  EXPECT_GT(measure(flown, "period"), 2.0 * measure(flown, "reach") * 0.8);
  EXPECT_GT(measure(flown, "time of a complete cycle"), measure(flown, "reach"));
  EXPECT_TRUE(has(flown, "fourth overshoot angle"));
  EXPECT_FALSE(has(flown, "fifth overshoot angle"));
}

INSTANTIATE_TEST_SUITE_P(Angles, ZigZags, ::testing::Values(10.0, 20.0));

TEST(Pilot, AZigZagToPortIsTheMirrorOfOneToStarboard) {
  const FlownManoeuvre starboard =
      fly(manoeuvreOf(ZigZag{10.0, 10.0, 5, Side::kStarboard}), Nomoto());
  const FlownManoeuvre port = fly(manoeuvreOf(ZigZag{10.0, 10.0, 5, Side::kPort}), Nomoto());
  ASSERT_EQ(starboard.measures.size(), port.measures.size());
  for (std::size_t i = 0; i < port.measures.size(); ++i) {
    EXPECT_NEAR(starboard.measures[i].value, port.measures[i].value, 1e-9) << port.measures[i].name;
  }
}

TEST(Pilot, ReachAndPeriodOfAZigZagWithoutLagAreThoseOfStraightLines) {
  // Without lag the heading goes at ±R: to ψ after ψ/R, back at 0 after 2 ψ/R, at -ψ after 3 ψ/R,
  // at 0 after 4 ψ/R: and so on. Up to a decision late at each execute.
  Nomoto craft;
  craft.lag = 1e-6;
  const FlownManoeuvre flown = fly(manoeuvreOf(ZigZag{20.0, 10.0, 5, Side::kPort}), craft);
  const double quarter = 10.0 / (craft.gain * 20.0);
  EXPECT_NEAR(measure(flown, "initial turning time"), quarter, 1.5 * kPeriod);
  EXPECT_NEAR(measure(flown, "reach"), 2.0 * quarter, 3.0 * kPeriod);
  EXPECT_NEAR(measure(flown, "time of a complete cycle"), 4.0 * quarter, 6.0 * kPeriod);
  EXPECT_NEAR(measure(flown, "period"), 4.0 * quarter, 6.0 * kPeriod);
  EXPECT_NEAR(measure(flown, "first overshoot angle"), 0.0, 0.05);
}

TEST(Pilot, ATurningCircleWithoutLagIsACircle) {
  // Of radius V/R: advance and transfer at a quarter turn are the radius, the tactical diameter is
  // twice it.
  for (const Side side : {Side::kStarboard, Side::kPort}) {
    Nomoto craft;
    craft.lag = 1e-6;
    craft.motion.heading = 1.1;
    craft.motion.x = 5.0;
    const FlownManoeuvre flown = fly(manoeuvreOf(TurningCircle{35.0, 540.0, side}), craft);
    const double rate = craft.gain * 35.0 * kDegree;
    const double radius = craft.speed / rate;
    EXPECT_TRUE(flown.is_complete);
    EXPECT_NEAR(measure(flown, "advance"), radius, 0.003);
    EXPECT_NEAR(measure(flown, "transfer"), radius, 0.003);
    EXPECT_NEAR(measure(flown, "tactical diameter"), 2.0 * radius, 0.003);
    EXPECT_NEAR(measure(flown, "steady turning radius"), radius, 0.003);
    EXPECT_NEAR(measure(flown, "steady yaw rate"), rate / kDegree, 0.1);
    EXPECT_NEAR(measure(flown, "steady drift angle"), 0.0, 1e-9);
    EXPECT_NEAR(measure(flown, "time to turn 90 deg"), 0.5 * kPi / rate, kPeriod);
    EXPECT_NEAR(measure(flown, "time to turn 360 deg"), 2.0 * kPi / rate, kPeriod);
    EXPECT_NEAR(flown.end - flown.execute, 3.0 * kPi / rate, 2.0 * kPeriod);
  }
}

TEST(Pilot, ATurningCircleOfHalfATurnHasNoSteadyTurn) {
  const FlownManoeuvre flown = fly(manoeuvreOf(TurningCircle{35.0, 180.0, Side::kPort}), Nomoto());
  EXPECT_TRUE(has(flown, "tactical diameter"));
  EXPECT_FALSE(has(flown, "steady turning radius"));
}

TEST(Pilot, AFigureOfEightTurnsRoundToEitherSideAndComesBack) {
  Nomoto craft;
  craft.lag = 1e-6;
  const FlownManoeuvre flown = fly(manoeuvreOf(FigureOfEight{35.0, Side::kStarboard}), craft);
  const double round = 2.0 * kPi / (craft.gain * 35.0 * kDegree);
  EXPECT_TRUE(flown.is_complete);
  EXPECT_NEAR(measure(flown, "time of the first circle"), round, 2.0 * kPeriod);
  EXPECT_NEAR(measure(flown, "time of the second circle"), round, 2.0 * kPeriod);
  EXPECT_NEAR(measure(flown, "distance from where it began"), 0.0, 0.02);
  EXPECT_NEAR(measure(flown, "first circle: steady turning radius"),
              measure(flown, "second circle: steady turning radius"), 0.003);
}

TEST(Pilot, AStopOfLinearDragHasItsClosedForm) {
  // v = v0 e^(-t/T): T (v0 - v1) far, after T ln(v0/v1).
  Nomoto craft;
  craft.thrust_gain = 1.0;
  craft.speed_lag = 1.5;
  Manoeuvre stop = manoeuvreOf(Stop{{0.0, 0.0}, 0.1});
  const FlownManoeuvre flown = fly(stop, craft);
  EXPECT_TRUE(flown.is_complete);
  EXPECT_NEAR(measure(flown, "approach speed"), 2.0, 1e-12);
  EXPECT_NEAR(measure(flown, "time to stop"), 1.5 * std::log(2.0 / 0.1), 2.0 * kPeriod);
  EXPECT_NEAR(measure(flown, "head reach"), 1.5 * (2.0 - 0.1), 0.003);
  EXPECT_NEAR(measure(flown, "track reach"), 1.5 * (2.0 - 0.1), 0.003);
  EXPECT_NEAR(measure(flown, "lateral deviation to starboard"), 0.0, 1e-12);
}

TEST(Pilot, AStopOfACraftThatStandsIsNotComplete) {
  Nomoto craft;
  craft.speed = 0.0;
  const FlownManoeuvre flown = fly(manoeuvreOf(Stop{{0.0, 0.0}, 0.0}), craft);
  EXPECT_FALSE(flown.is_complete);
  EXPECT_NE(flown.reason.find("end_speed"), std::string::npos);
  EXPECT_TRUE(has(flown, "approach speed"));
  EXPECT_FALSE(has(flown, "head reach"));
  EXPECT_FALSE(has(flown, "time to stop"));
}

TEST(Pilot, AStopThatNeverStopsHasNoReach) {
  Nomoto craft;
  craft.thrust_gain = 1.0;
  Manoeuvre stop = manoeuvreOf(Stop{{0.0, 0.0}, 0.0});  // drag alone never stops it
  stop.longest = 3.0;
  const FlownManoeuvre flown = fly(stop, craft);
  EXPECT_FALSE(flown.is_complete);
  EXPECT_EQ(flown.measures.size(), 2U) << toText(flown);  // those of the approach
}

TEST(Pilot, AStopThatIsGivenUpHasNoReach) {
  Pilot pilot(planOf(manoeuvreOf(Stop{{0.0, 0.0}, 0.1})));
  PlanarMotion motion;
  for (motion.surge = 2.0; motion.surge > 1.0; motion.surge -= 0.1, motion.time += 0.1) {
    pilot.decide(motion);
  }
  pilot.giveUp("the run began anew");
  EXPECT_EQ(pilot.flown().at(0).measures.size(), 2U) << toText(pilot.flown()[0]);
}

TEST(Pilot, AStepOfAFirstOrderLagHasItsClosedForm) {
  // 10 to 90 %: T ln 9; no overshoot.
  Nomoto craft;
  craft.speed = 0.0;
  craft.thrust_gain = 0.5;
  craft.speed_lag = 0.4;
  Manoeuvre steps = manoeuvreOf(Steps{{{2.0, 0.0}, {4.0, 0.0}}, 8.0, Response::kSurge});
  steps.throttle = {0.0, 0.0};
  const FlownManoeuvre flown = fly(steps, craft);
  EXPECT_TRUE(flown.is_complete);
  EXPECT_NEAR(measure(flown, "step 1: settles at"), 1.0, 1e-6);
  EXPECT_NEAR(measure(flown, "step 2: settles at"), 2.0, 1e-6);
  EXPECT_NEAR(measure(flown, "step 1: rise time"), 0.4 * std::log(9.0), 1e-4);
  EXPECT_NEAR(measure(flown, "step 2: rise time"), 0.4 * std::log(9.0), 1e-4);
  EXPECT_NEAR(measure(flown, "step 1: overshoot"), 0.0, 1e-3);
}

TEST(Measures, AStepOfSecondOrderOvershootsByItsClosedForm) {
  // e^(-π ζ/√(1 - ζ²)).
  const double zeta = 0.3;
  const double omega = 4.0;
  Track track;
  for (int i = 0; i <= 10001; ++i) {
    const double t = 0.001 * i;
    const double damped = omega * std::sqrt(1.0 - zeta * zeta);
    PlanarMotion motion;
    motion.time = t;
    motion.yaw_rate =
        -(1.0 - std::exp(-zeta * omega * t) *
                    (std::cos(damped * t) + zeta * omega / damped * std::sin(damped * t)));
    track.push_back(motion);
  }
  const Measures measures = stepMeasures(track, Steps{{{1.0}}, 10.001, Response::kYawRate});
  ASSERT_EQ(measures.size(), 3U);
  EXPECT_NEAR(measures[0].value, -180.0 / kPi, 0.01);
  EXPECT_NEAR(measures[2].value, 100.0 * std::exp(-kPi * zeta / std::sqrt(1.0 - zeta * zeta)),
              0.01);
}

/// At a speed ahead each 0.1 s until a time.
Track rampOfSpeed(double end, double gain) {
  Track track;
  for (int i = 0; 0.1 * i <= end + 1e-9; ++i) {
    PlanarMotion motion;
    motion.time = 0.1 * i;
    motion.surge = gain * motion.time;
    track.push_back(motion);
  }
  return track;
}

TEST(Measures, AStepThatWasCutOffHasNone) {
  const Steps steps = {{{1.0}, {2.0}}, 2.0, Response::kSurge};
  // Where it settles, rise time and overshoot of each that was held to its end.
  EXPECT_EQ(stepMeasures(rampOfSpeed(4.0, 1.0), steps).size(), 6U);
  EXPECT_EQ(stepMeasures(rampOfSpeed(3.9, 1.0), steps).size(), 3U);
  EXPECT_EQ(stepMeasures(rampOfSpeed(2.0, 1.0), steps).size(), 3U);
  EXPECT_EQ(stepMeasures(rampOfSpeed(1.9, 1.0), steps).size(), 0U);
}

TEST(Measures, NoiseIsNoResponse) {
  const Steps steps = {{{1.0}}, 2.0, Response::kSurge};
  for (const double gain : {1e-17, -1e-17, 1e-8, 0.0}) {
    const Measures measures = stepMeasures(rampOfSpeed(2.0, gain), steps);
    ASSERT_EQ(measures.size(), 1U) << gain;
    EXPECT_EQ(measures[0].name, "step 1: settles at");
  }
  EXPECT_EQ(stepMeasures(rampOfSpeed(2.0, 1e-5), steps).size(), 3U);
}

TEST(Pilot, TheApproachHasTheHelmAmidships) {
  Manoeuvre manoeuvre = manoeuvreOf(TurningCircle{35.0, 540.0, Side::kStarboard});
  manoeuvre.approach = 0.5;
  Pilot pilot(planOf(manoeuvre));
  Nomoto craft;
  craft.motion.surge = craft.speed;
  while (craft.motion.time < 0.4995) {
    const Levels levels = pilot.decide(craft.motion);
    EXPECT_EQ(levels, (Levels{1.0, 0.0})) << craft.motion.time;
    craft.step(levels);
  }
  EXPECT_EQ(pilot.decide(craft.motion), (Levels{1.0, 35.0}));
}

TEST(Pilot, ManoeuvresFollowEachOtherWithoutAGap) {
  PilotPlan plan = planOf(manoeuvreOf(Ramp{{0.0, 0.0}, {1.0, 0.0}, 0.1}));
  plan.manoeuvres.push_back(manoeuvreOf(Steps{{{3.0, 0.0}}, 0.1, Response::kSurge}));
  Pilot pilot(plan);
  Nomoto craft;
  for (int i = 0; i < 100; ++i) craft.step(pilot.decide(craft.motion));
  EXPECT_EQ(pilot.decide(craft.motion), (Levels{3.0, 0.0}));
  ASSERT_EQ(pilot.flown().size(), 1U);
  EXPECT_DOUBLE_EQ(pilot.flown()[0].end, 0.1);
}

TEST(Pilot, WhatIsNotReachedIsGivenUpAndSaysSo) {
  Nomoto craft;
  craft.gain = 0.0;
  Manoeuvre manoeuvre = manoeuvreOf(ZigZag{10.0, 10.0, 5, Side::kStarboard});
  manoeuvre.longest = 2.0;
  const FlownManoeuvre flown = fly(manoeuvre, craft);
  EXPECT_FALSE(flown.is_complete);
  EXPECT_NE(toText(flown).find("not complete: it took longer than `longest`"), std::string::npos);
  EXPECT_NEAR(flown.end - flown.execute, 2.0, 2.0 * kPeriod);
  EXPECT_FALSE(has(flown, "first overshoot angle"));
}

TEST(Pilot, ThatGivesUpFliesNothingMore) {
  PilotPlan plan = planOf(manoeuvreOf(TurningCircle{35.0, 540.0, Side::kStarboard}));
  plan.manoeuvres.resize(3, plan.manoeuvres.front());
  Pilot pilot(plan);
  Nomoto craft;
  craft.step(pilot.decide(craft.motion));
  pilot.giveUp("the run was reset");
  EXPECT_TRUE(pilot.isDone());
  EXPECT_TRUE(pilot.decide(craft.motion).empty());
  ASSERT_EQ(pilot.flown().size(), 1U);
  EXPECT_EQ(pilot.flown()[0].reason, "the run was reset");
}

TEST(Pilot, WhatIsGivenUpDuringItsApproachEndsThen) {
  Manoeuvre manoeuvre = manoeuvreOf(TurningCircle{35.0, 540.0, Side::kStarboard});
  manoeuvre.approach = 5.0;
  Pilot pilot(planOf(manoeuvre));
  PlanarMotion motion;
  for (motion.time = 10.0; motion.time < 12.0; motion.time += 0.5) pilot.decide(motion);
  pilot.giveUp("the run began anew");
  ASSERT_EQ(pilot.flown().size(), 1U);
  const FlownManoeuvre& flown = pilot.flown()[0];
  EXPECT_EQ(flown.begin, 10.0);
  EXPECT_EQ(flown.execute, 11.5);
  EXPECT_EQ(flown.end, 11.5);
  EXPECT_EQ(flown.reason, "the run began anew, before the first execute");
  EXPECT_TRUE(flown.measures.empty());
}

TEST(MotionWatch, CountsTurnsByTheYawRateWhereMotionsAreFarBetween) {
  // 5 rad and more from one motion to the next, to either side, at a rate that goes up.
  for (const double side : {1.0, -1.0}) {
    MotionWatch watch;
    const Vector3 none = Vector3::Zero();
    for (int i = 0; i <= 20; ++i) {
      const double t = 1.0 * i;
      const double angle = side * (5.0 * t + 0.1 * t * t);
      const Quaternion q = {std::cos(0.5 * angle), {0.0, 0.0, std::sin(0.5 * angle)}};
      const Vector3 w_WB(0.0, 0.0, side * (5.0 + 0.2 * t));
      EXPECT_NEAR(watch.see(t, none, q, none, w_WB).heading, angle, 1e-9);
    }
  }
}

TEST(MotionWatch, CountsWholeTurns) {
  MotionWatch watch;
  const Vector3 none = Vector3::Zero();
  for (int i = 0; i <= 90; ++i) {
    const double angle = i <= 30 ? -0.5 * i : 0.5 * (i - 60);  // there, back and beyond
    const Quaternion q = {std::cos(0.5 * angle), {0.0, 0.0, std::sin(0.5 * angle)}};
    EXPECT_NEAR(watch.see(0.1 * i, none, q, none, none).heading, angle, 1e-12);
  }
}

TEST(MotionWatch, GivesVelocitiesInTheAxesOfTheCraft) {
  const Quaternion quarter = {std::sqrt(0.5), {0.0, 0.0, std::sqrt(0.5)}};  // bow along y
  const PlanarMotion motion =
      MotionWatch().see(1.0, {1.0, 2.0, 3.0}, quarter, {-1.0, 4.0, 0.0}, {0.0, 0.0, 0.3});
  EXPECT_NEAR(motion.surge, 4.0, 1e-12);
  EXPECT_NEAR(motion.sway, 1.0, 1e-12);
  EXPECT_EQ(motion.yaw_rate, 0.3);
  EXPECT_EQ(motion.y, 2.0);
}

}  // namespace
}  // namespace hovercraft
