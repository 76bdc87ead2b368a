#pragma once

#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/math/vector.h"

/// Both representations of an orientation, for tests that hold for either:
/// TYPED_TEST_SUITE(Suite, testing::Orientations, testing::OrientationName).

namespace hovercraft::testing {

using Orientations = ::testing::Types<Quaternion, Matrix3>;

struct OrientationName {
  template <class T>
  static std::string GetName(int index) {  // NOLINT(readability-identifier-naming): gtest's name
    return index == 0 ? "Quaternion" : "Matrix";
  }
};

/// q_WB as the representation that the template argument names.
template <class Orientation>
Orientation orientationOf(const Quaternion& q_WB);
template <>
inline Quaternion orientationOf<Quaternion>(const Quaternion& q_WB) {
  return q_WB;
}
template <>
inline Matrix3 orientationOf<Matrix3>(const Quaternion& q_WB) {
  return rotationMatrix(q_WB);
}

}  // namespace hovercraft::testing
