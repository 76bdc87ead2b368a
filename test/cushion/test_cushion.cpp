#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "hovercraft_sim/cushion/gap.h"
#include "hovercraft_sim/cushion/mirror_pairs.h"
#include "hovercraft_sim/math/rotation.h"

#include "flown_craft.h"

namespace hovercraft {
namespace {

using testing::allAt;
using testing::onePlenum;
using testing::rc5Cushion;

BodyMotion levelAt(double height) {
  BodyMotion motion;
  motion.R_WB = Matrix3::Identity();
  motion.p_WB = Vector3(0.0, 0.0, height);
  motion.v_WB_B = motion.w_WB_B = motion.u_B = Vector3::Zero();
  return motion;
}

TEST(MirrorPairs, LeftAndRightComeFirstAndThenTheirImagesForeAndAft) {
  const auto pairs = mirrorPairs({{Vector3(1, 2, 0), 1.0},
                                  {Vector3(0, 0, 0), 1.0},
                                  {Vector3(-1, -2, 0), 1.0},
                                  {Vector3(1, -2, 0), 1.0},
                                  {Vector3(-1, 2, 0), 1.0},
                                  {Vector3(1, -2, 0), 7.0}});
  const std::vector<MirrorPair> expected = {{0, 3}, {4, 2}, {1, -1}, {5, -1}};
  EXPECT_EQ(pairs, expected);
}

TEST(Cushion, SymmetricCraftHasNoMomentToTheLastBit) {
  CushionParameters parameters = rc5Cushion();
  parameters.skirt.stiffness = 2000.0;
  parameters.skirt.spring = {0.5, 0.3, 0.02};
  // In another order than mirrored.
  std::swap(parameters.cells[1], parameters.cells[3]);
  std::swap(parameters.cells[2].hem[0], parameters.cells[2].hem[1]);
  for (const CushionParameters& described : {parameters, onePlenum()}) {
    const Cushion cushion(described, Vector3::Zero());
    for (const double height : {-0.002, 0.0001, 0.0031, 0.02}) {
      BodyMotion motion = levelAt(height);
      motion.R_WB = rotationFromRpy({0.0, 0.0, 0.7});
      motion.v_WB_B = Vector3(0.0, 0.0, -0.0123);
      motion.u_B = motion.v_WB_B;
      const Wrench level = cushion.wrenchInBody(motion, allAt(0.93), PlaneGround(GroundPlane()));
      EXPECT_EQ(level.torque.x(), 0.0);
      EXPECT_EQ(level.torque.y(), 0.0);
      EXPECT_EQ(level.torque.z(), 0.0);
      EXPECT_GT(level.force.z(), 0.0);
    }
  }
}

TEST(Cushion, PitchedCraftHasNoRollingMomentAndARolledOneNoPitchingMoment) {
  CushionParameters parameters = rc5Cushion();
  parameters.skirt.stiffness = 2000.0;
  const Cushion cushion(parameters, Vector3::Zero());
  const PlaneGround ground{GroundPlane()};
  BodyMotion motion = levelAt(0.003);
  motion.v_WB_B = Vector3(0.7, 0.0, 0.01);
  motion.u_B = motion.v_WB_B;
  motion.R_WB = rotationFromRpy({0.0, 0.013, 0.0});
  motion.w_WB_B = Vector3(0.0, 0.4, 0.0);
  const Wrench pitched = cushion.wrenchInBody(motion, allAt(1.0), ground);
  EXPECT_EQ(pitched.torque.x(), 0.0);
  EXPECT_EQ(pitched.torque.z(), 0.0);
  EXPECT_GT(std::abs(pitched.torque.y()), 1e-3);
  motion.v_WB_B = Vector3(0.0, -0.7, 0.01);
  motion.u_B = motion.v_WB_B;
  motion.R_WB = rotationFromRpy({0.013, 0.0, 0.0});
  motion.w_WB_B = Vector3(0.4, 0.0, 0.0);
  const Wrench rolled = cushion.wrenchInBody(motion, allAt(1.0), ground);
  EXPECT_EQ(rolled.torque.y(), 0.0);
  EXPECT_EQ(rolled.torque.z(), 0.0);
  EXPECT_GT(std::abs(rolled.torque.x()), 1e-3);
}

TEST(Cushion, ForceOfACellIsPressureTimesAreaAlongTheBodysAxis) {
  const Cushion cushion(rc5Cushion(), Vector3::Zero());
  BodyMotion motion = levelAt(0.004);
  motion.R_WB = rotationFromRpy({0.01, -0.008, 0.3});
  const PlaneGround ground{GroundPlane()};
  std::array<CellReport, 4> cells;
  cushion.report(motion, allAt(1.0), ground, cells.data());
  const Wrench wrench = cushion.wrenchInBody(motion, allAt(1.0), ground);
  double force = 0.0;
  double roll = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_DOUBLE_EQ(cells[i].force, 0.027 * cells[i].pressure);
    force += cells[i].force;
    roll += rc5Cushion().cells[i].p_HC.y() * cells[i].force;
  }
  EXPECT_EQ(wrench.force.x(), 0.0);
  EXPECT_NEAR(wrench.force.z(), force, 1e-13);
  EXPECT_NEAR(wrench.torque.x(), roll, 1e-14);
}

TEST(Cushion, EscapeOfEachCellIsThatOfASharpEdgedOrifice) {
  // Q = C_d A sqrt(2 p/rho) (4), of a cell at rest with A from its own points.
  const CushionParameters parameters = rc5Cushion();
  const Cushion cushion(parameters, Vector3::Zero());
  BodyMotion motion = levelAt(0.004);
  motion.R_WB = rotationFromRpy({0.01, -0.008, 0.0});
  std::array<CellReport, 4> cells;
  cushion.report(motion, allAt(1.0), PlaneGround(GroundPlane()), cells.data());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    double area = 0.0;
    for (const HemPoint& hem : parameters.cells[i].hem) {
      const double gap = (times(motion.R_WB, hem.p_HK) + motion.p_WB).z();
      area += hem.length * hemGap(gap, 1e-4).open;
    }
    const double flow = 0.6 * leakArea(area, 0.027) * std::sqrt(2.0 * cells[i].pressure / 1.225);
    EXPECT_NEAR(cells[i].flow, flow, 1e-12);
    EXPECT_NEAR(cells[i].pressure, 935.264 - 1737300.0 * flow * flow, 1e-9);
  }
}

