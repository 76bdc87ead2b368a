#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/body/steppers.h"
#include "hovercraft_sim/cushion/body_motion.h"
#include "hovercraft_sim/cushion/cell_pressure.h"
#include "hovercraft_sim/cushion/cushion_layout.h"
#include "hovercraft_sim/cushion/fan_curve.h"
#include "hovercraft_sim/cushion/ground.h"
#include "hovercraft_sim/cushion/ground_spring.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// Bounds on the parts of one cushion: what is needed of them in a step lies on the stack.
constexpr std::size_t kMaxCells = 16;
constexpr std::size_t kMaxHemPoints = 64;  // of all cells together
constexpr std::size_t kMaxFans = 8;        // lift fans

/// A point of the hem and the length of hem that it stands for.
struct HemPoint {
  Vector3 p_HK = Vector3::Zero();  // in the hull frame, m
  double length = 0.0;             // m, > 0
};

/// A cell of the cushion: the air under a part of the craft, closed in by hem.
struct CushionCell {
  Vector3 p_HC = Vector3::Zero();  // centroid of its area, in the hull frame, m
  double area = 0.0;               // S, m², > 0
  double height = 0.0;             // H = V/S at hover, m, > 0: for the margin of stability only
  std::size_t fan = 0;             // that feeds it
  std::vector<HemPoint> hem;       // its points, in any order
};

/// A speed (share of the nominal one, >= 0) that a fan has at a time (s).
struct FanSpeedPoint {
  double time = 0.0;   // s
  double speed = 1.0;  // share of the nominal one
};

/// A lift fan as each of the cells that it feeds sees it.
struct CushionFan {
  std::string name;                        // its key in the scenario
  FanCurve curve;                          // of one cell's share
  Vector3 p_HI = Vector3::Zero();          // intake, in the hull frame, m
  double speed = 1.0;                      // share of the nominal speed, >= 0; of one that an
                                           // actuator turns the greatest
  std::vector<FanSpeedPoint> speeds = {};  // instead of it: in between on straight lines, held at
                                           // the ends; times ascend. Empty: always `speed`
  std::string lift_fan = {};  // the actuator of the craft that turns it instead; empty: none

  /// @param time s.
  double speedAt(double time) const;
  double fullSpeed() const;  // the greatest
};

/// The skirt as a spring.
struct Skirt {
  double stiffness = 0.0;  // k_s, N/m², of a metre of hem; 0: the skirt carries nothing
  GroundSpring spring;     // of a point of the hem
};

/// A cushion as the scenario describes it.
struct CushionParameters {
  double discharge = 0.6;          // C_d, of the escape under the hem
  double residual_gap = 1e-4;      // d, m, > 0
  double air_density = 1.225;      // rho, kg/m³, > 0
  std::vector<CushionFan> fans;    // that feed the cells
  std::vector<CushionCell> cells;  // in the order of the scenario
  Skirt skirt;                     // none by default: it carries nothing
};

/// The speeds of the fans, shares of their nominal ones.
using FanSpeeds = std::array<double, kMaxFans>;

/// The speeds of the fans over one step: at its stages, and in between.
struct FanSpeedCourse {
  FanSpeeds start;   // at t
  FanSpeeds middle;  // at t + h/2
  FanSpeeds end;     // at t + h

  /// Over the piece from `from` to `to` of a step of h, all in s: straight between the stages.
  FanSpeedCourse piece(double from, double to, double h) const;

  /// At a stage of the step that the course is of.
  const FanSpeeds& at(Stage stage) const {
    if (stage == Stage::kStart) return start;
    return stage == Stage::kMiddle ? middle : end;
  }
};

/// One cell as it is reported.
struct CellReport {
  double pressure = 0.0;  // Pa
  double gap = 0.0;       // m, mean height of its hem above the ground
  double flow = 0.0;      // m³/s, of its fan
  double force = 0.0;     // N, along z of B
};

/// The air cushion of a craft: cells under quasi-static pressure, the skirt around them, and the
/// drag of the air that the fans take in (doc/craft.md). No state of its own.
///
/// Sums go over the hem of a cell in a fixed order, and over cells and points of the skirt in
/// mirrored pairs: the moment of a symmetric craft is 0 to the last bit.
class HOVERCRAFT_PUBLIC Cushion {
 public:
  /// @param parameters within the bounds above; checked before. @param p_HB centre of mass in the
  /// hull frame, m.
  Cushion(const CushionParameters& parameters, const Vector3& p_HB);

  /// The wrench on the craft about its centre of mass, in B: pressure, skirt, momentum drag.
  Wrench wrenchInBody(const BodyMotion& motion, const FanSpeeds& speeds,
                      const Ground& ground) const;

  /// The same in the planar model, where height is not computed: the cushion carries what it can of
  /// the load, and the skirt grinds under the rest. (18) @param load N, on the ground, >= 0.
  Wrench planarWrenchInBody(const BodyMotion& motion, const FanSpeeds& speeds, double load) const;

  /// @param reports one for each cell, as many as cellCount().
  void report(const BodyMotion& motion, const FanSpeeds& speeds, const Ground& ground,
              CellReport* reports) const;
  /// The same of planarWrenchInBody().
  void planarReport(const FanSpeeds& speeds, double load, CellReport* reports) const;

  /// The fans' speeds as they are described, at a time, s. Those that actuators turn: the greatest.
  FanSpeeds describedSpeeds(double time) const;
  /// The greatest that they are described with.
  FanSpeeds fullSpeeds() const;

  std::size_t cellCount() const { return layout_.cells.size(); }       // as parameters()
  const CushionParameters& parameters() const { return parameters_; }  // as given
  const CushionLayout& layout() const { return layout_; }              // as worked out

 private:
  using Hem = CushionLayout::Hem;
  using Cell = CushionLayout::Cell;
  using Column = std::array<double, kMaxHemPoints>;  // one number of each hem point
  struct Airs;                                       // of all cells
  class PlaneProbe;
  class SampledProbe;
  class HemWrenches;

  template <class Probe>
  HOVERCRAFT_HIDDEN void blow(const BodyMotion& motion, const FanSpeeds& speeds, const Probe& probe,
                              Airs& airs) const;
  void planarAirs(const FanSpeeds& speeds, double load, Airs& airs) const;
  template <class Probe>
  HOVERCRAFT_HIDDEN Wrench wrenchOver(const BodyMotion& motion, const FanSpeeds& speeds,
                                      const Probe& probe) const;
  Wrench pressureWrench(const Airs& airs) const;
  template <class Probe>
  HOVERCRAFT_HIDDEN Wrench skirtWrench(const BodyMotion& motion, const Probe& probe,
                                       const Airs& airs) const;
  Wrench momentumDrag(const BodyMotion& motion, const Airs& airs) const;
  void write(const Airs& airs, CellReport* reports) const;

  CushionParameters parameters_;
  CushionLayout layout_;
};

}  // namespace hovercraft
