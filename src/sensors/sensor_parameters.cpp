#include "hovercraft_sim/sensors/sensor_parameters.h"

#include <sstream>

namespace hovercraft {
namespace {

using Names = std::vector<std::string>;

Names wordsOf(const char* text) {
  Names words;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// Those that are not in the traits.
struct FieldNames {
  Names operator()(const OdometryParameters& /*odometry*/) const {
    Names names = {"x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz"};
    // Upper triangle of the covariance of position and rotation, row by row.
    const Names axes = {"x", "y", "z", "roll", "pitch", "yaw"};
    for (std::size_t row = 0; row < axes.size(); ++row) {
      for (std::size_t column = row; column < axes.size(); ++column) {
        names.push_back("cov_" + axes[row] + "_" + axes[column]);
      }
    }
    return names;
  }
  Names operator()(const LaserParameters& laser) const {
    Names names;
    names.reserve(static_cast<std::size_t>(laser.beams));
    for (std::int32_t beam = 0; beam < laser.beams; ++beam) {
      names.push_back("range_" + std::to_string(beam));
    }
    return names;
  }
  template <class Parameters>
  Names operator()(const Parameters& /*parameters*/) const {
    return {};
  }
};

}  // namespace

std::vector<std::string> sensorTopics() {
  Names topics;
  for (int kind = 0; traitsOf(static_cast<SensorKind>(kind)).name != nullptr; ++kind) {
    const SensorTraits traits = traitsOf(static_cast<SensorKind>(kind));
    topics.emplace_back(traits.topic);
    if (traits.velocity_topic != nullptr) topics.emplace_back(traits.velocity_topic);
  }
  return topics;
}

std::vector<std::string> noiseChannels(SensorKind kind) {
  return wordsOf(traitsOf(kind).channels);
}

std::vector<std::string> sampleFields(const SensorParameters& sensor) {
  const Names fields = wordsOf(traitsOf(sensor.kind()).fields);
  return fields.empty() ? std::visit(FieldNames(), sensor.model) : fields;
}

std::vector<std::string> channelNames(const std::string& vehicle, const SensorParameters& sensor) {
  const std::string source = vehicle + "/" + sensor.name + "/";
  Names names;
  for (const std::string& channel : noiseChannels(sensor.kind())) names.push_back(source + channel);
  if (sensor.kind() == SensorKind::kLaser) names.push_back(source + "beam");
  names.push_back(source + "drop");
  return names;
}

}  // namespace hovercraft
