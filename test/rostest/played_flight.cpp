// Flight::play() flies what simulate computes, to the last bit: in lockstep (/hovercraft_sim) and
// at a pace (/free/hovercraft_sim), with commands at any tick.

#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <hovercraft_sim/ScheduleCommands.h>
#include <ros/package.h>
#include <ros/service.h>

#include "hovercraft_sim/bags/simulate.h"
#include "hovercraft_sim/clients/flight_test.h"

#include "../support/temporary_folder.h"

namespace hovercraft_ros::testing {
namespace {

constexpr const char* kLockstepNode = "/hovercraft_sim";
constexpr const char* kFreeNode = "/free/hovercraft_sim";

// The control period is 0.01 s, a step 0.001 s. A row with a time between two steps acts at the
// second one; empty fields leave an engine alone; at 0.9 s comes a command while the others were
// long enough ago to time out.
constexpr const char* kOffTheGrid =
    "time,rear,left,right\n0,1,,\n0.0004,2,,0.1\n0.0134,3,0,0\n0.0135,3,0.4,\n0.2071,2.5,,0.45\n"
    "0.21,1,0.2,\n0.9003,,,0\n";

class PlayedFlight : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.path() + "/" + name; }

  std::string offTheGrid() const {
    std::ofstream(file("commands.csv")) << kOffTheGrid;
    return file("commands.csv");
  }

  /// What simulate computes; the node publishes every tenth state.
  std::string reference(const std::string& commands) const {
    SimulateRequest request;
    request.scenario = ros::package::getPath("hovercraft_sim") + "/config/hovercraft.yaml";
    request.commands = commands;
    request.output = file("reference.csv");
    request.every = 10;
    request.hold = true;
    std::ostringstream messages;
    simulate(request, messages);
    return request.output;
  }

  TemporaryFolder folder_;
};

TEST_F(PlayedFlight, TheShippedManoeuvreInLockstepIsThatOfSimulate) {
  const std::string manoeuvre = ros::package::getPath("hovercraft_sim") + "/config/manoeuvre.csv";
  Flight flight(kLockstepNode);
  flight.play(manoeuvre);
  EXPECT_TRUE(follows(flight, reference(manoeuvre), {}));
}

TEST_F(PlayedFlight, InLockstepCommandsActAtTheirTicksOnTheControlGridAndOffIt) {
  Flight flight(kLockstepNode);
  flight.play(offTheGrid());
  EXPECT_TRUE(follows(flight, reference(offTheGrid()), {}));
}

TEST_F(PlayedFlight, AtAPaceTheyActAtTheSame) {
  Flight flight(kFreeNode);
  flight.play(offTheGrid());
  EXPECT_TRUE(follows(flight, reference(offTheGrid()), {}));
}

TEST_F(PlayedFlight, AResetForgetsWhatWasScheduled) {
  const Flight before(kFreeNode);  // at tick 0
  hovercraft_sim::ScheduleCommands call;
  call.request.vehicle = "hovercraft";
  ASSERT_TRUE(ros::service::call("/free/hovercraft_sim/schedule", call));
  ASSERT_TRUE(call.response.success) << call.response.message;
  EXPECT_EQ(call.response.control_period, 0U);  // no lockstep
  hovercraft_sim::AppliedCommand command;
  command.tick = call.response.tick + 20;
  command.episode = call.response.episode;
  command.engines = hovercraft_sim::AppliedCommand::REAR;
  command.rear = 4.0;
  call.request.commands = {command};
  ASSERT_TRUE(ros::service::call("/free/hovercraft_sim/schedule", call));
  ASSERT_TRUE(call.response.success) << call.response.message;
  Flight flight(kFreeNode);  // resets
  flight.watch(1.0);
  EXPECT_EQ(flight.trajectories().front().samples.back().p_WB.x(), 0.0);
  // The episode that it was meant for is over.
  ASSERT_TRUE(ros::service::call("/free/hovercraft_sim/schedule", call));
  EXPECT_FALSE(call.response.success);
  EXPECT_NE(std::string(call.response.message).find("must be that of the run"), std::string::npos);
}

}  // namespace
}  // namespace hovercraft_ros::testing
