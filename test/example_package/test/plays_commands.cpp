#include <string>

#include "hovercraft_sim/clients/flight_test.h"

namespace {

std::string folder;

// In lockstep commands act at the ticks that the file means. reference.csv is from
//   simulate craft.yaml --commands commands.csv --hold --every 100 --output reference.csv
TEST(PlaysCommands, FliesAsTheReference) {
  hovercraft_ros::Flight flight;
  flight.play(folder + "/commands.csv");
  EXPECT_TRUE(follows(flight, folder + "/reference.csv", {0.001, 0.001}));
}

TEST(PlaysCommands, WithoutToleranceEveryBitCounts) {
  hovercraft_ros::Flight flight;
  flight.play(folder + "/commands.csv");
  EXPECT_TRUE(follows(flight, folder + "/reference.csv", {}));
}

}  // namespace

int main(int argc, char** argv) {
  folder = argc > 1 ? argv[1] : ".";
  return hovercraft_ros::runFlightTests(argc, argv);
}
