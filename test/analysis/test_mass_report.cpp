#include <stdexcept>
#include <string>
#include <yaml-cpp/yaml.h>

#include <gtest/gtest.h>

#include "hovercraft_sim/analysis/mass_report.h"
#include "hovercraft_sim/math/constants.h"

namespace hovercraft {
namespace {

Scenario noScenario(const std::string& path) {
  ADD_FAILURE() << path << " was taken for a scenario";
  return {};
}

VehicleScenario vehicleOf(const std::string& name, const MassProperties& properties) {
  VehicleScenario vehicle;
  vehicle.name = name;
  vehicle.mass_properties = properties;
  return vehicle;
}

/// Two craft: `given` by mass and inertia, `made` of five parts.
Scenario twoCraft(const std::string& /*path*/) {
  Scenario scenario;
  scenario.vehicles = {vehicleOf("given", boxMassProperties(3.0, {1.0, 2.0, 3.0})),
                       vehicleOf("made", sphereMassProperties(7.0, 2.0))};
  for (const auto& shape : std::initializer_list<decltype(PartScenario::shape)>{
           BoxShape{{1.0, 2.0, 3.0}}, SphereShape{1.0}, CylinderShape{1.0, 2.0},
           ConeShape{1.0, 3.0}, MeshShape{"test/data/l_shape.obj"}}) {
    PartScenario part;
    part.shape = shape;
    scenario.vehicles[1].parts.push_back(part);
  }
  return scenario;
}

MassReportRequest requestFor(const std::string& file) {
  MassReportRequest request;
  request.file = file;
  return request;
}

std::string messageOf(const MassReportRequest& request) {
  try {
    bodiesOf(request, twoCraft);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

double entry(const YAML::Node& matrix, int row, int column) {
  return matrix[row][column].as<double>();
}

// JSON is YAML, so that yaml-cpp reads it. l_shape.obj by hand: boxes of 1.5 and 0.5 m³ at (1.5,
// 0.5) and (0.5, 1.5), 0.5 high, of 2 kg/m³. Centre (1.25, 0.75, 0.25). About it
// Izz = 3/12 (3² + 1²) + 3 * 0.125 + 1/12 (1 + 1) + 1 * 1.125 = 25/6.
TEST(MassReport, JsonOfAMeshHasEveryKey) {
  MassReportRequest request = requestFor("test/data/l_shape.obj");
  request.density = 2.0;
  const std::string text = toJson(bodiesOf(request, noScenario));
  EXPECT_EQ(text.back(), '\n');
  const YAML::Node json = YAML::Load(text);
  EXPECT_EQ(json.size(), 6U);
  EXPECT_DOUBLE_EQ(json["mass"].as<double>(), 4.0);
  EXPECT_DOUBLE_EQ(json["volume"].as<double>(), 2.0);
  EXPECT_DOUBLE_EQ(json["center_of_mass"][0].as<double>(), 1.25);
  EXPECT_DOUBLE_EQ(json["center_of_mass"][1].as<double>(), 0.75);
  EXPECT_DOUBLE_EQ(json["center_of_mass"][2].as<double>(), 0.25);
  EXPECT_DOUBLE_EQ(entry(json["inertia"], 2, 2), 25.0 / 6.0);
  EXPECT_DOUBLE_EQ(entry(json["inertia"], 0, 1), 0.75);  // -∫ xy dm = 3 * 0.0625 + 1 * 0.5625
  EXPECT_DOUBLE_EQ(entry(json["inertia"], 1, 0), 0.75);
  EXPECT_EQ(entry(json["inertia"], 1, 2), 0.0);
}

// Inertia = Σ moment * axis axisᵀ: holds only if row i is the axis of moment i.
TEST(MassReport, PrincipalAxesAreRowsThatBelongToTheirMoments) {
  const YAML::Node json =
      YAML::Load(toJson(bodiesOf(requestFor("test/data/l_shape.obj"), noScenario)));
  EXPECT_LT(json["principal_moments"][0].as<double>(), json["principal_moments"][1].as<double>());
  EXPECT_LT(json["principal_moments"][1].as<double>(), json["principal_moments"][2].as<double>());
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      double sum = 0.0;
      for (int k = 0; k < 3; ++k) {
        sum += json["principal_moments"][k].as<double>() * entry(json["principal_axes"], k, i) *
               entry(json["principal_axes"], k, j);
      }
      EXPECT_NEAR(entry(json["inertia"], i, j), sum, 1e-15) << i << j;
    }
  }
}

TEST(MassReport, AMeshWithoutDensityAndMassHasTheDensityOne) {
  const BodyReport body = bodiesOf(requestFor("test/data/tetrahedron.stl"), noScenario).front();
  EXPECT_EQ(body.properties.mass, body.volume);
  EXPECT_EQ(body.vehicle, "");
}

TEST(MassReport, AMeshMayHaveAMassInstead) {
  MassReportRequest request = requestFor("test/data/cube.obj");
  request.mass = 6.0;
  const BodyReport body = bodiesOf(request, noScenario).front();
  EXPECT_EQ(body.properties.mass, 6.0);
  EXPECT_DOUBLE_EQ(body.properties.I_BBo_B(0, 0), 1.0);  // 6/12 (1 + 1)
}

// Box 6, ball 4/3 π, cylinder 2 π, cone π, mesh 2 m³.
TEST(MassReport, TheVolumeOfAVehicleIsThatOfItsParts) {
  const std::vector<BodyReport> bodies = bodiesOf(requestFor("two.yaml"), twoCraft);
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].vehicle, "given");
  EXPECT_FALSE(bodies[0].volume.has_value());
  EXPECT_EQ(bodies[1].vehicle, "made");
  EXPECT_EQ(bodies[1].properties.mass, 7.0);
  EXPECT_DOUBLE_EQ(bodies[1].volume.value(), 8.0 + 13.0 / 3.0 * kPi);
}

