#pragma once

#include <memory>
#include <vector>

#include "hovercraft_sim/cushion/ground.h"
#include "hovercraft_sim/geometry/convex_polyhedron.h"
#include "hovercraft_sim/geometry/pose.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// The ground that fixed convex bodies make: the highest of their upper sides whose underside lies
/// below the craft's origin, so that a craft may pass under a bridge and over it (doc/craft.md,
/// 19). The same polyhedra as contact.
class HOVERCRAFT_PUBLIC RoofGround final : public Ground {
 public:
  /// @param base what lies beside and below the bodies; none: nothing.
  explicit RoofGround(std::shared_ptr<const Ground> base) : base_(std::move(base)) {}

  void add(const ConvexPolyhedron& body, const Pose& X_WO);

  void sample(const GroundQuery& query, GroundSample* samples) const override;

 private:
  /// z = level + by_x x + by_y y.
  struct Slope {
    double level, by_x, by_y;
    double at(const GroundPoint& p) const { return (level + by_x * p.x) + by_y * p.y; }
  };
  struct Top {
    Slope slope;
    double nx, ny, nz;  // unit
  };
  /// Inside where nx x + ny y <= offset.
  struct Wall {
    double nx, ny, offset;
  };
  /// A rectangle seen from above, m.
  struct Rectangle {
    double low_x, low_y, high_x, high_y;
  };
  struct Roof {
    Rectangle around;
    std::vector<Top> tops;
    std::vector<Slope> bottoms;
    std::vector<Wall> walls;
  };

  static bool holds(const Roof& roof, const GroundPoint& point);
  static bool holdsAll(const Roof& roof, const Rectangle& points);
  static const Top* topUnder(const Roof& roof, const GroundPoint& point, double below,
                             double& height);
  static void lift(const Roof& roof, const GroundQuery& query, bool holds_all,
                   GroundSample* samples);

  std::shared_ptr<const Ground> base_;
  std::vector<Roof> roofs_;
};

}  // namespace hovercraft
