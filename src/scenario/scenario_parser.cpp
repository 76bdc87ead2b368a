#include "hovercraft_sim/scenario/scenario_parser.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/io/input_file.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/rotation.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/scenario/actuator_parser.h"
#include "hovercraft_sim/scenario/actuator_topics.h"
#include "hovercraft_sim/scenario/air_parser.h"
#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/craft_keys.h"
#include "hovercraft_sim/scenario/cushion_parser.h"
#include "hovercraft_sim/scenario/drag_parser.h"
#include "hovercraft_sim/scenario/fleet.h"
#include "hovercraft_sim/scenario/ground_parser.h"
#include "hovercraft_sim/scenario/mesh_parser.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/sensor_parser.h"
#include "hovercraft_sim/scenario/version.h"
#include "hovercraft_sim/scenario/world_parser.h"

namespace hovercraft {
namespace {

Matrix3 parseInertia(const ConfigReader& vehicle) {
  const ConfigReader reader = vehicle.map("inertia");
  Matrix3 inertia = Matrix3::Zero();
  parseKeys(reader, kInertiaKeys, inertia);
  inertia(1, 0) = inertia(0, 1);
  inertia(2, 0) = inertia(0, 2);
  inertia(2, 1) = inertia(1, 2);
  return inertia;
}

struct ParsedPart {
  // A constructor, not an aggregate: GCC 12 destroys the first member twice if the second one's
  // initializer throws.
  ParsedPart(const PartScenario& described, const MassProperties& at_unit_density)
      : part(described), unit(at_unit_density) {}

