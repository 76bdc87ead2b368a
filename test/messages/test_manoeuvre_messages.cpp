#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include "hovercraft_sim/messages/manoeuvre_messages.h"

namespace hovercraft_ros {
namespace {

constexpr std::int64_t kObservedStepNs = 1000000;

hovercraft_sim::State observedState() {
  hovercraft_sim::State state;
  state.tick = 7;
  state.pose.position.x = 1.0;
  state.pose.orientation.w = 0.6;
  state.pose.orientation.z = 0.8;
  state.velocity.y = 2.0;
  state.angular_velocity.z = 3.0;
  return state;
}

bool isToldAt(std::uint64_t tick) {
  hovercraft_sim::State state = observedState();
  state.tick = tick;
  return toObservedMotion(state, kObservedStepNs).has_value();
}

TEST(ObservedMotion, HasTheNumbersOfTheState) {
  const auto motion = toObservedMotion(observedState(), kObservedStepNs);
  ASSERT_TRUE(motion.has_value());
  EXPECT_EQ(motion->tick, 7);
  EXPECT_EQ(motion->p_WB.x(), 1.0);
  EXPECT_EQ(motion->v_WB.y(), 2.0);
  EXPECT_EQ(motion->w_WB.z(), 3.0);
}

TEST(ObservedMotion, NumbersThatAreNotFiniteAreRefused) {
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    hovercraft_sim::State state = observedState();
    state.pose.position.z = value;
    EXPECT_FALSE(toObservedMotion(state, kObservedStepNs)) << value;
    state = observedState();
    state.pose.orientation.x = value;
    EXPECT_FALSE(toObservedMotion(state, kObservedStepNs)) << value;
    state = observedState();
    state.velocity.x = value;
    EXPECT_FALSE(toObservedMotion(state, kObservedStepNs)) << value;
    state = observedState();
    state.angular_velocity.y = value;
    EXPECT_FALSE(toObservedMotion(state, kObservedStepNs)) << value;
  }
}

TEST(ObservedMotion, OrientationsThatAreNoUnitQuaternionsAreRefused) {
  for (const double scale : {0.0, 0.99, 1.00001, 1e200}) {
    hovercraft_sim::State state = observedState();
    state.pose.orientation.w *= scale;
    state.pose.orientation.z *= scale;
    EXPECT_FALSE(toObservedMotion(state, kObservedStepNs)) << scale;
  }
  hovercraft_sim::State state = observedState();
  state.pose.orientation.w *= -(1.0 + 1e-12);
  state.pose.orientation.z *= -(1.0 + 1e-12);
  EXPECT_TRUE(toObservedMotion(state, kObservedStepNs));
}

TEST(ObservedMotion, TicksWhoseTimeHasNoNumberAreRefused) {
  const std::uint64_t last = std::numeric_limits<std::int64_t>::max() / kObservedStepNs;
  EXPECT_TRUE(isToldAt(0));
  EXPECT_TRUE(isToldAt(last));
  EXPECT_FALSE(isToldAt(last + 1));
  EXPECT_FALSE(isToldAt(std::numeric_limits<std::uint64_t>::max()));
}

}  // namespace
}  // namespace hovercraft_ros
