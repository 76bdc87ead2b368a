#pragma once

#include "hovercraft_sim/lanes/ground_plan.h"
#include "hovercraft_sim/lanes/lane_cell.h"
#include "hovercraft_sim/lanes/lane_forces.h"

/// A cushion over a plane for packs: the operations of Cushion::wrenchInBody() and
/// planarWrenchInBody() in cushion.cpp, in their order.

namespace hovercraft::lanes {

template <class Isa>
struct BodyMotion {
  Matrix<Isa> R_WB;
  Vector<Isa> p_WB;
  Vector<Isa> v_WB_B;
  Vector<Isa> w_WB_B;
  Vector<Isa> u_B;

  [[gnu::always_inline]] Vector<Isa> velocityAt(const Vector<Isa>& p_B) const {
    return v_WB_B + cross(w_WB_B, p_B);
  }
};

template <class Isa>
struct GroundSpring {
  NumberOf<Isa> damping, friction, slip_speed_square;

  [[gnu::always_inline]] static GroundSpring of(const Numbers& numbers) {
    return {numbers.at<Isa>(0), numbers.at<Isa>(1), numbers.at<Isa>(2)};
  }
  [[gnu::always_inline]] Vector<Isa> force(NumberOf<Isa> elastic, const Vector<Isa>& nhat,
                                           const Vector<Isa>& v) const {
    using Number = NumberOf<Isa>;
    const Number rate = dot(nhat, v);
    const Number N = elastic * notNegative<Isa>(same<Isa>(1.0) - damping * rate);
    const Vector<Isa> v_t = v - scaled<Isa>(rate, nhat);
    const Number share = (friction * N) / Isa::sqrt(dot(v_t, v_t) + slip_speed_square);
    return scaled<Isa>(N, nhat) - scaled<Isa>(share, v_t);
  }
};

/// The ground as a body sees it.
template <class Isa>
struct PlaneProbe {
  Vector<Isa> nhat_B;
  NumberOf<Isa> gap;  // m, of the centre of mass
};

template <class Isa>
[[gnu::always_inline]] inline PlaneProbe<Isa> planeProbe(const Numbers& numbers,
                                                         const BodyMotion<Isa>& motion) {
  const Vector<Isa> nhat_W = numbers.vector<Isa>(0);
  return {transposeTimes(motion.R_WB, nhat_W), dot(nhat_W, motion.p_WB) - numbers.at<Isa>(3)};
}

/// What the fans of a pack make at one stage.
template <class Isa>
struct StageAir {
  FanAtSpeed<Isa> fans[kMostLiftFans];
  NumberOf<Isa> flows[kMostLiftFans];  // in the planar model: of their cells, each without its sign
  NumberOf<Isa> left;                  // N, likewise: what the cells do not carry
};

/// @param pressures of the cells.
template <class Isa>
[[gnu::always_inline]] inline Wrench<Isa> pressureWrench(const GroundPlan& plan,
                                                         const Numbers& numbers,
                                                         const NumberOf<Isa>* pressures) {
  using Number = NumberOf<Isa>;
  Number force = Number{}, roll = Number{}, pitch = Number{};
  for (std::size_t i = 0; i < plan.cell_pair_count; ++i) {
    const PairStep& pair = plan.cell_pairs[i];
    const Numbers first = numbers.from(plan.cellRow(pair.first));
    Number pair_force = pressures[pair.first] * first.at<Isa>(3);
    Number pair_roll = pair_force * first.at<Isa>(1);
    Number pair_pitch = pair_force * first.at<Isa>(0);
    if (pair.second != PairStep::kAlone) {
      const Numbers second = numbers.from(plan.cellRow(pair.second));
      const Number other = pressures[pair.second] * second.at<Isa>(3);
      pair_roll = pair_roll + other * second.at<Isa>(1);
      pair_pitch = pair_pitch + other * second.at<Isa>(0);
      pair_force = pair_force + other;
    }
    force = force + pair_force;
    roll = roll + pair_roll;
    pitch = pitch + pair_pitch;
  }
  return {{Number{}, Number{}, force}, {roll, -pitch, Number{}}};
}

/// Where height is not computed the air does not depend on the motion.
template <class Isa>
[[gnu::always_inline]] inline void blowInPlane(const GroundPlan& plan, const Numbers& numbers,
                                               StageAir<Isa>& air) {
  using Number = NumberOf<Isa>;
  const Numbers common = numbers.from(GroundPlan::cushionRow());
  const Number wanted = common.at<Isa>(4);
  Number pressures[kMostCells];
  for (std::size_t i = 0; i < plan.fan_count; ++i) air.flows[i] = Number{};
  for (std::size_t i = 0; i < plan.cell_count; ++i) {
    const FanAtSpeed<Isa>& fan = air.fans[plan.cells[i].fan];
    Number& flow = air.flows[plan.cells[i].fan];
    pressures[i] = choose<Isa>(fan.shutoff < wanted, fan.shutoff, wanted);
    flow = flow + absolute<Isa>(fanFlow<Isa>(fan, pressures[i]));
  }
  const Number carried = pressureWrench<Isa>(plan, numbers, pressures).force.z;
  air.left = notNegative<Isa>(common.at<Isa>(3) - carried);
}

/// The cushion of a pack of craft at one stage.
template <class Isa>
struct PackCushion {
  using Number = NumberOf<Isa>;

