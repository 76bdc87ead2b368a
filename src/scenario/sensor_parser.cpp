#include "hovercraft_sim/scenario/sensor_parser.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>
#include <vector>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/noise.h"
#include "hovercraft_sim/scenario/air_parser.h"
#include "hovercraft_sim/scenario/key_table.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/sensor_keys.h"
#include "hovercraft_sim/scenario/step_time.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

using Keys = std::vector<std::string>;

/// Numbers of all sensors that wait to be delivered. Snapshots hold them in up to 26 bytes each,
/// and take what is a text of kLongestYamlText and of kMostYamlValues at most.
constexpr double kMostOnTheirWay = 600000.0;
constexpr double kNumbersOfASample = 6.0;  // what a sample takes besides its values: as much text

constexpr double kStandardGravity = 9.80665;  // m/s²

// ---- noise ----

void refuseTogether(const ConfigReader& reader, const std::string& a, const std::string& b) {
  if (!reader.has(a.c_str()) || !reader.has(b.c_str())) return;
  reader.fail(b, fmt::format("must not stand beside {}: give one of them", a));
}

NoiseParameters parseNoise(const ConfigReader& reader, const std::string& channel) {
  const auto key = [&channel](const char* name) { return channel + "_" + name; };
  refuseTogether(reader, key("noise_density"), key("gaussian_noise"));
  for (const char* of_kalibr : {"random_walk", "bias_correlation_time"}) {
    for (const char* of_hector : {"drift", "drift_frequency"}) {
      refuseTogether(reader, key(of_kalibr), key(of_hector));
    }
  }
  NoiseParameters noise;
  readKeys(reader, kNoiseKeys, noise, channel + "_");
  if (noise.drift > 0.0 && noise.drift_frequency == 0.0) {
    reader.fail(key("drift"), fmt::format("needs {} greater than 0", key("drift_frequency")));
  }
  return noise;
}

// ---- models ----

/// What a body at rest does not fall with.
Vector3 gravityOf(const Scenario& scenario) {
  Vector3 g = scenario.gravity;
  // The ideal cushion of the planar model carries the weight: a scenario need not say it.
  if (scenario.model == BodyModel::kPlanar && g.z() == 0.0) g.z() = -kStandardGravity;
  return g;
}

/// A sensor of a kind before its keys are read.
SensorParameters unreadSensor(SensorKind kind, const Scenario& scenario) {
  SensorParameters sensor;
  sensor.model = unreadModel(kind);
  if (auto* imu = std::get_if<ImuParameters>(&sensor.model)) imu->gravity_W = gravityOf(scenario);
  if (auto* odometry = std::get_if<OdometryParameters>(&sensor.model)) {
    odometry->planar = scenario.model == BodyModel::kPlanar;
  }
  return sensor;
}

Keys keysOf(const SensorParameters& sensor) {
  Keys keys = together({{"kind"}, keyNames(kSensorKeys, sensor)});
  for (const std::string& channel : noiseChannels(sensor.kind())) {
    keys = together({keys, keyNames(kNoiseKeys, NoiseParameters(), channel + "_")});
  }
  return keys;
}

void checkLaser(const ConfigReader& reader, const LaserParameters& laser) {
  if (laser.angle_max < laser.angle_min) {
    reader.fail("angle_max", "must not be less than angle_min");
  }
  if (laser.angle_max - laser.angle_min > 2.0 * kPi) {
    reader.fail("angle_max", "must be at most a turn, 6.2832 rad, from angle_min");
  }
  if (!(laser.range_min < laser.range_max)) {
    reader.fail("range_min", "must be less than range_max");
  }
}

SensorParameters parseSensor(const std::string& name, const ConfigReader& reader,
                             const Scenario& scenario) {
  if (!isGraphName(name)) {
    reader.fail("", "the name of a sensor is a ROS name: a letter, then letters, digits and _");
  }
  for (const char* frame : {"base_link", "odom", "engine_rear", "engine_left", "engine_right"}) {
    if (name == frame) reader.fail("", "the name of a sensor is its frame: that one is taken");
  }
  SensorKind kind = SensorKind::kImu;
  ChoiceKey("kind", sensorKindNames()).read(reader, "kind", kind);
  SensorParameters sensor = unreadSensor(kind, scenario);
  sensor.name = name;
  reader.allowOnly(keysOf(sensor));
  if (kind == SensorKind::kLaser && !scenario.world && !scenario.ground) {
    reader.fail("", "a laser needs a world: or a ground: in the scenario");
  }
  readKeys(reader, kSensorKeys, sensor);
  const double step = scenario.stepSize();
  const auto period = wholeSteps(1.0 / (sensor.rate * step));
  if (!period) {
    reader.fail("rate", fmt::format("must divide the step rate of {:.9g} Hz", 1.0 / step));
  }
  sensor.period = *period;
  if (const auto* laser = std::get_if<LaserParameters>(&sensor.model)) checkLaser(reader, *laser);
  const Keys channels = noiseChannels(kind);
  const std::vector<NoiseParameters*> noises = std::visit(NoisesOf(), sensor.model);
  for (std::size_t i = 0; i < channels.size(); ++i) *noises[i] = parseNoise(reader, channels[i]);
  return sensor;
}

