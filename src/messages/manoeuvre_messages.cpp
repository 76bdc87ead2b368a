#include "hovercraft_sim/messages/manoeuvre_messages.h"

#include <cmath>
#include <limits>

#include "hovercraft_sim/messages/conversions.h"

namespace hovercraft_ros {
namespace {

// How far the square of an orientation's norm may be from 1: far more than a simulation's rounding.
constexpr double kUnitTolerance = 1e-6;

bool isUnit(const geometry_msgs::Quaternion& q) {
  const double square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  return std::abs(square - 1.0) <= kUnitTolerance;  // not if one is not finite
}

}  // namespace

hovercraft_sim::Manoeuvre toMessage(const hovercraft::FlownManoeuvre& flown,
                                    const ros::Time& stamp) {
  hovercraft_sim::Manoeuvre message;
  message.header.stamp = stamp;
  message.name = flown.name;
  message.kind = flown.kind;
  message.complete = flown.is_complete;
  message.reason = flown.reason;
  message.begin = flown.begin;
  message.execute = flown.execute;
  message.end = flown.end;
  for (const hovercraft::Measure& measure : flown.measures) {
    hovercraft_sim::Measure one;
    one.name = measure.name;
    one.unit = measure.unit;
    one.value = measure.value;
    message.measures.push_back(one);
  }
  message.text = hovercraft::toText(flown);
  return message;
}

std::optional<hovercraft::ObservedMotion> toObservedMotion(const hovercraft_sim::State& state,
                                                           std::int64_t step_ns) {
  const auto last_tick =
      static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() / step_ns);
  if (state.tick > last_tick || !isUnit(state.pose.orientation)) return std::nullopt;
  const hovercraft::ObservedMotion motion = {
      static_cast<hovercraft::Tick>(state.tick), fromMessage(state.pose.position),
      fromMessage(state.pose.orientation), fromMessage(state.velocity),
      fromMessage(state.angular_velocity)};
  const bool is_finite =
      motion.p_WB.allFinite() && motion.v_WB.allFinite() && motion.w_WB.allFinite();
  return is_finite ? std::optional(motion) : std::nullopt;
}

}  // namespace hovercraft_ros
