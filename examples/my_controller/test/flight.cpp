#include <string>

#include <hovercraft_sim/clients/flight_test.h>

namespace {

std::string reference;

// Within a millimetre and a milliradian of the recorded flight, at each of its states.
TEST(MyController, FliesAsItWasRecorded) {
  hovercraft_ros::Flight flight;
  flight.watch(8.0);
  EXPECT_TRUE(hovercraft_ros::follows(flight, reference, {0.001, 0.001}));
}

}  // namespace

int main(int argc, char** argv) {
  reference = argc > 1 ? argv[1] : "reference.bag";
  return hovercraft_ros::runFlightTests(argc, argv);
}
