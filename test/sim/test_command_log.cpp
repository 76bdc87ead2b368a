#include <cstddef>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/command_log.h"

namespace hovercraft {
namespace {

Command at(Tick tick, double thrust) {
  Command command;
  command.tick = tick;
  command.thrusts = {thrust, 0.0, 0.0};
  return command;
}

Command of(std::size_t vehicle, EngineMask engines, double thrust) {
  Command command = at(5, thrust);
  command.vehicle = vehicle;
  command.engines = engines;
  return command;
}

/// The thrusts of the commands that wait.
std::vector<double> waitingIn(const CommandLog& log) {
  std::vector<double> thrusts;
  for (const Command& command : log.waiting()) thrusts.push_back(command.thrusts[0]);
  return thrusts;
}

double thrustOf(const Command* command) {
  return command == nullptr ? -1.0 : command->thrusts[0];
}

TEST(EngineMask, HasOneBitForEachEngine) {
  EXPECT_EQ(maskOf(EngineId::kRear), 1);
  EXPECT_EQ(maskOf(EngineId::kLeft), 2);
  EXPECT_EQ(maskOf(EngineId::kRight), 4);
  EXPECT_EQ(kAllEngines, 7);
}

TEST(CommandLog, GivesACommandFromItsTickOnAndOnce) {
  CommandLog log;
  EXPECT_TRUE(log.empty());
  log.push(at(5, 1.0));
  EXPECT_FALSE(log.empty());
  EXPECT_EQ(log.takeDue(4), nullptr);
  EXPECT_EQ(thrustOf(log.takeDue(5)), 1.0);
  EXPECT_EQ(log.takeDue(5), nullptr);
  EXPECT_TRUE(log.empty());
}

TEST(CommandLog, ALateQuestionStillGetsTheCommand) {
  CommandLog log;
  log.push(at(5, 1.0));
  EXPECT_EQ(thrustOf(log.takeDue(9)), 1.0);
}

TEST(CommandLog, CommandsOfOneTickComeInTheOrderTheyWereGiven) {
  CommandLog log;
  log.push(of(1, kAllEngines, 1.0));
  log.push(of(0, kAllEngines, 2.0));
  log.push(at(6, 3.0));
  EXPECT_EQ(thrustOf(log.takeDue(5)), 1.0);
  EXPECT_EQ(thrustOf(log.takeDue(5)), 2.0);
  EXPECT_EQ(log.takeDue(5), nullptr);
  EXPECT_EQ(thrustOf(log.takeDue(6)), 3.0);
}

TEST(CommandLog, DropsWhatALaterCommandReplacesForAllItsEngines) {
  CommandLog log;
  log.push(at(4, 0.0));               // another tick
  log.push(of(0, kAllEngines, 1.0));  // the left engine's command leaves two engines of it
  log.push(of(1, kAllEngines, 2.0));  // another craft
  log.push(of(0, maskOf(EngineId::kLeft), 3.0));
  log.push(of(0, maskOf(EngineId::kRear), 4.0));
  EXPECT_EQ(waitingIn(log), (std::vector<double>{0.0, 1.0, 2.0, 3.0, 4.0}));
  log.push(of(0, maskOf(EngineId::kLeft), 5.0));
  EXPECT_EQ(waitingIn(log), (std::vector<double>{0.0, 1.0, 2.0, 4.0, 5.0}));
  log.push(of(0, kAllEngines, 6.0));
  EXPECT_EQ(waitingIn(log), (std::vector<double>{0.0, 2.0, 6.0}));
}

// A paused simulation to which somebody goes on sending.
TEST(CommandLog, ManyCommandsOfOneTickTakeBoundedMemory) {
  CommandLog log;
  for (int i = 0; i < 100000; ++i) {
    log.push(of(static_cast<std::size_t>(i % 2), static_cast<EngineMask>(1 + i % 7), 1.0));
  }
  EXPECT_LE(log.waiting().size(), 2U * 7U);
}

TEST(CommandLog, WhatWasTakenNoLongerWaitsAndIsNotReplaced) {
  CommandLog log;
  log.push(at(5, 1.0));
  EXPECT_EQ(thrustOf(log.takeDue(5)), 1.0);
  log.push(at(5, 2.0));
  EXPECT_EQ(waitingIn(log), (std::vector<double>{2.0}));
  EXPECT_EQ(thrustOf(log.takeDue(5)), 2.0);
}

TEST(CommandLog, ACommandBeforeTheLastOneIsOurOwnMistake) {
  CommandLog log;
  log.push(at(5, 1.0));
  EXPECT_THROW(log.push(at(4, 2.0)), std::logic_error);
  EXPECT_NO_THROW(log.push(at(5, 2.0)));
}

// Always one or more in waiting, as a reader that looks ahead leaves it: every one of 10,000 comes
// in its turn.
TEST(CommandLog, KeepsTheOrderWhileItIsNeverEmpty) {
  CommandLog log;
  Tick pushed = 0;
  for (; pushed < 3; ++pushed) log.push(at(pushed, static_cast<double>(pushed)));
  for (Tick tick = 0; tick < 10000; ++tick) {
    for (int i = 0; i < (tick % 2 == 0 ? 2 : 0); ++i, ++pushed) {
      log.push(at(pushed, static_cast<double>(pushed)));
    }
    ASSERT_EQ(thrustOf(log.takeDue(tick)), static_cast<double>(tick));
    ASSERT_EQ(log.takeDue(tick), nullptr);
    ASSERT_FALSE(log.empty());
  }
}

}  // namespace
}  // namespace hovercraft
