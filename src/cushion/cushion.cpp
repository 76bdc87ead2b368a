#include "hovercraft_sim/cushion/cushion.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "hovercraft_sim/cushion/gap.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

/// Heights of a cell that its hem may be pressed in at most, as the hull stands on the ground by
/// then: what rises higher above a point of the hem is a wall beside it.
constexpr double kMostCompression = 2.0;

/// The order of hem points within a cell: mirrored cells get mirrored points in the same places.
bool comesBefore(const HemPoint& a, const HemPoint& b) {
  const auto key = [](const Vector3& p) {
    return std::make_tuple(std::abs(p.x()), std::abs(p.y()), p.z(), p.x(), p.y());
  };
  return key(a.p_HK) < key(b.p_HK);
}

}  // namespace

/// Of every cell and hem point in one stage.
struct Cushion::Airs {
  std::array<CellAir, kMaxCells> air;
  std::array<double, kMaxCells> mean_gap;  // m
  Column gap;
  Column open;
  Column compression;
};

/// The ground where it is one plane: what does not depend on the point is computed once.
class Cushion::PlaneProbe {
 public:
  PlaneProbe(const GroundPlane& plane, const BodyMotion& motion)
      : nhat_B_(transposeTimes(motion.R_WB, plane.nhat_W)), gap_(plane.gap(motion.p_WB)) {}

  void gaps(const Hem& hem, Column& gaps) const {
    const double nx = nhat_B_.x();
    const double ny = nhat_B_.y();
    const double nz = nhat_B_.z();
    const std::size_t count = hem.size();
    for (std::size_t k = 0; k < count; ++k) {
      gaps[k] = ((nx * hem.x[k] + ny * hem.y[k]) + nz * hem.z[k]) + gap_;
    }
  }
  double nx(std::size_t /*point*/) const { return nhat_B_.x(); }
  double ny(std::size_t /*point*/) const { return nhat_B_.y(); }
  double nz(std::size_t /*point*/) const { return nhat_B_.z(); }
  const Vector3& normalAtCell(std::size_t /*cell*/) const { return nhat_B_; }

 private:
  Vector3 nhat_B_;
  double gap_;  // m, of the centre of mass
};

/// Any other ground: it is asked for all hem points and cells at once.
class Cushion::SampledProbe {
 public:
  SampledProbe(const Ground& ground, const BodyMotion& motion, const Cushion& cushion)
      : R_WB_(motion.R_WB), point_count_(cushion.layout_.hem.size()) {
    std::array<GroundPoint, kMaxHemPoints + kMaxCells> points;
    int count = 0;
    const auto add = [&](const Vector3& p_B) {
      const Vector3 p_W = times(motion.R_WB, p_B) + motion.p_WB;
      points[static_cast<std::size_t>(count++)] = {p_W.x(), p_W.y(), p_W.z()};
    };
    for (std::size_t k = 0; k < point_count_; ++k) add(cushion.layout_.hem.at(k));
    for (const Cell& cell : cushion.layout_.cells) add(cell.p_BC);
    const double below = (times(motion.R_WB, cushion.layout_.p_BH) + motion.p_WB).z();
    ground.sample({points.data(), count, below, cushion.layout_.reach}, samples_.data());
  }

  void gaps(const Hem& /*hem*/, Column& gaps) const {
    for (std::size_t k = 0; k < point_count_; ++k) gaps[k] = samples_[k].gap;
  }
  double nx(std::size_t point) const { return inBody(point, 0); }
  double ny(std::size_t point) const { return inBody(point, 1); }
  double nz(std::size_t point) const { return inBody(point, 2); }
  Vector3 normalAtCell(std::size_t cell) const {
    return transposeTimes(R_WB_, samples_[point_count_ + cell].normal());
  }

 private:
  /// One number of transposeTimes(R_WB, normal).
  double inBody(std::size_t point, int axis) const {
    const GroundSample& n = samples_[point];
    return (R_WB_(0, axis) * n.nx + R_WB_(1, axis) * n.ny) + R_WB_(2, axis) * n.nz;
  }

  Matrix3 R_WB_;
  std::size_t point_count_;
  std::array<GroundSample, kMaxHemPoints + kMaxCells> samples_;
};

