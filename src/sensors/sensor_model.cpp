#include "hovercraft_sim/sensors/sensor_model.h"

#include <cmath>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/rotation.h"
#include "hovercraft_sim/sensors/inertial_models.h"
#include "hovercraft_sim/sensors/laser_model.h"
#include "hovercraft_sim/sensors/noise_process.h"
#include "hovercraft_sim/sensors/odometry_model.h"

namespace hovercraft {
namespace {

struct ModelMaker {
  const SensorMount& mount;
  const SensorSite& site;

  std::unique_ptr<SensorModel> operator()(const ImuParameters& imu) const {
    return std::make_unique<ImuModel>(imu, mount);
  }
  std::unique_ptr<SensorModel> operator()(const GnssParameters& gnss) const {
    return std::make_unique<GnssModel>(gnss, mount);
  }
  std::unique_ptr<SensorModel> operator()(const OdometryParameters& odometry) const {
    return std::make_unique<OdometryModel>(odometry, mount);
  }
  std::unique_ptr<SensorModel> operator()(const MagnetometerParameters& magnetometer) const {
    return std::make_unique<MagnetometerModel>(magnetometer, mount);
  }
  std::unique_ptr<SensorModel> operator()(const LaserParameters& laser) const {
    return std::make_unique<LaserModel>(laser, mount, site);
  }
};

}  // namespace

std::unique_ptr<SensorModel> makeSensorModel(const SensorParameters& parameters,
                                             const SensorSite& site) {
  const FloatingPointEnvironment environment;
  SensorMount mount;
  mount.R_BS = rotationFromRpy(parameters.rpy);
  mount.p_HS = parameters.p_HS;
  mount.p_HB = site.p_HB;
  mount.step = site.step;
  mount.period = static_cast<double>(parameters.period) * site.step;
  mount.channels = channelNames(site.vehicle, parameters);
  return std::visit(ModelMaker{mount, site}, parameters.model);
}

std::vector<double> sampleVariances(const SensorParameters& parameters, double step) {
  const FloatingPointEnvironment environment;
  const double period = static_cast<double>(parameters.period) * step;
  std::vector<double> variances;
  const auto noises =
      std::visit([](const auto& model) { return model.noises(); }, parameters.model);
  for (const NoiseParameters& noise : noises) {
    variances.push_back(NoiseProcess(noise, period, "").variance());
  }
  return variances;
}

}  // namespace hovercraft
