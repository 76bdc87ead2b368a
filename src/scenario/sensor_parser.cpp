#include "hovercraft_sim/scenario/sensor_parser.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>
#include <vector>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/noise.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/scenario/air_parser.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/step_time.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

using Keys = std::vector<std::string>;

constexpr double kMostNoise = 1e30;       // of any unit: its square is still a number
constexpr double kMostBeams = 20000.0;    // a turn in steps of a minute of arc
constexpr double kLongestLatency = 60.0;  // s

/// Numbers of all sensors that wait to be delivered. Snapshots hold them in up to 26 bytes each,
/// and take what is a text of kLongestYamlText and of kMostYamlValues at most.
constexpr double kMostOnTheirWay = 600000.0;
constexpr double kNumbersOfASample = 6.0;  // what a sample takes besides its values: as much text

constexpr double kStandardGravity = 9.80665;  // m/s²

const NumberRule kNoise = {[](double x) { return x >= 0.0 && x <= kMostNoise; },
                           "must be 0 to 1e30"};
const NumberRule kSignedNoise = {[](double x) { return x >= -kMostNoise && x <= kMostNoise; },
                                 "must be at most 1e30, of either sign"};
const NumberRule kProbability = {[](double x) { return x >= 0.0 && x <= 1.0; },
                                 "must be a probability, 0 to 1"};
const NumberRule kLatency = {[](double x) { return x >= 0.0 && x <= kLongestLatency; },
                             "must be 0 to 60 s"};
const NumberRule kLatitude = {[](double x) { return x >= -89.0 && x <= 89.0; },
                              "must be -89 to 89 degrees"};
const NumberRule kLongitude = {[](double x) { return x >= -180.0 && x <= 180.0; },
                               "must be -180 to 180 degrees"};
const NumberRule kAltitude = {[](double x) { return x >= -1e4 && x <= 1e5; },
                              "must be -10000 to 100000 m"};
const NumberRule kBeams = {[](double x) { return x >= 1.0 && x <= kMostBeams; },
                           "must be 1 to 20000"};
const NumberRule kAngle = {[](double x) { return x >= -2.0 * kPi && x <= 2.0 * kPi; },
                           "must be within a turn, -6.2832 to 6.2832 rad"};

// ---- noise ----

constexpr const char* kNoiseKeys[] = {"noise_density",         "gaussian_noise", "random_walk",
                                      "bias_correlation_time", "drift",          "drift_frequency",
                                      "turn_on_bias_sigma",    "scale",          "offset"};

void addNoiseKeys(Keys& keys, const std::string& channel) {
  for (const char* key : kNoiseKeys) keys.push_back(channel + "_" + key);
}

void refuseTogether(const ConfigReader& reader, const std::string& a, const std::string& b) {
  if (!reader.has(a.c_str()) || !reader.has(b.c_str())) return;
  reader.fail(b, fmt::format("must not stand beside {}: give one of them", a));
}

NoiseParameters parseNoise(const ConfigReader& reader, const std::string& channel) {
  const auto key = [&channel](const char* name) { return channel + "_" + name; };
  const auto number = [&](const char* name, const NumberRule& rule) {
    return reader.numberOr(0.0, key(name).c_str(), rule);
  };
  refuseTogether(reader, key("noise_density"), key("gaussian_noise"));
  for (const char* of_kalibr : {"random_walk", "bias_correlation_time"}) {
    for (const char* of_hector : {"drift", "drift_frequency"}) {
      refuseTogether(reader, key(of_kalibr), key(of_hector));
    }
  }
  NoiseParameters noise;
  noise.noise_density = number("noise_density", kNoise);
  noise.gaussian_noise = number("gaussian_noise", kNoise);
  noise.random_walk = number("random_walk", kNoise);
  noise.bias_correlation_time = number("bias_correlation_time", kNoise);
  noise.drift = number("drift", kNoise);
  noise.drift_frequency = number("drift_frequency", kNoise);
  noise.turn_on_bias_sigma = number("turn_on_bias_sigma", kNoise);
  noise.scale = number("scale", kSignedNoise);
  if (reader.has(key("offset").c_str())) {
    noise.offset = reader.numberOrVector(key("offset").c_str(), kSignedNoise);
  }
  if (noise.drift > 0.0 && noise.drift_frequency == 0.0) {
    reader.fail(key("drift"), fmt::format("needs {} greater than 0", key("drift_frequency")));
  }
  return noise;
}

