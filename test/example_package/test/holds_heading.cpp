#include <string>

#include "hovercraft_sim/ros/flight_test.h"

namespace {

std::string folder;

// The controller uses the C library's atan2, whose last bits differ between machines: hence a
// tolerance, m and rad. heading.bag is `rosbag record /hovercraft/state` of this flight.
TEST(HoldsHeading, FliesAsItWasRecorded) {
  hovercraft_ros::Flight flight;
  flight.watch(6.0);
  EXPECT_TRUE(follows(flight, folder + "/heading.bag", {1e-6, 1e-6}));
}

}  // namespace

int main(int argc, char** argv) {
  folder = argc > 1 ? argv[1] : ".";
  return hovercraft_ros::runFlightTests(argc, argv);
}
