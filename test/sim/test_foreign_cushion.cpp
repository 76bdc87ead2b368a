#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/cushion/cushion.h"
#include "hovercraft_sim/cushion/height_map.h"
#include "hovercraft_sim/cushion/hover.h"
#include "hovercraft_sim/cushion/pads.h"
#include "hovercraft_sim/geometry/polyhedron_shapes.h"
#include "hovercraft_sim/math/rotation.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/state_hash.h"
#include "hovercraft_sim/world/roof_ground.h"

#include "../cushion/flown_craft.h"
#include "../support/foreign_environment.h"
#include "../support/same_bits.h"

// What is set up for cushions does not depend on the floating-point environment that it is set up
// in: made in a foreign one, it is asked in the default one, as in a step.

namespace hovercraft {
namespace {

using testing::Bits;
using testing::bitsOf;
using testing::InForeignEnvironment;
using testing::kForeign;

BodyMotion swingingMotion() {
  BodyMotion motion;
  motion.R_WB = rotationFromRpy({0.013, -0.021, 0.7});
  motion.p_WB = Vector3(0.31, -0.17, 0.0531);
  motion.v_WB_B = Vector3(0.7, 0.3, -0.013);
  motion.w_WB_B = Vector3(0.11, -0.23, 0.37);
  motion.u_B = motion.v_WB_B;
  return motion;
}

/// Makes something in each foreign environment and asks it in the default one.
template <class Make, class Ask>
void expectMadeAlike(const char* what, const Make& make, const Ask& ask) {
  const Bits expected = ask(*make());
  for (const auto& foreign : kForeign) {
    const auto made = [&] {
      const InForeignEnvironment in_foreign(foreign);
      return make();
    }();
    EXPECT_EQ(ask(*made), expected) << what;
  }
}

Bits sampledBits(const Ground& ground) {
  StateHash hash;
  for (int i = 0; i < 40; ++i) {
    const GroundPoint point = {0.037 * i - 0.3, 0.9 - 0.041 * i, 0.3};
    GroundSample sample = kOverNothing;
    ground.sample({&point, 1, 0.4, kNoGround}, &sample);
    for (const double number : {sample.gap, sample.nx, sample.ny, sample.nz}) hash.add(number);
  }
  return hash.value();
}

TEST(ForeignEnvironment, CushionIsTheSame) {
  CushionParameters parameters = testing::rc5Cushion();
  parameters.discharge = 0.63;
  parameters.air_density = 1.2;
  parameters.skirt = {2500.0, {1.0, 0.3, 0.02}};
  for (CushionCell& cell : parameters.cells) {
    for (HemPoint& hem : cell.hem) hem.length *= 0.97;
  }
  const Vector3 p_HB(0.0011, 0.0007, 0.0513);
  expectMadeAlike(
      "Cushion", [&] { return std::make_unique<Cushion>(parameters, p_HB); },
      [](const Cushion& cushion) {
        const PlaneGround plane{GroundPlane()};
        const BodyMotion motion = swingingMotion();
        const Wrench wrench = cushion.wrenchInBody(motion, testing::allAt(0.9), plane);
        const Wrench planar = cushion.planarWrenchInBody(motion, testing::allAt(0.6), 51.0);
        return bitsOf(wrench.force) + bitsOf(wrench.torque) + 3 * bitsOf(planar.force);
      });
}

TEST(ForeignEnvironment, PadsAreTheSame) {
  const std::vector<Vector3> vertices = {{0.1, 0.2, -0.06}, {0.1, -0.2, -0.06}, {-0.3, 0.0, -0.07}};
  for (const double weight : {50.7, 13.1, 7.3}) {
    expectMadeAlike(
        "Pads",
        [&] {
          return std::make_unique<Pads>(vertices, weight, PadParameters{0.0013, {}});
        },
        [](const Pads& pads) {
          const PlaneGround plane{GroundPlane()};
          return bitsOf(pads.stiffness()) +
                 bitsOf(pads.wrenchInBody(swingingMotion(), plane).torque);
        });
  }
}

TEST(ForeignEnvironment, GroundsAreTheSame) {
  for (const double spacing : {0.3, 0.07, 0.11}) {
    const HeightGrid grid = {3,    3,   spacing,
                             -0.2, 0.1, {0.1, 0.2, 0.3, 0.15, 0.1, 0.07, 0.3, 0.1, 0.2}};
    expectMadeAlike(
        "HeightMapGround", [&] { return std::make_unique<HeightMapGround>(grid); }, sampledBits);
  }
  const ConvexPolyhedron body = cylinderPolyhedron(0.9, 0.3, 24);
  const Pose X_WO = {rotationFromRpy({0.13, 0.21, 0.34}), {0.1, 0.2, 0.03}};
  expectMadeAlike(
      "RoofGround",
      [&] {
        auto roofs = std::make_unique<RoofGround>(nullptr);
        roofs->add(body, X_WO);
        return roofs;
      },
      sampledBits);
}

TEST(ForeignEnvironment, StepsOfModesAreTheSame) {
  for (const Integrator integrator :
       {Integrator::kEuler, Integrator::kSemiImplicitEuler, Integrator::kHeun,
        Integrator::kRungeKutta4, Integrator::kLie4}) {
    testing::expectSameBits("longestStableStep", [&] {
      return bitsOf(longestStableStep(integrator, {5.15, 83.1, 16801.7, 0.0}));
    });
  }
}

}  // namespace
}  // namespace hovercraft