/// Forces of the skirt and their moments about the centre of mass, in B, point by point.
class Cushion::HemWrenches {
 public:
  /// @param elastic k c of each point, N. GroundSpring::force() number by number.
  template <class Probe>
  void fill(const Hem& hem, const GroundSpring& spring, const BodyMotion& motion,
            const Probe& probe, const Column& elastic) {
    const GroundSpring laws = spring;
    const double vx = motion.v_WB_B.x(), vy = motion.v_WB_B.y(), vz = motion.v_WB_B.z();
    const double wx = motion.w_WB_B.x(), wy = motion.w_WB_B.y(), wz = motion.w_WB_B.z();
    const std::size_t count = hem.size();
    for (std::size_t k = 0; k < count; ++k) {
      const double x = hem.x[k], y = hem.y[k], z = hem.z[k];
      const double nx = probe.nx(k), ny = probe.ny(k), nz = probe.nz(k);
      const double ux = vx + (wy * z - wz * y);
      const double uy = vy + (wz * x - wx * z);
      const double uz = vz + (wx * y - wy * x);
      const double rate = (nx * ux + ny * uy) + nz * uz;
      const double N = laws.normalForce(elastic[k], rate);
      const double slip_x = ux - rate * nx, slip_y = uy - rate * ny, slip_z = uz - rate * nz;
      const double slip = (slip_x * slip_x + slip_y * slip_y) + slip_z * slip_z;
      const double share = laws.frictionPerSpeed(N, slip);
      const double fx = N * nx - share * slip_x;
      const double fy = N * ny - share * slip_y;
      const double fz = N * nz - share * slip_z;
      fx_[k] = fx;
      fy_[k] = fy;
      fz_[k] = fz;
      tx_[k] = y * fz - z * fy;
      ty_[k] = z * fx - x * fz;
      tz_[k] = x * fy - y * fx;
    }
  }

  /// In mirrored pairs.
  Wrench sum(const std::vector<MirrorPair>& pairs) const {
    Wrench sum;
    for (const MirrorPair& pair : pairs) {
      sum = sum + (pair[1] < 0 ? at(pair[0]) : at(pair[0]) + at(pair[1]));
    }
    return sum;
  }

 private:
  Wrench at(int point) const {
    const auto k = static_cast<std::size_t>(point);
    return {Vector3(fx_[k], fy_[k], fz_[k]), Vector3(tx_[k], ty_[k], tz_[k])};
  }

  Column fx_, fy_, fz_;  // N
  Column tx_, ty_, tz_;  // N m
};

Cushion::Cushion(const CushionParameters& parameters, const Vector3& p_HB)
    : parameters_(parameters) {
  const FloatingPointEnvironment environment;
  layout_.p_BH = -p_HB;
  layout_.outflow_factor = parameters.discharge * std::sqrt(2.0 / parameters.air_density);
  demand(!parameters.cells.empty() && parameters.cells.size() <= kMaxCells,
         "a cushion has at least one cell, and no more than fit");
  demand(parameters.fans.size() <= kMaxFans, "a cushion has no more fans than fit");
  std::vector<PlacedElement> placed_cells;
  std::vector<PlacedElement> placed_points;
  for (CushionCell& described : parameters_.cells) {
    demand(described.fan < parameters.fans.size(), "a cell must name a fan of the cushion");
    std::sort(described.hem.begin(), described.hem.end(), comesBefore);
    Cell cell;
    cell.p_BC = described.p_HC - p_HB;
    cell.area = described.area;
    cell.fan = described.fan;
    cell.first_point = layout_.hem.size();
    for (const HemPoint& point : described.hem) {
      const Vector3 p_BK = point.p_HK - p_HB;
      layout_.hem.x.push_back(p_BK.x());
      layout_.hem.y.push_back(p_BK.y());
      layout_.hem.z.push_back(p_BK.z());
      layout_.hem.length.push_back(point.length);
      layout_.hem.stiffness.push_back(point.length * parameters.skirt.stiffness);
      cell.hem_length += point.length;
      placed_points.push_back({p_BK, point.length});
    }
    cell.end_point = layout_.hem.size();
    demand(cell.end_point > cell.first_point, "a cell has hem");
    layout_.total_area += cell.area;
    layout_.reach = std::max(layout_.reach, kMostCompression * described.height);
    layout_.total_length += cell.hem_length;
    placed_cells.push_back({cell.p_BC, cell.area});
    layout_.cells.push_back(cell);
  }
  demand(layout_.hem.size() <= kMaxHemPoints, "a cushion has no more hem points than fit");
  for (const CushionFan& fan : parameters.fans) layout_.intakes_B.emplace_back(fan.p_HI - p_HB);
  layout_.cell_pairs = mirrorPairs(placed_cells);
  layout_.point_pairs = mirrorPairs(placed_points);
}

