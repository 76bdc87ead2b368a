/// What sensors cost: a scan of 720 beams among 50 boxes beside Box2D's ray casts of the same
/// scene, in turns of one run; a sample of an IMU; a step of a run without sensors and with them.
/// Processor time, medians of 21 turns.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <random>
#include <vector>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/sensor_builder.h"
#include "hovercraft_sim/sim/simulation.h"

#ifdef HAS_BOX2D
#include <box2d/box2d.h>
#endif

namespace {

using namespace hovercraft;  // NOLINT: a program of one file

constexpr int kBeams = 720;
constexpr int kBoxes = 50;
constexpr double kRange = 30.0;  // m
constexpr int kTurns = 21;

struct Box {
  double x, y, half_x, half_y, yaw;
};

std::vector<Box> boxes() {
  std::mt19937 random(20261127);
  std::uniform_real_distribution<double> unit(0.0, 1.0);  // NOLINT: a scene, not a state
  std::vector<Box> all;
  while (static_cast<int>(all.size()) < kBoxes) {
    const Box box = {40.0 * unit(random) - 20.0, 40.0 * unit(random) - 20.0, 0.2 + unit(random),
                     0.2 + unit(random), 6.0 * unit(random)};
    if (std::hypot(box.x, box.y) > 2.5) all.push_back(box);
  }
  return all;
}

double secondsOf(std::clock_t ticks) {
  return static_cast<double>(ticks) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + kTurns / 2, values.end());
  return values[kTurns / 2];
}

template <class Call>
double nanosecondsOf(int calls, const Call& call) {
  const std::clock_t begin = std::clock();
  for (int i = 0; i < calls; ++i) call(i);
  return 1e9 * secondsOf(std::clock() - begin) / calls;
}

/// The sensor of a scenario, read again and again where the craft starts.
class Reader {
 public:
  explicit Reader(const Scenario& scenario)
      : simulation_(scenario),
        targets_(rayTargetsOf(scenario)),
        model_(makeSensorModel(scenario.vehicles[0].sensors[0],
                               {"craft", 0, Vector3::Zero(), scenario.stepSize(), &targets_})),
        memory_(model_->memorySize()),
        sample_(model_->sampleSize()) {
    model_->start(at(0), memory_.data());
  }

  SensedInstant at(Tick tick) const {
    const auto& bodies = simulation_.state().bodies;
    const Pose X_WB = poseOf(bodies[0]);
    return {1, tick, X_WB.p_AB, orientationOf(bodies[0]), X_WB.R_AB, Twist(), &bodies};
  }
  void read(Tick tick) { model_->measure(at(tick), memory_.data(), sample_.data()); }
  const std::vector<double>& sample() const { return sample_; }

 private:
  Simulation simulation_;
  std::vector<RayTarget> targets_;
  std::unique_ptr<SensorModel> model_;
  std::vector<double> memory_;
  std::vector<double> sample_;
};

const char* const kCraft =
    "vehicles:\n  craft:\n    mass: 2\n    inertia: {ixx: 0.5, iyy: 0.5, izz: 0.5}\n    engines:\n"
    "      rear: {position: [-1, 0, 0], direction: [1, 0, 0], min_thrust: 0, max_thrust: 10}\n"
    "      left: {position: [1, 0, 0], direction: [0, -1, 0], min_thrust: 0, max_thrust: 10}\n"
    "      right: {position: [1, 0, 0], direction: [0, 1, 0], min_thrust: 0, max_thrust: 10}\n";

Scenario scenarioOf(const std::string& sensors, const std::string& world) {
  const std::string hull = world.empty() ? "" : "    hull: {box: {size: [0.5, 0.5, 0.5]}}\n";
  return parseScenario("step_size: 0.001\nmodel: planar\n" + world + kCraft + hull + sensors,
                       {"bench", "", {}});
}

Scenario laserScenario() {
  std::string world = "world:\n  obstacles:\n";
  char line[200];
  int number = 0;
  for (const Box& box : boxes()) {
    std::snprintf(
        line, sizeof(line),
        "    b%d: {box: {size: [%.17g, %.17g, 1]}, position: [%.17g, %.17g, 0], rpy: [0, 0, "
        "%.17g]}\n",
        number++, 2 * box.half_x, 2 * box.half_y, box.x, box.y, box.yaw);
    world += line;
  }
  return scenarioOf(
      "    sensors: {laser: {kind: laser, rate: 10, angle_min: 0, angle_max: 6.2744, "
      "beams: 720, range_max: 30}}\n",
      world);
}

#ifdef HAS_BOX2D

class Nearest : public b2RayCastCallback {
 public:
  float ReportFixture(b2Fixture* /*fixture*/, const b2Vec2& /*point*/, const b2Vec2& /*normal*/,
                      float fraction) override {
    share = fraction;
    return fraction;
  }
  float share = 1.0F;
};

