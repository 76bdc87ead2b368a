#pragma once

#include <cstddef>

/// The cushion over a plane and the pads that each craft of a batch has, each with numbers of its
/// own, Row by Row, in this order:
/// - the plane: normal in W (3), offset
/// - with a cushion: d², C_d sqrt(2/rho), rho, load of the planar model, that over the area, length
///   of the hem, alpha, mu, v_s² of the skirt, its stiffness; each fan: a, sqrt(a), b, c, intake
///   (3); each cell: centroid (3), area; each hem point: place (3), length, stiffness
/// - with pads: middle of the box around them (3), half its extent (3), stiffness, alpha, mu, v_s²;
///   each vertex: place (3)

namespace hovercraft::lanes {

constexpr std::size_t kMostCells = 16;      // as kMaxCells
constexpr std::size_t kMostHemPoints = 64;  // as kMaxHemPoints
constexpr std::size_t kMostLiftFans = 8;    // as kMaxFans

/// Rows of the parts above, each.
constexpr std::size_t kPlaneRows = 4;
constexpr std::size_t kCushionRows = 10;
constexpr std::size_t kLiftFanRows = 7;
constexpr std::size_t kCellRows = 4;
constexpr std::size_t kHemPointRows = 5;
constexpr std::size_t kPadRows = 10;
constexpr std::size_t kVertexRows = 3;

/// A lift fan. `actuator`: that turns it; kDescribed: none, it has the speeds that come with the
/// steps.
struct LiftFanStep {
  static constexpr std::size_t kDescribed = static_cast<std::size_t>(-1);  // no actuator

  std::size_t actuator = kDescribed;  // id of an actuator
};

struct CellStep {
  std::size_t fan = 0;          // index of the one that feeds it
  std::size_t first_point = 0;  // of its hem
  std::size_t end_point = 0;    // behind its last one
};

/// What is summed together first: two mirror images, or one alone.
struct PairStep {
  static constexpr std::size_t kAlone = static_cast<std::size_t>(-1);  // no second one

  std::size_t first = 0;        // index of a cell or a point
  std::size_t second = kAlone;  // likewise, its image
};

/// What is the same for all craft of a batch.
struct GroundPlan {
  bool has_cushion = false;              // whether it has a cushion
  bool is_planar = false;                // the cushion is that of the planar model
  bool has_pads = false;                 // whether it has pads
  std::size_t fan_count = 0;             // of lift fans
  std::size_t cell_count = 0;            // of cells
  std::size_t point_count = 0;           // of points of the hem, of all cells
  std::size_t vertex_count = 0;          // of the hull, that are pads
  std::size_t paired_count = 0;          // of the vertices: two mirror images after each other
  LiftFanStep fans[kMostLiftFans];       // in the order of the cushion
  CellStep cells[kMostCells];            // likewise
  PairStep cell_pairs[kMostCells];       // in the order of sums
  std::size_t cell_pair_count = 0;       // how many
  PairStep point_pairs[kMostHemPoints];  // in the order of sums
  std::size_t point_pair_count = 0;      // how many
  std::size_t first_row = 0;             // of the numbers

  /// Whether anything acts.
  [[gnu::always_inline]] bool isThere() const { return has_cushion || has_pads; }
  /// First rows of the parts, from the first one of the ground on.
  [[gnu::always_inline]] static std::size_t cushionRow() { return kPlaneRows; }
  [[gnu::always_inline]] static std::size_t fanRow(std::size_t i) {
    return kPlaneRows + kCushionRows + kLiftFanRows * i;
  }
  [[gnu::always_inline]] std::size_t cellRow(std::size_t i) const {
    return fanRow(fan_count) + kCellRows * i;
  }
  [[gnu::always_inline]] std::size_t pointRow(std::size_t k) const {
    return cellRow(cell_count) + kHemPointRows * k;
  }
  [[gnu::always_inline]] std::size_t padRow() const {
    return has_cushion ? pointRow(point_count) : kPlaneRows;
  }
  /// Rows of all parts.
  [[gnu::always_inline]] std::size_t rowCount() const {
    if (!isThere()) return 0;
    return has_pads ? padRow() + kPadRows + kVertexRows * vertex_count : padRow();
  }
};

}  // namespace hovercraft::lanes
