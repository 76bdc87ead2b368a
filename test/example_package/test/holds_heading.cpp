#include <string>

#include "hovercraft_sim/clients/flight_test.h"

namespace {

std::string folder;

// The controller uses the C library's atan2, whose last bits differ between machines: hence a
// tolerance, m and rad. heading.bag is what `rosbag record /hovercraft/state` wrote of such a
// flight, every tenth message of it.
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
