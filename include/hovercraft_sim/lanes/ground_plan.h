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

constexpr std::size_t kMostCells = 16;
constexpr std::size_t kMostHemPoints = 64;
constexpr std::size_t kMostLiftFans = 8;

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
  static constexpr std::size_t kDescribed = static_cast<std::size_t>(-1);

  std::size_t actuator = kDescribed;
};

struct CellStep {
  std::size_t fan = 0;
  std::size_t first_point = 0;  // of its hem
  std::size_t end_point = 0;
};

/// What is summed together first: two mirror images, or one alone.
struct PairStep {
  static constexpr std::size_t kAlone = static_cast<std::size_t>(-1);

  std::size_t first = 0;
  std::size_t second = kAlone;
};

/// What is the same for all craft of a batch.
struct GroundPlan {
  bool has_cushion = false;
  bool is_planar = false;  // the cushion is that of the planar model
  bool has_pads = false;
  std::size_t fan_count = 0;
  std::size_t cell_count = 0;
  std::size_t point_count = 0;
  std::size_t vertex_count = 0;
  std::size_t paired_count = 0;  // of the vertices: two mirror images after each other
  LiftFanStep fans[kMostLiftFans];
  CellStep cells[kMostCells];
  PairStep cell_pairs[kMostCells];
  std::size_t cell_pair_count = 0;
  PairStep point_pairs[kMostHemPoints];
  std::size_t point_pair_count = 0;
  std::size_t first_row = 0;  // of the numbers

  [[gnu::always_inline]] bool isThere() const { return has_cushion || has_pads; }
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
  [[gnu::always_inline]] std::size_t rowCount() const {
    if (!isThere()) return 0;
    return has_pads ? padRow() + kPadRows + kVertexRows * vertex_count : padRow();
  }
};

}  // namespace hovercraft::lanes
