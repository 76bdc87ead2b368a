#include <cfenv>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/floating_point_environment.h"

#include "../support/foreign_environment.h"

namespace hovercraft {
namespace {

using testing::ControlRegisters;
using testing::controlRegisters;
using testing::Foreign;
using testing::InForeignEnvironment;
using testing::kForeign;
using testing::nameOf;

/// Computed when it runs, not by the compiler.
double quotient(double a, double b) {
  volatile double dividend = a;
  volatile double divisor = b;
  volatile double result = dividend / divisor;
  return result;
}

/// Three numbers that depend on rounding and on denormal numbers.
struct Numbers {
  double third;
  double denormal;
  double from_denormal;

  bool operator==(const Numbers& other) const {
    return third == other.third && denormal == other.denormal &&
           from_denormal == other.from_denormal;
  }
};

// Not inlined, so that no part of it is moved to where another environment holds.
[[gnu::noinline]] Numbers numbers() {
  const double least = std::numeric_limits<double>::min();
  return {quotient(1.0, 3.0), quotient(least, 4.0),
          quotient(std::numeric_limits<double>::denorm_min(), least)};
}

TEST(FloatingPointEnvironment, NumbersAreThoseOfIeee754AndTheThreadsEnvironmentComesBack) {
  const Numbers expected = numbers();
  ASSERT_GT(expected.denormal, 0.0);
  for (const Foreign foreign : kForeign) {
    Numbers inside{};
    ControlRegisters before;
    ControlRegisters after;
    {
      const InForeignEnvironment in_foreign(foreign);
      before = controlRegisters();
      {
        const FloatingPointEnvironment environment;
        inside = numbers();
      }
      after = controlRegisters();
    }
    EXPECT_TRUE(inside == expected) << nameOf(foreign);
    EXPECT_TRUE(after == before) << nameOf(foreign);
  }
}

// Else the test above could not fail.
TEST(FloatingPointEnvironment, ForeignOnesChangeNumbers) {
  const Numbers expected = numbers();
  for (const Foreign foreign :
       {Foreign::kFlushToZero, Foreign::kDenormalsAreZero, Foreign::kFastMath, Foreign::kUpward}) {
    Numbers inside{};
    {
      const InForeignEnvironment in_foreign(foreign);
      inside = numbers();
    }
    EXPECT_FALSE(inside == expected) << nameOf(foreign);
  }
}

TEST(FloatingPointEnvironment, AnErrorThatLeavesItBringsTheThreadsBack) {
  ControlRegisters before;
  ControlRegisters after;
  {
    const InForeignEnvironment in_foreign(Foreign::kUpward);
    before = controlRegisters();
    try {
      const FloatingPointEnvironment environment;
      throw std::invalid_argument("");
    } catch (const std::invalid_argument&) {
      after = controlRegisters();
    }
  }
  EXPECT_TRUE(after == before);
}

TEST(FloatingPointEnvironment, InsideAnotherItChangesNothing) {
  const Numbers expected = numbers();
  Numbers inside{};
  {
    const InForeignEnvironment in_foreign(Foreign::kUpward);
    const FloatingPointEnvironment outer;
    { const FloatingPointEnvironment inner; }
    inside = numbers();
  }
  EXPECT_TRUE(inside == expected);
}

TEST(FloatingPointEnvironment, InTheDefaultOneTheFlagsAreThoseOfTheArithmetic) {
  std::feclearexcept(FE_ALL_EXCEPT);
  {
    const FloatingPointEnvironment environment;
    quotient(1.0, 3.0);
  }
  EXPECT_EQ(std::fetestexcept(FE_ALL_EXCEPT), FE_INEXACT);
}

}  // namespace
}  // namespace hovercraft
