#include "hovercraft_sim/ros/manoeuvre_messages.h"

namespace hovercraft_ros {

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

}  // namespace hovercraft_ros
