#pragma once

/// Bags as tests, for packages that use this one; needs gtest. The launch file of the test includes
/// sim.launch and names the gtest; then
///
///   TEST(MyCraft, FliesAsItDid) {
///     hovercraft_ros::Flight flight;
///     flight.play("commands.csv");
///     EXPECT_TRUE(hovercraft_ros::follows(flight, "reference.bag", {0.01, 0.02}));
///   }
///
/// and the main function returns hovercraft_ros::runFlightTests(argc, argv).
///
/// On failure it says which field parted first, when, and by how much.

#include <string>

#include <gtest/gtest.h>

#include <ros/init.h>
#include <ros/node_handle.h>

#include "hovercraft_sim/clients/flight.h"

namespace hovercraft_ros {

/// Whether the flight stays within the tolerance of the reference (.bag or .csv), see judge().
inline ::testing::AssertionResult follows(const Flight& flight, const std::string& reference,
                                          const FlightTolerance& tolerance) {
  const FlightVerdict verdict = judge(flight.trajectories(), reference, tolerance);
  return (verdict.follows ? ::testing::AssertionSuccess() : ::testing::AssertionFailure())
         << verdict.text;
}

/// main() of a gtest that a rostest launches.
inline int runFlightTests(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "flight_test");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}

}  // namespace hovercraft_ros
