#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/records/states_csv.h"
#include "hovercraft_sim/sim/run.h"

#include "../support/files.h"
#include "../support/scenarios.h"
#include "../support/special_files.h"

namespace hovercraft {
namespace {

using testing::contentOf;
using testing::messageOf;
using testing::oneCraftYaml;
using testing::scenarioOf;
using testing::TestFolder;
using testing::twoCraftYaml;

constexpr const char* kHeader = "time,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n";

/// The same thrust on every engine at every tick.
class SteadyCommands : public CommandSource {
 public:
  std::optional<Command> next() override {
    return Command{tick_++, 0, kAllEngines, Vector3(1.0, 0.3, 0.2)};
  }

 private:
  Tick tick_ = 0;
};

/// A craft that tumbles, so that no number is round.
std::string tumblingYaml() {
  std::string yaml = oneCraftYaml() +
                     "    initial: {position: [0.1, -0.2, 0.3], rpy: [0.4, 0.5, 0.6], "
                     "velocity: [1, 2, 3], angular_velocity: [0.7, 0.8, 0.9]}\n";
  yaml.replace(yaml.find("planar"), 6, "spatial");
  return yaml;
}

class StatesCsv : public ::testing::Test {
 protected:
  RunSummary write(const std::string& yaml, Tick last_tick, Tick every = 1) const {
    Simulation simulation(scenarioOf(yaml));
    SteadyCommands commands;
    StatesCsvWriter writer(path_, simulation.scenario());
    RunPlan plan;
    plan.last_tick = last_tick;
    plan.every = every;
    return run(simulation, commands, writer, plan);
  }

  std::string errorOf(const std::string& text) const {
    const std::string path = folder_.write("in.csv", text);
    const std::string message = messageOf([&] { readStatesCsv(path); });
    return message.rfind(path, 0) == 0 ? "in.csv" + message.substr(path.size()) : message;
  }

  TestFolder folder_;
  std::string path_ = folder_.file("out.csv");
};

bool haveSameBits(double a, double b) {
  std::uint64_t bits_a = 0;
  std::uint64_t bits_b = 0;
  std::memcpy(&bits_a, &a, sizeof(bits_a));
  std::memcpy(&bits_b, &b, sizeof(bits_b));
  return bits_a == bits_b;
}

bool haveSameBits(const Vector3& a, const Vector3& b) {
  return haveSameBits(a.x(), b.x()) && haveSameBits(a.y(), b.y()) && haveSameBits(a.z(), b.z());
}

TEST_F(StatesCsv, BeginsWithTheInitialState) {
  write(oneCraftYaml(), 0);
  EXPECT_EQ(contentOf(path_), std::string(kHeader) + "0,0,0,0,0,0,0,1,0,0,0,0,0,0\n");
}

TEST_F(StatesCsv, GivesBackEveryBit) {
  write(tumblingYaml(), 500);
  Simulation simulation(scenarioOf(tumblingYaml()));
  SteadyCommands commands;
  const std::vector<Trajectory> read = readStatesCsv(path_);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read.front().vehicle, "");
  ASSERT_EQ(read.front().samples.size(), 501U);
  for (const TrajectorySample& sample : read.front().samples) {
    const Motion motion = simulation.motion(0);
    ASSERT_EQ(sample.time_ns, simulation.timeNs());
    ASSERT_TRUE(haveSameBits(sample.p_WB, motion.p_WB));
    ASSERT_TRUE(haveSameBits(sample.q_WB.s, motion.q_WB.s));
    ASSERT_TRUE(haveSameBits(sample.q_WB.v, motion.q_WB.v));
    ASSERT_TRUE(haveSameBits(sample.v_WB, motion.twist.v_WB));
    ASSERT_TRUE(haveSameBits(sample.w_WB, motion.twist.w_WB));
    simulation.push(*commands.next());
    simulation.step();
  }
  EXPECT_GT(std::abs(simulation.motion(0).q_WB.v.x()), 0.0);
}

TEST_F(StatesCsv, TheSameRunWritesTheSameBytes) {
  write(tumblingYaml(), 100);
  const std::string first = contentOf(path_);
  write(tumblingYaml(), 100);
  EXPECT_EQ(contentOf(path_), first);
}

TEST_F(StatesCsv, HasARowForEveryNthTick) {
  write(oneCraftYaml(), 100, 40);
  const auto samples = readStatesCsv(path_).front().samples;
  ASSERT_EQ(samples.size(), 3U);
  EXPECT_EQ(samples[1].time_ns, 400000000);
  EXPECT_EQ(samples[2].time_ns, 800000000);
}

TEST_F(StatesCsv, SeveralVehiclesAreNamedInAColumn) {
  write(twoCraftYaml(), 10, 10);
  const std::string content = contentOf(path_);
  EXPECT_EQ(content.substr(0, content.find('\n')),
            "time,vehicle,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz");
  EXPECT_NE(content.find("\n0,alpha,0,0,0"), std::string::npos);
  EXPECT_NE(content.find("\n0.1,beta,0,0,0"), std::string::npos);
  const std::vector<Trajectory> read = readStatesCsv(path_);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].vehicle, "alpha");
  EXPECT_EQ(read[1].vehicle, "beta");
  EXPECT_GT(read[0].samples.back().p_WB.x(), 0.0);  // only alpha is commanded
  EXPECT_EQ(read[1].samples.back().p_WB.x(), 0.0);
}

