#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/lanes/advances.h"
#include "hovercraft_sim/lanes/instruction_set.h"
#include "hovercraft_sim/lanes/lane_advance.h"

namespace hovercraft::lanes {
namespace {

/// Eight craft at a time by whatever instructions this file is compiled for: what a processor with
/// AVX-512 computes, but for the instructions themselves.
struct Eight {
  static constexpr std::size_t kWidth = 8;
  using Number = double __attribute__((vector_size(64)));
  using Mask = std::int64_t __attribute__((vector_size(64)));

  [[gnu::always_inline]] static Number sqrt(const Number& x) {
    Number root{};
    for (std::size_t i = 0; i < kWidth; ++i) root[i] = __builtin_sqrt(x[i]);
    return root;
  }
  [[gnu::always_inline]] static bool allOf(const Mask& mask) {
    bool all = true;
    for (std::size_t i = 0; i < kWidth; ++i) all = all && mask[i] != 0;
    return all;
  }
};

class RandomBlock {
 public:
  explicit RandomBlock(std::uint32_t seed) : random_(seed) {}

  double uniform(double least, double most) {
    return least + (most - least) * (static_cast<double>(random_()) / 4294967296.0);
  }
  void fill(Row* rows, std::size_t count, double least, double most) {
    for (std::size_t i = 0; i < count; ++i) {
      for (double& number : rows[i].of) number = uniform(least, most);
    }
  }

  Block block() {
    Block block = {};
    BlockConstants& constants = block.constants;
    fill(&constants.inverse_mass, 1, 0.1, 1.0);
    fill(constants.inverse_inertia_B, 9, -1.0, 5.0);
    fill(constants.engine_force, 9, -1.0, 1.0);
    fill(constants.engine_torque, 9, -0.3, 0.3);
    for (Rows3* rows : {&constants.drag_linear, &constants.drag_quadratic,
                        &constants.drag_angular_linear, &constants.drag_angular_quadratic}) {
      fill(*rows, 3, 0.0, 1.0);
    }
    fill(constants.weight_W, 3, -5.0, 5.0);
    fill(constants.half_decay, kMostActuators, 0.5, 1.0);
    fill(constants.full_decay, kMostActuators, 0.2, 0.5);
    BlockState& state = block.state;
    fill(state.p_WB, 3, -5.0, 5.0);
    fill(state.momentum_W, 3, -5.0, 5.0);
    fill(state.angular_momentum_W, 3, -0.5, 0.5);
    fill(state.level, kMostActuators, -1.0, 1.0);
    fill(block.demand, kMostActuators, -1.0, 1.0);
    for (std::size_t lane = 0; lane < kBlockLanes; ++lane) {
      state.q_s.of[lane] = 1.0;
      state.moves.of[lane] = lane == 5 ? 0 : -1;
      for (MaskRow& mask : constants.lags) mask.of[lane] = uniform(0.0, 1.0) < 0.7 ? -1 : 0;
    }
    state.momentum_W[0].of[2] = 1e200;  // that one is lost in the first step
    return block;
  }

