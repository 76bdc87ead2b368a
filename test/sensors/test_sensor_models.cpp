#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/elementary.h"
#include "hovercraft_sim/math/rotation.h"
#include "hovercraft_sim/sensors/odometry_model.h"
#include "hovercraft_sim/sensors/sensor_model.h"

namespace hovercraft {
namespace {

constexpr double kStep = 0.001;

/// One sensor without a run around it.
struct Bench {
  Bench(const SensorParameters& parameters, const Vector3& p_HB = Vector3::Zero())
      : model(makeSensorModel(parameters, {"craft", 0, p_HB, kStep, &targets})),
        memory(model->memorySize(), 0.0),
        sample(model->sampleSize(), 0.0) {}

  std::vector<RayTarget> targets;
  std::unique_ptr<SensorModel> model;
  std::vector<double> memory;
  std::vector<double> sample;

  Vector3 vectorAt(std::size_t i) const { return {sample[i], sample[i + 1], sample[i + 2]}; }
};

SensedInstant instantAt(Tick tick, const Vector3& p_WB, const Quaternion& q_WB,
                        const Twist& twist) {
  return {1, tick, p_WB, q_WB, rotationMatrix(q_WB), twist, nullptr};
}

SensorParameters sensorOf(decltype(SensorParameters::model) model, Tick period = 1) {
  SensorParameters parameters;
  parameters.name = "sensor";
  parameters.period = period;
  parameters.model = std::move(model);
  return parameters;
}

ImuParameters quietImu() {
  ImuParameters imu;
  imu.gravity_W = {0.0, 0.0, -9.81};
  return imu;
}

TEST(Imu, AtRestItFeelsWhatHoldsIt) {
  Bench bench(sensorOf(quietImu()));
  const SensedInstant start = instantAt(0, {1.0, 2.0, 3.0}, {}, {});
  bench.model->start(start, bench.memory.data());
  bench.model->measure(instantAt(1, {1.0, 2.0, 3.0}, {}, {}), bench.memory.data(),
                       bench.sample.data());
  EXPECT_EQ(bench.vectorAt(0), Vector3(0.0, 0.0, 0.0));
  EXPECT_EQ(bench.vectorAt(3), Vector3(0.0, 0.0, 9.81));
}

TEST(Imu, InFreeFallItFeelsNothing) {
  Bench bench(sensorOf(quietImu(), 10));
  bench.model->start(instantAt(0, {}, {}, {{1.0, 0.0, 0.0}, Vector3::Zero()}), bench.memory.data());
  bench.model->measure(
      instantAt(10, Vector3::Zero(), {}, {{1.0, 0.0, -9.81 * 0.01}, Vector3::Zero()}),
      bench.memory.data(), bench.sample.data());
  EXPECT_LT(bench.vectorAt(3).cwiseAbs().maxCoeff(), 1e-12);
}

// A turn about z at the rate r: the centre is at rest, and a sensor at x on it feels -r² x.
TEST(Imu, ASteadyTurnPullsTheSensorInwards) {
  SensorParameters parameters = sensorOf(quietImu(), 10);
  parameters.p_HS = {0.3, 0.1, 0.0};
  Bench bench(parameters, {0.1, 0.0, 0.0});  // 0.2 m and 0.1 m from the centre of mass
  const double r = 2.0;
  const Twist twist = {Vector3::Zero(), {0.0, 0.0, r}};
  bench.model->start(instantAt(0, Vector3::Zero(), {}, twist), bench.memory.data());
  for (Tick tick = 10; tick <= 30; tick += 10) {
    const Quaternion q =
        quaternionFromAxisAngle(Vector3::UnitZ(), r * static_cast<double>(tick) * kStep);
    bench.model->measure(instantAt(tick, Vector3::Zero(), q, twist), bench.memory.data(),
                         bench.sample.data());
    EXPECT_LT((bench.vectorAt(3) - Vector3(-r * r * 0.2, -r * r * 0.1, 9.81)).norm(), 1e-13);
    EXPECT_LT((bench.vectorAt(0) - Vector3(0.0, 0.0, r)).norm(), 1e-15);
  }
}

// On a circle of radius R at speed u the centre feels u²/R towards the middle: to the left. The
// mean over an interval is that by sin(a)/a, a being half the angle of the interval: a²/6 less.
TEST(Imu, OnACircleItFeelsTheCentripetalForce) {
  Bench bench(sensorOf(quietImu(), 10));
  const double u = 3.0;
  const double r = 0.5;
  const auto instant = [&](Tick tick) {
    const double angle = r * static_cast<double>(tick) * kStep;
    const Twist twist = {{u * std::cos(angle), u * std::sin(angle), 0.0}, {0.0, 0.0, r}};
    return instantAt(tick, Vector3::Zero(), quaternionFromAxisAngle(Vector3::UnitZ(), angle),
                     twist);
  };
  bench.model->start(instant(0), bench.memory.data());
  bench.model->measure(instant(10), bench.memory.data(), bench.sample.data());
  const double half_angle = 0.5 * r * 0.01;
  const double mean = u * r * std::sin(half_angle) / half_angle;
  EXPECT_LT((bench.vectorAt(3) - Vector3(0.0, mean, 9.81)).norm(), 1e-12);
}

// A bounce from -1 m/s to +0.5 m/s within an interval of 10 ms: 150 m/s² on average.
TEST(Imu, AnImpactIsInTheSpecificForce) {
  Bench bench(sensorOf(quietImu(), 10));
  bench.model->start(instantAt(0, Vector3::Zero(), {}, {{-1.0, 0.0, 0.0}, Vector3::Zero()}),
                     bench.memory.data());
  bench.model->measure(instantAt(10, Vector3::Zero(), {}, {{0.5, 0.0, 0.0}, Vector3::Zero()}),
                       bench.memory.data(), bench.sample.data());
  EXPECT_NEAR(bench.sample[3], 150.0, 1e-12);
}

TEST(Imu, ItsAxesAreThoseOfTheSensor) {
  SensorParameters parameters = sensorOf(quietImu());
  parameters.rpy = {kPi, 0.0, 0.0};  // upside down
  Bench bench(parameters);
  const Twist twist = {Vector3::Zero(), {0.0, 0.0, 1.0}};
  bench.model->start(instantAt(0, Vector3::Zero(), {}, twist), bench.memory.data());
  bench.model->measure(instantAt(1, Vector3::Zero(), {}, twist), bench.memory.data(),
                       bench.sample.data());
  EXPECT_LT((bench.vectorAt(0) - Vector3(0.0, 0.0, -1.0)).norm(), 1e-15);
  EXPECT_LT((bench.vectorAt(3) - Vector3(0.0, 0.0, -9.81)).norm(), 1e-14);
}

TEST(Imu, BeingPutElsewhereIsNoAcceleration) {
  Bench bench(sensorOf(quietImu(), 10));
  bench.model->start(instantAt(0, Vector3::Zero(), {}, {}), bench.memory.data());
  const Twist thrown = {{5.0, 0.0, 0.0}, Vector3::Zero()};
  bench.model->relocate(instantAt(6, Vector3::Zero(), {}, thrown), bench.memory.data());
  bench.model->measure(instantAt(10, Vector3::Zero(), {}, thrown), bench.memory.data(),
                       bench.sample.data());
  EXPECT_EQ(bench.vectorAt(3), Vector3(0.0, 0.0, 9.81));
  bench.model->relocate(instantAt(10, Vector3::Zero(), {}, {}), bench.memory.data());
  bench.model->measure(instantAt(10, Vector3::Zero(), {}, {}), bench.memory.data(),
                       bench.sample.data());
  EXPECT_EQ(bench.vectorAt(3), Vector3(0.0, 0.0, 9.81));
}

// Radii of curvature of WGS 84 at 52.2 degrees: along the meridian M = a (1-e²)/w³, across it
// N = a/w, w² = 1 - e² sin²; a degree of latitude there is 111.26 km, one of longitude 68.38 km
// (tables of geodesy: 111.2655 and 68.3779 km at 52.2 degrees, to their last digit).
TEST(Gnss, ADegreeHasTheLengthOfTheTables) {
  GnssParameters gnss;
  gnss.latitude_deg = 52.2;
  gnss.longitude_deg = 21.0;
  gnss.altitude = 0.0;
  Bench bench(sensorOf(gnss));
  bench.model->start(instantAt(0, Vector3::Zero(), {}, {}), bench.memory.data());
  bench.model->measure(instantAt(1, {683.7, 1112.6, 30.0}, {}, {{1.0, 2.0, 3.0}, {}}),
                       bench.memory.data(), bench.sample.data());
  EXPECT_NEAR(bench.sample[0] - 52.2, 0.01, 2e-6);
  EXPECT_NEAR(bench.sample[1] - 21.0, 0.01, 2e-6);
  EXPECT_EQ(bench.sample[2], 30.0);
}

TEST(Gnss, TheAntennaTurnsWithTheCraft) {
  SensorParameters parameters = sensorOf(GnssParameters());
  parameters.p_HS = {1.0, 0.0, 0.5};
  Bench bench(parameters);
  const Quaternion left = quaternionFromAxisAngle(Vector3::UnitZ(), 0.5 * kPi);
  const SensedInstant instant =
      instantAt(1, Vector3::Zero(), left, {{0.0, 0.0, 0.0}, {0.0, 0.0, 2.0}});
  bench.model->start(instant, bench.memory.data());
  bench.model->measure(instant, bench.memory.data(), bench.sample.data());
  // One metre north at the equator: 1/110.574 km.
  EXPECT_NEAR(bench.sample[0], 1.0 / 110574.3, 1e-9);
  EXPECT_NEAR(bench.sample[1], 0.0, 1e-15);
  EXPECT_EQ(bench.sample[2], 0.5);
  EXPECT_LT((bench.vectorAt(3) - Vector3(-2.0, 0.0, 0.0)).norm(), 1e-15);
}

TEST(Gnss, LongitudeGoesOnBehindTheDateLine) {
  GnssParameters gnss;
  gnss.longitude_deg = 180.0;
  Bench bench(sensorOf(gnss));
  const SensedInstant instant = instantAt(1, {111.3195, 0.0, 0.0}, {}, {});
  bench.model->start(instant, bench.memory.data());
  bench.model->measure(instant, bench.memory.data(), bench.sample.data());
  EXPECT_NEAR(bench.sample[1], -179.999, 1e-6);
}

TEST(Magnetometer, TurnsTheFieldIntoItsAxes) {
  MagnetometerParameters magnetometer;
  magnetometer.field_W = {2e-5, 0.0, -4e-5};
  SensorParameters parameters = sensorOf(magnetometer);
  parameters.rpy = {0.0, 0.0, 0.5 * kPi};
  Bench bench(parameters);
  const Quaternion left = quaternionFromAxisAngle(Vector3::UnitZ(), 0.5 * kPi);
  const SensedInstant instant = instantAt(1, Vector3::Zero(), left, {});
  bench.model->start(instant, bench.memory.data());
  bench.model->measure(instant, bench.memory.data(), bench.sample.data());
  // Half a turn in all: x of the world is -x of the sensor.
  EXPECT_LT((bench.vectorAt(0) - Vector3(-2e-5, 0.0, -4e-5)).norm(), 1e-20);
}

TEST(RotationVector, IsTheAxisAngleQuaternion) {
  for (const double angle : {0.0, 1e-9, 1e-3, 0.9, 1.1, 3.0, 6.0, 40.0}) {
    const Vector3 axis = Vector3(1.0, -2.0, 0.5).normalized();
    const Quaternion found = quaternionOfRotationVector(angle * axis);
    const Quaternion wanted = quaternionFromAxisAngle(axis, angle);
    EXPECT_LT(std::abs(found.s - wanted.s) + (found.v - wanted.v).norm(), 2e-14) << angle;
  }
}

// Without noise the odometry of a steady circle is the circle: the interval's chord is
// u dt sin(a)/a with a = half its angle; the sum of the chords by u dt each is too long by a²/6.
TEST(Odometry, WithoutNoiseItFindsTheWay) {
  Bench bench(sensorOf(OdometryParameters(), 10), {0.05, 0.0, 0.0});
  const double r = 0.5;
  const double u = 1.0;
  const auto instant = [&](Tick tick) {
    const double angle = r * static_cast<double>(tick) * kStep;
    const Quaternion q = quaternionFromAxisAngle(Vector3::UnitZ(), angle);
    // base_link moves at u along its x; the centre of mass is 0.05 m before it.
    const Vector3 v_B = {u, r * 0.05, 0.0};
    return instantAt(tick, Vector3::Zero(), q, {rotate(q, v_B), {0.0, 0.0, r}});
  };
  bench.model->start(instant(0), bench.memory.data());
  for (Tick tick = 10; tick <= 4000; tick += 10) {
    bench.model->measure(instant(tick), bench.memory.data(), bench.sample.data());
  }
  const double angle = r * 4.0;
  const double radius = u / r;
  const double a = 0.5 * r * 0.01;
  const Vector3 wanted =
      Vector3(radius * std::sin(angle), radius * (1.0 - std::cos(angle)), 0.0) * (a / std::sin(a));
  EXPECT_LT((bench.vectorAt(0) - wanted).norm(), 1e-11);
  EXPECT_NEAR(bench.sample[3], std::cos(0.5 * angle), 1e-12);
  EXPECT_NEAR(bench.sample[6], std::sin(0.5 * angle), 1e-12);
  EXPECT_LT((bench.vectorAt(7) - Vector3(u, 0.0, 0.0)).norm(), 1e-15);
  for (std::size_t i = 13; i < 34; ++i) EXPECT_EQ(bench.sample[i], 0.0);
}

// Straight ahead at u for a time t, n samples of period dt, sigma_w of the yaw rate, sigma_v of the
// speed: var(yaw) = n (sigma_w dt)², var(x) = n (sigma_v dt)², and an error of the yaw turns the
// way that is left: var(y) = n (sigma_v dt)² + (sigma_w dt)² (u dt)² sum of k², k = 1 .. n-1;
// cov(y, yaw) = (sigma_w dt)² u dt sum of k.
TEST(Odometry, TheCovarianceIsThatOfTheWhiteNoise) {
  OdometryParameters odometry;
  odometry.planar = true;
  odometry.linear.gaussian_noise = 0.02;
  odometry.angular.gaussian_noise = 0.1;
  Bench bench(sensorOf(odometry, 10));
  const double u = 2.0;
  const double dt = 0.01;
  constexpr int kCount = 5;
  // The way is that of the noisy twist; noise of the speed is 1 % of it: so are the covariances.
  const Twist twist = {{u, 0.0, 0.0}, Vector3::Zero()};
  bench.model->start(instantAt(0, Vector3::Zero(), {}, twist), bench.memory.data());
  for (int n = 1; n <= kCount; ++n) {
    bench.model->measure(instantAt(Tick{10} * n, Vector3::Zero(), {}, twist), bench.memory.data(),
                         bench.sample.data());
  }
  const double yaw = 0.1 * dt * 0.1 * dt;
  const double way = 0.02 * dt * 0.02 * dt;
  const auto entry = [&](std::size_t row, std::size_t column) {
    return bench.sample[13 + row * 6 - row * (row + 1) / 2 + column];
  };
  EXPECT_NEAR(entry(5, 5) / (kCount * yaw), 1.0, 1e-12);
  EXPECT_NEAR(entry(0, 0) / (kCount * way), 1.0, 1e-3);
  EXPECT_NEAR(entry(1, 1) / (kCount * way + yaw * u * dt * u * dt * 30.0), 1.0, 0.03);
  EXPECT_NEAR(entry(1, 5) / (yaw * u * dt * 10.0), 1.0, 0.03);
  EXPECT_EQ(entry(2, 2), 0.0);
  EXPECT_EQ(entry(3, 3), 0.0);
}

TEST(Odometry, ThePlanarOneStaysInThePlane) {
  OdometryParameters odometry;
  odometry.planar = true;
  odometry.linear.gaussian_noise = 0.1;
  odometry.angular.gaussian_noise = 0.1;
  Bench bench(sensorOf(odometry));
  bench.model->start(instantAt(0, Vector3::Zero(), {}, {}), bench.memory.data());
  for (Tick tick = 1; tick <= 100; ++tick) {
    bench.model->measure(instantAt(tick, Vector3::Zero(), {}, {}), bench.memory.data(),
                         bench.sample.data());
  }
  EXPECT_NE(bench.sample[0], 0.0);
  EXPECT_NE(bench.sample[6], 0.0);
  for (const std::size_t i : {2U, 4U, 5U, 9U, 10U, 11U}) EXPECT_EQ(bench.sample[i], 0.0) << i;
}

TEST(SampleVariances, AreThoseOfEachChannel) {
  ImuParameters imu;
  imu.gyroscope.noise_density = 0.01;  // over sqrt(0.01 s): 0.1
  imu.accelerometer.gaussian_noise = 3.0;
  imu.accelerometer.turn_on_bias_sigma = 4.0;
  imu.accelerometer.drift = 12.0;
  imu.accelerometer.drift_frequency = 1.0;
  const std::vector<double> variances = sampleVariances(sensorOf(imu, 10), kStep);
  ASSERT_EQ(variances.size(), 2U);
  EXPECT_NEAR(variances[0], 0.01, 1e-15);
  EXPECT_NEAR(variances[1], 169.0, 1e-12);
}

// ---- the list of kinds --------------------------------------------------------------------------

template <std::size_t kKind>
void expectWhole() {
  using Model = decltype(SensorParameters::model);
  const SensorParameters sensor = sensorOf(Model(std::in_place_index<kKind>));
  const SensorTraits traits = traitsOf(sensor.kind());
  ASSERT_NE(traits.name, nullptr) << kKind;
  EXPECT_EQ(sampleFields(sensor).size(), Bench(sensor).model->sampleSize()) << traits.name;
  // One channel more drops samples, of a laser another one is that of its beams.
  const std::size_t more = sensor.kind() == SensorKind::kLaser ? 2 : 1;
  const auto noises = std::visit([](const auto& model) { return model.noises(); }, sensor.model);
  EXPECT_EQ(channelNames("craft", sensor).size(), noises.size() + more) << traits.name;
}

template <std::size_t... kKind>
void expectAllWhole(std::index_sequence<kKind...> /*kinds*/) {
  (expectWhole<kKind>(), ...);
  EXPECT_EQ(traitsOf(static_cast<SensorKind>(sizeof...(kKind))).name, nullptr);
}

TEST(SensorKinds, EachHasANameANoiseForEachChannelAndAFieldForEachNumber) {
  expectAllWhole(
      std::make_index_sequence<std::variant_size_v<decltype(SensorParameters::model)>>());
}

}  // namespace
}  // namespace hovercraft
