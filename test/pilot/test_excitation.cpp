#include <cmath>
#include <cstdint>
#include <numeric>
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

/// A period of a sequence, as ±1.
std::vector<int> signsOf(int order) {
  std::vector<int> signs(static_cast<std::size_t>((1 << order) - 1));
  for (std::size_t i = 0; i < signs.size(); ++i) {
    signs[i] = maximumLengthBit(order, static_cast<std::int64_t>(i)) ? 1 : -1;
  }
  return signs;
}

int autocorrelation(const std::vector<int>& signs, std::size_t shift) {
  int sum = 0;
  for (std::size_t i = 0; i < signs.size(); ++i)
    sum += signs[i] * signs[(i + shift) % signs.size()];
  return sum;
}

TEST(Excitation, PrbsOfEveryOrderIsOfMaximumLength) {
  // Golomb's postulates: one more 1 than 0 in a period, and the autocorrelation of ±1 is -1 for
  // every shift but 0, which no shorter period has.
  for (int order = kLeastPrbsOrder; order <= kMostPrbsOrder; ++order) {
    const std::vector<int> signs = signsOf(order);
    EXPECT_EQ(std::accumulate(signs.begin(), signs.end(), 0), 1) << order;
    // All shifts of the short ones, some of the long ones.
    for (std::size_t shift = 1; shift < signs.size(); shift += order < 9 ? 1 : 97) {
      ASSERT_EQ(autocorrelation(signs, shift), -1) << "order " << order << ", shift " << shift;
    }
    EXPECT_EQ(maximumLengthBit(order, static_cast<std::int64_t>(signs.size())), signs[0] == 1);
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

TEST(Excitation, ALogarithmicChirpOfNearlyOneFrequencyKeepsItsDigits) {
  // f0 t (1 + x/2 + x²/6) turns with x = ln(f1/f0) t/T; further terms are below 1e-18.
  for (const double difference : {1e-15, -1e-15, 1e-12, -1e-12, 1e-9, -1e-9, 1e-6, -1e-6}) {
    const Chirp chirp = {{0.0}, {1.0}, 2.0, 2.0 * (1.0 + difference), 100.0, true};
    for (double t = 0.0; t <= 100.0; t += 3.7) {
      const double x = std::log1p(difference) * (t / 100.0);
      const double turns = 2.0 * t * (1.0 + x / 2.0 + x * x / 6.0);
      EXPECT_NEAR(levelAt(chirp, t), std::sin(2.0 * kPi * (turns - std::floor(turns))), 1e-12)
          << difference << " at " << t;
    }
  }
  const Chirp next_to_it = {{0.0}, {1.0}, 2.0, std::nextafter(2.0, 3.0), 100.0, true};
  EXPECT_NEAR(levelAt(next_to_it, 0.125), 1.0, 1e-12);
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
