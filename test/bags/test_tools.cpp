#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <sys/wait.h>
#include <utility>
#include <vector>
#include <yaml-cpp/yaml.h>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/version.h"

#include "../support/files.h"
#include "../support/scenarios.h"
#include "../support/special_files.h"

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

/// Runs a tool of the package, which lies beside this test, or a script of the source folder, or
/// bash. `{}` in the arguments is the folder.
class Tools : public ::testing::Test {
 protected:
  static std::string toolFolder() {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path().string() + "/";
  }

  Outcome run(std::string arguments) const {
    for (std::size_t at = arguments.find("{}"); at != std::string::npos;
         at = arguments.find("{}")) {
      arguments.replace(at, 2, folder_.file(""));
    }
    // Not executable, so that rosrun does not find it beside its copy in the devel space.
    if (arguments.rfind("scripts/plot_run.py", 0) == 0) arguments.insert(0, "python3 ");
    const bool is_script = arguments.rfind("python3 ", 0) == 0 ||
                           arguments.rfind("scripts/", 0) == 0 || arguments.rfind("bash ", 0) == 0;
    const std::string command = is_script ? arguments : toolFolder() + arguments;
    const bool has_streams = command.find("2>&1") != std::string::npos;
    std::FILE* pipe = popen((command + (has_streams ? "" : " 2>&1")).c_str(), "r");
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

// What takes longer to load than a short run takes is loaded where a bag is asked for.
TEST_F(Tools, RunsOfCsvFilesLoadNoRos) {
  folder_.write("s.yaml", oneCraftYaml());
  const std::string loads = "bash -c 'LD_DEBUG=libs " + toolFolder();
  const auto loads_ros = [&](const std::string& command) {
    const Outcome outcome = run(loads + command + "'");
    EXPECT_EQ(outcome.status, 0) << command;
    EXPECT_NE(outcome.output.find("calling init:"), std::string::npos) << command;
    return outcome.output.find("librosbag") != std::string::npos;
  };
#ifdef HOVERCRAFT_SANITIZE  // the programs have all of it in them
  constexpr bool always = true;
#else
  constexpr bool always = false;
#endif
  EXPECT_EQ(loads_ros("simulate {}s.yaml -d 0.1 -o {}a.csv"), always);
  EXPECT_EQ(loads_ros("mass_properties {}s.yaml"), always);
  EXPECT_EQ(loads_ros("cushion config/rc5.yaml"), always);
  EXPECT_EQ(loads_ros("velocity_gains {}s.yaml"), always);
  EXPECT_TRUE(loads_ros("simulate {}s.yaml -d 0.1 -o {}a.bag"));
}

TEST_F(Tools, EachSaysItsVersionAndThatOfThePhysics) {
  for (const char* tool : {"closest", "compare", "cushion", "mass_properties", "occupancy",
                           "replay", "report", "simulate", "velocity_gains"}) {
    const Outcome outcome = run(std::string(tool) + " --version");
    EXPECT_EQ(outcome.status, 0) << tool;
    EXPECT_EQ(outcome.output, hovercraft::versionText(tool) + "\n");
  }
}

TEST_F(Tools, NodesSayWhatTheyAreForWithoutAMaster) {
  for (const std::string node : {"bag_node", "hold_heading", "hovercraft_node", "markers_node",
                                 "play_commands", "velocity_controller", "web_node"}) {
    const Outcome help = run(node + " --help");
    EXPECT_EQ(help.status, 0) << node;
    EXPECT_EQ(help.output.find(node + " [_PARAMETER:=VALUE ...]"), 0U) << help.output;
    EXPECT_EQ(run(node + " --version").output, hovercraft::versionText(node) + "\n");
  }
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

TEST_F(Tools, SimulateAndReplayTakeTheSameOtherValues) {
  folder_.write("s.yaml", oneCraftYaml());
  folder_.write("c.csv", "time,rear,left,right\n0.03,3,1,0\n");
  const std::string sets =
      "--set 'vehicles.craft.mass=3; wind=[0, 1, 0]' -s "
      "vehicles.craft.engines.left.direction[1]=1";
  ASSERT_EQ(run("simulate {}s.yaml -c {}c.csv -d 0.2 -o {}run.bag").status, 0);
  const Outcome flown = run("simulate {}s.yaml -c {}c.csv -d 0.2 " + sets + " -o {}changed.bag");
  ASSERT_EQ(flown.status, 0) << flown.output;
  ASSERT_EQ(run("replay {}run.bag " + sets + " --output {}what_if.bag").status, 0);
  EXPECT_EQ(run("compare {}changed.bag {}what_if.bag").status, 0);
  EXPECT_EQ(run("compare {}run.bag {}what_if.bag").status, 1);
  EXPECT_EQ(run("replay {}changed.bag").status, 0);
  const Outcome bad = run("simulate {}s.yaml -d 0.2 --set vehicles.raft.mass=3 -o {}bad.csv");
  EXPECT_EQ(bad.status, 1);
  EXPECT_EQ(bad.output,
            "simulate: --set vehicles.raft.mass=3: vehicles has no key raft; there: craft\n");
  EXPECT_FALSE(std::filesystem::exists(folder_.file("bad.csv")));
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

// A craft that tumbles, so that each axis of the craft is none of the world: the rows of the CSV,
// turned into them, are what the bag has.
TEST_F(Tools, PlotRunReadsTheSameFromACsvAsFromABag) {
  std::string yaml = oneCraftYaml() +
                     "    initial: {rpy: [0.4, 0.5, 0.6], velocity: [1, 2, 3], "
                     "angular_velocity: [0.7, 0.8, 0.9]}\n";
  yaml.replace(yaml.find("planar"), 6, "spatial");
  folder_.write("s.yaml", yaml);
  ASSERT_EQ(run("simulate {}s.yaml -d 1 -o {}run.bag").status, 0);
  ASSERT_EQ(run("simulate {}s.yaml -d 1 -o {}run.csv").status, 0);
  folder_.write("same.py", R"(import sys
sys.path.insert(0, 'scripts')
import numpy
import plot_run
csv, bag = plot_run.read_csv(sys.argv[2], None), plot_run.read_bag(sys.argv[1], None)
assert len(bag.time) == 100 and len(csv.time) == 101  # a bag begins after tick 0
for name in 'xy', 'yaw', 'velocity', 'yaw_rate':
    numpy.testing.assert_allclose(getattr(csv, name)[1:], getattr(bag, name), rtol=0, atol=1e-12)
numpy.testing.assert_allclose(csv.time[1:], bag.time + 0.01, rtol=0, atol=1e-6)
)");
  const Outcome same = run("python3 -B {}same.py {}run.bag {}run.csv");
  EXPECT_EQ(same.status, 0) << same.output;
}

TEST_F(Tools, PlotRunTakesOneOfSeveralFromACsv) {
  ASSERT_EQ(run("simulate config/crates.yaml -d 0.5 -o {}crates.csv").status, 0);
  const Outcome drawn = run("scripts/plot_run.py {}crates.csv --vehicle crate_a -o {}run.png");
  EXPECT_EQ(drawn.status, 0) << drawn.output;
  EXPECT_NE(drawn.output.find("vehicle           crate_a\n"), std::string::npos) << drawn.output;
  EXPECT_TRUE(std::filesystem::exists(folder_.file("run.png")));

  const std::string header = "time,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n";
  folder_.write("commands.csv", "time,rear,left,right\n0,1,0,0\n");
  folder_.write("short.csv", header + "0,1\n");
  folder_.write("nan.csv", header + "0,nan,0,0,0,0,0,1,0,0,0,0,0,0\n");
  folder_.write("one.csv", header + "0,0,0,0,0,0,0,1,0,0,0,0,0,0\n");
  folder_.write("errors.py", R"(import os, sys
sys.path.insert(0, os.path.abspath('scripts'))
os.chdir(os.path.dirname(sys.argv[0]))
import plot_run
for argument in sys.argv[1:]:
    path, _, vehicle = argument.partition(':')
    try:
        plot_run.read_csv(path, vehicle or None)
        print('no error')
    except ValueError as error:
        print(error)
)");
  const Outcome errors = run(
      "python3 -B {}errors.py crates.csv crates.csv:boat commands.csv short.csv nan.csv one.csv "
      "one.csv:boat");
  EXPECT_EQ(errors.output,
            "crates.csv: vehicles and loose bodies: crate_a, crate_b, hovercraft; choose one with "
            "--vehicle\n"
            "crates.csv: --vehicle boat: it holds crate_a, crate_b, hovercraft\n"
            "commands.csv: the first line must be time,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz, with "
            "or without vehicle after time\n"
            "short.csv, line 2: 2 fields, but the first line has 14\n"
            "nan.csv, line 2: a number is not finite\n"
            "one.csv: fewer than two states\n"
            "one.csv: --vehicle boat: there is no column vehicle, the file holds one craft\n");
}

TEST_F(Tools, PlotRunNamesAFileThatIsNoBag) {
  folder_.write("notes.txt", "This is no bag.\n");
  const Outcome notes = run("scripts/plot_run.py {}notes.txt -o {}z.png");
  EXPECT_EQ(notes.status, 1);
  EXPECT_EQ(notes.output.rfind("plot_run.py: " + folder_.file("notes.txt") + ": ", 0), 0U)
      << notes.output;
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
  ASSERT_EQ(run("simulate {}s.yaml -o {}o.csv -d 0.1").status, 0);
  const std::vector<std::pair<std::string, std::string>> errors = {
      {"simulate -o {}o.csv", "simulate: the option '--scenario' is required but missing\n"},
      {"simulate {}s.yaml", "simulate: the option '--output' is required but missing\n"},
      {"simulate {}s.yaml -o {}o.csv",
       "simulate: --duration is missing: without --commands and --pilot it must be given\n"},
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
       "replay: " + folder_.file("no.bag") + ": cannot be read: No such file or directory\n"},
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
       "closest: --pose-b: 2 numbers, it takes 7: x y z (m) qx qy qz qw\n"},
      {"closest test/data/cube.obj test/data/cube.obj --pose-b 1e200 0 0 0 0 0 1",
       "closest: --pose-b: x, y, z = 1e+200, 0, 0: each must be a number from -1e+30 to 1e+30 "
       "m\n"},
      {"closest test/data/cube.obj test/data/cube.obj --pose-a 0 nan -inf 0 0 0 1",
       "closest: --pose-a: x, y, z = 0, nan, -inf: each must be a number from -1e+30 to 1e+30 "
       "m\n"},
      {"closest test/data/cube.obj test/data/cube.obj --pose-b 1 0 0 0 0 0 1e200",
       "closest: --pose-b: the quaternion has the length inf, it must be 1\n"},
      {"simulate {}s.yaml -o {}o.csv -d 1e-300",
       "simulate: --duration = 1e-300: must be at least a nanosecond, 1e-9 s\n"},
      {"simulate {}s.yaml -o {}o.csv -d 4.9e-10",
       "simulate: --duration = 4.9e-10: must be at least a nanosecond, 1e-9 s\n"},
      {"simulate {}s.yaml -o {}o.csv --duration=-1",
       "simulate: --duration = -1: must be greater than 0\n"},
      {"simulate {}s.yaml -o {}o.csv -d nan",
       "simulate: --duration = nan: must be a number of seconds\n"},
      {"simulate {}s.yaml -o {}o.csv -d 1e400",
       "simulate: --duration = 1e400: must be a number of seconds\n"},
      {"simulate {}s.yaml -o {}o.csv -d 0x10",
       "simulate: --duration = 0x10: must be a number of seconds\n"},
      {"simulate {}s.yaml -o {}o.csv -d 1s",
       "simulate: --duration = 1s: must be a number of seconds\n"},
      {"simulate {}s.yaml -o {}o.csv -d 1e7",
       "simulate: --duration = 1e7: must be at most 1000000 s\n"},
      {"simulate {}s.yaml -o {}o.csv -d 1 --every=-1",
       "simulate: --every = -1: must be 1 or greater\n"},
      {"simulate {}s.yaml -o {}o.csv -d 1 --every 99999999999999999999",
       "simulate: the argument ('99999999999999999999') for option '--every' is invalid\n"},
      {"compare {}o.csv {}o.csv --tolerance nan",
       "compare: position tolerance = nan m: must be 0 or greater, and finite\n"},
      {"compare {}o.csv {}o.csv --attitude-tolerance=-1e-3",
       "compare: attitude tolerance = -0.001 rad: must be 0 or greater, and finite\n"},
      {"compare {}o.csv {}o.csv --tolerance 1e400",
       "compare: the argument ('1e400') for option '--tolerance' is invalid\n"},
      {"mass_properties test/data/cube.obj --density inf",
       "mass_properties: density = inf kg/m^3: must be positive and finite\n"},
      {"mass_properties test/data/cube.obj --mass=-0",
       "mass_properties: mass = -0 kg: must be positive and finite\n"}};
  for (const auto& [arguments, message] : errors) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 1) << arguments;
    EXPECT_EQ(outcome.output, message) << arguments;
  }
}