FanSpeeds Cushion::describedSpeeds(double time) const {
  FanSpeeds speeds = {};
  for (std::size_t i = 0; i < parameters_.fans.size(); ++i) {
    speeds[i] = parameters_.fans[i].speedAt(time);
  }
  return speeds;
}

FanSpeeds Cushion::fullSpeeds() const {
  FanSpeeds speeds = {};
  for (std::size_t i = 0; i < parameters_.fans.size(); ++i) {
    speeds[i] = parameters_.fans[i].fullSpeed();
  }
  return speeds;
}

/// Pressure and flow of each cell over the ground that the probe sees.
template <class Probe>
void Cushion::blow(const BodyMotion& motion, const FanSpeeds& speeds, const Probe& probe,
                   Airs& airs) const {
  std::array<FanAtSpeed, kMaxFans> fans;
  for (std::size_t i = 0; i < parameters_.fans.size(); ++i) {
    fans[i] = atSpeed(parameters_.fans[i].curve, speeds[i]);
  }
  probe.gaps(layout_.hem, airs.gap);
  const std::size_t count = layout_.hem.size();
  for (std::size_t k = 0; k < count; ++k) {
    const HemGap hem = hemGap(airs.gap[k], parameters_.residual_gap);
    airs.open[k] = hem.open;
    airs.compression[k] = hem.compression;
  }
  for (std::size_t i = 0; i < layout_.cells.size(); ++i) {
    const Cell& cell = layout_.cells[i];
    double area_under_hem = 0.0;
    double gaps = 0.0;
    for (std::size_t k = cell.first_point; k < cell.end_point; ++k) {
      area_under_hem += layout_.hem.length[k] * airs.open[k];
      gaps += layout_.hem.length[k] * airs.gap[k];
    }
    airs.mean_gap[i] = gaps / cell.hem_length;
    const double outflow = layout_.outflow_factor * leakArea(area_under_hem, cell.area);
    const double pumping = cell.area * dot(probe.normalAtCell(i), motion.velocityAt(cell.p_BC));
    airs.air[i] = cellAir(fans[cell.fan], outflow, pumping);
  }
}

/// The force of each cell is p S along z of B, at the cell's centroid: the hull and the skirt
/// within a hem feel p times the area vector of that hem, whatever their shape. (8)
Wrench Cushion::pressureWrench(const Airs& airs) const {
  double force = 0.0;
  double roll = 0.0;
  double pitch = 0.0;
  for (const MirrorPair& pair : layout_.cell_pairs) {
    const auto first = static_cast<std::size_t>(pair[0]);
    double pair_force = airs.air[first].pressure * layout_.cells[first].area;
    double pair_roll = pair_force * layout_.cells[first].p_BC.y();
    double pair_pitch = pair_force * layout_.cells[first].p_BC.x();
    if (pair[1] >= 0) {
      const auto second = static_cast<std::size_t>(pair[1]);
      const double other = airs.air[second].pressure * layout_.cells[second].area;
      pair_roll += other * layout_.cells[second].p_BC.y();
      pair_pitch += other * layout_.cells[second].p_BC.x();
      pair_force += other;
    }
    force += pair_force;
    roll += pair_roll;
    pitch += pair_pitch;
  }
  return {Vector3(0.0, 0.0, force), Vector3(roll, -pitch, 0.0)};
}

template <class Probe>
Wrench Cushion::skirtWrench(const BodyMotion& motion, const Probe& probe, const Airs& airs) const {
  Column elastic;
  const std::size_t count = layout_.hem.size();
  for (std::size_t k = 0; k < count; ++k)
    elastic[k] = layout_.hem.stiffness[k] * airs.compression[k];
  HemWrenches wrenches;
  wrenches.fill(layout_.hem, parameters_.skirt.spring, motion, probe, elastic);
  return wrenches.sum(layout_.point_pairs);
}

