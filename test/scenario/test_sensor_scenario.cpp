#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/scenario_parser.h"

#include "../support/files.h"
#include "../support/scenarios.h"
#include "../support/sensor_scenario.h"

namespace hovercraft {
namespace {

std::string sensedScenario(const std::string& sensors, const std::string& model = "planar",
                           const std::string& rest = "") {
  return "step_size: 0.001\nmodel: " + model + "\n" + rest + "vehicles:\n" +
         testing::craftYaml("craft") + sensors;
}

std::string withSensor(const std::string& sensor) {
  return sensedScenario("    sensors: {s: {" + sensor + "}}\n");
}

std::string withWorld(const std::string& sensor) {
  return sensedScenario("    hull: {box: {size: [1, 1, 1]}}\n    sensors: {s: {" + sensor + "}}\n",
                        "planar", "world: {}\n");
}

std::string sensorComplaint(const std::string& text) {
  return testing::messageOf([&] { testing::scenarioOf(text); });
}

TEST(SensorScenario, EveryKeyOfEveryKindIsRead) {
  const Scenario scenario = testing::scenarioOf(sensedScenario(testing::allSensors()));
  const VehicleScenario& craft = scenario.vehicles[0];
  EXPECT_EQ(craft.tf, TfSource::kOdometry);
  ASSERT_EQ(craft.sensors.size(), 4U);  // by name: compass, gps, imu, wheel
  EXPECT_EQ(craft.sensors[0].kind(), SensorKind::kMagnetometer);
  const SensorParameters& imu = craft.sensors[2];
  EXPECT_EQ(imu.name, "imu");
  EXPECT_EQ(imu.period, 5);
  EXPECT_EQ(imu.latency_ns, 3000000);
  EXPECT_EQ(imu.drop, 0.1);
  EXPECT_EQ(imu.p_HS, Vector3(0.1, -0.05, 0.02));
  EXPECT_EQ(imu.rpy, Vector3(0.1, 0.2, 0.3));
  const auto& inertial = std::get<ImuParameters>(imu.model);
  EXPECT_EQ(inertial.gyroscope.noise_density, 3.394e-4);
  EXPECT_EQ(inertial.gyroscope.random_walk, 3.8785e-5);
  EXPECT_EQ(inertial.gyroscope.bias_correlation_time, 1000.0);
  EXPECT_EQ(inertial.gyroscope.turn_on_bias_sigma, 0.0087);
  EXPECT_EQ(inertial.accelerometer.scale, 0.001);
  EXPECT_EQ(inertial.accelerometer.offset, Vector3(0.01, 0.0, -0.02));
  const auto& gnss = std::get<GnssParameters>(craft.sensors[1].model);
  EXPECT_EQ(gnss.latitude_deg, 52.2);
  EXPECT_EQ(gnss.altitude, 110.0);
  EXPECT_EQ(gnss.position.drift, 1.0);
  EXPECT_EQ(gnss.position.drift_frequency, 0.01);
  EXPECT_EQ(gnss.velocity.gaussian_noise, 0.05);
  EXPECT_TRUE(std::get<OdometryParameters>(craft.sensors[3].model).planar);
  EXPECT_EQ(std::get<MagnetometerParameters>(craft.sensors[0].model).field_W,
            Vector3(1e-6, 1.9e-5, -4.6e-5));
}

// The ideal cushion of the planar model carries the weight: an IMU on it feels that.
TEST(SensorScenario, AnImuHasTheGravityOfTheScenarioOrTheStandardOne) {
  const std::string imu = "    sensors: {imu: {kind: imu, rate: 100}}\n";
  const auto gravity_of = [](const std::string& text) {
    const Scenario scenario = testing::scenarioOf(text);
    return std::get<ImuParameters>(scenario.vehicles[0].sensors[0].model).gravity_W;
  };
  EXPECT_EQ(gravity_of(sensedScenario(imu)), Vector3(0.0, 0.0, -9.80665));
  EXPECT_EQ(gravity_of(sensedScenario(imu, "planar", "gravity: [0.5, 0, -9.81]\n")),
            Vector3(0.5, 0.0, -9.81));
  EXPECT_EQ(gravity_of(sensedScenario(imu, "spatial")), Vector3(0.0, 0.0, 0.0));
  EXPECT_EQ(gravity_of(withSensor("kind: imu, rate: 100, gravity: [0, 0, -1.62]")),
            Vector3(0.0, 0.0, -1.62));
}

TEST(SensorScenario, WhatIsWrittenParsesToTheSameText) {
  for (const char* model : {"planar", "spatial"}) {
    const std::string text = sensedScenario(
        testing::allSensors() + testing::laserSensor() + "    hull: {box: {size: [1, 1, 1]}}\n",
        model, "world: {}\n");
    const std::string written = toYaml(testing::scenarioOf(text));
    EXPECT_NE(written.find("kind: laser"), std::string::npos);
    EXPECT_EQ(toYaml(testing::scenarioOf(written)), written);
    for (const char* part : {"tf: odometry", "rate: 200", "latency: 0.003", "drop: 0.1",
                             "position: [0.1, -0.05, 0.02]", "gyroscope_noise_density: 0.0003394",
                             "position_drift_frequency: 0.01", "beams: 271",
                             "range_offset: [0.002, 0.002, 0.002]", "longitude_deg: 21"}) {
      EXPECT_NE(written.find(part), std::string::npos) << part;
    }
  }
}

TEST(SensorScenario, WithoutSensorsNothingIsWritten) {
  const std::string written = toYaml(testing::scenarioOf(sensedScenario("")));
  EXPECT_EQ(written.find("sensors"), std::string::npos);
  EXPECT_EQ(written.find("tf"), std::string::npos);
}

struct Rule {
  const char* sensor;
  const char* message;
};

TEST(SensorScenario, EveryRuleNamesKeyValueAndRule) {
  const std::vector<Rule> rules = {
      {"rate: 100", "s.kind: the key is missing"},
      {"kind: radar, rate: 100",
       "s.kind = radar: must be one of: imu, gnss, odometry, magnetometer, laser"},
      {"kind: imu", "s.rate: the key is missing"},
      {"kind: imu, rate: 0", "s.rate = 0: must be greater than 0"},
      {"kind: imu, rate: 300", "s.rate = 300: must divide the step rate of 1000 Hz"},
      {"kind: imu, rate: 2000", "s.rate = 2000: must divide the step rate of 1000 Hz"},
      {"kind: imu, rate: 1e-20", "s.rate = 1e-20: must divide the step rate of 1000 Hz"},
      {"kind: imu, rate: 100, latency: -1", "s.latency = -1: must be 0 to 60 s"},
      {"kind: imu, rate: 100, latency: 61", "s.latency = 61: must be 0 to 60 s"},
      {"kind: imu, rate: 100, latency: 1e-10",
       "s.latency = 1e-10: must be a whole number of nanoseconds"},
      {"kind: imu, rate: 100, drop: 1.5", "s.drop = 1.5: must be a probability, 0 to 1"},
      {"kind: imu, rate: 100, position: [1, 2]",
       "s.position = [1, 2]: must be a list of three numbers"},
      {"kind: imu, rate: 100, gyroscope_noise_density: -1",
       "s.gyroscope_noise_density = -1: must be 0 to 1e30"},
      {"kind: imu, rate: 100, gyroscope_noise_density: 1e31",
       "s.gyroscope_noise_density = 1e31: must be 0 to 1e30"},
      {"kind: imu, rate: 100, gyroscope_noise_density: 1, gyroscope_gaussian_noise: 1",
       "s.gyroscope_gaussian_noise = 1: must not stand beside gyroscope_noise_density: give one of "
       "them"},
      {"kind: imu, rate: 100, gyroscope_random_walk: 1, gyroscope_drift: 1",
       "s.gyroscope_drift = 1: must not stand beside gyroscope_random_walk: give one of them"},
      {"kind: imu, rate: 100, gyroscope_drift: 1",
       "s.gyroscope_drift = 1: needs gyroscope_drift_frequency greater than 0"},
      {"kind: gnss, rate: 5, longitude_deg: 0", "s.latitude_deg: the key is missing"},
      {"kind: gnss, rate: 5, latitude_deg: 90, longitude_deg: 0",
       "s.latitude_deg = 90: must be -89 to 89 degrees"},
      {"kind: gnss, rate: 5, latitude_deg: 0, longitude_deg: 181",
       "s.longitude_deg = 181: must be -180 to 180 degrees"},
      {"kind: gnss, rate: 5, latitude_deg: 0, longitude_deg: 0, altitude: 1e6",
       "s.altitude = 1e6: must be -10000 to 100000 m"},
      {"kind: magnetometer, rate: 5", "s.field: the key is missing"},
      {"kind: laser, rate: 5, angle_min: 0, angle_max: 1, beams: 3, range_max: 5",
       "a laser needs a world: or a ground: in the scenario"},
  };
  for (const Rule& rule : rules) {
    const std::string found = sensorComplaint(withSensor(rule.sensor));
    EXPECT_NE(found.find(std::string("vehicles.craft.sensors.")), std::string::npos) << found;
    EXPECT_NE(found.find(rule.message), std::string::npos) << rule.sensor << "\n" << found;
  }
}

TEST(SensorScenario, EveryRuleOfALaserToo) {
  const std::string whole =
      "kind: laser, rate: 5, angle_min: -1, angle_max: 1, beams: 3, range_min: "
      "0.1, range_max: 5";
  EXPECT_EQ(sensorComplaint(withWorld(whole)), "nothing was thrown");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    text.replace(text.find(from), from.size(), to);
    return sensorComplaint(withWorld(text));
  };
  const std::vector<std::array<const char*, 3>> rules = {
      {"angle_max: 1", "angle_max: -2", "s.angle_max = -2: must not be less than angle_min"},
      {"angle_max: 1", "angle_max: 6",
       "s.angle_max = 6: must be at most a turn, 6.2832 rad, from "
       "angle_min"},
      {"angle_max: 1", "angle_max: 7", "s.angle_max = 7: must be within a turn"},
      {"beams: 3", "beams: 0", "s.beams = 0: must be 1 to 20000"},
      {"beams: 3", "beams: 2.5", "s.beams = 2.5: must be a whole number"},
      {"beams: 3", "beams: 20001", "s.beams = 20001: must be 1 to 20000"},
      {"range_min: 0.1", "range_min: 5", "s.range_min = 5: must be less than range_max"},
      {"range_max: 5", "range_max: 0", "s.range_max = 0: must be greater than 0"},
      {"range_max: 5", "latency: 60, range_max: 5", "nothing was thrown"},
      {"beams: 3", "latency: 60, beams: 20000",
       "s.latency = 60: must be so short that at most 600000 numbers are on their way"},
  };
  for (const auto& [from, to, message] : rules) {
    EXPECT_NE(changed(from, to).find(message), std::string::npos) << to << "\n"
                                                                  << changed(from, to);
  }
}

// One alone has (60 s 1000 Hz + 1) (3 + 6) = 540,009.
TEST(SensorScenario, AllTogetherHaveABoundForWhatIsOnItsWay) {
  const std::string compass = ": {kind: magnetometer, rate: 1000, latency: 60, field: [0, 0, 0]}\n";
  const auto with_sensors = [&](const std::string& sensors) {
    return testing::messageOf(
        [&] { testing::scenarioOf(testing::sensedCraftYaml("    sensors:\n" + sensors)); });
  };
  EXPECT_EQ(with_sensors("      a" + compass), "nothing was thrown");
  EXPECT_EQ(with_sensors("      a" + compass + "      b" + compass),
            "test: vehicles.craft.sensors.b.latency = 60: must be so short that at most 600000 "
            "numbers are on their way, of all sensors together");
}

TEST(SensorScenario, AKeyOfAnotherKindIsUnknown) {
  for (const char* sensor :
       {"kind: imu, rate: 5, beams: 3", "kind: odometry, rate: 5, position: [0, 0, 0]",
        "kind: gnss, rate: 5, latitude_deg: 0, longitude_deg: 0, rpy: [0, 0, 0]",
        "kind: magnetometer, rate: 5, field: [0, 0, 1], gyroscope_drift: 1"}) {
    EXPECT_NE(
        sensorComplaint(withSensor(sensor)).find("unknown key; known here: kind, rate, latency"),
        std::string::npos)
        << sensor;
  }
}

TEST(SensorScenario, NamesAndTfHaveRules) {
  const auto named = [](const std::string& name) {
    return sensorComplaint(sensedScenario("    sensors: {" + name + ": {kind: imu, rate: 100}}\n"));
  };
  EXPECT_EQ(named("front_imu"), "nothing was thrown");
  EXPECT_NE(named("my-imu").find("the name of a sensor is a ROS name"), std::string::npos);
  EXPECT_NE(named("base_link").find("is its frame: that one is taken"), std::string::npos);
  EXPECT_NE(sensorComplaint(sensedScenario("    tf: odometry\n"))
                .find("vehicles.craft.tf = odometry: needs a sensor of kind odometry"),
            std::string::npos);
  EXPECT_NE(sensorComplaint(sensedScenario("    tf: both\n"))
                .find("vehicles.craft.tf = both: must be one of: truth, odometry, none"),
            std::string::npos);
  EXPECT_EQ(sensorComplaint(sensedScenario("    tf: none\n")), "nothing was thrown");
}

}  // namespace
}  // namespace hovercraft