std::string noiseText(const std::string& channel, const NoiseParameters& noise) {
  std::string text;
  const auto add = [&](const char* name, double value) {
    text += fmt::format(", {}_{}: {}", channel, name, yamlNumber(value));
  };
  if (noise.gaussian_noise > 0.0) {
    add("gaussian_noise", noise.gaussian_noise);
  } else {
    add("noise_density", noise.noise_density);
  }
  if (noise.drift > 0.0 || noise.drift_frequency > 0.0) {
    add("drift", noise.drift);
    add("drift_frequency", noise.drift_frequency);
  } else {
    add("random_walk", noise.random_walk);
    add("bias_correlation_time", noise.bias_correlation_time);
  }
  add("turn_on_bias_sigma", noise.turn_on_bias_sigma);
  add("scale", noise.scale);
  return text + fmt::format(", {}_offset: {}", channel, yamlVector(noise.offset));
}

// ---- models ----

/// What the models need of the scenario.
struct SensorContext {
  const Scenario& scenario;

  Vector3 gravity() const {
    Vector3 g = scenario.gravity;
    // The ideal cushion of the planar model carries the weight: a scenario need not say it.
    if (scenario.model == BodyModel::kPlanar && g.z() == 0.0) g.z() = -kStandardGravity;
    return g;
  }
};

/// Those of a kind alone, besides its noise.
Keys ownKeysOf(SensorKind kind) {
  switch (kind) {
    case SensorKind::kImu:
      return {"gravity"};
    case SensorKind::kGnss:
      return {"latitude_deg", "longitude_deg", "altitude"};
    case SensorKind::kOdometry:
      return {};
    case SensorKind::kMagnetometer:
      return {"field"};
    case SensorKind::kLaser:
      return {"angle_min", "angle_max", "beams", "range_min", "range_max"};
  }
  return {};
}

Keys keysOf(SensorKind kind) {
  Keys keys = {"kind", "rate", "latency", "drop"};
  const SensorPlace place = traitsOf(kind).place;
  if (place != SensorPlace::kNone) keys.emplace_back("position");
  if (place == SensorPlace::kPositionAndAxes) keys.emplace_back("rpy");
  const Keys own = ownKeysOf(kind);
  keys.insert(keys.end(), own.begin(), own.end());
  for (const std::string& channel : noiseChannels(kind)) addNoiseKeys(keys, channel);
  return keys;
}

LaserParameters parseLaser(const ConfigReader& reader, const SensorContext& context) {
  if (!context.scenario.world && !context.scenario.ground) {
    reader.fail("", "a laser needs a world: or a ground: in the scenario");
  }
  LaserParameters laser;
  laser.angle_min = reader.number("angle_min", kAngle);
  laser.angle_max = reader.number("angle_max", kAngle);
  if (laser.angle_max < laser.angle_min) {
    reader.fail("angle_max", "must not be less than angle_min");
  }
  if (laser.angle_max - laser.angle_min > 2.0 * kPi) {
    reader.fail("angle_max", "must be at most a turn, 6.2832 rad, from angle_min");
  }
  reader.number("beams", kBeams);
  laser.beams = static_cast<std::int32_t>(reader.wholeNumberOr(1, "beams"));
  laser.range_min = reader.numberOr(0.0, "range_min", kNotNegative);
  laser.range_max = reader.length("range_max");
  if (!(laser.range_min < laser.range_max)) {
    reader.fail("range_min", "must be less than range_max");
  }
  laser.range = parseNoise(reader, "range");
  return laser;
}

