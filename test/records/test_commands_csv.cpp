#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/records/commands_csv.h"

#include "../support/files.h"
#include "../support/scenarios.h"

namespace hovercraft {
namespace {

using testing::messageOf;
using testing::oneCraftYaml;
using testing::scenarioOf;
using testing::TestFolder;
using testing::twoCraftYaml;

class CommandsCsv : public ::testing::Test {
 protected:
  std::vector<Command> commandsOf(const std::string& text, const Scenario& scenario) const {
    CsvCommandSource source(folder_.write("c.csv", text), scenario);
    std::vector<Command> commands;
    while (const auto command = source.next()) commands.push_back(*command);
    return commands;
  }

  /// The error without the path of the folder.
  std::string errorOf(const std::string& text, const Scenario& scenario) const {
    const std::string message = messageOf([&] { commandsOf(text, scenario); });
    const std::string path = folder_.file("c.csv");
    EXPECT_EQ(message.rfind(path, 0), 0U) << message;
    return message.size() < path.size() ? message : "c.csv" + message.substr(path.size());
  }

  TestFolder folder_;
  Scenario one_ = scenarioOf(oneCraftYaml());
  Scenario two_ = scenarioOf(twoCraftYaml());
};

TEST_F(CommandsCsv, ARowIsACommandForEveryEngineOfTheOnlyVehicle) {
  const auto commands = commandsOf("time,rear,left,right\n0,1,-2,3e-1\n0.5,4,5,6\n", one_);
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(commands[0].tick, 0);
  EXPECT_EQ(commands[0].vehicle, 0U);
  EXPECT_EQ(commands[0].engines, kAllEngines);
  EXPECT_EQ(commands[0].thrusts, Vector3(1.0, -2.0, 0.3));
  EXPECT_EQ(commands[1].tick, 50);
  EXPECT_EQ(commands[1].thrusts, Vector3(4.0, 5.0, 6.0));
}

TEST_F(CommandsCsv, TakesEffectAtTheFirstTickAtOrAfterItsTime) {
  const auto commands = commandsOf(
      "time,rear,left,right\n0.01,0,0,0\n0.010000001,0,0,0\n0.0199999994,0,0,0\n"
      "0.02,0,0,0\n0.29,0,0,0\n0.57,0,0,0\n1e3,0,0,0\n",
      one_);
  std::vector<Tick> ticks;
  ticks.reserve(commands.size());
  for (const Command& command : commands) ticks.push_back(command.tick);
  // 0.29 / 0.01 and 0.57 / 0.01 are 28.999999999999996 and 56.99999999999999 in doubles.
  EXPECT_EQ(ticks, (std::vector<Tick>{1, 2, 2, 2, 29, 57, 100000}));
}

TEST_F(CommandsCsv, AnEmptyFieldLeavesItsEngineAlone) {
  const auto commands = commandsOf("time,rear,left,right\n0,,2,\n1,3, ,\n", one_);
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(commands[0].engines, maskOf(EngineId::kLeft));
  EXPECT_EQ(commands[0].thrusts, Vector3(0.0, 2.0, 0.0));
  EXPECT_EQ(commands[1].engines, maskOf(EngineId::kRear));
}

TEST_F(CommandsCsv, NamesAVehicleOfSeveral) {
  const auto commands =
      commandsOf("time,vehicle,rear,left,right\n0,beta,1,2,3\n0,alpha,4,5,6\n", two_);
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(commands[0].vehicle, 1U);
  EXPECT_EQ(commands[1].vehicle, 0U);
  EXPECT_EQ(commands[1].thrusts, Vector3(4.0, 5.0, 6.0));
  EXPECT_EQ(commandsOf("time,vehicle,rear,left,right\n0,craft,1,2,3\n", one_).size(), 1U);
}

TEST_F(CommandsCsv, PassesOverCarriageReturnsBlanksByteOrderMarkAndBlankLinesAtTheEnd) {
  const auto commands =
      commandsOf("\xEF\xBB\xBFtime, rear,left,right\r\n0 , 1,\t2,3\r\n 1,4,5,6 \r\n\r\n \n", one_);
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(commands[0].thrusts, Vector3(1.0, 2.0, 3.0));
  EXPECT_EQ(commands[1].thrusts, Vector3(4.0, 5.0, 6.0));
  EXPECT_EQ(commandsOf("time,rear,left,right\n0,1,2,3", one_).size(), 1U);  // no end of line
}

TEST_F(CommandsCsv, AFileWithoutRowsHasNoCommands) {
  EXPECT_TRUE(commandsOf("time,rear,left,right\n", one_).empty());
}

TEST_F(CommandsCsv, EveryErrorNamesLineColumnValueAndRule) {
  const std::string header = "time,rear,left,right\n";
  const std::vector<std::pair<std::string, std::string>> errors = {
      {header + "0,1,2\n", "c.csv:2: 3 fields: must have 4, as the header"},
      {header + "0,1,2,3,4\n", "c.csv:2: 5 fields: must have 4, as the header"},
      {header + "0,1,2,3\n1,x,2,3\n", "c.csv:3: rear = x: must be a number"},
      {header + "0,1,nan,3\n", "c.csv:2: left = nan: must be finite"},
      {header + "0,1,2,1e999\n", "c.csv:2: right = 1e999: must be finite"},
      {header + "inf,1,2,3\n", "c.csv:2: time = inf: must be finite"},
      {header + ",1,2,3\n", "c.csv:2: time = : must be a number"},
      {header + "-0.1,1,2,3\n", "c.csv:2: time = -0.1: must be 0 or greater"},
      {header + "1000001,1,2,3\n", "c.csv:2: time = 1000001: must be at most 1000000 s"},
      {header + "2,1,2,3\n1.5,1,2,3\n",
       "c.csv:3: time = 1.5: must not be less than the time before it, 2"},
      {header + "0,,,\n", "c.csv:2: must have a thrust for at least one engine"},
      {header + "0,1,2,3\n\n1,1,2,3\n", "c.csv:3: a blank line must be the last"},
      {header + "0;1;2;3\n", "c.csv:2: 1 fields: must have 4, as the header"},
      {"", "c.csv: the file is empty; a header is missing"},
      {"rear,left,right\n",
       "c.csv:1: header = rear,left,right: must be time,rear,left,right or "
       "time,vehicle,rear,left,right"},
      {"0,1,2,3\n",
       "c.csv:1: header = 0,1,2,3: must be time,rear,left,right or time,vehicle,rear,left,right"},
      {"time,vehicle,rear,left,right\n0,Craft,1,2,3\n",
       "c.csv:2: vehicle = Craft: must be a vehicle of the scenario: craft"},
  };
  for (const auto& [text, message] : errors) EXPECT_EQ(errorOf(text, one_), message);
}

TEST_F(CommandsCsv, SeveralVehiclesNeedTheirColumn) {
  EXPECT_EQ(errorOf("time,rear,left,right\n", two_),
            "c.csv:1: header = time,rear,left,right: must be time,vehicle,rear,left,right");
  EXPECT_EQ(errorOf("time,vehicle,rear,left,right\n0,,1,2,3\n", two_),
            "c.csv:2: vehicle = : must be a vehicle of the scenario: alpha, beta");
}

TEST_F(CommandsCsv, AFileThatCannotBeReadIsNamed) {
  const std::string missing = folder_.file("missing.csv");
  EXPECT_EQ(messageOf([&] { CsvCommandSource(missing, one_); }),
            missing + ": cannot be read: No such file or directory");
  EXPECT_EQ(messageOf([&] { CsvCommandSource(folder_.file(""), one_); }),
            folder_.file("") + ": cannot be read: it is a directory, must be a regular file");
}

TEST_F(CommandsCsv, ReadsOnlyAsFarAsItIsAsked) {
  // The second row is bad: it must not matter before its turn.
  CsvCommandSource source(folder_.write("c.csv", "time,rear,left,right\n0,1,2,3\nbad\n"), one_);
  EXPECT_TRUE(source.next().has_value());
  EXPECT_NE(messageOf([&] { (void)source.next(); }).find(":3:"), std::string::npos);
}

}  // namespace
}  // namespace hovercraft