TEST(Cushion, SampledPlaneIsThePlane) {
  /// A plane that does not say so.
  class Disguised : public Ground {
   public:
    explicit Disguised(const GroundPlane& plane) : plane_(plane) {}
    void sample(const GroundQuery& query, GroundSample* samples) const override {
      plane_.sample(query, samples);
    }

   private:
    PlaneGround plane_;
  };
  CushionParameters parameters = rc5Cushion();
  parameters.skirt.stiffness = 1000.0;
  const Cushion cushion(parameters, Vector3(0.01, 0.0, 0.02));
  const Matrix3 tilt = rotationFromRpy({0.02, 0.1, 0.0});
  const GroundPlane plane = {tilt.col(2), 0.3};
  BodyMotion motion = levelAt(0.0);
  motion.R_WB = rotationFromRpy({0.03, 0.095, 0.0});
  motion.p_WB = 0.325 * tilt.col(2);
  motion.v_WB_B = Vector3(0.3, 0.2, -0.05);
  motion.w_WB_B = Vector3(0.1, -0.4, 0.3);
  const Wrench known = cushion.wrenchInBody(motion, allAt(1.0), PlaneGround(plane));
  const Wrench sampled = cushion.wrenchInBody(motion, allAt(1.0), Disguised(plane));
  EXPECT_NEAR(norm(known.force - sampled.force), 0.0, 1e-10);
  EXPECT_NEAR(norm(known.torque - sampled.torque), 0.0, 1e-11);
  EXPECT_GT(known.force.z(), 1.0);
}

TEST(Cushion, PumpingGoesByTheVelocityOfTheCellAlongTheGroundsNormal) {
  const Cushion cushion(onePlenum(), Vector3::Zero());
  const PlaneGround ground{GroundPlane()};
  BodyMotion still = levelAt(0.003);
  BodyMotion sinking = still;
  sinking.v_WB_B = Vector3(0.0, 0.0, -0.1);
  CellReport at_rest;
  CellReport pumped;
  cushion.report(still, allAt(1.0), ground, &at_rest);
  cushion.report(sinking, allAt(1.0), ground, &pumped);
  // What does not go under the hem goes through the fan: Q_fan = k sqrt p - S 0.1.
  const double outflow = at_rest.flow / std::sqrt(at_rest.pressure);
  EXPECT_NEAR(pumped.flow, outflow * std::sqrt(pumped.pressure) - 0.108 * 0.1, 1e-13);
  EXPECT_GT(pumped.pressure, at_rest.pressure);
}

