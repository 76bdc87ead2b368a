#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <hovercraft_sim/State.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "hovercraft_sim/analysis/compare.h"
#include "hovercraft_sim/bags/simulate.h"
#include "hovercraft_sim/bags/trajectory_file.h"
#include "hovercraft_sim/io/progress_bar.h"
#include "hovercraft_sim/records/states_csv.h"

#include "../support/files.h"
#include "../support/scenarios.h"
#include "../support/special_files.h"

namespace hovercraft_ros {
namespace {

using hovercraft::TrajectorySample;
using hovercraft::testing::contentOf;
using hovercraft::testing::messageOf;
using hovercraft::testing::oneCraftYaml;
using hovercraft::testing::TestFolder;
using hovercraft::testing::twoCraftYaml;

class Simulate : public ::testing::Test {
 protected:
  SimulateRequest requestOf(const std::string& yaml, const std::string& commands = "") const {
    SimulateRequest request;
    request.scenario = folder_.write("scenario.yaml", yaml);
    if (!commands.empty()) request.commands = folder_.write("commands.csv", commands);
    request.output = folder_.file("out.csv");
    return request;
  }

  /// @returns what it says.
  std::string messagesOf(const SimulateRequest& request) const {
    std::ostringstream messages;
    simulate(request, messages);
    return messages.str();
  }

  std::string errorOf(const SimulateRequest& request) const {
    return messageOf([&] { messagesOf(request); });
  }

