#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/constants.h"

#include "../support/free_body.h"
#include "../support/free_flight.h"

namespace hovercraft {
namespace {

using testing::Brick;
using testing::freeFlight;

class TumblingBrick : public ::testing::TestWithParam<std::array<double, 4>> {};

// NASA/TM-2015-218675 (NESC), Verification of 6-DOF flight simulations, check-case 2, "tumbling
// brick, no damping": a brick of 0.00189422, 0.006211019, 0.007194665 slug ft² (any unit will do:
// w depends on the ratios only) let go with 10, 20, 30 deg/s. Rows of the published tables of
// simulations 01 and 04 (NESC_data/Atmospheric_checkcases/Atmos_02_TumblingBrickNoDamping of
// github.com/nasa/simupy-flight, commit 70754e6): time in s, p, q, r in deg/s. Both differ from the
// closed form by up to 3.4e-10 deg/s, and 04 is printed to 5e-11; RK4 at 1 ms adds less than 1e-11.
constexpr double kPublishedError = 4e-10;
constexpr double kRadiansPerDegree = kPi / 180.0;
constexpr std::array<std::array<double, 4>, 18> kPublishedRates = {{
    {0, 9.999999999960824, 19.999999999978947, 29.999999999939774},     // simulation 01
    {1, 4.25884189865367, 23.119942897440833, 28.379817775030197},      //
    {2, -1.7508153285369548, 23.64955775981849, 28.071320044883304},    //
    {5, -16.939485149392073, 9.631939377436426, 33.40662807936806},     //
    {10, -2.41890222177841, -23.55256951951579, 28.12859263003343},     //
    {15, 18.43725431358227, 2.386880298914253, 34.31070561161288},      //
    {20, -5.422734679890159, 22.715930576502963, 28.608281747225586},   //
    {25, -15.184088701189102, -13.61779950029914, 32.416796198407226},  //
    {30, 12.61839077566776, -17.3974747618308, 31.11958888682995},      //
    {0, 10.0, 20.0, 30.0},                                              // simulation 04
    {1, 4.25884189866, 23.1199428975, 28.3798177751},                   //
    {2, -1.75081532854, 23.6495577599, 28.0713200449},                  //
    {5, -16.9394851494, 9.63193937745, 33.4066280795},                  //
    {10, -2.41890222177, -23.5525695195, 28.12859263},                  //
    {15, 18.4372543136, 2.38688029893, 34.3107056116},                  //
    {20, -5.42273467991, 22.7159305765, 28.6082817473},                 //
    {25, -15.1840887012, -13.6177995003, 32.4167961985},                //
    {30, 12.6183907757, -17.3974747619, 31.1195888868},
}};

TEST_P(TumblingBrick, TurnsAsPublished) {
  Brick brick;
  brick.moments = {0.00189422, 0.006211019, 0.007194665};
  brick.w_WB_B = kRadiansPerDegree * Vector3(10.0, 20.0, 30.0);
  const Mobility mobility = brick.mobility();
  const auto [time, p, q, r] = GetParam();
  const Vector3 published = {p, q, r};
  const int steps = std::max(1, static_cast<int>(1000.0 * time));
  const auto state = freeFlight<Quaternion>(Integrator::kRungeKutta4, brick, time, steps);
  const Vector3 rates =
      mobility.angularVelocityInBody(state.angular_momentum_W, rotationMatrix(state.orientation));
  const Vector3 exact =
      testing::FreeBody(brick.moments, brick.w_WB_B, brick.R_WB).angularVelocityInBody(time);
  EXPECT_LT((rates / kRadiansPerDegree - published).cwiseAbs().maxCoeff(), kPublishedError);
  EXPECT_LT((exact / kRadiansPerDegree - published).cwiseAbs().maxCoeff(), kPublishedError);
  EXPECT_LT((rates - exact).cwiseAbs().maxCoeff(), 1e-11 * kRadiansPerDegree);
}

std::string timeOf(const ::testing::TestParamInfo<std::array<double, 4>>& row) {
  return (row.index < 9 ? "Simulation01At" : "Simulation04At") +
         std::to_string(static_cast<int>(row.param[0])) + "s";
}
INSTANTIATE_TEST_SUITE_P(NasaCheckCase2, TumblingBrick, ::testing::ValuesIn(kPublishedRates),
                         timeOf);

/// Principal moments and angular velocities of both kinds of motion (L circles the axis of the
/// largest or of the smallest moment) for every order of the axes, with every sign.
struct FreeMotion {
  Vector3 moments;
  Vector3 w_WB_B;
};
class FreeBodyClosedForm : public ::testing::TestWithParam<FreeMotion> {};

// The closed form against RK4 at 0.4 ms, whose error of order h^4 was 2.2e-13 at worst.
TEST_P(FreeBodyClosedForm, IsTheMotionThatTheEquationsGive) {
  Brick brick;
  brick.moments = GetParam().moments;
  brick.w_WB_B = GetParam().w_WB_B;
  const testing::FreeBody exact(brick.moments, brick.w_WB_B, brick.R_WB);
  EXPECT_LT((exact.angularVelocityInBody(0.0) - brick.w_WB_B).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((exact.attitude(0.0) - brick.R_WB).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((exact.angularVelocityInBody(exact.period()) - brick.w_WB_B).cwiseAbs().maxCoeff(),
            1e-13);
  for (const double time : {0.5, 2.0}) {
    const auto steps = static_cast<int>(2500.0 * time);
    const auto state = freeFlight<Quaternion>(Integrator::kRungeKutta4, brick, time, steps);
    const Matrix3 R_WB = rotationMatrix(state.orientation);
    EXPECT_LT((exact.attitude(time) - R_WB).cwiseAbs().maxCoeff(), 1e-12) << time;
    EXPECT_LT(orthogonalityError(exact.attitude(time)), 1e-14) << time;
    const Vector3 w_WB_B = brick.mobility().angularVelocityInBody(state.angular_momentum_W, R_WB);
    EXPECT_LT((exact.angularVelocityInBody(time) - w_WB_B).cwiseAbs().maxCoeff(), 1e-12) << time;
  }
}

std::vector<FreeMotion> freeMotions() {
  std::vector<FreeMotion> motions;
  Vector3 moments(1.0, 2.0, 2.5);
  do {
    for (const double sign : {-1.0, 1.0}) {
      motions.push_back({moments, {1.2 * sign, 0.4, 0.3}});
      motions.push_back({moments, {0.2, 0.5 * sign, -0.9}});
      motions.push_back({moments, {-0.5, 2.0, 0.7 * sign}});
    }
  } while (std::next_permutation(moments.data(), moments.data() + 3));
  return motions;
}
std::string numberOf(const ::testing::TestParamInfo<FreeMotion>& motion) {
  return std::to_string(motion.index);
}
INSTANTIATE_TEST_SUITE_P(EveryOrderOfAxes, FreeBodyClosedForm, ::testing::ValuesIn(freeMotions()),
                         numberOf);

}  // namespace
}  // namespace hovercraft