class Peer {
 public:
  Peer() {
    for (const Box& box : boxes()) {
      b2BodyDef body;
      body.position.Set(static_cast<float>(box.x), static_cast<float>(box.y));
      body.angle = static_cast<float>(box.yaw);
      b2PolygonShape shape;
      shape.SetAsBox(static_cast<float>(box.half_x), static_cast<float>(box.half_y));
      world_.CreateBody(&body)->CreateFixture(&shape, 0.0F);
    }
    for (int i = 0; i < kBeams; ++i) {
      const double angle = 6.2744 / (kBeams - 1) * i;
      ends_[static_cast<std::size_t>(i)].Set(static_cast<float>(kRange * std::cos(angle)),
                                             static_cast<float>(kRange * std::sin(angle)));
    }
  }

  void scan() {
    for (std::size_t i = 0; i < kBeams; ++i) {
      Nearest nearest;
      world_.RayCast(&nearest, b2Vec2(0.0F, 0.0F), ends_[i]);
      ranges[i] = nearest.share < 1.0F ? kRange * static_cast<double>(nearest.share) : -1.0;
    }
  }

  std::array<double, kBeams> ranges{};

 private:
  b2World world_{b2Vec2(0.0F, 0.0F)};
  std::array<b2Vec2, kBeams> ends_;
};

void benchLaser() {
  Reader ours(laserScenario());
  Peer peer;
  std::vector<double> of_ours;
  std::vector<double> of_peer;
  for (int turn = 0; turn < kTurns; ++turn) {
    of_ours.push_back(
        nanosecondsOf(200, [&](int i) { ours.read(hovercraft::Tick{100} * (i + 1)); }));
    of_peer.push_back(nanosecondsOf(200, [&](int /*i*/) { peer.scan(); }));
  }
  int hits = 0;
  double worst = 0.0;
  for (std::size_t i = 0; i < kBeams; ++i) {
    if (ours.sample()[i] < 0.0 || peer.ranges[i] < 0.0) continue;
    ++hits;
    worst = std::max(worst, std::abs(ours.sample()[i] - peer.ranges[i]));
  }
  std::printf(
      "scan of %d beams among %d boxes: %.1f us; Box2D %.1f us; ratio %.2f; %d beams hit in "
      "both, ranges differ by %.2g m at most\n",
      kBeams, kBoxes, 1e-3 * median(of_ours), 1e-3 * median(of_peer),
      median(of_ours) / median(of_peer), hits, worst);
}

#else

void benchLaser() {
  Reader ours(laserScenario());
  std::vector<double> of_ours;
  for (int turn = 0; turn < kTurns; ++turn) {
    of_ours.push_back(
        nanosecondsOf(200, [&](int i) { ours.read(hovercraft::Tick{100} * (i + 1)); }));
  }
  std::printf("scan of %d beams among %d boxes: %.1f us (Box2D is not installed)\n", kBeams, kBoxes,
              1e-3 * median(of_ours));
}

#endif

void benchImu(const char* name, const std::string& noise) {
  Reader imu(scenarioOf("    sensors: {imu: {kind: imu, rate: 200" + noise + "}}\n", ""));
  std::vector<double> times;
  times.reserve(kTurns);
  Tick tick = 0;
  for (int turn = 0; turn < kTurns; ++turn) {
    times.push_back(nanosecondsOf(100000, [&](int /*i*/) { imu.read(tick += 5); }));
  }
  std::printf("IMU sample %s: %.0f ns\n", name, median(times));
}

void benchStep(const char* name, const std::string& sensors) {
  Simulation simulation(scenarioOf(sensors, ""));
  std::vector<double> times;
  times.reserve(kTurns);
  for (int turn = 0; turn < kTurns; ++turn) {
    times.push_back(nanosecondsOf(100000, [&](int /*i*/) { simulation.step(); }));
  }
  std::printf("step %s: %.1f ns\n", name, median(times));
}

}  // namespace

// A benchmark that cannot be set up ends with the exception.
// NOLINTNEXTLINE(bugprone-exception-escape)
int main() {
  benchLaser();
  const std::string white = ", gyroscope_noise_density: 2e-4, accelerometer_noise_density: 2e-3";
  benchImu("without noise", "");
  benchImu("with white noise", white);
  benchImu("with white noise and biases",
           white +
               ", gyroscope_random_walk: 4e-5, gyroscope_bias_correlation_time: 1000, "
               "accelerometer_random_walk: 6e-3, accelerometer_bias_correlation_time: 300");
  benchStep("without sensors", "");
  benchStep("with an IMU of 200 Hz", "    sensors: {imu: {kind: imu, rate: 200" + white + "}}\n");
  return 0;
}