  TestFolder folder_;
};

TEST_F(Simulate, APilotFliesWithoutCommandsAndEndsTheRun) {
  SimulateRequest request = requestOf(oneCraftYaml());
  const std::string plan =
      folder_.write("plan.yaml", "manoeuvres: [{kind: ramp, to: {rear: 4}, duration: 1}]");
  request.pilots = {plan};
  EXPECT_NE(messagesOf(request).find("ramp (ramp), first execute at 0.01 s, end at 1.01 s"),
            std::string::npos);
  // A second after the last manoeuvre.
  EXPECT_EQ(hovercraft::readStatesCsv(request.output).front().samples.back().time_ns, 2010000000);
  request.duration = "0.5";
  EXPECT_NE(messagesOf(request).find("the run ended before the last manoeuvre did"),
            std::string::npos);
}

TEST_F(Simulate, APilotThatDoesNotFitIsRefusedBeforeAnythingIsWritten) {
  SimulateRequest request = requestOf(oneCraftYaml(), "time,rear,left,right\n0,1,0,0\n");
  const std::string plan =
      folder_.write("plan.yaml", "manoeuvres: [{kind: ramp, to: {rear: 11}, duration: 1}]");
  request.pilots = {plan};
  EXPECT_EQ(errorOf(request), "--pilot: must not stand beside --commands");
  request.commands.clear();
  EXPECT_NE(errorOf(request).find("would set rear to 11: must be -10 to 10"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(request.output));
  request.output = plan;
  EXPECT_NE(errorOf(request).find("--output"), std::string::npos);
  request.pilots = {folder_.file("missing.yaml")};
  request.output = folder_.file("out.csv");
  EXPECT_NE(errorOf(request).find("missing.yaml"), std::string::npos);
}

TEST_F(Simulate, TheTestbedCraftFollowsItsClosedForm) {
  // MVWT, both engines full: u = 2 (1 - exp(-t/τ)), x = 2 (t - τ (1 - exp(-t/τ))), τ = m/c.
  SimulateRequest request;
  request.scenario = "config/mvwt.yaml";
  request.commands = folder_.write("c.csv", "time,rear,left,right\n0,,4.5,4.5\n");
  request.output = folder_.file("out.csv");
  request.duration = "5";
  request.hold = true;
  messagesOf(request);
  const double tau = 5.15 / 4.5;
  const auto samples = hovercraft::readStatesCsv(request.output).front().samples;
  ASSERT_EQ(samples.size(), 5001U);
  for (const TrajectorySample& sample : samples) {
    const double t = hovercraft::toSeconds(sample.time_ns);
    const double rise = -std::expm1(-t / tau);
    ASSERT_NEAR(sample.v_WB.x(), 2.0 * rise, 1e-12) << t;
    ASSERT_NEAR(sample.p_WB.x(), 2.0 * (t - tau * rise), 1e-12) << t;
  }
}

TEST_F(Simulate, BothOutputsHoldTheSameBits) {
  SimulateRequest request;
  request.scenario = "config/hovercraft.yaml";
  request.commands = "config/manoeuvre.csv";
  request.duration = "6";
  request.hold = true;
  request.every = 10;
  request.output = folder_.file("out.csv");
  const auto csv_summary = simulate(request, *std::make_unique<std::ostringstream>());
  request.output = folder_.file("out.bag");
  const auto bag_summary = simulate(request, *std::make_unique<std::ostringstream>());
  EXPECT_EQ(csv_summary.hash, bag_summary.hash);

  const auto csv = readTrajectories(folder_.file("out.csv"));
  const auto bag = readTrajectories(folder_.file("out.bag"));
  ASSERT_EQ(csv.size(), 1U);
  ASSERT_EQ(bag.size(), 1U);
  EXPECT_EQ(csv.front().samples.size(), 601U);
  EXPECT_EQ(bag.front().samples.size(), 600U);  // a bag holds no time 0
  const auto comparison = hovercraft::compareTrajectories(csv.front(), bag.front(), {});
  EXPECT_TRUE(comparison.is_within) << toText(comparison, {});
  EXPECT_TRUE(comparison.compared_velocities);
}

TEST_F(Simulate, TheBagOfARunFliesItAgain) {
  SimulateRequest request;
  request.scenario = "config/hovercraft.yaml";
  request.commands = "config/manoeuvre.csv";
  request.duration = "9";
  request.every = 50;
  request.output = folder_.file("first.bag");
  const auto first = simulate(request, *std::make_unique<std::ostringstream>());
  request.commands = request.output;
  request.output = folder_.file("second.bag");
  const auto second = simulate(request, *std::make_unique<std::ostringstream>());
  EXPECT_EQ(first.hash, second.hash);
  EXPECT_FALSE(first.timeouts.empty());  // rows of the manoeuvre are seconds apart
}

TEST_F(Simulate, SaysWhichEngineTimedOutUnlessCommandsHold) {
  SimulateRequest request =
      requestOf(oneCraftYaml(), "time,rear,left,right\n0,2,,\n2,3,,1\n4,4,,\n");
  request.duration = "6";
  const std::string messages = messagesOf(request);
  EXPECT_NE(messages.find("craft: engine rear timed out at 0.5 s: 2 N were commanded, and then "
                          "nothing for 0.5 s (the first of 3 times); --hold keeps commands\n"),
            std::string::npos)
      << messages;
  EXPECT_NE(messages.find("craft: engine right timed out at 2.5 s: 1 N were commanded, and then "
                          "nothing for 0.5 s; --hold keeps commands\n"),
            std::string::npos)
      << messages;
  EXPECT_EQ(messages.find("engine left"), std::string::npos);

  request.hold = true;
  EXPECT_EQ(messagesOf(request).find("timed out"), std::string::npos);
}

TEST_F(Simulate, HoldKeepsTheLastCommand) {
  // 2 N on 2 kg: 1 m/s², for 0.5 s or for all of 3 s.
  SimulateRequest request = requestOf(oneCraftYaml(), "time,rear,left,right\n0,2,,\n");
  request.duration = "3";
  messagesOf(request);
  EXPECT_NEAR(hovercraft::readStatesCsv(request.output).front().samples.back().v_WB.x(), 0.5,
              1e-12);
  request.hold = true;
  messagesOf(request);
  EXPECT_NEAR(hovercraft::readStatesCsv(request.output).front().samples.back().v_WB.x(), 3.0,
              1e-12);
}

TEST_F(Simulate, RunsOneSecondBeyondTheLastCommandIfNotTold) {
  const SimulateRequest request =
      requestOf(oneCraftYaml(), "time,rear,left,right\n0,1,,\n0.4,1,,\n1.25,0,,\n");
  messagesOf(request);
  EXPECT_EQ(hovercraft::readStatesCsv(request.output).front().samples.back().time_ns, 2250000000);
}

TEST_F(Simulate, RunsToTheFirstTickAtOrAfterTheDuration) {
  SimulateRequest request = requestOf(oneCraftYaml());
  request.duration = "0.57";
  messagesOf(request);
  EXPECT_EQ(hovercraft::readStatesCsv(request.output).front().samples.back().time_ns, 570000000);
  request.duration = "0.571";
  messagesOf(request);
  EXPECT_EQ(hovercraft::readStatesCsv(request.output).front().samples.back().time_ns, 580000000);
}

TEST_F(Simulate, EndsWithWhatAStepCostAndASummary) {
  SimulateRequest request = requestOf(oneCraftYaml());
  request.duration = "250";
  const std::string messages = messagesOf(request);
  std::smatch found;
  ASSERT_TRUE(std::regex_match(
      messages, found,
      std::regex("a step cost ([0-9]+) ns, ([0-9.e+]+) x real time, without the output\n"
                 "simulated 250 s in 25000 ticks, wall time ([0-9.]+) s, ([0-9]+) x real time, "
                 "state hash [0-9a-f]{16}\n")))
      << messages;
  const double cost = std::stod(found[1]);
  const double factor = std::stod(found[2]);
  const double wall = std::stod(found[3]);
  EXPECT_GE(cost, 1.0);
  EXPECT_NEAR(factor * cost, 1e7, 0.5 * factor + 0.006e7);  // a step is 10 ms; both are rounded
  // Every state is written, which costs more than a step: what is said without it is less.
  EXPECT_LT(25000.0 * cost, 0.8e9 * wall + 1e6);
  EXPECT_NEAR(std::stod(found[4]) * wall, 250.0, 0.5 * wall + 0.001 * std::stod(found[4]));
}

TEST_F(Simulate, DrawsABarOnlyIfAskedTo) {
  SimulateRequest request = requestOf(oneCraftYaml());
  request.duration = "100";
  EXPECT_EQ(messagesOf(request).find('['), std::string::npos);
  request.shows_progress = true;
  const std::string messages = messagesOf(request);
  EXPECT_EQ(messages.rfind("\r[" + std::string(40, ' ') + "]   0%", 0), 0U) << messages;
  EXPECT_NE(messages.find("\ra step cost"), std::string::npos);  // the bar was wiped
}

TEST(ProgressBar, FillsAsItGoesAndIsWiped) {
  std::ostringstream terminal;
  {
    hovercraft::ProgressBar bar(terminal, 200);
    const hovercraft::ProgressBar::Clock::time_point begin;
    bar.show(100, begin);
    bar.show(101, begin + std::chrono::milliseconds(99));  // too soon to be drawn
    bar.show(200, begin + std::chrono::milliseconds(100));
  }
  EXPECT_EQ(terminal.str(), "\r[" + std::string(20, '=') + std::string(20, ' ') + "]  50%\r[" +
                                std::string(40, '=') + "] 100%\r" + std::string(47, ' ') + "\r");
}

TEST_F(Simulate, EveryErrorOfARequestNamesWhatIsWrong) {
  const std::string yaml = oneCraftYaml();
  SimulateRequest request = requestOf(yaml);
  EXPECT_EQ(errorOf(request),
            "--duration is missing: without --commands and --pilot it must be given");
  const std::vector<std::pair<std::string, std::string>> durations = {
      {"x", "--duration = x: must be a number of seconds"},
      {"nan", "--duration = nan: must be a number of seconds"},
      {"0", "--duration = 0: must be greater than 0"},
      {"-1", "--duration = -1: must be greater than 0"},
      {"1e7", "--duration = 1e7: must be at most 1000000 s"}};
  for (const auto& [duration, message] : durations) {
    request.duration = duration;
    EXPECT_EQ(errorOf(request), message);
  }
  request.duration = "1";
  request.every = 0;
  EXPECT_EQ(errorOf(request), "--every = 0: must be 1 or greater");
  request.every = 1;
  request.output = "out.txt";
  EXPECT_EQ(errorOf(request),
            "--output = out.txt: must end in .csv or .bag, or be - for CSV on the standard output");
  request.output = folder_.file("");
  EXPECT_NE(errorOf(request).find("it is a directory, must be a regular file"), std::string::npos);
  request.output = folder_.file("out.csv");
  request.scenario = folder_.file("missing.yaml");
  EXPECT_EQ(errorOf(request), request.scenario + ": there is no such file");
}

TEST_F(Simulate, NeverWritesOverAFileThatItReads) {
  SimulateRequest request = requestOf(oneCraftYaml(), "time,rear,left,right\n0,1,1,1\n");
  request.output = folder_.file("./commands.csv");
  EXPECT_EQ(errorOf(request), "--output = " + request.output + ": must not be a file that is read");
  EXPECT_EQ(contentOf(request.commands), "time,rear,left,right\n0,1,1,1\n");
}

TEST_F(Simulate, BadCommandsAreFoundBeforeAnythingIsWritten) {
  SimulateRequest request =
      requestOf(oneCraftYaml(), "time,rear,left,right\n0,1,1,1\n1,1,oops,1\n");
  EXPECT_EQ(errorOf(request), request.commands + ":3: left = oops: must be a number");
  EXPECT_FALSE(std::filesystem::exists(request.output + ".partial"));
  request = requestOf(oneCraftYaml(), "time,rear,left,right\n");
  EXPECT_EQ(errorOf(request), request.commands + ": there are no commands in it; use --duration");
  request.commands = "/dev/null";
  EXPECT_EQ(errorOf(request),
            "/dev/null: the duration is missing: commands that do not come from a file need "
            "--duration");
}

TEST_F(Simulate, AFullDiskIsAnErrorForBothOutputs) {
  SimulateRequest request = requestOf(twoCraftYaml());
  const hovercraft::testing::SmallDisk disk(100000);
  request.duration = "100";
  request.output = folder_.file("full.csv");
  EXPECT_EQ(errorOf(request), request.output + ".partial: cannot be written: File too large");
  request.output = folder_.file("full.bag");
  EXPECT_EQ(errorOf(request).rfind(request.output + ".partial: cannot be written: ", 0), 0U)
      << errorOf(request);
  EXPECT_FALSE(std::filesystem::exists(request.output));
}

TEST_F(Simulate, APathThatCannotBeWrittenIsAnErrorForABag) {
  SimulateRequest request = requestOf(oneCraftYaml());
  request.duration = "1";
  request.output = folder_.file("no/such.bag");
  EXPECT_EQ(errorOf(request), request.output + ": cannot be written: No such file or directory");
}

TEST_F(Simulate, NoOutputIsADevice) {
  SimulateRequest request = requestOf(oneCraftYaml());
  request.duration = "1";
  hovercraft::testing::makeFifo(folder_.file("fifo.bag"));
  std::filesystem::create_symlink("/dev/full", folder_.file("full.csv"));
  for (const char* name : {"fifo.bag", "full.csv"}) {
    request.output = folder_.file(name);
    EXPECT_NE(errorOf(request).find("must be a regular file or a name that is free"),
              std::string::npos)
        << errorOf(request);
  }
}

// rosbag opens files by their names, and follows links.
TEST_F(Simulate, ABagIsNotWrittenThroughALinkUnderThePartialName) {
  SimulateRequest request = requestOf(oneCraftYaml());
  request.duration = "0.1";
  request.output = folder_.file("out.bag");
  const std::string target = folder_.write("target", "old");
  std::filesystem::create_symlink(target, request.output + ".partial");
  messagesOf(request);
  EXPECT_EQ(contentOf(target), "old");
  const rosbag::Bag bag(request.output);
}

TEST_F(Simulate, ARunThatFailsLeavesAPartialBagThatCanBeRead) {
  // 1e308 N on 2 kg is beyond a double within a few steps.
  std::string yaml = oneCraftYaml();
  while (yaml.find("max_thrust: 10}") != std::string::npos) {
    yaml.replace(yaml.find("max_thrust: 10}"), 15, "max_thrust: 1e308}");
  }
  yaml.replace(yaml.find("0.01"), 4, "1000");
  SimulateRequest request = requestOf(yaml, "time,rear,left,right\n5000,1e308,0,0\n");
  request.duration = "20000";
  request.output = folder_.file("out.bag");
  EXPECT_THROW(messagesOf(request), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(request.output));
  rosbag::Bag bag(request.output + ".partial");
  rosbag::View states(bag, rosbag::TopicQuery("/craft/state"));
  EXPECT_EQ(states.size(), 5U);
}

}  // namespace
}  // namespace hovercraft_ros