// A crate far off that moves by 0.25 m/s and the craft at rest: at 0.1 s it has moved by 0.025 m.
TEST_F(StatesCsv, ALooseBodyHasARowOfItsOwnAtEachTime) {
  write(oneCraftYaml() + R"(    hull: {box: {size: [1, 1, 1]}}
world:
  bodies:
    crate: {parts: [{box: {size: [1, 1, 1]}, mass: 1}], initial: {position: [30, 4, 0], velocity: [0.25, 0, 0]}}
)",
        10, 5);
  const std::string content = contentOf(path_);
  EXPECT_EQ(content.substr(0, content.find('\n')),
            "time,vehicle,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz");
  EXPECT_NE(content.find("\n0,crate,30,4,0,0,0,0,1,0.25,0,0,0,0,0\n"), std::string::npos)
      << content;
  const std::vector<Trajectory> read = readStatesCsv(path_);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].vehicle, "craft");
  EXPECT_EQ(read[1].vehicle, "crate");
  for (const Trajectory& trajectory : read) {
    ASSERT_EQ(trajectory.samples.size(), 3U) << trajectory.vehicle;
    for (std::size_t row = 0; row < 3; ++row) {
      EXPECT_EQ(trajectory.samples[row].time_ns, static_cast<std::int64_t>(row) * 50000000)
          << trajectory.vehicle;
    }
  }
  EXPECT_NEAR(read[1].samples.back().p_WB.x(), 30.025, 1e-12);
  EXPECT_EQ(read[1].samples.back().p_WB.y(), 4.0);
}

TEST_F(StatesCsv, AFullDiskIsAnError) {
  Simulation simulation(scenarioOf(oneCraftYaml()));
  SteadyCommands commands;
  const testing::SmallDisk disk(100000);
  StatesCsvWriter writer(path_, simulation.scenario());
  RunPlan plan;
  plan.last_tick = 10000;
  EXPECT_EQ(messageOf([&] { run(simulation, commands, writer, plan); }),
            path_ + ".partial: cannot be written: File too large");
  const testing::SmallDisk smaller(10);
  StatesCsvWriter small(path_, simulation.scenario());
  EXPECT_EQ(messageOf([&] { small.close(); }),
            path_ + ".partial.2: cannot be written: File too large");
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(StatesCsv, APathThatCannotBeWrittenIsAnError) {
  const std::string path = folder_.file("no/such/out.csv");
  EXPECT_EQ(messageOf([&] { StatesCsvWriter(path, scenarioOf(oneCraftYaml())); }),
            path + ": cannot be written: No such file or directory");
}

TEST_F(StatesCsv, ARunThatFailsLeavesNoFileThatLooksWhole) {
  folder_.write("out.csv", "from an earlier run");
  {
    Simulation simulation(scenarioOf(oneCraftYaml()));
    StatesCsvWriter writer(path_, simulation.scenario());
    for (int n = 0; n < 3000; ++n) writer.state(simulation);  // more than its buffer holds
  }
  EXPECT_EQ(contentOf(path_), "from an earlier run");
  const std::string partial = contentOf(path_ + ".partial");
  EXPECT_EQ(std::count(partial.begin(), partial.end(), '\n'), 1 + 3000) << "each row of the run";
  EXPECT_EQ(partial.back(), '\n');
  std::filesystem::remove(path_ + ".partial");
  { const StatesCsvWriter untold(path_, scenarioOf(oneCraftYaml())); }
  EXPECT_FALSE(std::filesystem::exists(path_ + ".partial")) << "a header alone";
  write(oneCraftYaml(), 0);
  EXPECT_EQ(contentOf(path_).rfind(kHeader, 0), 0U);
  EXPECT_FALSE(std::filesystem::exists(path_ + ".partial"));
}

TEST_F(StatesCsv, ARunThatDivergesLeavesWhatItWasUpToThere) {
  std::string yaml = oneCraftYaml() + "    initial: {velocity: [1, 0, 0]}\n";
  yaml += "    drag: {linear: [1e9, 1e9, 0]}\n";
  EXPECT_THROW(write(yaml, 1000), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(path_));
  EXPECT_EQ(contentOf(path_ + ".partial").rfind(std::string(kHeader) + "0,", 0), 0U);
}

TEST_F(StatesCsv, ALinkToAFileStaysALink) {
  const std::string target = folder_.write("target.csv", "");
  std::filesystem::create_symlink(target, path_);
  write(oneCraftYaml(), 0);
  EXPECT_TRUE(std::filesystem::is_symlink(path_));
  EXPECT_EQ(contentOf(target).rfind(kHeader, 0), 0U);
}

TEST_F(StatesCsv, EveryErrorNamesLineColumnValueAndRule) {
  const std::string header = kHeader;
  const std::string row = "0,0,0,0,0,0,0,1,0,0,0,0,0,0\n";
  EXPECT_EQ(errorOf("time,x,y\n"),
            "in.csv:1: header = time,x,y: must be time,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz or "
            "time,vehicle,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz");
  EXPECT_EQ(errorOf(header + row + "1,0,0,0\n"), "in.csv:3: 4 fields: must have 14, as the header");
  EXPECT_EQ(errorOf(header + "0,0,a,0,0,0,0,1,0,0,0,0,0,0\n"), "in.csv:2: y = a: must be a number");
  EXPECT_EQ(errorOf(header + "0,0,0,0,0,0,0,1,0,0,0,0,0,nan\n"),
            "in.csv:2: wz = nan: must be finite");
  EXPECT_EQ(errorOf(header + row + row),
            "in.csv:3: time = 0: must be greater than the time before it, 0");
  EXPECT_EQ(errorOf(header + "0,0,0,0,0,0,0,0,0,0,0,0,0,0\n"),
            "in.csv:2: qx = 0: the quaternion must not be 0");
}

}  // namespace
}  // namespace hovercraft
