#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/live/command_schedule.h"

#include "../support/numbers.h"
#include "../support/scenarios.h"

namespace hovercraft_ros {
namespace {

using hovercraft_sim::AppliedCommand;
using hovercraft_sim::ScheduleCommands;

using hovercraft::testing::kNan;

ScheduleCommands::Request requestOf(std::uint64_t tick, double rear) {
  ScheduleCommands::Request request;
  request.vehicle = "beta";
  AppliedCommand command;
  command.tick = tick;
  command.episode = 3;
  command.engines = AppliedCommand::REAR | AppliedCommand::LEFT;
  command.rear = rear;
  command.left = 0.5;
  request.commands.push_back(command);
  return request;
}

/// Of an episode 3 that stands at tick 100.
std::vector<hovercraft::Command> taken(const ScheduleCommands::Request& request) {
  const auto scenario = hovercraft::testing::scenarioOf(hovercraft::testing::twoCraftYaml());
  return scheduledCommands(scenario, request, 3, 100);
}

std::string refusal(const ScheduleCommands::Request& request) {
  try {
    taken(request);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

/// A request with its only command changed.
std::string refusalOf(const std::function<void(AppliedCommand&)>& change) {
  ScheduleCommands::Request request = requestOf(100, 1.0);
  change(request.commands.front());
  return refusal(request);
}

TEST(CommandSchedule, GivesCommandsAtTheirTicksInTheOrderInWhichTheyCame) {
  CommandSchedule schedule;
  schedule.add(taken(requestOf(120, 1.0)));
  schedule.add(taken(requestOf(110, 2.0)));
  schedule.add(taken(requestOf(120, 3.0)));
  EXPECT_EQ(schedule.next(), 110);
  EXPECT_FALSE(schedule.takeDue(109));
  const auto first = schedule.takeDue(110);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->tick, 110);
  EXPECT_EQ(first->vehicle, 1U);
  EXPECT_EQ(first->engines, 3);
  EXPECT_EQ(first->thrusts, hovercraft::Vector3(2.0, 0.5, 0.0));
  EXPECT_FALSE(schedule.takeDue(119));
  EXPECT_EQ(schedule.takeDue(120)->thrusts[0], 1.0);
  EXPECT_EQ(schedule.takeDue(120)->thrusts[0], 3.0);
  EXPECT_FALSE(schedule.takeDue(1000));
  EXPECT_FALSE(schedule.next());
}

TEST(CommandSchedule, ForgetsWhenItIsCleared) {
  CommandSchedule schedule;
  schedule.add(taken(requestOf(120, 1.0)));
  schedule.clear();
  EXPECT_FALSE(schedule.next());
  EXPECT_FALSE(schedule.takeDue(1000));
}

TEST(CommandSchedule, RefusesWhatCannotActAndNamesTheCommand) {
  EXPECT_EQ(refusal(requestOf(100, 1.0)), "");
  ScheduleCommands::Request request = requestOf(100, 1.0);
  request.vehicle = "gamma";
  EXPECT_EQ(refusal(request), "vehicle = gamma: must be one of: alpha, beta");
  request = requestOf(100, 1.0);
  request.commands.push_back(requestOf(99, 1.0).commands.front());
  EXPECT_EQ(refusal(request),
            "commands[1]: tick = 99: must be 100, where the run stands, or later, and fit 63 bits");
  EXPECT_NE(refusalOf([](AppliedCommand& command) {
              command.tick = 1ULL << 63U;
            }).find("tick = 9223372036854775808"),
            std::string::npos);
  EXPECT_EQ(refusalOf([](AppliedCommand& command) { command.episode = 2; }),
            "commands[0]: episode = 2: must be that of the run, 3");
  EXPECT_EQ(refusalOf([](AppliedCommand& command) { command.engines = 0; }),
            "commands[0]: engines = 0: must be 1 to 7");
  EXPECT_EQ(refusalOf([](AppliedCommand& command) { command.engines = 8; }),
            "commands[0]: engines = 8: must be 1 to 7");
  EXPECT_EQ(refusalOf([](AppliedCommand& command) { command.ids = {3}; }),
            "commands[0]: ids and values: must be as many");
  EXPECT_EQ(refusalOf([](AppliedCommand& command) {
              command.ids = {3};
              command.values = {1.0};
            }),
            "commands[0]: ids[0] = 3: must be an actuator of the craft, ascending");
  EXPECT_EQ(refusalOf([](AppliedCommand& command) { command.left = kNan; }),
            "commands[0]: a thrust must be finite");
}

}  // namespace
}  // namespace hovercraft_ros
