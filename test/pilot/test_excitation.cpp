#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/pilot/excitation.h"

namespace hovercraft {
namespace {

template <class Timed>
double levelAt(const Timed& task, double t) {
  Levels levels(1);
  levelsAt(task, t, levels);
  return levels[0];
}

TEST(Excitation, AStepHoldsUntilTheNextOneAndTheLastOneForEver) {
  const Steps steps = {{{1.0}, {3.0}, {2.0}}, 0.7, Response::kSurge};
  EXPECT_DOUBLE_EQ(durationOf(steps), 2.1);
  EXPECT_EQ(levelAt(steps, 0.0), 1.0);
  EXPECT_EQ(levelAt(steps, 0.69), 1.0);
  EXPECT_EQ(levelAt(steps, 0.7), 3.0);
  EXPECT_EQ(levelAt(steps, 2.0 * 0.7), 2.0);
  // What rounding leaves of a border is the border: 3 · 0.1 / 0.1 is 3, 0.3 / 0.1 is less.
  EXPECT_EQ(levelAt(Steps{{{0.0}, {1.0}, {2.0}, {3.0}}, 0.1, Response::kSurge}, 0.3), 3.0);
  EXPECT_EQ(levelAt(steps, 99.0), 2.0);
}

TEST(Excitation, ARampIsAStraightLine) {
  const Ramp ramp = {{1.0}, {3.0}, 4.0};
  EXPECT_EQ(levelAt(ramp, 0.0), 1.0);
  EXPECT_EQ(levelAt(ramp, 1.0), 1.5);
  EXPECT_EQ(levelAt(ramp, 4.0), 3.0);
  EXPECT_EQ(levelAt(ramp, 5.0), 3.0);
}

TEST(Excitation, PrbsOfEveryOrderIsOfMaximumLength) {
  // Golomb's postulates: one more 1 than 0 in a period, and the autocorrelation of ±1 is -1 for
  // every shift but 0, which no shorter period has.
  for (int order = kLeastPrbsOrder; order <= kMostPrbsOrder; ++order) {
    const int length = (1 << order) - 1;
    std::vector<int> bits;
    for (int i = 0; i < length; ++i) bits.push_back(maximumLengthBit(order, i) ? 1 : -1);
    int sum = 0;
    for (const int bit : bits) sum += bit;
    EXPECT_EQ(sum, 1) << order;
    // All shifts of the short ones, some of the long ones.
    for (int shift = 1; shift < length; shift += order < 9 ? 1 : 97) {
      int product = 0;
      for (int i = 0; i < length; ++i) {
        product += bits[static_cast<std::size_t>(i)] *
                   bits[static_cast<std::size_t>((i + shift) % length)];
      }
      ASSERT_EQ(product, -1) << "order " << order << ", shift " << shift;
    }
    EXPECT_EQ(maximumLengthBit(order, length), maximumLengthBit(order, 0));
  }
}

TEST(Excitation, PrbsGoesBetweenItsLevelsOncePerBit) {
  const Prbs prbs = {{-1.0}, {2.0}, 3, 0.1, 2};
  EXPECT_DOUBLE_EQ(durationOf(prbs), 1.4);
  for (int i = 0; i < 14; ++i) {
    const double expected = maximumLengthBit(3, i) ? 2.0 : -1.0;
    EXPECT_EQ(levelAt(prbs, 0.1 * i), expected) << i;
    EXPECT_EQ(levelAt(prbs, 0.1 * i + 0.099), expected) << i;
  }
}

TEST(Excitation, TheFrequencyOfAChirpGoesFromTheFirstToTheLastOne) {
  // The phase is the integral of the frequency: linear f0 t + (f1 - f0) t²/2T, logarithmic
  // f0 T/ln(f1/f0) ((f1/f0)^(t/T) - 1), in turns.
  const Chirp linear = {{1.0}, {0.5}, 0.2, 3.0, 10.0, false};
  Chirp logarithmic = linear;
  logarithmic.is_logarithmic = true;
  for (double t = 0.0; t <= 10.0; t += 0.137) {
    const double turns = 0.2 * t + 2.8 * t * t / 20.0;
    EXPECT_NEAR(levelAt(linear, t), 1.0 + 0.5 * std::sin(2.0 * kPi * turns), 1e-12) << t;
    const double growth = std::log(3.0 / 0.2);
    const double log_turns = 0.2 * 10.0 / growth * (std::exp(growth * t / 10.0) - 1.0);
    EXPECT_NEAR(levelAt(logarithmic, t), 1.0 + 0.5 * std::sin(2.0 * kPi * log_turns), 1e-11) << t;
  }
}

TEST(Excitation, AChirpMayGoDownAndMayStay) {
  const Chirp down = {{0.0}, {1.0}, 3.0, 0.2, 10.0, true};
  const double growth = std::log(0.2 / 3.0);
  const double turns = 3.0 * 10.0 / growth * (std::exp(0.4 * growth) - 1.0);
  EXPECT_NEAR(levelAt(down, 4.0), std::sin(2.0 * kPi * turns), 1e-11);
  const Chirp even = {{0.0}, {1.0}, 0.25, 0.25, 10.0, true};
  EXPECT_NEAR(levelAt(even, 1.0), 1.0, 1e-15);
}

}  // namespace
}  // namespace hovercraft
