#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/run_observer.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/snapshot.h"

#include "../support/files.h"
#include "../support/scenarios.h"
#include "../support/sensor_scenario.h"

namespace hovercraft {
namespace {

using testing::allSensors;

std::string scenarioText(const std::string& sensors, const std::string& seed = "1") {
  return testing::sensedCraftYaml(sensors, seed);
}
std::string wholeText(const std::string& seed = "1") {
  return scenarioText(allSensors() + testing::laserSensor(), seed);
}

struct Recorded {
  Tick measured;
  Tick delivered;
  std::vector<double> values;

  bool operator==(const Recorded& other) const {
    return measured == other.measured && delivered == other.delivered && values == other.values;
  }
};
using Recording = std::map<std::string, std::vector<Recorded>>;  // by the sensor's name

/// Keeps the samples of a simulation, as long as it lives.
class SampleRecorder : public RunObserver {
 public:
  SampleRecorder(Recording& recording, Simulation& simulation)
      : recording_(recording), scenario_(simulation.scenario()) {
    simulation.observe(this);
  }
  void sample(const SensorSample& sample) override {
    const auto& vehicle = scenario_.vehicles[sample.vehicle];
    recording_[vehicle.sensors[sample.sensor].name].push_back(
        {sample.measured, sample.delivered,
         std::vector<double>(sample.values, sample.values + sample.count)});
  }