// The device that is always full: the standard output may go anywhere, a file not.
TEST_F(Tools, AFullStandardOutputIsAnError) {
  folder_.write("s.yaml", oneCraftYaml());
  const Outcome full = run("simulate {}s.yaml -d 100 -o - 2>&1 >/dev/full");
  EXPECT_EQ(full.status, 1);
  EXPECT_EQ(full.output,
            "simulate: the standard output: cannot be written: No space left on device\n");
  EXPECT_EQ(run("simulate {}s.yaml -d 100 -o - > /dev/null").status, 0);
}

TEST_F(Tools, NoOutputGoesWhereTheStandardOutputGoes) {
  folder_.write("s.yaml", oneCraftYaml());
  const Outcome outcome = run("simulate {}s.yaml -d 1 -o {}o.csv 2>&1 >{}o.csv");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.output,
            "simulate: --output = " + folder_.file("o.csv") +
                ": must not be where the standard output or the standard error goes\n");
}

TEST_F(Tools, SimulateWritesActuatorsAtARateOfTheirOwn) {
  folder_.write("s.yaml", oneCraftYaml());
  const std::string fly = "simulate {}s.yaml -d 0.1 -o {}o.csv --every 5 ";
  EXPECT_EQ(run(fly + "--actuators {}a.csv --actuators-every 2 2>&1").status, 0);
  const auto lines = [this](const char* name) {
    const std::string text = contentOf(folder_.file(name));
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(lines("o.csv"), 1 + 3);      // ticks 0, 5, 10
  EXPECT_EQ(lines("a.csv"), 1 + 6 * 3);  // ticks 0, 2, ... 10 of three engines
  EXPECT_EQ(run(fly + "--actuators {}a.csv 2>&1").status, 0);
  EXPECT_EQ(lines("a.csv"), 1 + 3 * 3);
  EXPECT_EQ(run(fly + "--actuators-every 2 2>&1").output,
            "simulate: --actuators-every: has a meaning with --actuators only\n");
  EXPECT_EQ(run(fly + "--cushion-every 2 2>&1").output,
            "simulate: --cushion-every: has a meaning with --cushion only\n");
  EXPECT_EQ(run(fly + "--actuators {}a.csv --actuators-every=-1 2>&1").output,
            "simulate: --actuators-every = -1: must be 1 or greater\n");
}

// What a scenario names is read too: a mesh, an image of heights.
TEST_F(Tools, NoOutputIsAFileThatTheScenarioNames) {
  const std::string mesh = contentOf("test/data/cube.obj");
  folder_.write("c.obj", mesh);
  std::filesystem::create_symlink("c.obj", folder_.file("l.csv"));
  std::string scenario = oneCraftYaml();
  const std::string given = "    mass: 2\n    inertia: {ixx: 0.5, iyy: 0.5, izz: 0.5}\n";
  scenario.replace(scenario.find(given), given.size(),
                   "    parts: [{mesh: {file: c.obj}, mass: 5}]\n");
  folder_.write("m.yaml", scenario);
  for (const char* option : {"-o {}l.csv", "-o - --contacts {}l.csv", "-o - --actuators {}l.csv"}) {
    const Outcome outcome = run("simulate {}m.yaml -d 0.01 " + std::string(option) + " 2>&1");
    EXPECT_EQ(outcome.status, 1) << option;
    EXPECT_NE(outcome.output.find("l.csv: must not be a file that is read"), std::string::npos)
        << outcome.output;
  }
  EXPECT_EQ(contentOf(folder_.file("c.obj")), mesh);
}

TEST_F(Tools, AMapDoesNotReplaceTheHeightsOfItsScenario) {
  const std::string image = contentOf("config/rough.pgm");
  folder_.write("map.pgm", image);
  std::string scenario = contentOf("config/rough.yaml");
  scenario.replace(scenario.find("rough.pgm"), 9, "map.pgm");
  folder_.write("s.yaml", scenario +
                              "\nworld: {obstacles: {b: {box: {size: [1, 1, 3]}, position: "
                              "[-20, -20, 0]}}}\n");
  const Outcome outcome = run("occupancy {}s.yaml --output {}map.yaml 2>&1");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.output.find("map.pgm: must not be a file that is read"), std::string::npos)
      << outcome.output;
  EXPECT_EQ(contentOf(folder_.file("map.pgm")), image);
}

