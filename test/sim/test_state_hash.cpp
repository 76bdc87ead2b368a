#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/state_hash.h"

#include "../support/scenarios.h"

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

/// Two craft whose numbers are sums of few powers of two, so that they can be followed by hand: 2
/// kg, 1, 2 and 2 kg m², steps of 0.5 s. The rear engine pushes through the centre of mass, up to 4
/// N.
std::string roundNumbers(const std::string& spin) {
  const auto craft = [](const std::string& name, const std::string& initial) {
    const std::string off = "direction: [1, 0, 0], min_thrust: 0, max_thrust: ";
    return "  " + name + ":\n    mass: 2\n    inertia: {ixx: 1, iyy: 2, izz: 2}\n    engines:\n" +
           "      rear: {position: [-1, 0, 0], " + off + "4}\n" +
           "      left: {position: [1, 0, 0], " + off + "0}\n" +
           "      right: {position: [1, 0, 0], " + off + "0}\n    initial: {" + initial + "}\n";
  };
  return "step_size: 0.5\nintegrator: euler\norientation: quaternion\nmodel: spatial\n"
         "gravity: [0, 0, 0]\nvehicles:\n" +
         craft("alpha",
               "position: [1, 2, 3], velocity: [0.5, 0.25, -1], angular_velocity: " + spin) +
         craft("beta", "position: [16, 0, 0.5]");
}

// The published hashes at the start, computed apart from this code (FNV-1a in Python, fields in the
// order of ARCHITECTURE.md) from: tick 0; alpha at (1, 2, 3), identity, P = 2 (0.5, 0.25, -1) = (1,
// 0.5, -2), L = (1·0.5, 2·0.25, 2·0.125) = (0.5, 0.5, 0.25); beta at (16, 0, 0.5), at rest; each
// engine 0, 0, -1.
TEST(StateHash, OfTheStartIsTheNumberByHand) {
  const Simulation simulation(testing::scenarioOf(roundNumbers("[0.5, 0.25, 0.125]")));
  EXPECT_EQ(simulation.hash(0), 0xc85e40ee876828e8ULL);
  EXPECT_EQ(simulation.hash(1), 0x15679bb95661b72dULL);
  EXPECT_EQ(simulation.hash(), 0x6adc73b271d86f90ULL);
}

// After two steps of Euler: alpha has moved by 2·0.5·v to (1.5, 2.25, 2); its rear engine, asked
// for 8 N at tick 1, gave 4 N for 0.5 s: P = (3, 0.5, -2), engine 8, 4, 1. Beta is pushed by 2 N
// along x: P = (2, 0, 0), and in the second step moved by 0.5·(1/2) to x = 16.25. Its wrench stays
// until tick 10: 1, 0, (2, 0, 0), (0, 0, 0), 10.
TEST(StateHash, OfARunIsTheNumberByHand) {
  Simulation simulation(testing::scenarioOf(roundNumbers("[0, 0, 0]")));
  simulation.push({1, 0, maskOf(EngineId::kRear), Vector3(8.0, 0.0, 0.0)});
  simulation.applyWrench(
      {1, ExternalWrench::Frame::kWorld, {{2.0, 0.0, 0.0}, Vector3::Zero()}, 10});
  simulation.step();
  simulation.step();
  EXPECT_EQ(simulation.hash(0), 0x8f34174c800a1f65ULL);
  EXPECT_EQ(simulation.hash(1), 0x8db4168fe9530a24ULL);
  EXPECT_EQ(simulation.hash(), 0x622febecd2e66c86ULL);
}

TEST(StateHash, OfOneCraftChangesWithTheTickAlone) {
  Simulation simulation(testing::scenarioOf(roundNumbers("[0, 0, 0]")));
  const std::uint64_t before = simulation.hash(1);
  simulation.step();  // beta rests
  EXPECT_NE(simulation.hash(1), before);
}

// By hand, as above: what contacts remember of bodies 1 and 3; edge 5 of the one, face 2 of the
// other, hints 6 and 7; at rest at two points of three.
TEST(StateHash, OfAContactIsTheNumberByHand) {
  ContactCache contact;
  contact.a = 1;
  contact.b = 3;
  contact.features = {true, {FeatureKind::kEdge, 5}, {FeatureKind::kFace, 2}, {6, 7}};
  contact.resting = true;
  contact.count = 2;
  for (int i = 0; i < 3; ++i) {
    contact.p_AC[static_cast<std::size_t>(i)] = Vector3(1.0, 2.0, 3.0 + i);
    contact.force_B_W[static_cast<std::size_t>(i)] = Vector3(0.5, -0.5, 8.0 * i);
  }
  StateHash hash;
  hash.add(contact);
  EXPECT_EQ(hash.value(), 0x8722507315af60a8ULL);
}

}  // namespace
}  // namespace hovercraft
