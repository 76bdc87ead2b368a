#include "hovercraft_sim/hovercraft/ground_forces.h"

#include <utility>

namespace hovercraft {

GroundForces::GroundForces(std::optional<Cushion> cushion, Pads pads,
                           std::optional<double> planar_load)
    : cushion_(std::move(cushion)), pads_(std::move(pads)), planar_load_(planar_load) {}

Wrench GroundForces::wrenchInBody(const BodyMotion& motion, const Environment& environment,
                                  const FanSpeeds& speeds) const {
  if (planar_load_) return cushion_->planarWrenchInBody(motion, speeds, *planar_load_);
  if (pads_.empty()) return cushion_->wrenchInBody(motion, speeds, *environment.ground);
  Wrench standing = pads_.wrenchInBody(motion, *environment.bare_ground);
  if (!cushion_) return standing;
  return cushion_->wrenchInBody(motion, speeds, *environment.ground) + standing;
}

void GroundForces::report(const BodyMotion& motion, const Environment& environment,
                          const FanSpeeds& speeds, CellReport* reports) const {
  if (planar_load_) {
    cushion_->planarReport(speeds, *planar_load_, reports);
  } else {
    cushion_->report(motion, speeds, *environment.ground, reports);
  }
}

}  // namespace hovercraft