TEST(MassReport, SeveralVehiclesAreKeyedByTheirNames) {
  const YAML::Node json = YAML::Load(toJson(bodiesOf(requestFor("two.yml"), twoCraft)));
  ASSERT_EQ(json.size(), 1U);
  ASSERT_EQ(json["vehicles"].size(), 2U);
  EXPECT_TRUE(json["vehicles"]["given"]["volume"].IsNull());
  EXPECT_EQ(json["vehicles"]["given"]["mass"].as<double>(), 3.0);
  EXPECT_EQ(json["vehicles"]["made"]["vehicle"].as<std::string>(), "made");
}

TEST(MassReport, OneVehicleOfSeveralCanBeChosen) {
  MassReportRequest request = requestFor("two.yaml");
  request.vehicle = "made";
  const YAML::Node json = YAML::Load(toJson(bodiesOf(request, twoCraft)));
  EXPECT_EQ(json["vehicle"].as<std::string>(), "made");
  EXPECT_EQ(json["mass"].as<double>(), 7.0);
}

TEST(MassReport, JsonKeepsEveryBit) {
  BodyReport body;
  body.properties = boxMassProperties(0.1, {0.3, 0.7, 1.1});
  const YAML::Node json = YAML::Load(toJson({body}));
  EXPECT_EQ(json["mass"].as<double>(), 0.1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(entry(json["inertia"], i, i), body.properties.I_BBo_B(i, i));
  }
}

TEST(MassReport, TextHasAParagraphForEachVehicle) {
  const std::string text = toText(bodiesOf(requestFor("two.yaml"), twoCraft));
  EXPECT_EQ(text.substr(0, text.find("  center_of_mass")),
            "vehicle given\n"
            "  mass                             3 kg\n"
            "  volume                     unknown, as mass and inertia are given\n");
  EXPECT_NE(text.find("\n\nvehicle made\n"), std::string::npos);
  EXPECT_NE(text.find("\n  principal_moments"), std::string::npos);
}

