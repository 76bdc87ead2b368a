#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/state_hash.h"

namespace hovercraft {
namespace {

// FNV-1a of the eight bytes 1, 0, 0, ...: (offset basis ^ 1) · prime, then seven times · prime.
TEST(StateHash, IsFnv1aOfTheBytesLowestFirst) {
  StateHash hash;
  EXPECT_EQ(hash.value(), 14695981039346656037ULL);
  hash.add(std::uint64_t{1});
  std::uint64_t expected = 14695981039346656037ULL ^ 1U;
  for (int byte = 0; byte < 8; ++byte) expected *= 1099511628211ULL;
  EXPECT_EQ(hash.value(), expected);
  StateHash of_double;
  of_double.add(1.0);  // 0x3ff0000000000000
  StateHash of_bits;
  of_bits.add(std::uint64_t{0x3ff0000000000000});
  EXPECT_EQ(of_double.value(), of_bits.value());
}

template <class State>
std::uint64_t hashOf(const State& state) {
  StateHash hash;
  hash.add(state);
  return hash.value();
}

template <class Body>
std::vector<double*> numbersOf(Body& body) {
  std::vector<double*> numbers;
  for (Vector3* v : {&body.p_WB, &body.momentum_W, &body.angular_momentum_W}) {
    for (int i = 0; i < 3; ++i) numbers.push_back(&(*v)[i]);
  }
  return numbers;
}

TEST(StateHash, ChangesWithTheLastBitOfEachFieldOfAQuaternionState) {
  RigidBodyState<Quaternion> body;
  std::vector<double*> numbers = numbersOf(body);
  numbers.push_back(&body.orientation.s);
  for (int i = 0; i < 3; ++i) numbers.push_back(&body.orientation.v[i]);
  const std::uint64_t before = hashOf(BodyState(body));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double kept = *numbers[i];
    *numbers[i] = std::nextafter(kept, 2.0);
    EXPECT_NE(hashOf(BodyState(body)), before) << "number " << i;
    *numbers[i] = kept;
  }
}

TEST(StateHash, ChangesWithTheLastBitOfEachFieldOfAMatrixState) {
  RigidBodyState<Matrix3> body;
  body.orientation = Matrix3::Identity();
  std::vector<double*> numbers = numbersOf(body);
  for (int i = 0; i < 9; ++i) numbers.push_back(body.orientation.data() + i);
  const std::uint64_t before = hashOf(BodyState(body));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double kept = *numbers[i];
    *numbers[i] = std::nextafter(kept, 2.0);
    EXPECT_NE(hashOf(BodyState(body)), before) << "number " << i;
    *numbers[i] = kept;
  }
}

TEST(StateHash, ChangesWithEachFieldOfAnEngine) {
  const EngineStates engines;
  for (std::size_t i = 0; i < engines.size(); ++i) {
    EngineStates other = engines;
    other[i].commanded = 5e-324;
    EXPECT_NE(hashOf(other), hashOf(engines)) << kEngineNames[i];
    other = engines;
    other[i].thrust = 5e-324;
    EXPECT_NE(hashOf(other), hashOf(engines)) << kEngineNames[i];
    other = engines;
    other[i].command_tick = 0;
    EXPECT_NE(hashOf(other), hashOf(engines)) << kEngineNames[i];
  }
}

}  // namespace
}  // namespace hovercraft
