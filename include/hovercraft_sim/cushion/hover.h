#pragma once

#include <array>
#include <vector>

#include "hovercraft_sim/body/steppers.h"
#include "hovercraft_sim/cushion/cushion.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// The ways in which a craft swings on its cushion.
enum class HoverMotion : int { kHeave = 0, kPitch = 1, kRoll = 2 };
constexpr std::size_t kHoverMotions = 3;
constexpr std::array<const char*, kHoverMotions> kHoverMotionNames = {"heave", "pitch", "roll"};

/// One of them by itself, linearised about the hover: M q'' + D q' + K q = 0. (10), (13b)
struct HoverMode {
  double inertia = 0.0;    // M, kg or kg m²
  double damping = 0.0;    // D, N s/m or N m s
  double stiffness = 0.0;  // K, N/m or N m
  double margin = 0.0;     // M of (12): below 1 compressible air swings by itself

  double frequency() const;     // omega = sqrt(K/M), 1/s; 0 without stiffness
  double dampingRatio() const;  // zeta = D/(2 M omega); 0 without stiffness
};

/// What hovers.
struct HoverBody {
  double mass = 0.0;                      // kg
  Matrix3 I_BBo_B = Matrix3::Identity();  // kg m², about the centre of mass
  double gravity = 0.0;                   // m/s², along -z of W, > 0
};

enum class [[nodiscard]] HoverStatus{
    kHovers,
    kTooHeavy,  // the fans' pressure without flow does not carry the craft
    kTooLight,  // the fans carry it however high it is
    kNotLevel,  // no attitude below kMostTrim balances the moments
};

/// A craft that hovers over level ground.
struct Hover {
  HoverStatus status = HoverStatus::kTooHeavy;
  double lift_off_speed = 0.0;  // s = sqrt(m g/sum(a S)): the share of the fans' speed that lifts
                                // the craft off (18)
  double height = 0.0;          // m, of the centre of mass above the ground
  double roll = 0.0;            // rad, trim
  double pitch = 0.0;           // rad, trim
  double gap = 0.0;             // m, mean of the cells
  double pressure = 0.0;        // Pa, mean over the area
  double flow = 0.0;            // m³/s, of all fans
  double power = 0.0;           // W, in the air: sum of p Q
  double skirt_load = 0.0;      // N, on the skirt
  std::vector<CellReport> cells;
  std::array<HoverMode, kHoverMotions> modes;
};

/// Greatest roll or pitch (rad) at which a craft still counts as hovering: beyond it a skirt tucks
/// under, which is not modelled.
constexpr double kMostTrim = 0.1;

/// The hover of a craft, and its swinging about it. Each mode by itself: exact where the craft is
/// symmetric fore and aft and left and right.
HOVERCRAFT_PUBLIC Hover hoverOf(const Cushion& cushion, const HoverBody& body,
                                const FanSpeeds& speeds);

/// The longest step (s) with which an integrator lets the mode decay; 0 if there is none, and
/// infinity for a mode without stiffness and damping.
HOVERCRAFT_PUBLIC double longestStableStep(Integrator integrator, const HoverMode& mode);

}  // namespace hovercraft
