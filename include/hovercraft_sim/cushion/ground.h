#pragma once

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// Height (m) of a point above the ground where there is none below it: air escapes freely, and
/// its square is far from the largest double.
constexpr double kNoGround = 1e6;

/// The ground as one point sees it: plain numbers, so that an array of them costs nothing to make.
struct GroundSample {
  double gap;         // m, height of the point above it, along its normal; negative: below it
  double nx, ny, nz;  // its normal in W, unit, nz > 0

  /// As a vector.
  Vector3 normal() const { return {nx, ny, nz}; }
};
constexpr GroundSample kOverNothing = {kNoGround, 0.0, 0.0, 1.0};  // as where there is no ground

/// A point in W, m.
struct GroundPoint {
  double x, y, z;  // m
};

/// The plane nhat · p = offset, in W.
struct GroundPlane {
  Vector3 nhat_W = Vector3::UnitZ();  // unit, pointing up: z > 0
  double offset = 0.0;                // m

  double gap(const Vector3& p_W) const { return dot(nhat_W, p_W) - offset; }
};

/// Points that ask for the ground.
struct GroundQuery {
  const GroundPoint* points = nullptr;  // as many as count
  int count = 0;                        // how many
  double below = 0.0;        // m: of what lies over each other the highest whose underside is lower
  double reach = kNoGround;  // m: what rises above a point by more is a wall beside it
};

/// What a cushion blows on, and what pads stand on: the same for both. It does not move, and is
/// asked in each stage of a step: an implementation allocates nothing, and computes with + - * /
/// and sqrt only.
class HOVERCRAFT_PUBLIC Ground {
 public:
  virtual ~Ground() = default;

  /// @param samples one for each point of the query.
  virtual void sample(const GroundQuery& query, GroundSample* samples) const = 0;

  /// All of the ground, if it is one plane.
  virtual const GroundPlane* plane() const { return nullptr; }
};

/// One plane.
class HOVERCRAFT_PUBLIC PlaneGround final : public Ground {
 public:
  /// @param plane nhat_W of length 1.
  explicit PlaneGround(const GroundPlane& plane) : plane_(plane) {}

  void sample(const GroundQuery& query, GroundSample* samples) const override;
  const GroundPlane* plane() const override { return &plane_; }

 private:
  GroundPlane plane_;
};

}  // namespace hovercraft