 private:
  std::mt19937 random_;
};

/// The same in the plane. @param is_known whether its steps may leave out what is 0.
Block planarBlock(std::uint32_t seed, bool is_known) {
  Block block = RandomBlock(seed).block();
  for (std::size_t i = 0; i < 8; ++i) block.constants.inverse_inertia_B[i] = {};
  block.state.momentum_W[2] = block.state.angular_momentum_W[0] = {};
  block.state.angular_momentum_W[1] = {};
  block.constants.is_planar = is_known;
  return block;
}

constexpr std::size_t kRowsOfForces = 102;  // of planOf()

/// A force of each kind and two rotors, or none of them.
StepPlan planOf(Method method, bool has_more) {
  StepPlan plan;
  plan.method = method;
  plan.h = 0.01;
  plan.free_translation[2] = 0.0;
  if (!has_more) return plan;
  plan.actuator_count = 6;
  std::size_t row = 0;
  const auto add = [&](ForceKind kind, ForceKind fan_kind, std::size_t id, std::size_t rows) {
    plan.forces[plan.force_count++] = {kind, fan_kind, id, 4, row};
    row += rows;
  };
  add(ForceKind::kPolar, ForceKind::kNone, 0, kPolarRows);
  add(ForceKind::kFan, ForceKind::kNone, 3, kFanRows);
  add(ForceKind::kPropeller, ForceKind::kNone, 4, kPropellerRows);
  add(ForceKind::kRudder, ForceKind::kFan, 5, kRudderRows + kFanRows);
  add(ForceKind::kRudder, ForceKind::kPropeller, 5, kRudderRows + kPropellerRows);
  plan.rotors[0] = {1, true, row};
  plan.rotors[1] = {4, false, row + kRotorRows};
  plan.rotor_count = 2;
  return plan;
}

/// On a cushion of two cells and two fans, one of them turned by an actuator, and on pads.
GroundPlan groundOf(bool is_planar, std::size_t first_row) {
  GroundPlan ground;
  ground.has_cushion = true;
  ground.is_planar = is_planar;
  ground.has_pads = !is_planar;
  ground.fan_count = ground.cell_count = 2;
  ground.fans[1].actuator = 2;
  ground.point_count = 5;
  ground.cells[0] = {0, 0, 2};
  ground.cells[1] = {1, 2, 5};
  ground.cell_pairs[0] = {1, 0};
  ground.cell_pair_count = 1;
  ground.point_pairs[0] = {0, 3};
  ground.point_pairs[1] = {1, PairStep::kAlone};
  ground.point_pairs[2] = {4, 2};
  ground.point_pair_count = 3;
  ground.vertex_count = is_planar ? 0 : 5;
  ground.paired_count = is_planar ? 0 : 2;
  ground.first_row = first_row;
  return ground;
}

/// Everything that a block's state is, in bits.
std::vector<std::uint64_t> bitsOf(const BlockState& state) {
  std::vector<std::uint64_t> bits(sizeof(state) / sizeof(std::uint64_t));
  std::memcpy(bits.data(), &state, sizeof(state));
  return bits;
}

std::vector<std::uint64_t> bitsAfter(Advance advance, const StepPlan& plan, std::uint32_t seed) {
  constexpr std::size_t kSteps = 40;
  const std::size_t row_count = kRowsOfForces + plan.ground.rowCount();
  RandomBlock random(seed);
  Block block = random.block();
  std::vector<Row> more(row_count);
  random.fill(more.data(), row_count, 0.1, 0.4);
  std::vector<Row> winds(3 * kSteps);
  random.fill(winds.data(), winds.size(), -2.0, 2.0);
  std::vector<Row> speeds(6 * kSteps);  // of two fans
  random.fill(speeds.data(), speeds.size(), 0.5, 1.0);
  advance(plan, {&block, more.data(), winds.data(), 3, kSteps, speeds.data(), 6});
  advance(plan, {&block, more.data(), winds.data(), 0, kSteps, speeds.data(), 0});
  return bitsOf(block.state);
}

TEST(LaneAdvance, EveryInstructionSetHasTheBitsOfOneCraftAtATime) {
  for (const Method method : {Method::kEuler, Method::kSemiImplicitEuler, Method::kHeun,
                              Method::kRungeKutta4, Method::kLie4}) {
    for (const bool has_more : {false, true}) {
      const StepPlan plan = planOf(method, has_more);
      for (std::uint32_t seed = 1; seed < 20; ++seed) {
        const auto expected = bitsAfter(kAdvanceScalar, plan, seed);
        for (const InstructionSet set : availableInstructionSets()) {
          ASSERT_EQ(bitsAfter(advanceBy(set), plan, seed), expected)
              << instructionSetName(set) << ", method " << static_cast<int>(method) << ", seed "
              << seed;
        }
      }
    }
  }
}

TEST(LaneAdvance, CraftOverGroundHaveTheBitsOfOneCraftAtATime) {
  for (const Method method : {Method::kEuler, Method::kHeun, Method::kLie4}) {
    for (const bool is_planar : {false, true}) {
      StepPlan plan = planOf(method, true);
      plan.ground = groundOf(is_planar, kRowsOfForces);
      for (std::uint32_t seed = 1; seed < 20; ++seed) {
        const auto expected = bitsAfter(kAdvanceScalar, plan, seed);
        for (const InstructionSet set : availableInstructionSets()) {
          ASSERT_EQ(bitsAfter(advanceBy(set), plan, seed), expected)
              << instructionSetName(set) << ", method " << static_cast<int>(method) << ", seed "
              << seed;
        }
        if (method != Method::kHeun) continue;
        ASSERT_EQ(bitsAfter(advanceBlock<Eight, Method::kHeun>, plan, seed), expected) << seed;
      }
    }
  }
}

TEST(LaneAdvance, EightAtATimeHaveTheBitsOfOneAtATime) {
  for (const bool has_more : {false, true}) {
    const StepPlan plan = planOf(Method::kHeun, has_more);
    for (std::uint32_t seed = 1; seed < 20; ++seed) {
      EXPECT_EQ(bitsAfter(advanceBlock<Eight, Method::kHeun>, plan, seed),
                bitsAfter(kAdvanceScalar, plan, seed))
          << seed;
    }
  }
}

TEST(LaneAdvance, InThePlaneWhatIsLeftOutChangesNoBit) {
  std::vector<Row> wind(3);
  RandomBlock(7).fill(wind.data(), wind.size(), -2.0, 2.0);
  for (const Method method : {Method::kEuler, Method::kHeun, Method::kRungeKutta4}) {
    StepPlan plan = planOf(method, false);
    plan.free_rotation[0] = plan.free_rotation[1] = 0.0;
    for (std::uint32_t seed = 1; seed < 50; ++seed) {
      Block whole = planarBlock(seed, false);
      kAdvanceScalar(plan, {&whole, nullptr, wind.data(), 0, 40});
      const auto expected = bitsOf(whole.state);
      const auto advanced = [&](Advance advance) {
        Block block = planarBlock(seed, true);
        advance(plan, {&block, nullptr, wind.data(), 0, 40});
        return bitsOf(block.state);
      };
      for (const InstructionSet set : availableInstructionSets()) {
        ASSERT_EQ(advanced(advanceBy(set)), expected) << instructionSetName(set) << ", " << seed;
      }
      if (method != Method::kHeun) continue;
      ASSERT_EQ(advanced(advanceBlock<Eight, Method::kHeun>), expected) << seed;
    }
  }
}

TEST(LaneAdvance, OnlyACraftThatIsLostStays) {
  const StepPlan plan = planOf(Method::kHeun, false);
  RandomBlock random(3);
  const Block before = random.block();
  Block after = before;
  std::vector<Row> wind(3);
  kAdvanceScalar(plan, {&after, nullptr, wind.data(), 0, 10});
  for (std::size_t lane = 0; lane < kBlockLanes; ++lane) {
    const bool stays = lane == 2 || lane == 5;  // one was lost before
    EXPECT_EQ(after.state.p_WB[0].of[lane] == before.state.p_WB[0].of[lane], stays) << lane;
    EXPECT_EQ(after.state.moves.of[lane], stays ? 0 : -1) << lane;
  }
  EXPECT_EQ(after.state.lost_after[2], 0);
}

}  // namespace
}  // namespace hovercraft::lanes
