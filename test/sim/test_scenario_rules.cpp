#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/scenario_text.h"

/// Every rule of a scenario file, broken once, with the whole message.

namespace hovercraft {
namespace {

using testing::kMassByNumbers;

struct BrokenRule {
  const char* name;
  const char* old_part;
  const char* new_part;
  const char* message;
};

void PrintTo(const BrokenRule& rule, std::ostream* stream) {  // NOLINT: gtest's name
  *stream << rule.new_part;
}

class BrokenScenario : public ::testing::TestWithParam<BrokenRule> {};

TEST_P(BrokenScenario, IsRefusedWithSourceKeyValueAndRule) {
  const BrokenRule& rule = GetParam();
  const std::string text = testing::with(testing::validScenario(), rule.old_part, rule.new_part);
  const std::string complaint = testing::complaintAbout(text);
  EXPECT_EQ(complaint, std::string("test.yaml: ") + rule.message);
  EXPECT_EQ(std::count(complaint.begin(), complaint.end(), '\n'), 0);
}

std::string nameOf(const ::testing::TestParamInfo<BrokenRule>& rule) {
  return rule.param.name;
}

// ---- keys ---------------------------------------------------------------------------------------
const std::vector<BrokenRule> kBrokenKeys = {
    {"UnknownKey", "seed: 7", "sede: 7",
     "sede = 7: unknown key; known here: step_size, integrator, orientation, model, gravity, wind, "
     "seed, vehicles, world"},
    {"UnknownVehicleKey", "    mass: 5.5", "    weight: 5.5",
     "vehicles.alpha.weight = 5.5: unknown key; known here: mass, inertia, center_of_mass, parts, "
     "engines, drag, hull, material, visual, initial"},
    {"UnknownEngine", "      left: {", "      port: {",
     "vehicles.alpha.engines.port = {position: [0.2, 0.15, 0.05], direction: [0, -1, 0], "
     "min_thrust: 0, max_thrust: ...: unknown key; known here: rear, left, right"},
    {"UnknownEngineKey", "timeout: 0.75", "time_out: 0.75",
     "vehicles.alpha.engines.rear.time_out = 0.75: unknown key; known here: position, direction, "
     "min_thrust, max_thrust, time_constant, timeout"},
    {"UnknownInertiaKey", "iyz: 0.03", "izy: 0.03",
     "vehicles.alpha.inertia.izy = 0.03: unknown key; known here: ixx, iyy, izz, ixy, ixz, iyz"},
    {"UnknownDragKey", "{linear: [0.8", "{lineal: [0.8",
     "vehicles.alpha.drag.lineal = [0.8, 1.2, 1.6]: unknown key; known here: linear, quadratic, "
     "angular_linear, angular_quadratic"},
    {"UnknownInitialKey", "rpy: [0.1", "yaw: [0.1",
     "vehicles.alpha.initial.yaw = [0.1, 0.2, 0.3]: unknown key; known here: position, rpy, "
     "velocity, angular_velocity"},
    {"MissingStepSize", "step_size: 0.002\n", "", "step_size: the key is missing"},
    {"MissingMass", "    mass: 5.5\n", "", "vehicles.alpha.mass: the key is missing"},
    {"MissingMoment", "izz: 0.25, ", "", "vehicles.alpha.inertia.izz: the key is missing"},
    {"MissingEngine",
     "      left: {position: [0.2, 0.15, 0.05], direction: [0, -1, 0], min_thrust: 0, max_thrust: "
     "1.5}\n",
     "", "vehicles.alpha.engines.left: the key is missing"},
    {"MissingLimit", ", max_thrust: 1.5}", "}",
     "vehicles.alpha.engines.left.max_thrust: the key is missing"},
    {"MissingDirection", "direction: [0, -1, 0], ", "",
     "vehicles.alpha.engines.left.direction: the key is missing"},
    {"EmptyValue", "mass: 5.5", "mass:", "vehicles.alpha.mass: the value is missing"},
    {"EmptyOptionalValue", "seed: 7", "seed:", "seed: the value is missing"},
    {"EmptyMap",
     "    drag: {linear: [0.8, 1.2, 1.6], quadratic: [0.4, 0.9, 1.1], angular_linear: [0.12, "
     "0.13, 0.14], angular_quadratic: [0.05, 0.06, 0.07]}",
     "    drag:", "vehicles.alpha.drag: the value is missing"},
    {"KeyTwice", "seed: 7", "seed: 7\nseed: 8", "seed = 7: the key stands twice"},
    {"KeyTwiceInside", "ixx: 0.1,", "ixx: 0.1, ixx: 0.1,",
     "vehicles.alpha.inertia.ixx = 0.1: the key stands twice"},
    {"VehicleTwice", "  alpha:\n", "  alpha: {mass: 1}\n  alpha:\n",
     "vehicles.alpha = {mass: 1}: the name stands twice"},
};
INSTANTIATE_TEST_SUITE_P(Keys, BrokenScenario, ::testing::ValuesIn(kBrokenKeys), nameOf);

// ---- numbers ------------------------------------------------------------------------------------
const std::vector<BrokenRule> kBrokenNumbers = {
    {"WordForNumber", "mass: 5.5", "mass: heavy", "vehicles.alpha.mass = heavy: must be a number"},
    {"TruthForNumber", "mass: 5.5", "mass: true", "vehicles.alpha.mass = true: must be a number"},
    {"NumberWithUnit", "mass: 5.5", "mass: 5.5 kg",
     "vehicles.alpha.mass = 5.5 kg: must be a number"},
    {"NumberWithComma", "mass: 5.5", "mass: 5,5", "vehicles.alpha.mass = 5,5: must be a number"},
    {"Hexadecimal", "mass: 5.5", "mass: 0x10", "vehicles.alpha.mass = 0x10: must be a number"},
    {"ListForNumber", "mass: 5.5", "mass: [5.5]", "vehicles.alpha.mass = [5.5]: must be a number"},
    {"MapForNumber", "mass: 5.5", "mass: {kg: 5.5}",
     "vehicles.alpha.mass = {kg: 5.5}: must be a number"},
    {"NanOfYaml", "mass: 5.5", "mass: .nan", "vehicles.alpha.mass = .nan: must be finite"},
    {"NanOfPython", "mass: 5.5", "mass: nan", "vehicles.alpha.mass = nan: must be finite"},
    {"Infinity", "mass: 5.5", "mass: .inf", "vehicles.alpha.mass = .inf: must be finite"},
    {"MinusInfinity", "min_thrust: -1,", "min_thrust: -.INF,",
     "vehicles.alpha.engines.rear.min_thrust = -.INF: must be finite"},
    {"BeyondDouble", "mass: 5.5", "mass: 1e999", "vehicles.alpha.mass = 1e999: must be finite"},
    {"NanInVector", "gravity: [0, 0, -9.81]", "gravity: [0, .nan, -9.81]",
     "gravity = [0, .nan, -9.81]: must be finite"},
    {"WordInVector", "gravity: [0, 0, -9.81]", "gravity: [0, 0, down]",
     "gravity = [0, 0, down]: must be a number"},
    {"NumberForVector", "gravity: [0, 0, -9.81]", "gravity: -9.81",
     "gravity = -9.81: must be a list of three numbers"},
    {"TwoComponents", "gravity: [0, 0, -9.81]", "gravity: [0, -9.81]",
     "gravity = [0, -9.81]: must be a list of three numbers"},
    {"FourComponents", "wind: [1, -2, 0.5]", "wind: [1, -2, 0.5, 0]",
     "wind = [1, -2, 0.5, 0]: must be a list of three numbers"},
    {"NegativeMass", "mass: 5.5", "mass: -5.5",
     "vehicles.alpha.mass = -5.5: must be greater than 0"},
    {"NoMass", "mass: 5.5", "mass: 0", "vehicles.alpha.mass = 0: must be greater than 0"},
    {"MassBelowDouble", "mass: 5.5", "mass: 1e-999",
     "vehicles.alpha.mass = 1e-999: must be greater than 0"},
    {"PositiveMinThrust", "min_thrust: -1,", "min_thrust: 1,",
     "vehicles.alpha.engines.rear.min_thrust = 1: must be 0 or less"},
    {"NegativeMaxThrust", "max_thrust: 4.5", "max_thrust: -4.5",
     "vehicles.alpha.engines.rear.max_thrust = -4.5: must be 0 or greater"},
    {"NegativeTimeConstant", "time_constant: 0.1", "time_constant: -0.1",
     "vehicles.alpha.engines.rear.time_constant = -0.1: must be 0 or greater"},
    {"NegativeTimeout", "timeout: 0.75", "timeout: -0.75",
     "vehicles.alpha.engines.rear.timeout = -0.75: must be 0 or greater"},
    {"NegativeDrag", "quadratic: [0.4, 0.9, 1.1], ", "quadratic: [0.4, -0.9, 1.1], ",
     "vehicles.alpha.drag.quadratic = [0.4, -0.9, 1.1]: must be 0 or greater"},
    {"DirectionTooLong", "direction: [0, -1, 0]", "direction: [0, -2, 0]",
     "vehicles.alpha.engines.left.direction = [0, -2, 0]: must have length 1 (it has 2)"},
    {"DirectionIsNotNormalised", "direction: [0, -1, 0]", "direction: [0, -1, 0.01]",
     "vehicles.alpha.engines.left.direction = [0, -1, 0.01]: must have length 1 (it has 1.00005)"},
    {"NoDirection", "direction: [0, -1, 0]", "direction: [0, 0, 0]",
     "vehicles.alpha.engines.left.direction = [0, 0, 0]: must have length 1 (it has 0)"},
    {"FractionForSeed", "seed: 7", "seed: 7.5",
     "seed = 7.5: must be a whole number of at most 64 bits"},
    {"WordForSeed", "seed: 7", "seed: any",
     "seed = any: must be a whole number of at most 64 bits"},
    {"SeedBeyond64Bits", "seed: 7", "seed: 9223372036854775808",
     "seed = 9223372036854775808: must be a whole number of at most 64 bits"},
};
INSTANTIATE_TEST_SUITE_P(Numbers, BrokenScenario, ::testing::ValuesIn(kBrokenNumbers), nameOf);

// ---- time ---------------------------------------------------------------------------------------
const std::vector<BrokenRule> kBrokenTimes = {
    {"NoStep", "step_size: 0.002", "step_size: 0", "step_size = 0: must be greater than 0"},
    {"NegativeStep", "step_size: 0.002", "step_size: -0.002",
     "step_size = -0.002: must be greater than 0"},
    {"StepBelowANanosecond", "step_size: 0.002", "step_size: 1e-10",
     "step_size = 1e-10: must be a whole number of nanoseconds"},
    {"StepBetweenNanoseconds", "step_size: 0.002", "step_size: 0.0020000005",
     "step_size = 0.0020000005: must be a whole number of nanoseconds"},
    {"ThirdOfASecond", "step_size: 0.002", "step_size: 0.3333333333333333",
     "step_size = 0.3333333333333333: must be a whole number of nanoseconds"},
    {"StepTooLong", "step_size: 0.002", "step_size: 1000000.1",
     "step_size = 1000000.1: must be at most 1000000 s"},
    {"TimeoutBetweenNanoseconds", "timeout: 0.75", "timeout: 0.7500000001",
     "vehicles.alpha.engines.rear.timeout = 0.7500000001: must be a whole number of nanoseconds"},
    {"TimeoutTooLong", "timeout: 0.75", "timeout: 1e300",
     "vehicles.alpha.engines.rear.timeout = 1e300: must be at most 1000000 s"},
};
INSTANTIATE_TEST_SUITE_P(Times, BrokenScenario, ::testing::ValuesIn(kBrokenTimes), nameOf);

// ---- choices, names, structure ------------------------------------------------------------------
const std::vector<BrokenRule> kBrokenStructures = {
    {"UnknownIntegrator", "integrator: rk4", "integrator: rk5",
     "integrator = rk5: must be one of: euler, semi_implicit_euler, heun, rk4"},
    {"UnknownOrientation", "orientation: matrix", "orientation: euler_angles",
     "orientation = euler_angles: must be one of: quaternion, matrix"},
    {"UnknownModel", "model: spatial", "model: Planar",
     "model = Planar: must be one of: planar, spatial"},
    {"EmptyModel", "model: spatial", "model: ''", "model: must be a text"},
    {"ListForModel", "model: spatial", "model: [spatial]", "model = [spatial]: must be a text"},
    {"VehicleNameWithDash", "  alpha:\n", "  al-pha:\n",
     "vehicles.al-pha = {mass: 5.5, center_of_mass: [0.01, 0.02, 0.03], inertia: {ixx: 0.1, iyy: "
     "0.2, iz...: the name of a vehicle is a ROS name: a letter, then letters, digits and _"},
    {"NoVehicleMap", "  alpha:\n", "  alpha: 5\n  beta:\n",
     "vehicles.alpha = 5: must be a map of keys"},
    {"EnginesAreAList",
     "      rear: {position: [-0.25, 0, 0.05], direction: [1, 0, 0], min_thrust: -1, max_thrust: "
     "4.5, time_constant: 0.1, timeout: 0.75}",
     "      rear: [1, 2]", "vehicles.alpha.engines.rear = [1, 2]: must be a map of keys"},
    {"PlanarWithRoll", "model: spatial", "model: planar",
     "vehicles.alpha.initial.rpy = [0.1, 0.2, 0.3]: does not fit model: planar, which moves in x, "
     "y and yaw only"},
    {"ValueOfSeveralLines", "mass: 5.5", "mass: |\n      5\n      5",
     "vehicles.alpha.mass = 5 5 : must be a number"},
};
INSTANTIATE_TEST_SUITE_P(Structures, BrokenScenario, ::testing::ValuesIn(kBrokenStructures),
                         nameOf);

// ---- inertia ------------------------------------------------------------------------------------
constexpr const char* kInertia =
    "{ixx: 0.1, iyy: 0.2, izz: 0.25, ixy: 0.01, ixz: -0.02, iyz: 0.03}";
const std::vector<BrokenRule> kBrokenInertias = {
    // Largest moment 0.75 > 0.25 + 0.25: no distribution of mass has it.
    {"TriangleInequality", kInertia, "{ixx: 0.25, iyy: 0.25, izz: 0.75}",
     "vehicles.alpha.inertia = {ixx: 0.25, iyy: 0.25, izz: 0.75}: its largest principal moment is "
     "0.75 kg m^2: must be at most 0.5 kg m^2, the sum of the other two"},
    {"NegativeMoment", kInertia, "{ixx: 0.25, iyy: -0.5, izz: 0.25}",
     "vehicles.alpha.inertia = {ixx: 0.25, iyy: -0.5, izz: 0.25}: must be positive definite: its "
     "smallest principal moment is -0.5 kg m^2"},
    // Every diagonal entry is positive, and yet [1 1 0; 1 1 0; 0 0 1] · 0.25 is singular; here the
    // product is larger still: eigenvalues 0.25 ± 0.5.
    {"LargeProduct", kInertia, "{ixx: 0.25, iyy: 0.25, izz: 0.25, ixy: 0.5}",
     "vehicles.alpha.inertia = {ixx: 0.25, iyy: 0.25, izz: 0.25, ixy: 0.5}: must be positive "
     "definite: its smallest principal moment is -0.25 kg m^2"},
};
INSTANTIATE_TEST_SUITE_P(Inertias, BrokenScenario, ::testing::ValuesIn(kBrokenInertias), nameOf);

// ---- parts --------------------------------------------------------------------------------------
const std::vector<BrokenRule> kBrokenParts = {
    {"PartsBesideMass", "    mass: 5.5\n",
     "    mass: 5.5\n    parts: [{sphere: {radius: 0.1}, mass: 1}]\n",
     "vehicles.alpha.mass = 5.5: must not stand beside parts, which determine it"},
    {"NoParts", kMassByNumbers, "    parts: []\n",
     "vehicles.alpha.parts = []: must be a list, not empty"},
    {"PartsAreAMap", kMassByNumbers, "    parts: {sphere: {radius: 0.1}, mass: 1}\n",
     "vehicles.alpha.parts = {sphere: {radius: 0.1}, mass: 1}: must be a list, not empty"},
    {"TwoShapes", kMassByNumbers,
     "    parts: [{sphere: {radius: 0.1}, box: {size: [1, 1, 1]}, mass: 1}]\n",
     "vehicles.alpha.parts[0] = {sphere: {radius: 0.1}, box: {size: [1, 1, 1]}, mass: 1}: must "
     "have one of box, cylinder, cone, sphere, mesh"},
    {"NoShape", kMassByNumbers, "    parts: [{sphere: {radius: 0.1}, mass: 1}, {mass: 2}]\n",
     "vehicles.alpha.parts[1] = {mass: 2}: must have one of box, cylinder, cone, sphere, mesh"},
    {"MassAndDensity", kMassByNumbers,
     "    parts: [{sphere: {radius: 0.1}, mass: 1, density: 1000}]\n",
     "vehicles.alpha.parts[0] = {sphere: {radius: 0.1}, mass: 1, density: 1000}: must have either "
     "mass or density"},
    {"NeitherMassNorDensity", kMassByNumbers, "    parts: [{sphere: {radius: 0.1}}]\n",
     "vehicles.alpha.parts[0] = {sphere: {radius: 0.1}}: must have either mass or density"},
    {"UnknownPartKey", kMassByNumbers, "    parts: [{sphere: {radius: 0.1}, mass: 1, at: 3}]\n",
     "vehicles.alpha.parts[0].at = 3: unknown key; known here: box, cylinder, cone, sphere, mesh, "
     "mass, density, position, rpy"},
    {"UnknownShapeKey", kMassByNumbers, "    parts: [{sphere: {diameter: 0.1}, mass: 1}]\n",
     "vehicles.alpha.parts[0].sphere.diameter = 0.1: unknown key; known here: radius"},
    {"NegativeRadius", kMassByNumbers, "    parts: [{sphere: {radius: -0.1}, mass: 1}]\n",
     "vehicles.alpha.parts[0].sphere.radius = -0.1: must be greater than 0"},
    {"FlatBox", kMassByNumbers, "    parts: [{box: {size: [1, 0, 1]}, mass: 1}]\n",
     "vehicles.alpha.parts[0].box.size = [1, 0, 1]: must be greater than 0"},
    {"NoLengthOfCylinder", kMassByNumbers, "    parts: [{cylinder: {radius: 0.1}, mass: 1}]\n",
     "vehicles.alpha.parts[0].cylinder.length: the key is missing"},
    {"NegativeLengthOfCone", kMassByNumbers,
     "    parts: [{cone: {radius: 0.1, length: -1}, mass: 1}]\n",
     "vehicles.alpha.parts[0].cone.length = -1: must be greater than 0"},
    {"NegativeDensity", kMassByNumbers, "    parts: [{sphere: {radius: 0.1}, density: -3}]\n",
     "vehicles.alpha.parts[0].density = -3: must be greater than 0"},
    {"DensityMakesTheMassInfinite", kMassByNumbers,
     "    parts: [{sphere: {radius: 1e50}, density: 1e300}]\n",
     "vehicles.alpha.parts[0].density = 1e300: makes a mass that is not positive and finite"},
    {"PartWithoutVolume", kMassByNumbers,
     "    parts: [{box: {size: [1e-200, 1e-200, 1]}, mass: 1}]\n",
     "vehicles.alpha.parts[0].box = {size: [1e-200, 1e-200, 1]}: has a volume that is not positive "
     "and finite"},
    {"MeshIsMissing", kMassByNumbers, "    parts: [{mesh: {file: nowhere.obj}, mass: 1}]\n",
     "vehicles.alpha.parts[0].mesh.file = nowhere.obj: mesh file 'test/data/nowhere.obj': does not "
     "exist or cannot be read"},
    {"PackageIsMissing", kMassByNumbers,
     "    parts: [{mesh: {file: 'package://nowhere/hull.obj'}, mass: 1}]\n",
     "vehicles.alpha.parts[0].mesh.file = package://nowhere/hull.obj: there is no ROS package "
     "nowhere"},
    {"PackageWithoutPath", kMassByNumbers,
     "    parts: [{mesh: {file: 'package://nowhere'}, mass: 1}]\n",
     "vehicles.alpha.parts[0].mesh.file = package://nowhere: must be package://PACKAGE/PATH"},
};
INSTANTIATE_TEST_SUITE_P(Parts, BrokenScenario, ::testing::ValuesIn(kBrokenParts), nameOf);

}  // namespace
}  // namespace hovercraft
