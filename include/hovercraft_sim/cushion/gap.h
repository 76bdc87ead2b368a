#pragma once

#include <cmath>

namespace hovercraft {

/// A point of the hem of a skirt over the ground (doc/craft.md): what air escapes through, and how
/// far the skirt is pressed in. Both are smooth, and each takes over where the other ends.
struct HemGap {
  double open;         // h, m, > 0: the height that air escapes through
  double compression;  // c = h - g, m, > 0
};

/// h = (g + sqrt(g² + d²))/2 and c = h - g. (1), (2)
/// @param gap g, m: height of the point above the ground, along the ground's normal; negative where
/// the undeformed hem would be below it. @param residual_gap d, m, > 0: what folded fingers leave
/// open.
inline HemGap hemGap(double gap, double residual_gap) {
  const double root = std::sqrt(gap * gap + residual_gap * residual_gap);
  return {0.5 * (gap + root), 0.5 * (root - gap)};
}

/// Slope dh/dg (-) of the open gap.
inline double openGapSlope(double gap, double residual_gap) {
  const double root = std::sqrt(gap * gap + residual_gap * residual_gap);
  return 0.5 * (1.0 + gap / root);
}

/// The area that air of a cell escapes through, m²: the area under the hem, in series with the cell
/// itself, A = A_l/sqrt(1 + (A_l/S)²). (3)
/// @param area_under_hem A_l, m², the sum of length times open gap. @param cell_area S, m², > 0.
inline double leakArea(double area_under_hem, double cell_area) {
  const double share = area_under_hem / cell_area;
  return area_under_hem / std::sqrt(1.0 + share * share);
}

/// Slope dA/dA_l (-) of leakArea().
inline double leakAreaSlope(double area_under_hem, double cell_area) {
  const double share = area_under_hem / cell_area;
  const double square = 1.0 + share * share;
  return 1.0 / (square * std::sqrt(square));
}

}  // namespace hovercraft
