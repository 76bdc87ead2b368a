#pragma once

#include <cstddef>
#include <vector>

#include "hovercraft_sim/cushion/mirror_pairs.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// What a cushion works out once of its parameters; places in B, m.
struct CushionLayout {
  /// Hem points of all cells, one column for each number: the loops over them are of independent
  /// lines, which compilers make several of at once.
  struct Hem {
    std::vector<double> x, y, z;    // m, in B
    std::vector<double> length;     // m
    std::vector<double> stiffness;  // N/m

    std::size_t size() const { return x.size(); }  // points
    /// Place of a point, m.
    Vector3 at(std::size_t k) const { return {x[k], y[k], z[k]}; }
  };
  struct Cell {
    Vector3 p_BC;                 // centroid of its area
    double area = 0.0;            // m²
    std::size_t fan = 0;          // index of the fan that feeds it
    std::size_t first_point = 0;  // of its hem, into the points of all cells
    std::size_t end_point = 0;    // behind the last one
    double hem_length = 0.0;      // m
  };

  std::vector<Cell> cells;              // in the order of the parameters
  Hem hem;                              // of the first cell, the second, ...
  std::vector<MirrorPair> cell_pairs;   // cells that are summed together
  std::vector<MirrorPair> point_pairs;  // points of the hem that are
  std::vector<Vector3> intakes_B;       // of each fan
  Vector3 p_BH;                         // origin of the hull frame
  double reach = 0.0;                   // m: what rises above a hem point by more is a wall
  double outflow_factor = 0.0;          // C_d sqrt(2/rho)
  double total_area = 0.0;              // m²
  double total_length = 0.0;            // m
};

}  // namespace hovercraft