void parseModel(const ConfigReader& reader, SensorKind kind, const SensorContext& context,
                SensorParameters& sensor) {
  switch (kind) {
    case SensorKind::kImu:
      sensor.model =
          ImuParameters{parseNoise(reader, "gyroscope"), parseNoise(reader, "accelerometer"),
                        reader.vectorOr(context.gravity(), "gravity", kSignedNoise)};
      break;
    case SensorKind::kGnss:
      sensor.model = GnssParameters{reader.number("latitude_deg", kLatitude),
                                    reader.number("longitude_deg", kLongitude),
                                    reader.numberOr(0.0, "altitude", kAltitude),
                                    parseNoise(reader, "position"), parseNoise(reader, "velocity")};
      break;
    case SensorKind::kOdometry:
      sensor.model = OdometryParameters{parseNoise(reader, "linear"), parseNoise(reader, "angular"),
                                        context.scenario.model == BodyModel::kPlanar};
      break;
    case SensorKind::kMagnetometer:
      sensor.model =
          MagnetometerParameters{reader.vector("field", kSignedNoise), parseNoise(reader, "field")};
      break;
    case SensorKind::kLaser:
      sensor.model = parseLaser(reader, context);
      break;
  }
}

SensorParameters parseSensor(const std::string& name, const ConfigReader& reader,
                             const SensorContext& context) {
  if (!isGraphName(name)) {
    reader.fail("", "the name of a sensor is a ROS name: a letter, then letters, digits and _");
  }
  for (const char* frame : {"base_link", "odom", "engine_rear", "engine_left", "engine_right"}) {
    if (name == frame) reader.fail("", "the name of a sensor is its frame: that one is taken");
  }
  reader.text("kind");  // must be there
  const auto kind = static_cast<SensorKind>(reader.choiceOr(0, "kind", sensorKindNames()));
  reader.allowOnly(keysOf(kind));
  SensorParameters sensor;
  sensor.name = name;
  sensor.rate = reader.number("rate", kPositive);
  const double step = context.scenario.stepSize();
  const auto period = wholeSteps(1.0 / (sensor.rate * step));
  if (!period) {
    reader.fail("rate", fmt::format("must divide the step rate of {:.9g} Hz", 1.0 / step));
  }
  sensor.period = *period;
  sensor.latency_ns = nanosecondsOf(reader, "latency", reader.numberOr(0.0, "latency", kLatency));
  sensor.drop = reader.numberOr(0.0, "drop", kProbability);
  sensor.p_HS = reader.vectorOr(Vector3::Zero(), "position", kCoordinate);
  sensor.rpy = reader.vectorOr(Vector3::Zero(), "rpy");
  parseModel(reader, kind, context, sensor);
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

/// The keys of a kind alone, with a comma before each.
struct ModelWriter {
  std::string operator()(const ImuParameters& imu) const {
    return ", gravity: " + yamlVector(imu.gravity_W);
  }
  std::string operator()(const GnssParameters& gnss) const {
    return fmt::format(", latitude_deg: {}, longitude_deg: {}, altitude: {}",
                       yamlNumber(gnss.latitude_deg), yamlNumber(gnss.longitude_deg),
                       yamlNumber(gnss.altitude));
  }
  std::string operator()(const OdometryParameters& /*odometry*/) const { return ""; }
  std::string operator()(const MagnetometerParameters& magnetometer) const {
    return ", field: " + yamlVector(magnetometer.field_W);
  }
  std::string operator()(const LaserParameters& laser) const {
    return fmt::format(", angle_min: {}, angle_max: {}, beams: {}, range_min: {}, range_max: {}",
                       yamlNumber(laser.angle_min), yamlNumber(laser.angle_max), laser.beams,
                       yamlNumber(laser.range_min), yamlNumber(laser.range_max));
  }
};

std::string sensorText(const SensorParameters& sensor) {
  const SensorTraits traits = traitsOf(sensor.kind());
  std::string text = fmt::format("      {}: {{kind: {}, rate: {}, latency: {}, drop: {}",
                                 yamlText(sensor.name), traits.name, yamlNumber(sensor.rate),
                                 yamlNumber(toSeconds(sensor.latency_ns)), yamlNumber(sensor.drop));
  if (traits.place != SensorPlace::kNone) text += ", position: " + yamlVector(sensor.p_HS);
  if (traits.place == SensorPlace::kPositionAndAxes) text += ", rpy: " + yamlVector(sensor.rpy);
  text += std::visit(ModelWriter(), sensor.model);
  const auto noises = std::visit([](const auto& model) { return model.noises(); }, sensor.model);
  const Keys channels = noiseChannels(sensor.kind());
  for (std::size_t i = 0; i < channels.size(); ++i) text += noiseText(channels[i], noises[i]);
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
        vehicle.sensors.push_back(parseSensor(name, sensor, {scenario}));
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
