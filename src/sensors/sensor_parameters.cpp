#include "hovercraft_sim/sensors/sensor_parameters.h"

namespace hovercraft {
namespace {

using Names = std::vector<std::string>;

struct FieldNames {
  Names operator()(const ImuParameters& /*imu*/) const {
    return {"wx", "wy", "wz", "ax", "ay", "az"};
  }
  Names operator()(const GnssParameters& /*gnss*/) const {
    return {"latitude", "longitude", "altitude", "v_east", "v_north", "v_up"};
  }
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
  Names operator()(const MagnetometerParameters& /*magnetometer*/) const {
    return {"mx", "my", "mz"};
  }
  Names operator()(const LaserParameters& laser) const {
    Names names;
    names.reserve(static_cast<std::size_t>(laser.beams));
    for (std::int32_t beam = 0; beam < laser.beams; ++beam) {
      names.push_back("range_" + std::to_string(beam));
    }
    return names;
  }
};

/// The channels of each kind.
Names channelsOf(SensorKind kind) {
  switch (kind) {
    case SensorKind::kImu:
      return {"gyroscope", "accelerometer"};
    case SensorKind::kGnss:
      return {"position", "velocity"};
    case SensorKind::kOdometry:
      return {"linear", "angular"};
    case SensorKind::kMagnetometer:
      return {"field"};
    case SensorKind::kLaser:
      return {"range", "beam"};
  }
  return {};
}

}  // namespace

std::vector<std::string> sampleFields(const SensorParameters& sensor) {
  return std::visit(FieldNames(), sensor.model);
}

std::vector<std::string> channelNames(const std::string& vehicle, const SensorParameters& sensor) {
  const std::string source = vehicle + "/" + sensor.name + "/";
  Names names;
  for (const std::string& channel : channelsOf(sensor.kind())) {
    names.push_back(source + channel);
  }
  names.push_back(source + "drop");
  return names;
}

}  // namespace hovercraft
