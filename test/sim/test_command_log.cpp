#include <stdexcept>

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

double thrustOf(const Command* command) {
  return command == nullptr ? -1.0 : command->thrusts.x();
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
  log.push(at(5, 1.0));
  log.push(at(5, 2.0));
  log.push(at(6, 3.0));
  EXPECT_EQ(thrustOf(log.takeDue(5)), 1.0);
  EXPECT_EQ(thrustOf(log.takeDue(5)), 2.0);
  EXPECT_EQ(log.takeDue(5), nullptr);
  EXPECT_EQ(thrustOf(log.takeDue(6)), 3.0);
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
