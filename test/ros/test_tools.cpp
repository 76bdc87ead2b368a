#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <sys/wait.h>
#include <utility>
#include <vector>
#include <yaml-cpp/yaml.h>

#include <gtest/gtest.h>

#include "../support/files.h"
#include "../support/scenarios.h"

namespace hovercraft_ros {
namespace {

using hovercraft::testing::contentOf;
using hovercraft::testing::oneCraftYaml;
using hovercraft::testing::TestFolder;
using hovercraft::testing::twoCraftYaml;

struct Outcome {
  int status = -1;
  std::string output;  // both streams
};

/// Runs a tool of the package, which lies beside this test, or a script of the source folder. `{}`
/// in the arguments is the folder.
class Tools : public ::testing::Test {
 protected:
  Outcome run(std::string arguments) const {
    for (std::size_t at = arguments.find("{}"); at != std::string::npos;
         at = arguments.find("{}")) {
      arguments.replace(at, 2, folder_.file(""));
    }
    const bool is_script = arguments.rfind("scripts/", 0) == 0;
    const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    const std::string command = is_script ? arguments : folder.string() + "/" + arguments;
    std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
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

TEST_F(Tools, NoneWritesOverWhatItReads) {
  folder_.write("s.yaml", oneCraftYaml());
  ASSERT_EQ(run("simulate {}s.yaml -d 0.1 -o {}a.bag").status, 0);
  ASSERT_EQ(run("simulate {}s.yaml -d 0.1 -o {}a.csv").status, 0);
  const std::string rule = ": must not be a file that is read\n";
  const struct {
    std::string arguments;
    std::string file;
    std::string message;
  } cases[] = {
      {"simulate {}s.yaml -d 0.1 -o {}b.csv --contacts {}s.yaml", "s.yaml",
       "simulate: --contacts = " + folder_.file("s.yaml") + rule},
      {"simulate {}s.yaml -d 0.1 -o {}a.csv --contacts {}a.csv", "a.csv",
       "simulate: --contacts = " + folder_.file("a.csv") + ": must not be what --output writes\n"},
      {"replay {}a.bag --set vehicles.craft.mass=3 --output {}a.bag", "a.bag",
       "replay: --output = " + folder_.file("a.bag") + rule},
      {"replay {}a.bag --output {}a.bag", "a.bag",
       "replay: --output = " + folder_.file("a.bag") + rule},
      {"compare {}a.csv {}a.bag --errors {}a.csv", "a.csv",
       "compare: --errors = " + folder_.file("a.csv") + rule},
      {"compare {}a.csv {}a.bag --errors {}a.bag", "a.bag",
       "compare: --errors = " + folder_.file("a.bag") + rule},
  };
  for (const auto& [arguments, file, message] : cases) {
    const std::string before = contentOf(folder_.file(file));
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 1) << arguments;
    EXPECT_EQ(outcome.output, message) << arguments;
    EXPECT_TRUE(contentOf(folder_.file(file)) == before) << arguments;
  }
}

TEST_F(Tools, ReplayAnswersWhatIfAndCompareSaysWhereTheyPart) {
  folder_.write("s.yaml", oneCraftYaml());
  folder_.write("c.csv", "time,rear,left,right\n0.03,3,0,0\n");
  ASSERT_EQ(run("simulate {}s.yaml -c {}c.csv -d 0.2 -o {}run.bag").status, 0);
  const Outcome same = run("replay {}run.bag --output {}again.bag");
  EXPECT_EQ(same.status, 0);
  EXPECT_EQ(same.output.rfind("identical: 20 ticks, 20 states compared, hash ", 0), 0U)
      << same.output;
  EXPECT_EQ(run("compare {}run.bag {}again.bag").status, 0);
  const Outcome changed =
      run("replay {}run.bag --set vehicles.craft.mass=3 --output {}what_if.bag");
  EXPECT_EQ(changed.status, 0);
  EXPECT_EQ(changed.output.rfind("replayed with changes: 20 ticks, hash ", 0), 0U)
      << changed.output;
  // Nobody commands anything for 3 ticks; in the 4th of 10 ms, 3 N move 2 kg by 75 µm and 3 kg by
  // 50 µm.
  const Outcome parted = run("compare {}run.bag {}what_if.bag");
  EXPECT_EQ(parted.status, 1);
  EXPECT_NE(parted.output.find("differ first at 0.04 s: x = "), std::string::npos) << parted.output;
  EXPECT_NE(parted.output.find("in B (B - A = -2.5e-05)\n"), std::string::npos) << parted.output;
}

TEST_F(Tools, PlotRunDrawsTheOnlyCraftAmongLooseBodies) {
  ASSERT_EQ(run("simulate config/crates.yaml -d 0.5 -o {}crates.bag").status, 0);
  const Outcome drawn = run("scripts/plot_run.py {}crates.bag -o {}run.png");
  EXPECT_EQ(drawn.status, 0) << drawn.output;
  EXPECT_NE(drawn.output.find("vehicle           hovercraft\n"), std::string::npos) << drawn.output;
  EXPECT_TRUE(std::filesystem::exists(folder_.file("run.png")));

  ASSERT_EQ(run("simulate config/curling.yaml -d 0.1 -o {}two.bag").status, 0);
  const Outcome two = run("scripts/plot_run.py {}two.bag -o {}two.png");
  EXPECT_EQ(two.status, 1);
  EXPECT_NE(two.output.find("two.bag: vehicles with pose and twist: stone, target; choose one with "
                            "--vehicle\n"),
            std::string::npos)
      << two.output;
}

TEST_F(Tools, MassPropertiesOfAMeshAndOfAScenario) {
  // A cube of edge a = 1 m: I = m a²/6.
  const Outcome mesh = run("mass_properties test/data/cube.obj --mass 12 --json");
  EXPECT_EQ(mesh.status, 0) << mesh.output;
  const YAML::Node body = YAML::Load(mesh.output);
  EXPECT_EQ(body["mass"].as<double>(), 12.0);
  EXPECT_NEAR(body["volume"].as<double>(), 1.0, 1e-15);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(body["center_of_mass"][i].as<double>(), 0.5, 1e-15);
    EXPECT_NEAR(body["principal_moments"][i].as<double>(), 2.0, 1e-13);
  }
  const Outcome scaled = run("mass_properties --scale 0.5 test/data/cube.obj --mass 12 --json");
  EXPECT_EQ(scaled.status, 0) << scaled.output;
  EXPECT_EQ(YAML::Load(scaled.output)["volume"].as<double>(), 0.125);
  const Outcome large = run("mass_properties test/data/cube.obj --scale 600 600 600");
  EXPECT_EQ(large.output.find("mass_properties: mesh file 'test/data/cube.obj': encloses "), 0U)
      << large.output;
  const YAML::Node dense =
      YAML::Load(run("mass_properties test/data/cube.obj --density 500 -j").output);
  EXPECT_NEAR(dense["mass"].as<double>(), 500.0, 1e-12);