// A composed body may have -0 among its products of inertia.
TEST(MassReport, ThereIsNoMinusZero) {
  BodyReport body;
  body.properties = boxMassProperties(1.0, {1.0, 2.0, 3.0});
  body.properties.I_BBo_B(0, 1) = body.properties.I_BBo_B(1, 0) = -0.0;
  body.properties.p_HB = {-0.0, 0.0, 0.0};
  EXPECT_EQ(toText({body}).find("-0"), std::string::npos) << toText({body});
  EXPECT_EQ(toJson({body}).find("-0"), std::string::npos) << toJson({body});
}

// 1 m³ times 0.001³ of 1000 kg/m³; a cube has m a²/6.
TEST(MassReport, AMeshMayHaveAScale) {
  MassReportRequest request = requestFor("test/data/cube.obj");
  request.density = 1000.0;
  request.scale = Vector3::Constant(0.25);
  const BodyReport body = bodiesOf(request, noScenario).front();
  EXPECT_EQ(body.volume, 1.0 / 64.0);
  EXPECT_EQ(body.properties.mass, 1000.0 / 64.0);
  EXPECT_NEAR(body.properties.I_BBo_B(2, 2), 1000.0 / 64.0 / 16.0 / 6.0, 1e-15);
  EXPECT_TRUE(body.notes.empty());
  request.file = "two.yaml";
  request.density.reset();
  EXPECT_EQ(messageOf(request),
            "--scale: is for a mesh; in two.yaml a mesh has a scale of its own");
}

TEST(MassReport, ABodyThatWeighsWhatNoCraftWeighsIsAskedAbout) {
  MassReportRequest request = requestFor("test/data/cube.obj");
  EXPECT_TRUE(bodiesOf(request, noScenario).front().notes.empty());
  request.scale = Vector3::Constant(600.0);
  const BodyReport body = bodiesOf(request, noScenario).front();
  ASSERT_EQ(body.notes.size(), 1U);
  EXPECT_EQ(body.notes[0],
            "mesh file 'test/data/cube.obj': encloses 2.16e+08 m^3 and weighs 2.16e+08 kg, which "
            "no craft does: is the file in millimetres? Then take the scale 0.001");
}

TEST(MassReport, DensityAndMassExcludeEachOther) {
  MassReportRequest request = requestFor("test/data/cube.obj");
  request.density = 1.0;
  request.mass = 1.0;
  EXPECT_EQ(messageOf(request), "--density and --mass: only one of them can be given");
}

TEST(MassReport, AScenarioTakesNoMassAndNoDensity) {
  MassReportRequest request = requestFor("two.yaml");
  request.mass = 1.0;
  EXPECT_EQ(messageOf(request),
            "--mass: is for a mesh; the vehicles of two.yaml have their own mass");
  request.mass.reset();
  request.density = 1.0;
  EXPECT_EQ(messageOf(request),
            "--density: is for a mesh; the vehicles of two.yaml have their own mass");
}

TEST(MassReport, AVehicleThatIsNotThereIsNamedWithThoseThatAre) {
  MassReportRequest request = requestFor("two.yaml");
  request.vehicle = "third";
  EXPECT_EQ(messageOf(request),
            "--vehicle third: two.yaml has no such vehicle; it has given, made");
}

TEST(MassReport, AMeshHasNoVehicle) {
  MassReportRequest request = requestFor("test/data/cube.obj");
  request.vehicle = "given";
  EXPECT_EQ(messageOf(request),
            "--vehicle given: is for a scenario (.yaml or .yml), but test/data/cube.obj is a mesh");
}

TEST(MassReport, AMeshThatIsNotClosedIsRefused) {
  EXPECT_EQ(messageOf(requestFor("test/data/open_cube.obj"))
                .find("mesh file 'test/data/open_cube.obj': not closed"),
            0U);
}

// 1.7e308 kg on a body 4 m long: its moments are beyond the largest double, 1.8e308.
TEST(MassReport, AnInertiaBeyondTheRangeOfNumbersIsRefused) {
  MassReportRequest request = requestFor("test/data/two_boxes.obj");
  request.mass = 1.7e308;
  EXPECT_EQ(messageOf(request),
            "test/data/two_boxes.obj: inertia: iyy = inf kg m^2: must be finite");
}

}  // namespace
}  // namespace hovercraft
