#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "hovercraft_sim/body/body_state.h"
#include "hovercraft_sim/math/tolerances.h"

#include "../support/numbers.h"
#include "../support/orientations.h"

namespace hovercraft {
namespace {

template <class T>
class BodyStates : public ::testing::Test {};

TYPED_TEST_SUITE(BodyStates, testing::Orientations, testing::OrientationName);

/// At rest, not turned, in a place.
template <class Orientation>
RigidBodyState<Orientation> restingAt(const Vector3& p_WB) {
  RigidBodyState<Orientation> state;
  state.p_WB = p_WB;
  state.orientation = testing::orientationOf<Orientation>(Quaternion());
  return state;
}

// The farthest coordinate is still in reach, the next double is not, along each axis, either way.
TYPED_TEST(BodyStates, AreInReachUpToTheFarthestCoordinate) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const auto at = [&](double distance) {
        return isInReach(restingAt<TypeParam>((sign * distance) * Vector3::Unit(axis)));
      };
      EXPECT_TRUE(at(kFarthest)) << axis;
      EXPECT_FALSE(at(std::nextafter(kFarthest, 1e300))) << axis;
      EXPECT_FALSE(at(std::numeric_limits<double>::infinity())) << axis;
      EXPECT_FALSE(at(testing::kNan)) << axis;
    }
  }
}

// An orientation that is none: of length 0, twice as long, or no number.
TYPED_TEST(BodyStates, AreOutOfReachWithoutAnOrientation) {
  const RigidBodyState<TypeParam> state = restingAt<TypeParam>(Vector3::Zero());
  for (const double scale : {0.0, 2.0, testing::kNan}) {
    RigidBodyState<TypeParam> lost = state;
    lost.orientation = scale * state.orientation;
    EXPECT_FALSE(isInReach(lost)) << scale;
  }
  EXPECT_TRUE(isInReach(state));
}

}  // namespace
}  // namespace hovercraft