  const GroundPlan& plan;
  const Numbers& numbers;
  const BodyMotion<Isa>& motion;
  Numbers common;
  Number pressures[kMostCells];
  Number elastic[kMostHemPoints];  // how far the hem is pressed in, times its stiffness

  [[gnu::always_inline]] PackCushion(const GroundPlan& of, const Numbers& rows,
                                     const BodyMotion<Isa>& moves)
      : plan(of), numbers(rows), motion(moves), common(rows.from(GroundPlan::cushionRow())) {}

  /// Pressures, and how far the hem is pressed in. @param flows of the cells of each fan, without
  /// their signs.
  [[gnu::always_inline]] void blow(const PlaneProbe<Isa>& probe, const FanAtSpeed<Isa>* fans,
                                   Number* flows) {
    const Number half = same<Isa>(0.5);
    const Vector<Isa>& n = probe.nhat_B;
    for (std::size_t i = 0; i < plan.fan_count; ++i) flows[i] = Number{};
    for (std::size_t i = 0; i < plan.cell_count; ++i) {
      const CellStep& cell = plan.cells[i];
      Number area_under_hem = Number{};
      for (std::size_t k = cell.first_point; k < cell.end_point; ++k) {
        const Numbers point = numbers.from(plan.pointRow(k));
        const Number gap = dot(n, point.vector<Isa>(0)) + probe.gap;
        const Number root = Isa::sqrt(gap * gap + common.at<Isa>(0));
        area_under_hem = area_under_hem + point.at<Isa>(3) * (half * (gap + root));
        elastic[k] = point.at<Isa>(4) * (half * (root - gap));
      }
      const Numbers place = numbers.from(plan.cellRow(i));
      const Number area = place.at<Isa>(3);
      const Number outflow = common.at<Isa>(1) * leakArea<Isa>(area_under_hem, area);
      const Number pumping = area * dot(n, motion.velocityAt(place.vector<Isa>(0)));
      const CellAir<Isa> air = cellAir<Isa>(fans[cell.fan], outflow, pumping);
      pressures[i] = air.pressure;
      flows[cell.fan] = flows[cell.fan] + absolute<Isa>(air.fan_flow);
    }
  }

  [[gnu::always_inline]] Wrench<Isa> momentumDrag(const Number* flows) const {
    Wrench<Isa> sum = {};
    for (std::size_t i = 0; i < plan.fan_count; ++i) {
      const Number mass_flow = common.at<Isa>(2) * flows[i];
      const Vector<Isa> intake = numbers.from(GroundPlan::fanRow(i)).vector<Isa>(4);
      const Vector<Isa> force = scaled<Isa>(-mass_flow, motion.u_B + cross(motion.w_WB_B, intake));
      sum = sum + Wrench<Isa>{force, cross(intake, force)};
    }
    return sum;
  }
};

}  // namespace hovercraft::lanes