/// What may wait of a sensor's samples, in numbers of a snapshot.
double numbersOnTheirWay(const SensorParameters& sensor, const Scenario& scenario) {
  const double samples =
      static_cast<double>(sensor.latency_ns) /
      (static_cast<double>(sensor.period) * static_cast<double>(scenario.step_ns));
  return (samples + 1.0) * (static_cast<double>(sampleFields(sensor).size()) + kNumbersOfASample);
}

void parseTf(const ConfigReader& reader, VehicleScenario& vehicle) {
  vehicle.tf = static_cast<TfSource>(
      reader.choiceOr(static_cast<std::size_t>(vehicle.tf), "tf", tfSourceNames()));
  const bool has_odometry =
      std::any_of(vehicle.sensors.begin(), vehicle.sensors.end(),
                  [](const auto& sensor) { return sensor.kind() == SensorKind::kOdometry; });
  if (vehicle.tf == TfSource::kOdometry && !has_odometry) {
    reader.fail("tf", "needs a sensor of kind odometry");
  }
}

// ---- text ----

std::string sensorText(const SensorParameters& sensor) {
  std::string text = fmt::format("      {}: {{kind: {}, {}", yamlText(sensor.name),
                                 traitsOf(sensor.kind()).name, keysText(kSensorKeys, sensor));
  const auto noises = std::visit([](const auto& model) { return model.noises(); }, sensor.model);
  const Keys channels = noiseChannels(sensor.kind());
  for (std::size_t i = 0; i < channels.size(); ++i) {
    text += ", " + keysText(kNoiseKeys, noises[i], channels[i] + "_");
  }
  return text + "}\n";
}

/// Sensors have other noise than the gusts, too.
void addGusts(const ConfigReader& top, const Scenario& scenario, NoiseStreams& streams) {
  if (!scenario.gusts) return;
  try {
    for (const std::string& body : bodyNames(scenario)) {
      for (const std::string& channel : Gusts::channelsOf(body)) streams.add(channel);
    }
  } catch (const std::invalid_argument& error) {
    top.map("gusts").fail("", error.what());
  }
}

/// What the sensors of all craft share.
struct SharedBounds {
  NoiseStreams streams;
  double on_their_way = 0.0;
};

void addSensor(const ConfigReader& reader, const std::string& vehicle,
               const SensorParameters& sensor, const Scenario& scenario, SharedBounds& shared) {
  shared.on_their_way += numbersOnTheirWay(sensor, scenario);
  if (shared.on_their_way > kMostOnTheirWay) {
    reader.fail("latency", fmt::format("must be so short that at most {:.0f} numbers are on "
                                       "their way, of all sensors together",
                                       kMostOnTheirWay));
  }
  try {
    for (const std::string& channel : channelNames(vehicle, sensor)) shared.streams.add(channel);
  } catch (const std::invalid_argument& error) {
    reader.fail("", error.what());
  }
}

}  // namespace

void parseSensors(const ConfigReader& top, Scenario& scenario) {
  const ConfigReader vehicles = top.map("vehicles");
  SharedBounds shared;
  addGusts(top, scenario, shared.streams);
  for (VehicleScenario& vehicle : scenario.vehicles) {
    const ConfigReader reader = vehicles.map(vehicle.name);
    if (reader.has("sensors")) {
      for (const auto& [name, sensor] : reader.map("sensors").maps()) {
        vehicle.sensors.push_back(parseSensor(name, sensor, scenario));
        addSensor(sensor, vehicle.name, vehicle.sensors.back(), scenario, shared);
      }
    }
    parseTf(reader, vehicle);
  }
}

std::string sensorsYaml(const VehicleScenario& vehicle) {
  if (vehicle.sensors.empty() && vehicle.tf == TfSource::kTruth) return "";
  std::string yaml =
      fmt::format("    tf: {}\n", tfSourceNames()[static_cast<std::size_t>(vehicle.tf)]);
  if (vehicle.sensors.empty()) return yaml;
  yaml += "    sensors:\n";
  for (const SensorParameters& sensor : vehicle.sensors) yaml += sensorText(sensor);
  return yaml;
}

}  // namespace hovercraft
