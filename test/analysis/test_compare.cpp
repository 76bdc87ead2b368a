#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/analysis/compare.h"
#include "hovercraft_sim/math/constants.h"

#include "../support/files.h"

namespace hovercraft {
namespace {

using testing::messageOf;

constexpr double kRounding = 1e-13;
constexpr std::int64_t kStepNs = 10000000;

/// A circle of radius 2 m at 0.5 rad/s, heading along it: 101 samples over 1 s.
Trajectory circle() {
  Trajectory trajectory;
  trajectory.source = "circle";
  for (int i = 0; i <= 100; ++i) {
    const double yaw = 0.5 * 0.01 * i;
    TrajectorySample sample;
    sample.time_ns = i * kStepNs;
    sample.p_WB = {2.0 * std::sin(yaw), 2.0 - 2.0 * std::cos(yaw), 0.0};
    sample.q_WB = quaternionFromAxisAngle(Vector3::UnitZ(), yaw);
    sample.v_WB = {std::cos(yaw), std::sin(yaw), 0.0};
    sample.w_WB = {0.0, 0.0, 0.5};
    trajectory.samples.push_back(sample);
  }
  return trajectory;
}

/// The whole trajectory turned about z and moved.
Trajectory moved(Trajectory trajectory, double yaw, const Vector3& shift) {
  const Quaternion turn = quaternionFromAxisAngle(Vector3::UnitZ(), yaw);
  for (TrajectorySample& sample : trajectory.samples) {
    sample.p_WB = rotate(turn, sample.p_WB) + shift;
    sample.q_WB = turn * sample.q_WB;
    sample.v_WB = rotate(turn, sample.v_WB);
  }
  return trajectory;
}

CompareOptions toleranceOf(double position, double attitude) {
  CompareOptions options;
  options.position_tolerance = position;
  options.attitude_tolerance = attitude;
  return options;
}

TEST(Compare, ATrajectoryIsIdenticalToItself) {
  const Comparison comparison = compareTrajectories(circle(), circle(), {});
  EXPECT_TRUE(comparison.is_within);
  EXPECT_FALSE(comparison.divergence.has_value());
  EXPECT_EQ(comparison.errors.size(), 101U);
  EXPECT_EQ(comparison.position.max, 0.0);
  EXPECT_EQ(comparison.attitude.max, 0.0);
  EXPECT_EQ(comparison.relative_position.max, 0.0);
  EXPECT_EQ(comparison.relative_attitude.max, 0.0);
  EXPECT_NE(toText(comparison, {}).find("identical to the last bit"), std::string::npos);
}

TEST(Compare, FindsAPlantedDifferenceAtItsTimeAndSize) {
  Trajectory changed = circle();
  changed.samples[42].p_WB.y() += 0.25;
  changed.samples[43].p_WB.x() -= 0.5;
  const Comparison comparison = compareTrajectories(circle(), changed, toleranceOf(0.1, 1e-9));
  EXPECT_FALSE(comparison.is_within);
  ASSERT_TRUE(comparison.divergence.has_value());
  EXPECT_EQ(comparison.divergence->time_ns, 42 * kStepNs);
  EXPECT_EQ(comparison.divergence->quantity, "position");
  EXPECT_NEAR(comparison.divergence->a, 0.25, kRounding);
  EXPECT_NEAR(comparison.position.max, 0.5, kRounding);
  EXPECT_EQ(comparison.position.max_time_ns, 43 * kStepNs);
  EXPECT_NEAR(comparison.position.rms, std::sqrt((0.25 * 0.25 + 0.5 * 0.5) / 101.0), kRounding);
  EXPECT_EQ(comparison.position.final, 0.0);
  EXPECT_EQ(comparison.attitude.max, 0.0);
  EXPECT_TRUE(compareTrajectories(circle(), changed, toleranceOf(0.51, 1e-9)).is_within);
}

TEST(Compare, FindsAPlantedTurn) {
  Trajectory changed = circle();
  changed.samples[70].q_WB =
      changed.samples[70].q_WB * quaternionFromAxisAngle(Vector3::UnitX(), 0.01);
  const Comparison comparison = compareTrajectories(circle(), changed, toleranceOf(0.1, 0.005));
  ASSERT_TRUE(comparison.divergence.has_value());
  EXPECT_EQ(comparison.divergence->time_ns, 70 * kStepNs);
  EXPECT_EQ(comparison.divergence->quantity, "attitude");
  EXPECT_NEAR(comparison.attitude.max, 0.01, kRounding);
  EXPECT_EQ(comparison.position.max, 0.0);
}

TEST(Compare, WithoutATolerancesASingleBitIsADifference) {
  Trajectory changed = circle();
  double& number = changed.samples[17].w_WB.z();
  number = std::nextafter(number, 1.0);
  const Comparison comparison = compareTrajectories(circle(), changed, {});
  ASSERT_TRUE(comparison.divergence.has_value());
  EXPECT_EQ(comparison.divergence->time_ns, 17 * kStepNs);
  EXPECT_EQ(comparison.divergence->quantity, "wz");
  EXPECT_EQ(comparison.divergence->b, number);
  EXPECT_FALSE(comparison.is_within);
  EXPECT_NE(toText(comparison, {})
                .find("differ first at 0.17 s: wz = 0.5 in A, "
                      "0.5000000000000001 in B"),
            std::string::npos);

  changed = circle();
  changed.samples[0].p_WB.z() = -0.0;
  EXPECT_EQ(compareTrajectories(circle(), changed, {}).divergence->quantity, "z");
  EXPECT_TRUE(compareTrajectories(circle(), changed, toleranceOf(0.0, 0.0)).is_within);
}

TEST(Compare, VelocitiesThatOneSideDoesNotHaveAreLeftOut) {
  Trajectory without = circle();
  for (TrajectorySample& sample : without.samples) sample.v_WB = Vector3::Zero();
  EXPECT_FALSE(compareTrajectories(circle(), without, {}).is_within);
  without.has_velocities = false;
  const Comparison comparison = compareTrajectories(circle(), without, {});
  EXPECT_TRUE(comparison.is_within);
  EXPECT_NE(toText(comparison, {}).find("velocities are not in both"), std::string::npos);
}

TEST(Compare, QuaternionsOfBothSignsAreTheSameAttitude) {
  Trajectory changed = circle();
  for (TrajectorySample& sample : changed.samples) sample.q_WB = -1.0 * sample.q_WB;
  EXPECT_LT(compareTrajectories(circle(), changed, {}).attitude.max, kRounding);
}

TEST(Compare, TheRelativeErrorIsWithoutTheDifferenceOfTheFirstPoses) {
  // A turn by 90° about the origin and a shift (3, 4): the first point moves by 5.
  const Trajectory other = moved(circle(), 0.5 * kPi, {3.0, 4.0, 0.0});
  CompareOptions options = toleranceOf(1e-9, 1e-9);
  const Comparison absolute = compareTrajectories(circle(), other, options);
  EXPECT_FALSE(absolute.is_within);
  EXPECT_NEAR(absolute.errors.front().position, 5.0, kRounding);
  EXPECT_NEAR(absolute.attitude.max, 0.5 * kPi, kRounding);
  EXPECT_LT(absolute.relative_position.max, kRounding);
  EXPECT_LT(absolute.relative_attitude.max, kRounding);
  options.relative = true;
  EXPECT_TRUE(compareTrajectories(circle(), other, options).is_within);

  Trajectory drifting = other;
  drifting.samples.back().p_WB.x() += 0.125;
  const Comparison drift = compareTrajectories(circle(), drifting, options);
  EXPECT_EQ(drift.divergence->time_ns, 100 * kStepNs);
  EXPECT_NEAR(drift.relative_position.final, 0.125, kRounding);
}

TEST(Compare, AToleranceThatIsNotGivenIsNotJudged) {
  Trajectory changed = circle();
  changed.samples[5].q_WB = changed.samples[50].q_WB;
  CompareOptions options;
  options.position_tolerance = 0.0;
  const Comparison comparison = compareTrajectories(circle(), changed, options);
  EXPECT_TRUE(comparison.is_within);
  EXPECT_NE(toText(comparison, options).find("within 0 m, attitude not judged"), std::string::npos);
}

TEST(Compare, SamplesWithoutAPartnerAreNamedAndFail) {
  Trajectory shorter = circle();
  shorter.samples.erase(shorter.samples.begin() + 30);
  shorter.samples.resize(90);
  CompareOptions options = toleranceOf(0.0, 0.0);
  const Comparison comparison = compareTrajectories(circle(), shorter, options);
  EXPECT_FALSE(comparison.is_within);
  EXPECT_EQ(comparison.only_in_a.count, 11U);
  EXPECT_EQ(comparison.only_in_a.first_ns, 30 * kStepNs);
  EXPECT_EQ(comparison.only_in_a.last_ns, 100 * kStepNs);
  EXPECT_EQ(comparison.only_in_b.count, 0U);
  const std::string text = toText(comparison, options);
  EXPECT_NE(text.find("11 samples only in A, the first at 0.3 s, the last at 1 s"),
            std::string::npos);
  EXPECT_NE(text.find("samples are missing"), std::string::npos);

  EXPECT_EQ(compareTrajectories(shorter, circle(), options).only_in_b.count, 11U);
  EXPECT_FALSE(compareTrajectories(shorter, circle(), options).is_within);
  options.matching = SampleMatching::kCommon;
  EXPECT_TRUE(compareTrajectories(circle(), shorter, options).is_within);
}

TEST(Compare, ASampleAtTimeZeroNeedsNoPartnerInABag) {
  Trajectory bag = circle();
  bag.samples.erase(bag.samples.begin());
  EXPECT_FALSE(compareTrajectories(circle(), bag, {}).is_within);
  bag.holds_time_zero = false;
  EXPECT_TRUE(compareTrajectories(circle(), bag, {}).is_within);
  EXPECT_TRUE(compareTrajectories(bag, circle(), {}).is_within);
  bag.samples.erase(bag.samples.begin());
  EXPECT_FALSE(compareTrajectories(circle(), bag, {}).is_within);
}

TEST(Compare, NothingInCommonIsNotWithin) {
  Trajectory later = circle();
  for (TrajectorySample& sample : later.samples) sample.time_ns += 1;
  CompareOptions options = toleranceOf(1.0, 1.0);
  options.matching = SampleMatching::kCommon;
  const Comparison comparison = compareTrajectories(circle(), later, options);
  EXPECT_FALSE(comparison.is_within);
  EXPECT_NE(toText(comparison, options).find("no sample of A has a partner in B"),
            std::string::npos);
  EXPECT_FALSE(compareTrajectories(Trajectory(), Trajectory(), options).is_within);
}

TEST(Compare, TimesCanBeCountedFromTheFirstSample) {
  Trajectory later = circle();
  for (TrajectorySample& sample : later.samples) sample.time_ns += 1700000000123456789;
  CompareOptions options;
  options.from_start = true;
  EXPECT_TRUE(compareTrajectories(circle(), later, options).is_within);
}

TEST(Compare, InterpolatesBetweenSamples) {
  // B at every tenth sample: on a circle of radius r the chord is r (1 - cos(θ/2)) off its arc,
  // θ = 0.05 rad; the yaw turns evenly, so that slerp is exact.
  Trajectory sparse = circle();
  sparse.samples.clear();
  for (std::size_t i = 0; i <= 90; i += 10) sparse.samples.push_back(circle().samples[i]);
  CompareOptions options = toleranceOf(1e-3, 1e-12);
  options.matching = SampleMatching::kInterpolated;
  const Comparison comparison = compareTrajectories(circle(), sparse, options);
  EXPECT_TRUE(comparison.is_within);
  EXPECT_EQ(comparison.errors.size(), 91U);
  EXPECT_EQ(comparison.only_in_a.count, 10U);
  EXPECT_EQ(comparison.only_in_a.first_ns, 91 * kStepNs);
  EXPECT_NEAR(comparison.position.max, 2.0 * (1.0 - std::cos(0.025)), 1e-9);
  EXPECT_EQ(comparison.errors[20].position, 0.0);
}

TEST(Compare, AToleranceMustBeANumberOfZeroOrMore) {
  EXPECT_EQ(messageOf([] { compareTrajectories(circle(), circle(), toleranceOf(-1.0, 0.0)); }),
            "position tolerance = -1 m: must be 0 or greater, and finite");
  EXPECT_EQ(messageOf([] { compareTrajectories(circle(), circle(), toleranceOf(0.0, NAN)); }),
            "attitude tolerance = nan rad: must be 0 or greater, and finite");
}

TEST(Compare, ErrorsOverTimeAreCsv) {
  Trajectory a = circle();
  a.samples.resize(2);
  Trajectory b = a;
  b.samples[1].p_WB.z() += 0.5;
  EXPECT_EQ(errorsCsv(compareTrajectories(a, b, {})),
            "time,position,attitude,relative_position,relative_attitude\n"
            "0,0,0,0,0\n0.01,0.5,0,0.5,0\n");
}

Trajectory named(const std::string& vehicle) {
  Trajectory trajectory;
  trajectory.vehicle = vehicle;
  return trajectory;
}

TEST(PairByVehicle, TakesSingleOnesTogetherAndOthersByName) {
  const std::vector<Trajectory> a = {named("")};
  const std::vector<Trajectory> b = {named("craft")};
  ASSERT_EQ(pairByVehicle(a, b).size(), 1U);
  EXPECT_EQ(pairByVehicle(a, b, "craft").front().b, &b.front());

  const std::vector<Trajectory> two = {named("alpha"), named("beta")};
  const std::vector<Trajectory> same = {named("beta"), named("alpha")};
  const auto pairs = pairByVehicle(two, same);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].a, &two[0]);
  EXPECT_EQ(pairs[0].b, &same[1]);
  EXPECT_EQ(pairByVehicle(two, same, "beta").size(), 1U);
}

TEST(PairByVehicle, NamesAVehicleThatIsMissing) {
  const std::vector<Trajectory> two = {named("alpha"), named("beta")};
  const std::vector<Trajectory> other = {named("alpha"), named("gamma")};
  EXPECT_EQ(messageOf([&] { pairByVehicle(two, other); }),
            "vehicle = beta: B does not have it; it has alpha, gamma");
  EXPECT_EQ(messageOf([&] { pairByVehicle(two, {named("alpha")}); }),
            "vehicle = beta: B does not have it; it has alpha");
  EXPECT_EQ(messageOf([&] { pairByVehicle({named("alpha")}, two); }),
            "vehicle = beta: A does not have it; it has alpha");
  EXPECT_EQ(messageOf([&] { pairByVehicle(two, two, "delta"); }),
            "vehicle = delta: A does not have it; it has alpha, beta");
  EXPECT_EQ(messageOf([] { pairByVehicle({}, {}); }), "A has no trajectory, and neither has B");
}

}  // namespace
}  // namespace hovercraft