TEST(Cushion, MomentumDragIsWhatTheIntakeTakesFromTheAir) {
  CushionParameters parameters = rc5Cushion();
  parameters.fans[0].p_HI = Vector3(-0.1, 0.0, 0.15);
  const Cushion cushion(parameters, Vector3::Zero());
  const PlaneGround ground{GroundPlane()};
  BodyMotion motion = levelAt(0.003);
  std::array<CellReport, 4> cells;
  cushion.report(motion, allAt(1.0), ground, cells.data());
  double flow = 0.0;
  for (const CellReport& cell : cells) flow += cell.flow;
  motion.u_B = Vector3(3.0, -2.0, 0.0);
  motion.w_WB_B = Vector3(0.0, 0.0, 0.5);
  const Wrench wrench = cushion.wrenchInBody(motion, allAt(1.0), ground);
  const Vector3 at_intake(3.0, -2.0 + 0.5 * -0.1, 0.0);
  const Vector3 expected = -1.225 * flow * at_intake;
  EXPECT_NEAR(wrench.force.x(), expected.x(), 1e-13);
  EXPECT_NEAR(wrench.force.y(), expected.y(), 1e-13);
  EXPECT_NEAR(wrench.torque.z(), -0.1 * expected.y(), 1e-14);
  EXPECT_NEAR(wrench.torque.y(), 0.15 * expected.x(), 1e-13);
  EXPECT_NEAR(1.225 * flow, 0.080, 0.0005);  // kg/s of rc5
}

TEST(Cushion, WhereThereIsNoGroundTheCellsAreOpen) {
  class Nothing : public Ground {
   public:
    void sample(const GroundQuery& query, GroundSample* samples) const override {
      for (int i = 0; i < query.count; ++i) samples[i] = kOverNothing;
    }
  };
  const Cushion cushion(rc5Cushion(), Vector3::Zero());
  const Wrench wrench = cushion.wrenchInBody(levelAt(0.003), allAt(1.0), Nothing());
  // All the fans' free flow through 0.6 S: rho/2 (Q/(0.6 S))² S, and no more.
  const double flow = 4.0 * std::sqrt(935.264 / 1737300.0);
  const double speed = flow / (0.6 * 0.108);
  EXPECT_NEAR(wrench.force.z(), 0.5 * 1.225 * speed * speed * 0.108, 0.01);
  EXPECT_LT(wrench.force.z(), 0.2);
}

TEST(Cushion, PlanarSkirtGrindsUnderTheLoadThatTheFansDoNotCarry) {
  CushionParameters parameters = rc5Cushion();
  parameters.skirt.spring = {0.0, 0.4, 0.02};
  const Cushion cushion(parameters, Vector3::Zero());
  const double weight = 5.15 * testing::kGravity;
  BodyMotion motion = levelAt(0.0);
  motion.v_WB_B = Vector3(2.0, 0.0, 0.0);  // and no wind: no momentum drag at u = 0
  const double half = 0.25 * 935.264 * 0.108;
  const Wrench dragged = cushion.planarWrenchInBody(motion, allAt(0.5), weight);
  EXPECT_NEAR(dragged.force.x(), -0.4 * (weight - half), 0.4 * weight * 1e-4);
  EXPECT_NEAR(dragged.torque.z(), 0.0, 1e-12);
  // It lifts off at s = sqrt(m g/(a S)). (18)
  const double lift_off = std::sqrt(weight / (935.264 * 0.108));
  EXPECT_LT(cushion.planarWrenchInBody(motion, allAt(0.999 * lift_off), weight).force.x(), -1e-3);
  EXPECT_EQ(cushion.planarWrenchInBody(motion, allAt(1.001 * lift_off), weight).force.x(), 0.0);
  motion.v_WB_B = Vector3::Zero();
  motion.w_WB_B = Vector3(0.0, 0.0, 30.0);
  EXPECT_LT(cushion.planarWrenchInBody(motion, allAt(0.0), weight).torque.z(), -1.0);
}

}  // namespace
}  // namespace hovercraft
