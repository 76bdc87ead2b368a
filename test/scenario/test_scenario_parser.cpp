#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/rotation.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"

#include "../support/files.h"
#include "../support/scenario_text.h"

namespace hovercraft {
namespace {

using testing::kMassByNumbers;
using testing::messageOf;
using testing::parsed;
using testing::scenarioOfParts;
using testing::TestFolder;
using testing::validScenario;
using testing::with;

TEST(ScenarioParser, ReadsEveryKey) {
  const Scenario scenario = parsed(validScenario());
  EXPECT_EQ(scenario.step_ns, 2000000);
  EXPECT_EQ(scenario.integrator, Integrator::kRungeKutta4);
  EXPECT_EQ(scenario.orientation, OrientationKind::kMatrix);
  EXPECT_EQ(scenario.model, BodyModel::kSpatial);
  EXPECT_EQ(scenario.gravity, Vector3(0.0, 0.0, -9.81));
  EXPECT_EQ(scenario.wind, Vector3(1.0, -2.0, 0.5));
  EXPECT_EQ(scenario.seed, 7);
  ASSERT_EQ(scenario.vehicles.size(), 1U);
  const VehicleScenario& vehicle = scenario.vehicles[0];
  EXPECT_EQ(vehicle.name, "alpha");
  EXPECT_EQ(vehicle.mass_properties.mass, 5.5);
  EXPECT_EQ(vehicle.mass_properties.p_HB, Vector3(0.01, 0.02, 0.03));
  Matrix3 inertia;
  inertia << 0.1, 0.01, -0.02,  //
      0.01, 0.2, 0.03,          //
      -0.02, 0.03, 0.25;
  EXPECT_EQ(vehicle.mass_properties.I_BBo_B, inertia);
  EXPECT_TRUE(vehicle.parts.empty());
  EXPECT_EQ(vehicle.drag.linear, Vector3(0.8, 1.2, 1.6));
  EXPECT_EQ(vehicle.drag.quadratic, Vector3(0.4, 0.9, 1.1));
  EXPECT_EQ(vehicle.drag.angular_linear, Vector3(0.12, 0.13, 0.14));
  EXPECT_EQ(vehicle.drag.angular_quadratic, Vector3(0.05, 0.06, 0.07));
  EXPECT_EQ(vehicle.initial_p_WB, Vector3(1.0, 2.0, 3.0));
  EXPECT_EQ(vehicle.initial_rpy, Vector3(0.1, 0.2, 0.3));
  EXPECT_EQ(vehicle.initial_v_WB, Vector3(4.0, 5.0, 6.0));
  EXPECT_EQ(vehicle.initial_w_WB, Vector3(0.4, 0.5, 0.6));
}

TEST(ScenarioParser, ReadsEveryKeyOfAnEngine) {
  const Scenario scenario = parsed(validScenario());
  const EngineParameters& rear = scenario.vehicles[0].engines[0];
  EXPECT_EQ(rear.p_HE, Vector3(-0.25, 0.0, 0.05));
  EXPECT_EQ(rear.direction, Vector3(1.0, 0.0, 0.0));
  EXPECT_EQ(rear.min_thrust, -1.0);
  EXPECT_EQ(rear.max_thrust, 4.5);
  EXPECT_EQ(rear.time_constant, 0.1);
  EXPECT_EQ(rear.timeout_ns, 750000000);
  EXPECT_EQ(scenario.vehicles[0].engines[1].max_thrust, 1.5);
  EXPECT_EQ(scenario.vehicles[0].engines[2].max_thrust, 1.25);
}

// The shortest scenario there is: Heun, quaternion, planar, no gravity, no wind, seed 1; engines
// without lag that stop after 0.5 s; no drag; at rest in the origin.
TEST(ScenarioParser, OptionalKeysHaveTheirDefaults) {
  const Scenario scenario = parsed(R"(step_size: 0.001
vehicles:
  a:
    mass: 1
    inertia: {ixx: 1, iyy: 1, izz: 1}
    engines:
      rear: {position: [0, 0, 0], direction: [1, 0, 0], min_thrust: 0, max_thrust: 1}
      left: {position: [0, 0, 0], direction: [1, 0, 0], min_thrust: 0, max_thrust: 1}
      right: {position: [0, 0, 0], direction: [1, 0, 0], min_thrust: 0, max_thrust: 1}
)");
  EXPECT_EQ(scenario.integrator, Integrator::kHeun);
  EXPECT_EQ(scenario.orientation, OrientationKind::kQuaternion);
  EXPECT_EQ(scenario.model, BodyModel::kPlanar);
  EXPECT_EQ(scenario.gravity, Vector3(0.0, 0.0, 0.0));
  EXPECT_EQ(scenario.wind, Vector3(0.0, 0.0, 0.0));
  EXPECT_EQ(scenario.seed, 1);
  const VehicleScenario& vehicle = scenario.vehicles.at(0);
  EXPECT_EQ(vehicle.mass_properties.p_HB, Vector3(0.0, 0.0, 0.0));
  EXPECT_EQ(vehicle.engines[0].time_constant, 0.0);
  EXPECT_EQ(vehicle.engines[0].timeout_ns, 500000000);
  EXPECT_EQ(vehicle.drag.linear, Vector3(0.0, 0.0, 0.0));
  EXPECT_EQ(vehicle.drag.angular_quadratic, Vector3(0.0, 0.0, 0.0));
  EXPECT_EQ(vehicle.initial_p_WB, Vector3(0.0, 0.0, 0.0));
  EXPECT_EQ(vehicle.initial_w_WB, Vector3(0.0, 0.0, 0.0));
}

// Numbers as people and programs write them.
TEST(ScenarioParser, NumbersMayBeWrittenInAnyDecimalForm) {
  for (const char* mass : {"5.5", "+5.5", "5.5e0", "0.55E+1", "55e-1", "005.50"}) {
    EXPECT_EQ(parsed(with(validScenario(), "mass: 5.5", std::string("mass: ") + mass))
                  .vehicles[0]
                  .mass_properties.mass,
              5.5)
        << mass;
  }
}

TEST(ScenarioParser, TimeoutMayBeZeroAndTimesMayReachTheirBound) {
  EXPECT_EQ(parsed(with(validScenario(), "timeout: 0.75", "timeout: 0"))
                .vehicles[0]
                .engines[0]
                .timeout_ns,
            0);
  EXPECT_EQ(parsed(with(validScenario(), "timeout: 0.75", "timeout: 1000000"))
                .vehicles[0]
                .engines[0]
                .timeout_ns,
            1000000000000000);
  EXPECT_EQ(parsed(with(validScenario(), "step_size: 0.002", "step_size: 1e-9")).step_ns, 1);
}

TEST(ScenarioParser, PlanarCraftMayNotMoveOutOfThePlane) {
  const std::string planar = with(validScenario(), "model: spatial", "model: planar");
  const std::string level = with(planar, "rpy: [0.1, 0.2, 0.3]", "rpy: [0, 0, 0.3]");
  EXPECT_EQ(testing::complaintAbout(level),
            "test.yaml: vehicles.alpha.initial.velocity = [4, 5, 6]: does not fit model: planar, "
            "which moves in x, y and yaw only");
  const std::string gliding = with(level, "velocity: [4, 5, 6]", "velocity: [4, 5, 0]");
  EXPECT_EQ(testing::complaintAbout(gliding),
            "test.yaml: vehicles.alpha.initial.angular_velocity = [0.4, 0.5, 0.6]: does not fit "
            "model: planar, which moves in x, y and yaw only");
  EXPECT_EQ(testing::complaintAbout(with(gliding, "[0.4, 0.5, 0.6]", "[0, 0, 0.6]")),
            "nothing was thrown");
}

TEST(ScenarioParser, SomethingMustMove) {
  const std::string head = "step_size: 0.001\n";
  EXPECT_EQ(testing::complaintAbout(head), "test.yaml: vehicles: the key is missing");
  EXPECT_EQ(testing::complaintAbout(head + "vehicles: {}"),
            "test.yaml: vehicles = {}: must name at least one vehicle");
  EXPECT_EQ(testing::complaintAbout(""),
            "test.yaml: the scenario: must be a map of keys; it is empty");
  EXPECT_EQ(testing::complaintAbout("[1, 2]"),
            "test.yaml: the scenario = [1, 2]: must be a map of keys");
}

TEST(ScenarioParser, VehiclesAreSortedByNameAndNamesMayBeLong) {
  const std::string& text = validScenario();
  const std::size_t start = text.find("    mass:");
  const std::string body = text.substr(start);
  const std::string head = text.substr(0, text.find("  alpha:"));
  const std::string long_name(100, 'n');
  const Scenario scenario = parsed(head + "  zulu:\n" + body + "  " + long_name + "1:\n" + body +
                                   "  " + long_name + "2:\n" + body + "  alpha:\n" + body);
  ASSERT_EQ(scenario.vehicles.size(), 4U);
  EXPECT_EQ(scenario.vehicles[0].name, "alpha");
  EXPECT_EQ(scenario.vehicles[1].name, long_name + "1");
  EXPECT_EQ(scenario.vehicles[2].name, long_name + "2");
  EXPECT_EQ(scenario.vehicles[3].name, "zulu");
}

// ---- parts --------------------------------------------------------------------------------------

TEST(ScenarioParser, PartsMakeMassCentreAndInertia) {
  const VehicleScenario vehicle = parsed(scenarioOfParts()).vehicles.at(0);
  ASSERT_EQ(vehicle.parts.size(), 4U);
  const MassProperties expected =
      composed({boxMassProperties(31.7 * boxVolume({0.6, 0.4, 0.1}), {0.6, 0.4, 0.1}),
                placed(cylinderMassProperties(0.3, 0.05, 0.2), rotationY(1.5707963267948966),
                       {-0.25, 0.0, 0.1}),
                placed(coneMassProperties(0.15, 0.07, 0.3), rotationFromRpy({0.1, 1.1, -0.4}),
                       {0.3, 0.0, 0.05}),
                placed(sphereMassProperties(7850 * sphereVolume(0.033), 0.033), Matrix3::Identity(),
                       {0.01, 0.07, 0.0})});
  EXPECT_NEAR(vehicle.mass_properties.mass, expected.mass, 1e-14);
  EXPECT_LT((vehicle.mass_properties.p_HB - expected.p_HB).norm(), 1e-15);
  EXPECT_LT((vehicle.mass_properties.I_BBo_B - expected.I_BBo_B).norm(), 1e-15);
}

// Slender to the point where no tensor has meaning: what parts make is checked as what is given is.
TEST(ScenarioParser, InertiaOfPartsIsChecked) {
  const std::string needle = with(validScenario(), kMassByNumbers,
                                  "    parts: [{cylinder: {radius: 1e-9, length: 1}, mass: 1}]\n");
  const std::string complaint = testing::complaintAbout(needle);
  EXPECT_EQ(complaint.find("test.yaml: vehicles.alpha.parts = [{cylinder: {radius: 1e-9, length: "
                           "1}, mass: 1}]: must be positive definite"),
            0U)
      << complaint;
}

std::string withMesh(const std::string& file) {
  return with(validScenario(), kMassByNumbers,
              "    parts: [{mesh: {file: '" + file + "'}, mass: 2, position: [1, 2, 3]}]\n");
}

// test/data/cube.obj through each kind of path: the same craft.
TEST(ScenarioParser, MeshesAreFoundByRelativeAbsoluteAndPackagePaths) {
  const std::string folder = std::filesystem::absolute("test/data").string();
  ScenarioSource parameter_server;
  parameter_server.name = "/hovercraft";
  parameter_server.package_folder = [&](const std::string& package) {
    return package == "shapes" ? folder : "";
  };
  const auto relative = parsed(withMesh("cube.obj")).vehicles[0].mass_properties;
  const auto absolute =
      parseScenario(withMesh(folder + "/cube.obj"), parameter_server).vehicles[0].mass_properties;
  const auto package = parseScenario(withMesh("package://shapes/cube.obj"), parameter_server)
                           .vehicles[0]
                           .mass_properties;
  EXPECT_EQ(relative.mass, 2.0);
  for (const MassProperties& other : {absolute, package}) {
    EXPECT_EQ(other.mass, relative.mass);
    EXPECT_EQ(other.p_HB, relative.p_HB);
    EXPECT_EQ(other.I_BBo_B, relative.I_BBo_B);
  }
  EXPECT_EQ(
      messageOf([&] { parseScenario(withMesh("cube.obj"), parameter_server); }),
      "/hovercraft: vehicles.alpha.parts[0].mesh.file = cube.obj: is relative to no "
      "folder: must be a package:// URL or an absolute path (or, for a node, give its parameter "
      "scenario_dir)");
}

// ---- files --------------------------------------------------------------------------------------

TEST(ScenarioFile, IsReadAndItsMeshesLieBesideIt) {
  const TestFolder folder;
  std::filesystem::copy_file("test/data/cube.obj", folder.file("hull.obj"));
  EXPECT_EQ(loadScenario(folder.write("scenario.yaml", withMesh("hull.obj")))
                .vehicles.at(0)
                .mass_properties.mass,
            2.0);
}

TEST(ScenarioFile, ThatIsMissingIsSaidToBeSo) {
  EXPECT_EQ(messageOf([] { loadScenario("nowhere/scenario.yaml"); }),
            "nowhere/scenario.yaml: there is no such file");
  EXPECT_EQ(messageOf([] { loadScenario("test"); }),
            "test: cannot be read: it is a directory, must be a regular file");
}

TEST(ScenarioFile, ThatIsNotYamlIsSaidToBeSoWithTheLine) {
  const TestFolder folder;
  const std::string file = folder.write("scenario.yaml", "step_size: 0.001\nvehicles: [1, 2\n");
  const std::string complaint = messageOf([&] { loadScenario(file); });
  EXPECT_EQ(complaint.find(file + ": not YAML: "), 0U) << complaint;
  EXPECT_NE(complaint.find("line 3"), std::string::npos) << complaint;
}

TEST(ScenarioFile, ErrorsNameTheFile) {
  const TestFolder folder;
  const std::string file = folder.write("scenario.yaml", "step_size: 0\n");
  EXPECT_EQ(messageOf([&] { loadScenario(file); }),
            file + ": step_size = 0: must be greater than 0");
}

TEST(ScenarioFile, OfSeveralDocumentsIsRefused) {
  const TestFolder folder;
  const std::string file =
      folder.write("scenario.yaml", validScenario() + "---\n" + validScenario());
  EXPECT_EQ(messageOf([&] { loadScenario(file); }),
            file + ": line 19: must be one YAML document, and here a second one begins");
}

TEST(ScenarioFile, ThoseThatAreShippedParse) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator("config")) {
    if (entry.path().extension() != ".yaml") continue;
    found.push_back(entry.path().filename().string());
    EXPECT_EQ(messageOf([&] { loadScenario(entry.path().string()); }), "nothing was thrown");
  }
  for (const char* name : {"hovercraft.yaml", "mvwt.yaml"}) {
    EXPECT_EQ(std::count(found.begin(), found.end(), name), 1) << name;
  }
}

}  // namespace
}  // namespace hovercraft
