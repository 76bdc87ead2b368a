#include <gtest/gtest.h>

#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/run_events.h"

#include "../support/same_bits.h"
#include "../support/scenario_text.h"

// A node's threads belong to ROS and its plug-ins: what a service makes of a request, and what is
// published, does not depend on the floating-point environment.

namespace hovercraft_ros {
namespace {

using hovercraft::StateHash;
using hovercraft::testing::expectSameBits;
using hovercraft::testing::parsed;
using hovercraft::testing::validScenario;

hovercraft_sim::SetState::Request denormalStateRequest() {
  hovercraft_sim::SetState::Request request;
  request.vehicle = "alpha";
  request.pose.position = toPointMessage({1.1, 2e-310, 3.3});
  request.pose.orientation = toQuaternionMessage(hovercraft::quaternionFromRpy({0.1, 0.2, 0.7}));
  request.twist.linear = toVector3Message({0.5, -0.4, 0.1});
  request.twist.angular = toVector3Message({0.1, 0.3, 0.9});
  return request;
}

TEST(ForeignEnvironmentOfTheNode, ARequestedStateIsTheSame) {
  const hovercraft::Scenario scenario = parsed(validScenario());
  const auto request = denormalStateRequest();
  expectSameBits("set_state", [&] {
    hovercraft::Simulation simulation(scenario);
    const hovercraft_sim::RunEvent event = setStateEvent(scenario, request);
    applyEvent(event, simulation);
    StateHash hash;
    hash.add(fromMessage(event.pose.position));
    hash.add(fromMessage(event.twist.linear));
    hash.add(simulation.hash());
    return hash.value();
  });
}

TEST(ForeignEnvironmentOfTheNode, WhatIsPublishedIsTheSame) {
  const hovercraft::Simulation simulation(parsed(validScenario()));
  expectSameBits("hullMotion", [&] {
    const HullMotion hull = hullMotion(simulation.motion(0), {0.01, 0.02, 0.03});
    StateHash hash;
    hash.add(hull.p_WH);
    hash.add(hull.v_WH_H);
    hash.add(hull.w_WH_H);
    return hash.value();
  });
  expectSameBits("turnFromX", [] {
    StateHash hash;
    hash.add(turnFromX({0.3, 0.2, -0.7}));
    return hash.value();
  });
}

}  // namespace
}  // namespace hovercraft_ros
