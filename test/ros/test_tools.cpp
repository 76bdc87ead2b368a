#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <sys/wait.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "../support/files.h"
#include "../support/scenarios.h"

namespace hovercraft_ros {
namespace {

using hovercraft::testing::contentOf;
using hovercraft::testing::oneCraftYaml;
using hovercraft::testing::TestFolder;

struct Outcome {
  int status = -1;
  std::string output;  // both streams
};

/// Runs a tool of the package, which lies beside this test. `{}` in the arguments is the folder.
class Tools : public ::testing::Test {
 protected:
  Outcome run(std::string arguments) const {
    for (std::size_t at = arguments.find("{}"); at != std::string::npos;
         at = arguments.find("{}")) {
      arguments.replace(at, 2, folder_.file(""));
    }
    const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    std::FILE* pipe = popen((folder.string() + "/" + arguments + " 2>&1").c_str(), "r");
    Outcome outcome;
    std::array<char, 4096> buffer{};
    while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) {
      outcome.output += buffer.data();
    }
    const int ended = pclose(pipe);
    if (WIFEXITED(ended)) outcome.status = WEXITSTATUS(ended);
    return outcome;
  }

  TestFolder folder_;
};

TEST_F(Tools, SimulateAndCompareWorkTogether) {
  folder_.write("s.yaml", oneCraftYaml());
  folder_.write("c.csv", "time,rear,left,right\n0,1,,0.1\n0.3,2,0,0\n");
  const Outcome first = run("simulate {}s.yaml --commands {}c.csv --output {}a.csv");
  EXPECT_EQ(first.status, 0) << first.output;
  EXPECT_EQ(first.output.find('\r'), std::string::npos);  // no bar in a pipe
  EXPECT_EQ(run("simulate {}s.yaml -c {}c.csv -o {}b.bag").status, 0);
  const Outcome same = run("compare {}a.csv {}b.bag");
  EXPECT_EQ(same.status, 0) << same.output;
  EXPECT_NE(same.output.find("identical to the last bit"), std::string::npos) << same.output;

  EXPECT_EQ(run("simulate {}s.yaml -c {}c.csv -o {}held.csv --hold --duration 1.3").status, 0);
  const Outcome other = run("compare {}a.csv {}held.csv --tolerance 0.01 --errors {}errors.csv");
  EXPECT_EQ(other.status, 1);
  EXPECT_NE(other.output.find("beyond the tolerance first at 0.9"), std::string::npos)
      << other.output;
  EXPECT_EQ(
      contentOf(folder_.file("errors.csv"))
          .rfind("time,position,attitude,relative_position,relative_attitude\n0,0,0,0,0\n", 0),
      0U);
  EXPECT_EQ(run("compare {}a.csv {}held.csv --tolerance 10 --attitude-tolerance 10").status, 0);
}

TEST_F(Tools, SimulateWritesToTheStandardOutput) {
  folder_.write("s.yaml", oneCraftYaml());
  const Outcome outcome = run("simulate {}s.yaml --duration 0.02 --output - --every 2");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.output.find("time,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n"
                                "0,0,0,0,0,0,0,1,0,0,0,0,0,0\n0.02,0,"),
            std::string::npos)
      << outcome.output;
}

TEST_F(Tools, ErrorsAreOneLineAndStatusOne) {
  folder_.write("s.yaml", oneCraftYaml());
  folder_.write("bad.csv", "x\n");
  const std::vector<std::pair<std::string, std::string>> errors = {
      {"simulate -o {}o.csv", "simulate: the option '--scenario' is required but missing\n"},
      {"simulate {}s.yaml", "simulate: the option '--output' is required but missing\n"},
      {"simulate {}s.yaml -o {}o.csv",
       "simulate: --duration is missing: without --commands it must be given\n"},
      {"simulate {}s.yaml -o {}o.csv -d 1 --every x",
       "simulate: the argument ('x') for option '--every' is invalid\n"},
      {"simulate {}s.yaml -o {}o.csv -d 1 --speed 2", "simulate: unrecognised option '--speed'\n"},
      {"compare {}bad.csv", "compare: the option '--b' is required but missing\n"},
      {"compare {}a.csv {}b.csv",
       "compare: " + folder_.file("a.csv") + ": cannot be read: No such file or directory\n"},
      {"compare {}bad.csv {}bad.csv --common --interpolate",
       "compare: --common and --interpolate exclude each other\n"},
      {"compare {}bad.csv {}bad.csv",
       "compare: " + folder_.file("bad.csv") +
           ":1: header = x: must be time,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz or "
           "time,vehicle,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n"}};
  for (const auto& [arguments, message] : errors) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 1) << arguments;
    EXPECT_EQ(outcome.output, message) << arguments;
  }
}

TEST_F(Tools, HelpIsNoError) {
  for (const char* tool : {"simulate", "compare"}) {
    const Outcome outcome = run(std::string(tool) + " --help");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.output.rfind(tool, 0), 0U) << outcome.output;
  }
}

}  // namespace
}  // namespace hovercraft_ros