TEST_F(Tools, CommandsMayComeThroughAPipe) {
  folder_.write("s.yaml", oneCraftYaml());
  folder_.write("c.csv", "time,rear,left,right\n0,1,0,0.1\n");
  ASSERT_EQ(run("simulate {}s.yaml -c {}c.csv -d 1 -o {}a.csv").status, 0);
  const Outcome piped =
      run("simulate {}s.yaml -c /dev/stdin -d 1 -o {}b.csv < {}c.csv; cat {}c.csv | " +
          toolFolder() + "simulate {}s.yaml -c /dev/stdin -d 1 -o {}p.csv");
  EXPECT_EQ(piped.status, 0) << piped.output;
  EXPECT_EQ(contentOf(folder_.file("b.csv")), contentOf(folder_.file("a.csv")));
  EXPECT_EQ(contentOf(folder_.file("p.csv")), contentOf(folder_.file("a.csv")));
}

TEST_F(Tools, PlotRunReplacesRegularFilesOnly) {
  folder_.write("s.yaml", oneCraftYaml());
  ASSERT_EQ(run("simulate {}s.yaml -d 0.5 -o {}run.bag").status, 0);
  const std::string fifo = folder_.file("fifo.png");
  hovercraft::testing::makeFifo(fifo);
  const Outcome refused = run("scripts/plot_run.py {}run.bag -o {}fifo.png");
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.output,
            "plot_run.py: " + fifo +
                ": cannot be written: must be a regular file or a name that is free\n");
  EXPECT_EQ(run("scripts/plot_run.py {}run.bag -o {}run.bag").output,
            "plot_run.py: --output = " + folder_.file("run.bag") +
                ": must not be the file that is read\n");
  const std::string target = folder_.write("target.png", "old");
  const std::string own = folder_.write("target.png.partial", "the user's own");
  std::filesystem::create_symlink(target, folder_.file("link.png"));
  EXPECT_EQ(run("scripts/plot_run.py {}run.bag -o {}link.png").status, 0);
  EXPECT_EQ(contentOf(target).substr(1, 3), "PNG");
  EXPECT_EQ(contentOf(own), "the user's own");
  EXPECT_TRUE(std::filesystem::is_symlink(folder_.file("link.png")));
}