 private:
  Recording& recording_;
  const Scenario& scenario_;
};

void flySensed(Simulation& simulation, Tick ticks) {
  for (const Tick end = simulation.tick() + ticks; simulation.tick() < end; simulation.step()) {
    if (simulation.tick() % 100 != 0) continue;
    const auto phase = static_cast<double>(simulation.tick() / 100 % 3);
    simulation.push({simulation.tick(), 0, kAllEngines, {2.0 * phase, 0.3 * phase, 0.5}});
  }
}

Recording samplesOf(const std::string& text, Tick ticks = 2000) {
  Simulation simulation(testing::scenarioOf(text));
  Recording recording;
  const SampleRecorder recorder(recording, simulation);
  flySensed(simulation, ticks);
  return recording;
}

TEST(SimulationSensors, EachIsReadAtItsRateAndDeliveredAfterItsLatency) {
  const Recording recording = samplesOf(wholeText());
  const std::map<std::string, std::pair<Tick, Tick>> rhythm = {
      {"gps", {200, 250}}, {"wheel", {20, 0}}, {"compass", {50, 0}}, {"lidar", {100, 20}}};
  for (const auto& [name, timing] : rhythm) {
    const auto& samples = recording.at(name);
    const auto [period, latency] = timing;
    ASSERT_EQ(samples.size(), static_cast<std::size_t>((2000 - latency) / period)) << name;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      EXPECT_EQ(samples[i].measured, static_cast<Tick>(i + 1) * period) << name;
      EXPECT_EQ(samples[i].delivered, samples[i].measured + latency) << name;
    }
  }
}

// 400 samples of which a tenth is lost: 40, sigma 6; five sigma.
TEST(SimulationSensors, ATenthOfTheSamplesIsDropped) {
  const auto samples = samplesOf(wholeText()).at("imu");
  EXPECT_NEAR(static_cast<double>(samples.size()), 359.0, 30.0);
  for (const Recorded& sample : samples) EXPECT_EQ(sample.measured % 5, 0);
}

TEST(SimulationSensors, LatencyThatIsNoWholeStepIsRoundedUp) {
  const auto samples =
      samplesOf(scenarioText("    sensors: {c: {kind: magnetometer, rate: 100, field: "
                             "[0, 0, 1], latency: 0.0021}}\n"),
                100)
          .at("c");
  EXPECT_EQ(samples[0].delivered - samples[0].measured, 3);
}

TEST(SimulationSensors, TheBodiesDoNotKnowThem) {
  Simulation with(testing::scenarioOf(wholeText()));
  Simulation without(testing::scenarioOf(scenarioText("")));
  flySensed(with, 3000);
  flySensed(without, 3000);
  EXPECT_EQ(with.hash(), without.hash());
  EXPECT_EQ(with.hash(0), without.hash(0));
  EXPECT_NE(with.sensorHash(), 0U);
  EXPECT_EQ(without.sensorHash(), 0U);
  EXPECT_EQ(without.sensors(), nullptr);
}

TEST(SimulationSensors, TheSameSeedGivesTheSameBitsAndAnotherOneOthers) {
  const Recording first = samplesOf(wholeText());
  EXPECT_EQ(samplesOf(wholeText()), first);
  const Recording other = samplesOf(wholeText("2"));
  for (const auto& [name, samples] : first) {
    EXPECT_NE(other.at(name).back().values, samples.back().values) << name;
  }
}

TEST(SimulationSensors, NoneDependsOnWhichOthersThereAre) {
  const Recording all = samplesOf(wholeText());
  const std::string laser_only = "    sensors:\n" + testing::laserSensor();
  EXPECT_EQ(samplesOf(scenarioText(laser_only)).at("lidar"), all.at("lidar"));
  const Recording without_laser = samplesOf(scenarioText(allSensors()));
  for (const auto& [name, samples] : without_laser) EXPECT_EQ(samples, all.at(name)) << name;
}

TEST(SimulationSensors, ARunFromASnapshotGivesTheSamplesOfTheRunThatNeverStopped) {
  const Scenario scenario = testing::scenarioOf(wholeText());
  Simulation unbroken(scenario);
  flySensed(unbroken, 1337);
  const std::string snapshot = toSnapshot(unbroken);
  Simulation resumed(scenario);
  resumed.restore(parseSnapshot(snapshot, "snap.yaml", scenario));
  EXPECT_EQ(resumed.sensorHash(), unbroken.sensorHash());
  Recording a;
  Recording b;
  const SampleRecorder of_unbroken(a, unbroken);
  const SampleRecorder of_resumed(b, resumed);
  flySensed(unbroken, 800);
  flySensed(resumed, 800);
  EXPECT_EQ(a, b);
  EXPECT_EQ(a.size(), 5U);
  EXPECT_EQ(a.at("gps")[0].measured, 1200);  // was on its way
  EXPECT_EQ(resumed.sensorHash(), unbroken.sensorHash());
}

TEST(SimulationSensors, AResetBeginsAnewWithItsSeed) {
  const Recording first = samplesOf(wholeText());
  Simulation simulation(testing::scenarioOf(wholeText("7")));
  flySensed(simulation, 777);
  simulation.reset(1);
  Recording again;
  const SampleRecorder recorder(again, simulation);
  flySensed(simulation, 2000);
  EXPECT_EQ(again, first);
}

TEST(SimulationSensors, ACraftThatIsPutElsewhereFeelsNoBlow) {
  const std::string imu = "    sensors: {imu: {kind: imu, rate: 100}}\n";
  Simulation simulation(testing::scenarioOf(scenarioText(imu)));
  Recording recording;
  const SampleRecorder recorder(recording, simulation);
  for (int n = 0; n < 15; ++n) simulation.step();
  simulation.setMotion(0, {-5.0, 0.0, 0.0}, Quaternion::identity(),
                       {{0.0, 3.0, 0.0}, Vector3::Zero()});
  for (int n = 0; n < 15; ++n) simulation.step();
  const auto& samples = recording.at("imu");
  ASSERT_EQ(samples.size(), 3U);
  for (const Recorded& sample : samples) {
    EXPECT_EQ(sample.values, (std::vector<double>{0.0, 0.0, 0.0, 0.0, 0.0, 9.80665}));
  }
}

// 2 N push 2 kg: 1 m/s².
TEST(SimulationSensors, AnImuFeelsTheThrust) {
  const std::string imu = "    sensors: {imu: {kind: imu, rate: 100}}\n";
  Simulation simulation(testing::scenarioOf(scenarioText(imu)));
  Recording recording;
  const SampleRecorder recorder(recording, simulation);
  simulation.push({0, 0, maskOf(EngineId::kRear), {2.0, 0.0, 0.0}});
  for (int n = 0; n < 30; ++n) simulation.step();
  for (const Recorded& sample : recording.at("imu")) {
    EXPECT_NEAR(sample.values[3], 1.0, 1e-12);
    EXPECT_NEAR(sample.values[5], 9.80665, 1e-12);
  }
}

TEST(SimulationSensors, TheNextSampleIsForetold) {
  Simulation simulation(testing::scenarioOf(wholeText()));
  Tick last = 0;
  RunCallbacks told;
  simulation.observe(&told);
  told.on_sample = [&](const SensorSample& sample) { last = sample.delivered; };
  for (int n = 0; n < 1000; ++n) {
    const Tick foretold = simulation.nextSampleTick();
    EXPECT_GT(foretold, simulation.tick());
    simulation.step();
    if (last == simulation.tick()) {
      EXPECT_LE(foretold, last);
    }
  }
  Simulation without(testing::scenarioOf(scenarioText("")));
  EXPECT_EQ(without.nextSampleTick(), std::numeric_limits<Tick>::max());
}

std::string complaintOfSensors(std::string snapshot, const std::string& from, const std::string& to,
                               const Scenario& scenario) {
  const std::size_t place = snapshot.find(from);
  if (place == std::string::npos) return "'" + from + "' is not in the snapshot";
  snapshot.replace(place, from.size(), to);
  return testing::messageOf([&] { parseSnapshot(snapshot, "snap.yaml", scenario); });
}

TEST(SimulationSensors, ADamagedSnapshotIsRefused) {
  const Scenario scenario = testing::scenarioOf(wholeText());
  Simulation simulation(scenario);
  flySensed(simulation, 1337);
  const std::string snapshot = toSnapshot(simulation);
  const auto complaint = [&](const std::string& from, const std::string& to) {
    return complaintOfSensors(snapshot, from, to, scenario);
  };
  EXPECT_NE(complaint("gps: {memory: [", "gps: {memory: [1, ").find("must be a list of at most 12"),
            std::string::npos);
  EXPECT_NE(complaint("gps: {memory: [", "gps: {memory: [0e0").find("snap.yaml: "),
            std::string::npos);
  EXPECT_NE(complaint("{tick: 1200, ", "{tick: 1201, ").find("samples must be of ticks at which"),
            std::string::npos);
  EXPECT_NE(complaint("{tick: 1200, ", "{tick: 1400, ").find("must be 1 to 1337"),
            std::string::npos);
  EXPECT_NE(complaint("{tick: 1200, ", "{tick: 1000, ").find("still on their way"),
            std::string::npos);
  EXPECT_NE(complaint("sensor_hash: '", "sensor_hash: '1").find("sensor_hash: must be that of"),
            std::string::npos);
  EXPECT_NE(complaint("    gps: {", "    gpz: {").find("snap.yaml: "), std::string::npos);
  EXPECT_NE(complaint("sensors:\n", "sensorz:\n").find("snap.yaml: "), std::string::npos);
}

}  // namespace
}  // namespace hovercraft