/// What a fan takes in is brought to the craft's velocity at its intake:
/// F = -m_dot u(r_in), M = r_in x F, m_dot = rho |Q|. (24)
Wrench Cushion::momentumDrag(const BodyMotion& motion, const Airs& airs) const {
  std::array<double, kMaxFans> flows = {};
  for (std::size_t i = 0; i < layout_.cells.size(); ++i) {
    flows[layout_.cells[i].fan] += std::abs(airs.air[i].fan_flow);
  }
  Wrench sum;
  for (std::size_t i = 0; i < layout_.intakes_B.size(); ++i) {
    const double mass_flow = parameters_.air_density * flows[i];
    const Vector3 force = -mass_flow * (motion.u_B + cross(motion.w_WB_B, layout_.intakes_B[i]));
    sum = sum + Wrench{force, cross(layout_.intakes_B[i], force)};
  }
  return sum;
}

template <class Probe>
Wrench Cushion::wrenchOver(const BodyMotion& motion, const FanSpeeds& speeds,
                           const Probe& probe) const {
  Airs airs;
  blow(motion, speeds, probe, airs);
  Wrench air = pressureWrench(airs) + momentumDrag(motion, airs);
  if (!(parameters_.skirt.stiffness > 0.0)) return air;
  return air + skirtWrench(motion, probe, airs);
}

Wrench Cushion::wrenchInBody(const BodyMotion& motion, const FanSpeeds& speeds,
                             const Ground& ground) const {
  if (const GroundPlane* plane = ground.plane()) {
    return wrenchOver(motion, speeds, PlaneProbe(*plane, motion));
  }
  return wrenchOver(motion, speeds, SampledProbe(ground, motion, *this));
}

/// Each cell has the pressure that carries its share of the load, or that of its fan without flow,
/// if that is less: the hem then lies on the ground.
void Cushion::planarAirs(const FanSpeeds& speeds, double load, Airs& airs) const {
  const double wanted = load / layout_.total_area;
  for (std::size_t i = 0; i < layout_.cells.size(); ++i) {
    const FanAtSpeed fan =
        atSpeed(parameters_.fans[layout_.cells[i].fan].curve, speeds[layout_.cells[i].fan]);
    const double pressure = std::min(wanted, fan.shutoff);
    airs.air[i] = {pressure, fanFlow(fan, pressure)};
    airs.mean_gap[i] = 0.0;
  }
}

Wrench Cushion::planarWrenchInBody(const BodyMotion& motion, const FanSpeeds& speeds,
                                   double load) const {
  Airs airs;
  planarAirs(speeds, load, airs);
  const double left = std::max(0.0, load - pressureWrench(airs).force.z());
  const double per_metre = left / layout_.total_length;
  const auto wrench_of = [&](int index) -> Wrench {
    const auto k = static_cast<std::size_t>(index);
    const Vector3 p_BK = layout_.hem.at(k);
    Vector3 velocity = motion.velocityAt(p_BK);
    velocity.z() = 0.0;
    const Vector3 force = parameters_.skirt.spring.force(per_metre * layout_.hem.length[k],
                                                         Vector3::UnitZ(), velocity);
    return {force, cross(p_BK, force)};
  };
  Wrench sum = momentumDrag(motion, airs);
  if (!(left > 0.0)) return sum;
  for (const MirrorPair& pair : layout_.point_pairs) {
    sum = sum + (pair[1] < 0 ? wrench_of(pair[0]) : wrench_of(pair[0]) + wrench_of(pair[1]));
  }
  return sum;
}

void Cushion::write(const Airs& airs, CellReport* reports) const {
  for (std::size_t i = 0; i < layout_.cells.size(); ++i) {
    const CellAir& air = airs.air[i];
    reports[i] = {air.pressure, airs.mean_gap[i], air.fan_flow,
                  air.pressure * layout_.cells[i].area};
  }
}

void Cushion::report(const BodyMotion& motion, const FanSpeeds& speeds, const Ground& ground,
                     CellReport* reports) const {
  Airs airs;
  blow(motion, speeds, SampledProbe(ground, motion, *this), airs);
  write(airs, reports);
}

void Cushion::planarReport(const FanSpeeds& speeds, double load, CellReport* reports) const {
  Airs airs;
  planarAirs(speeds, load, airs);
  write(airs, reports);
}

}  // namespace hovercraft
