#pragma once

#include <optional>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/cushion/cushion.h"
#include "hovercraft_sim/cushion/pads.h"
#include "hovercraft_sim/hovercraft/environment.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// What the ground does to a body besides contact: its cushion, and its hull on springs where the
/// ground is no polyhedron.
class HOVERCRAFT_PUBLIC GroundForces {
 public:
  /// @param planar_load m g along z, N: what cushion and skirt carry together in the planar model;
  /// none in the spatial one.
  GroundForces(std::optional<Cushion> cushion, Pads pads, std::optional<double> planar_load);

  /// The wrench on the body about its centre of mass, in B. Not inlined: a craft without it keeps
  /// the code of its step. @param speeds of the fans; only with a cushion.
  [[gnu::noinline]] Wrench wrenchInBody(const BodyMotion& motion, const Environment& environment,
                                        const FanSpeeds& speeds) const;

  const std::optional<Cushion>& cushion() const { return cushion_; }  // none: no cushion
  const Pads& pads() const { return pads_; }                          // empty: no pads
  /// N, on the ground; only in the planar model.
  const std::optional<double>& planarLoad() const { return planar_load_; }
  /// @param reports one for each cell. Only with a cushion.
  void report(const BodyMotion& motion, const Environment& environment, const FanSpeeds& speeds,
              CellReport* reports) const;

 private:
  std::optional<Cushion> cushion_;
  Pads pads_;
  std::optional<double> planar_load_;
};

}  // namespace hovercraft
