#include "hovercraft_sim/sensors/laser_model.h"

#include <algorithm>
#include <limits>

#include "hovercraft_sim/math/elementary.h"

namespace hovercraft {
namespace {

NoiseParameters withoutWhite(NoiseParameters noise) {
  noise.noise_density = 0.0;
  noise.gaussian_noise = 0.0;
  noise.scale = 0.0;
  return noise;
}

}  // namespace

LaserModel::LaserModel(const LaserParameters& parameters, const SensorMount& mount,
                       const SensorSite& site)
    : noise_(withoutWhite(parameters.range), mount.period, mount.channels[0]),
      white_(NoiseProcess(parameters.range, mount.period, mount.channels[0]).white()),
      gain_(1.0 + parameters.range.scale),
      beam_stream_(streamOf(mount.channels[1])),
      range_max_(parameters.range_max),
      R_BS_(mount.R_BS),
      p_BS_(mount.positionInBody()),
      body_(site.body),
      targets_(*site.targets),
      ground_(site.ground) {
  std::size_t most_faces = 0;
  for (const RayTarget& target : targets_) most_faces = std::max(most_faces, target.faces.size());
  faces_.resize(most_faces);
  for (std::int32_t beam = 0; beam < parameters.beams; ++beam) {
    const double angle = parameters.angle_min + beam * parameters.increment();
    fan_.cosines.push_back(exactCos(angle));
    fan_.sines.push_back(exactSin(angle));
  }
}

void LaserModel::start(const SensedInstant& instant, double* memory) const {
  startChannel(noise_, instant.seed, memory);
}

void LaserModel::measure(const SensedInstant& instant, double* memory, double* sample) {
  std::fill_n(sample, sampleSize(), std::numeric_limits<double>::infinity());
  const Pose X_WS = {product(instant.R_WB, R_BS_), times(instant.R_WB, p_BS_) + instant.p_WB};
  for (const RayTarget& target : targets_) {
    if (target.moving == body_) continue;
    const Pose X_WT = target.moving == RayTarget::kFixed
                          ? target.X_WT
                          : poseOf((*instant.bodies)[static_cast<std::size_t>(target.moving)]);
    castBeams(fan_, X_WS, target, X_WT, range_max_, faces_, sample);
  }
  if (ground_ != nullptr) ground_->cast(fan_, X_WS, range_max_, sample);
  addNoise(instant, memory, sample);
}

void LaserModel::addNoise(const SensedInstant& instant, double* memory, double* sample) const {
  const double bias = measureChannel(noise_, instant, Vector3::Zero(), memory).x();
  const NoiseChannel channel(instant.seed, beam_stream_);
  const std::size_t count = sampleSize();
  for (std::size_t beam = 0; beam < count; beam += 2) {
    const std::size_t end = std::min(beam + 2, count);
    // A beam that meets nothing has no noise; nobody depends on its draw.
    std::array<double, 2> white = {0.0, 0.0};
    const bool sees = sample[beam] <= range_max_ || sample[end - 1] <= range_max_;
    if (white_ > 0.0 && sees) {
      white = channel.normals(instant.tick, static_cast<std::uint32_t>(beam / 2));
    }
    for (std::size_t i = beam; i < end; ++i) {
      if (sample[i] > range_max_) {
        sample[i] = kNoReturn;
      } else {
        sample[i] = std::max(0.0, gain_ * sample[i] + (bias + white_ * white[i - beam]));
      }
    }
  }
}

}  // namespace hovercraft