TEST_F(Tools, HelpIsNoError) {
  for (const char* tool : {"simulate", "compare", "replay", "mass_properties", "closest"}) {
    const Outcome outcome = run(std::string(tool) + " --help");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.output.rfind(tool, 0), 0U) << outcome.output;
  }
}

// enter_ros is what each script calls before anything of ROS.
TEST_F(Tools, ScriptsSayInOneLineThatTheirHostNameCannotBeResolved) {
  const Outcome lost =
      run("bash -c '. scripts/common.sh; ROS_HOSTNAME=no-such-host.invalid; enter_ros; echo on'");
  EXPECT_EQ(lost.status, 1);
  EXPECT_EQ(lost.output.rfind("bash: the name no-such-host.invalid cannot be resolved", 0), 0U)
      << lost.output;
  EXPECT_EQ(lost.output.find('\n'), lost.output.size() - 1) << lost.output;
}

TEST_F(Tools, ScriptsFindAFreePortWithoutAnyName) {
  const Outcome port = run("bash -c '. scripts/common.sh; port=$(free_port); echo $port'");
  EXPECT_EQ(port.status, 0);
  EXPECT_GE(std::stoi(port.output), 1024) << port.output;
  EXPECT_NE(contentOf("scripts/common.sh").find("bind((\"127.0.0.1\", 0))"), std::string::npos);
}

TEST_F(Tools, TheDemoRefusesCommandsThatAreNotThere) {
  for (const char* arguments : {"'{}no such.csv'", "'{}no folder/c.csv'", "'{}'"}) {
    const Outcome missing = run(std::string("scripts/demo ") + arguments);
    EXPECT_EQ(missing.status, 1);
    EXPECT_NE(missing.output.find(": there is no such file, or it cannot be read\n"),
              std::string::npos)
        << missing.output;
    EXPECT_EQ(missing.output.find('\n'), missing.output.size() - 1) << missing.output;
  }
  const Outcome usage = run("scripts/demo config/manoeuvre.csv config/manoeuvre.csv");
  EXPECT_EQ(usage.status, 1);
  EXPECT_EQ(usage.output, "demo: usage: scripts/demo [COMMANDS.csv]\n");
}

}  // namespace
}  // namespace hovercraft_ros