  folder_.write("s.yaml", twoCraftYaml());
  const Outcome both = run("mass_properties {}s.yaml");
  EXPECT_EQ(both.status, 0);
  EXPECT_NE(both.output.find("alpha"), std::string::npos) << both.output;
  EXPECT_NE(both.output.find("beta"), std::string::npos) << both.output;
  const Outcome one = run("mass_properties {}s.yaml --vehicle beta --json");
  EXPECT_EQ(YAML::Load(one.output)["mass"].as<double>(), 2.0) << one.output;
}

TEST_F(Tools, ClosestOfTwoMeshes) {
  const std::string cubes = "closest test/data/cube.obj test/data/cube.obj";
  // Of edge 1 m.
  const Outcome apart = run(cubes + " --pose-b 3.5 0 0 0 0 0 1 --json");
  EXPECT_EQ(apart.status, 0) << apart.output;
  const YAML::Node found = YAML::Load(apart.output);
  EXPECT_EQ(found["status"].as<std::string>(), "separated");
  EXPECT_NEAR(found["distance"].as<double>(), 2.5, 1e-12);
  const Outcome moved = run(cubes + " --pose-a -1.5 0 0 0 0 0 1 --pose-b 2 0 0 0 0 0 1 --json");
  EXPECT_NEAR(YAML::Load(moved.output)["distance"].as<double>(), 2.5, 1e-12);
  const Outcome same = run(cubes);
  EXPECT_EQ(same.status, 0);
  EXPECT_NE(same.output.find("penetrating"), std::string::npos) << same.output;
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
           "time,vehicle,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n"},
      {"replay", "replay: the option '--bag' is required but missing\n"},
      {"replay {}no.bag",
       "replay: " + folder_.file("no.bag") +
           ": cannot be read as a bag: Error opening file: " + folder_.file("no.bag") + "\n"},
      {"mass_properties", "mass_properties: it takes one file: a scenario or a mesh\n"},
      {"mass_properties {}no.yaml",
       "mass_properties: " + folder_.file("no.yaml") + ": there is no such file\n"},
      {"mass_properties test/data/cube.obj --mass x",
       "mass_properties: the argument ('x') for option '--mass' is invalid\n"},
      {"closest test/data/cube.obj", "closest: it takes two mesh files\n"},
      {"closest test/data/cube.obj --scale 2", "closest: it takes two mesh files\n"},
      {"closest test/data/cube.obj --scale 0 test/data/cube.obj",
       "closest: --scale 0: must be greater than 0 and finite\n"},
      {"mass_properties test/data/cube.obj a.obj",
       "mass_properties: it takes one file: a scenario or a mesh\n"},
      {"closest test/data/cube.obj {}no.obj",
       "closest: mesh file '" + folder_.file("no.obj") + "': does not exist or cannot be read\n"},
      {"closest test/data/cube.obj test/data/cube.obj --pose-b 1 2",
       "closest: --pose-b: 2 numbers, it takes 7: x y z (m) qx qy qz qw\n"}};
  for (const auto& [arguments, message] : errors) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 1) << arguments;
    EXPECT_EQ(outcome.output, message) << arguments;
  }
}

TEST_F(Tools, HelpIsNoError) {
  for (const char* tool : {"simulate", "compare", "replay", "mass_properties", "closest"}) {
    const Outcome outcome = run(std::string(tool) + " --help");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.output.rfind(tool, 0), 0U) << outcome.output;
  }
}

}  // namespace
}  // namespace hovercraft_ros