  PartScenario part;
  MassProperties unit;  // of density 1 kg/m³, in the part's own frame
};

bool isPositiveAndFinite(double number) {
  return number > 0.0 && std::isfinite(number);
}

/// Lengths that pass may still multiply to 0 or infinity.
double checkedVolume(double volume, const ConfigReader& shape) {
  if (!isPositiveAndFinite(volume)) {
    shape.fail("", "has a volume that is not positive and finite");
  }
  return volume;
}

ParsedPart parseShape(const ConfigReader& part, const ScenarioSource& source) {
  if (part.has("box")) {
    const ConfigReader box = part.map("box");
    box.allowOnly({"size"});
    const Vector3 size = box.lengths("size");
    return {{BoxShape{size}}, boxMassProperties(checkedVolume(boxVolume(size), box), size)};
  }
  if (part.has("sphere")) {
    const ConfigReader sphere = part.map("sphere");
    sphere.allowOnly({"radius"});
    const double radius = sphere.length("radius");
    return {{SphereShape{radius}},
            sphereMassProperties(checkedVolume(sphereVolume(radius), sphere), radius)};
  }
  if (part.has("mesh")) {
    const ConfigReader mesh = part.map("mesh");
    const MeshShape shape = parseMesh(mesh, source);
    return {{shape}, meshMassPropertiesOfDensity(loadedBody(mesh, shape, source), 1.0)};
  }
  const bool is_cone = part.has("cone");
  const ConfigReader round = part.map(is_cone ? "cone" : "cylinder");
  round.allowOnly({"radius", "length"});
  const double radius = round.length("radius");
  const double length = round.length("length");
  if (is_cone) {
    return {{ConeShape{radius, length}},
            coneMassProperties(checkedVolume(coneVolume(radius, length), round), radius, length)};
  }
  return {
      {CylinderShape{radius, length}},
      cylinderMassProperties(checkedVolume(cylinderVolume(radius, length), round), radius, length)};
}

/// A part and its mass properties in the hull frame.
std::pair<PartScenario, MassProperties> parsePart(const ConfigReader& reader,
                                                  const ScenarioSource& source) {
  reader.allowOnly(
      {"box", "cylinder", "cone", "sphere", "mesh", "mass", "density", "position", "rpy"});
  int shapes = 0;
  for (const char* key : {"box", "cylinder", "cone", "sphere", "mesh"}) {
    if (reader.has(key)) ++shapes;
  }
  if (shapes != 1) reader.fail("", "must have one of box, cylinder, cone, sphere, mesh");
  if (reader.has("mass") == reader.has("density")) {
    reader.fail("", "must have either mass or density");
  }
  ParsedPart parsed = parseShape(reader, source);
  PartScenario& part = parsed.part;
  part.mass = reader.has("mass") ? reader.number("mass", kPositive)
                                 : reader.number("density", kPositive) * parsed.unit.mass;
  if (!isPositiveAndFinite(part.mass)) {
    reader.fail("density", "makes a mass that is not positive and finite");
  }
  const std::string hint = scaleHint(parsed.unit.mass, part.mass);
  if (source.note && !hint.empty() && std::holds_alternative<MeshShape>(part.shape)) {
    source.note(reader.where("mesh") + ": " + hint);
  }
  part.p_HP = reader.vectorOr(Vector3::Zero(), "position", kCoordinate);
  part.rpy = reader.vectorOr(Vector3::Zero(), "rpy");
  parsed.unit.I_BBo_B *= part.mass / parsed.unit.mass;
  parsed.unit.mass = part.mass;
  return {part, placed(parsed.unit, rotationFromRpy(part.rpy), part.p_HP)};
}

void parseMass(const ConfigReader& reader, const ScenarioSource& source, VehicleScenario& vehicle) {
  if (reader.has("parts")) {
    for (const char* key : {"mass", "inertia", "center_of_mass"}) {
      if (reader.has(key)) reader.fail(key, "must not stand beside parts, which determine it");
    }
    std::vector<MassProperties> placed_parts;
    for (const ConfigReader& part : reader.list("parts")) {
      auto [description, properties] = parsePart(part, source);
      vehicle.parts.push_back(std::move(description));
      placed_parts.push_back(properties);
    }
    vehicle.mass_properties = composed(placed_parts);
    checkInertia(vehicle.mass_properties.I_BBo_B, reader.where("parts"));
    return;
  }
  vehicle.mass_properties.mass = reader.number("mass", kPositive);
  vehicle.mass_properties.p_HB = reader.vectorOr(Vector3::Zero(), "center_of_mass", kCoordinate);
  vehicle.mass_properties.I_BBo_B = parseInertia(reader);
  checkInertia(vehicle.mass_properties.I_BBo_B, reader.where("inertia"));
}

void parseInitial(const ConfigReader& reader, BodyModel model, VehicleScenario& vehicle) {
  parseKeys(reader, kInitialKeys, vehicle);
  if (model != BodyModel::kPlanar) return;
  const char* rule = "does not fit model: planar, which moves in x, y and yaw only";
  if (vehicle.initial_rpy.x() != 0.0 || vehicle.initial_rpy.y() != 0.0) reader.fail("rpy", rule);
  if (vehicle.initial_v_WB.z() != 0.0) reader.fail("velocity", rule);
  if (vehicle.initial_w_WB.x() != 0.0 || vehicle.initial_w_WB.y() != 0.0) {
    reader.fail("angular_velocity", rule);
  }
}

}  // namespace

VehicleScenario parseMovingBody(const std::string& name, const ConfigReader& reader,
                                const ScenarioSource& source, BodyModel model) {
  if (!isGraphName(name)) {
    reader.fail("", "the name of a vehicle is a ROS name: a letter, then letters, digits and _");
  }
  VehicleScenario vehicle;
  vehicle.name = name;
  parseMass(reader, source, vehicle);
  vehicle.visual = parseVisual(reader, source);
  if (reader.has("drag")) parseDrag(reader.map("drag"), vehicle);
  if (reader.has("initial")) parseInitial(reader.map("initial"), model, vehicle);
  return vehicle;
}

namespace {

VehicleScenario parseVehicle(const std::string& name, const ConfigReader& reader,
                             const ScenarioSource& source, BodyModel model) {
  reader.allowOnly({"mass", "inertia", "center_of_mass", "parts", "engines", "actuators", "drag",
                    "hull", "material", "visual", "initial", "cushion", "sensors", "tf"});
  VehicleScenario vehicle = parseMovingBody(name, reader, source, model);
  parseEngines(reader, vehicle);
  if (reader.has("actuators")) vehicle.actuators = parseActuators(reader.map("actuators"));
  vehicle.cushion = parseCushion(reader, vehicle.actuators);
  return vehicle;
}

/// A text that toYaml() wrote says by which equations its bits were computed.
void checkPhysicsVersion(const ConfigReader& reader, bool may_be_older) {
  if (!reader.has("physics_version")) return;
  const std::int64_t version = reader.wholeNumberOr(0, "physics_version");
  if (version == kPhysicsVersion) return;
  if (may_be_older && version > 0 && version < kPhysicsVersion) return;
  reader.fail("physics_version", fmt::format("must be {}, that of this build: with another one the "
                                             "same scenario gives other bits",
                                             kPhysicsVersion));
}

/// The tree with its fleets written out.
ConfigNode withFleets(const ConfigNode& tree, const ScenarioSource& source, BodyModel model) {
  ScenarioSource silent = source;  // the craft written out say what there is to know
  silent.note = nullptr;
  const auto check = [&](const ConfigReader& craft) {
    parseVehicle("craft", craft, silent, model);
  };
  ConfigNode::Map members = tree.members();
  for (auto& [key, value] : members) {
    if (key == "vehicles") value = withFleetsWrittenOut(value, source.name, check);
  }
  return ConfigNode::ofMap(std::move(members));
}

/// What is to be known of each craft of a fleet is said of its first one.
ScenarioSource notingOneOfEachFleet(const ScenarioSource& source, const ConfigNode& vehicles) {
  ScenarioSource result = source;
  if (!source.note) return result;
  result.note = [note = source.note, begin = source.name + ": vehicles.",
                 vehicles](const std::string& text) {
    const bool is_of_craft = text.compare(0, begin.size(), begin) == 0;
    const std::size_t end = is_of_craft ? text.find_first_of(". ", begin.size()) : begin.size();
    const std::string name = text.substr(begin.size(), end - begin.size());
    if (!is_of_craft || !isLaterOfFleet(vehicles, name)) note(text);
  };
  return result;
}

}  // namespace

std::int64_t physicsVersionOf(const std::string& text, const std::string& source) {
  const ConfigNode tree = treeOf(text, source);
  return ConfigReader(tree, source).wholeNumberOr(1, "physics_version");
}

Scenario parseScenario(const ConfigNode& tree, const ScenarioSource& source) {
  const FloatingPointEnvironment environment;
  const ConfigReader written(tree, source.name);
  Scenario scenario;
  written.allowOnly(together({{"physics_version", "software"},
                              keyNames(kRunKeys, scenario),
                              {"gusts"},
                              keyNames(kSeedKeys, scenario),
                              {"vehicles", "world", "ground"}}));
  checkPhysicsVersion(written, source.may_be_older);
  if (written.has("software")) (void)written.text("software");  // whatever wrote it
  readKeys(written, kRunKeys, scenario);
  parseAir(written, scenario);
  readKeys(written, kSeedKeys, scenario);
  written.map("vehicles");  // is there
  const ConfigReader reader(withFleets(tree, source, scenario.model), source.name);
  const ScenarioSource told = notingOneOfEachFleet(source, *tree.find("vehicles"));
  for (const auto& [name, vehicle] : reader.map("vehicles").maps()) {
    scenario.vehicles.push_back(parseVehicle(name, vehicle, told, scenario.model));
  }
  if (scenario.vehicles.empty()) reader.fail("vehicles", "must name at least one vehicle");
  scenario.ground = parseGround(reader, told);
  parseWorld(reader, told, scenario);
  checkCushions(reader, told, scenario);
  checkCommandTopics(reader, scenario);
  parseSensors(reader, scenario);
  return scenario;
}

Scenario parseScenario(const std::string& text, const ScenarioSource& source,
                       const OverrideList& overrides) {
  ScenarioSource changed = source;
  changed.name = sourceWith(source.name, overrides);
  return parseScenario(withOverrides(treeOf(text, source.name), overrides), changed);
}

Scenario loadScenario(const std::string& path,
                      std::function<std::string(const std::string&)> package_folder,
                      const OverrideList& overrides, std::function<void(const std::string&)> note) {
  std::error_code unreadable;
  if (!std::filesystem::exists(path, unreadable)) {
    throw std::invalid_argument(path + ": there is no such file");
  }
  const std::string text = readWholeFile(path, kLongestYamlText);
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  return parseScenario(text, {path, folder.string(), std::move(package_folder), std::move(note)},
                       overrides);
}

}  // namespace hovercraft
