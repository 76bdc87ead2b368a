#pragma once

#include <array>
#include <vector>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/body/steppers.h"
#include "hovercraft_sim/cushion/cushion.h"
#include "hovercraft_sim/cushion/hover.h"

namespace hovercraft::testing {

constexpr double kGravity = 9.80665;

/// rc5: the body of the MVWT on four cells of 0.18 m × 0.15 m. The hem of each is a front or rear
/// side of 0.15 m and a port or starboard side of 0.18 m, with one point each, in its middle.
inline CushionParameters rc5Cushion() {
  CushionParameters cushion;
  cushion.discharge = 0.6;
  cushion.residual_gap = 1e-4;
  cushion.fans = {{"lift", {935.264, 0.0, 1737300.0}}};
  for (const double x : {1.0, -1.0}) {
    for (const double y : {1.0, -1.0}) {
      CushionCell cell;
      cell.p_HC = Vector3(0.09 * x, 0.075 * y, 0.0);
      cell.area = 0.027;
      cell.height = 0.05;
      cell.hem = {{Vector3(0.18 * x, 0.075 * y, 0.0), 0.15},
                  {Vector3(0.09 * x, 0.15 * y, 0.0), 0.18}};
      cushion.cells.push_back(cell);
    }
  }
  return cushion;
}

inline HoverBody rc5Body() {
  return {5.15, Vector3(0.03, 0.04, 0.047).asDiagonal(), kGravity};
}

/// All of one plenum: the same area, hem and flow in one cell.
inline CushionParameters onePlenum() {
  CushionParameters cushion = rc5Cushion();
  CushionCell whole;
  whole.area = 0.108;
  whole.height = 0.05;
  for (const CushionCell& cell : cushion.cells) {
    whole.hem.insert(whole.hem.end(), cell.hem.begin(), cell.hem.end());
  }
  cushion.cells = {whole};
  cushion.fans[0].curve.curve = 1737300.0 / 16.0;
  return cushion;
}

inline FanSpeeds allAt(double speed) {
  FanSpeeds speeds;
  speeds.fill(speed);
  return speeds;
}

/// A craft with a cushion and nothing else, as steppers want it.
struct FlownCraft {
  Mobility mobility;
  Cushion cushion;
  Vector3 weight_W;
  PlaneGround ground{GroundPlane()};
  FanSpeeds speeds = allAt(1.0);
  Vector3 wind_W = Vector3::Zero();
  Vector3 thrust_B = Vector3::Zero();

  FlownCraft(const CushionParameters& parameters, const HoverBody& body)
      : mobility(Mobility::spatial(body.mass, body.I_BBo_B)),
        cushion(parameters, Vector3::Zero()),
        weight_W(0.0, 0.0, -body.mass * body.gravity) {}

  template <class Orientation>
  BodyMotion motionOf(const RigidBodyState<Orientation>& state) const {
    BodyMotion motion;
    motion.R_WB = rotationMatrix(state.orientation);
    motion.p_WB = state.p_WB;
    const Vector3 v_WB = mobility.velocity(state.momentum_W);
    motion.v_WB_B = transposeTimes(motion.R_WB, v_WB);
    motion.w_WB_B = mobility.angularVelocityInBody(state.angular_momentum_W, motion.R_WB);
    motion.u_B = transposeTimes(motion.R_WB, v_WB - wind_W);
    return motion;
  }
  template <class Orientation>
  StateDerivative<Orientation> derivative(const RigidBodyState<Orientation>& state,
                                          Stage /*stage*/) const {
    const BodyMotion motion = motionOf(state);
    const Wrench wrench = cushion.wrenchInBody(motion, speeds, ground);
    return {mobility.velocity(state.momentum_W),
            orientationRate(times(motion.R_WB, motion.w_WB_B), state.orientation),
            times(motion.R_WB, wrench.force + thrust_B) + weight_W,
            times(motion.R_WB, wrench.torque)};
  }
  template <class Orientation>
  Twist twist(const RigidBodyState<Orientation>& state) const {
    return mobility.twist(state);
  }

  RigidBodyState<Quaternion> at(double height) const {
    return mobility.stateOfMotion(Vector3(0.0, 0.0, height), Quaternion{1.0, Vector3::Zero()},
                                  Twist());
  }
};

}  // namespace hovercraft::testing
