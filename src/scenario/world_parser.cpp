#include "hovercraft_sim/scenario/world_parser.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/math/contact_tolerances.h"
#include "hovercraft_sim/scenario/mesh_parser.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/wall.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/scenario/world_keys.h"

namespace hovercraft {
namespace {

std::vector<std::string> namesOf(const std::vector<MaterialScenario>& materials) {
  std::vector<std::string> names;
  names.reserve(materials.size());
  for (const MaterialScenario& material : materials) names.push_back(material.name);
  return names;
}

void parseMaterials(const ConfigReader& reader, WorldScenario& world) {
  if (reader.has("materials")) {
    for (const auto& [name, material] : reader.map("materials").maps()) {
      ContactMaterial surface;
      parseKeys(material, kMaterialKeys, surface);
      if (name == "default") {
        world.materials[0].surface = surface;
      } else {
        world.materials.push_back({name, surface});
      }
    }
  }
  if (!reader.has("material_pairs")) return;
  const std::vector<std::string> names = namesOf(world.materials);
  for (const ConfigReader& pair : reader.list("material_pairs")) {
    MaterialPairScenario law;
    pair.allowOnly(together({{"first", "second"}, keyNames(kMaterialKeys, law.law)}));
    ChoiceKey("first", names).read(pair, "first", law.first);
    ChoiceKey("second", names).read(pair, "second", law.second);
    readKeys(pair, kMaterialKeys, law.law);
    for (const MaterialPairScenario& known : world.material_pairs) {
      if (std::minmax(known.first, known.second) != std::minmax(law.first, law.second)) continue;
      pair.fail("",
                fmt::format("{} and {} have a law already", names[law.first], names[law.second]));
    }
    world.material_pairs.push_back(law);
  }
}

PointsShape parsePoints(const ConfigReader& reader) {
  PointsShape shape;
  for (const ConfigReader& point : reader.list("points")) {
    point.allowOnly({"p"});
    shape.points.push_back(point.vector("p", kCoordinate));
  }
  return shape;
}

/// One of box, cylinder, sphere, mesh, points of a map, and where it is.
HullScenario parseHull(const ConfigReader& reader, const ScenarioSource& source) {
  int shapes = 0;
  for (const char* key : {"box", "cylinder", "sphere", "mesh", "points"}) {
    if (reader.has(key)) ++shapes;
  }
  if (shapes != 1) reader.fail("", "must have one of box, cylinder, sphere, mesh, points");
  HullScenario hull;
  if (reader.has("box")) {
    const ConfigReader box = reader.map("box");
    box.allowOnly({"size"});
    hull.shape = BoxShape{box.lengths("size")};
  } else if (reader.has("sphere")) {
    const ConfigReader sphere = reader.map("sphere");
    sphere.allowOnly({"radius"});
    hull.shape = SphereShape{sphere.length("radius")};
  } else if (reader.has("cylinder")) {
    const ConfigReader cylinder = reader.map("cylinder");
    cylinder.allowOnly({"radius", "length"});
    hull.shape = CylinderShape{cylinder.length("radius"), cylinder.length("length")};
  } else if (reader.has("mesh")) {
    const ConfigReader mesh = reader.map("mesh");
    hull.shape = loadedHull(mesh, parseMesh(mesh, source), source);
  } else {
    hull.shape = parsePoints(reader);
  }
  hull.p_HS = reader.vectorOr(Vector3::Zero(), "position", kCoordinate);
  hull.rpy = reader.vectorOr(Vector3::Zero(), "rpy");
  try {
    convexHull(hullPoints(hull), "hull");
  } catch (const std::invalid_argument& error) {
    reader.fail("", error.what());
  }
  return hull;
}

/// The hull of a craft or a loose body. @param is_needed by others that it meets.
void parseHullOf(const ConfigReader& reader, const ScenarioSource& source, bool is_needed,
                 VehicleScenario& body) {
  if (reader.has("hull")) {
    const ConfigReader hull = reader.map("hull");
    hull.allowOnly({"box", "cylinder", "sphere", "mesh", "points", "position", "rpy"});
    body.hull = parseHull(hull, source);
    return;
  }
  if (body.parts.empty() && is_needed) {
    reader.fail("hull", "is missing: in a scenario with a world a body has parts or a hull");
  }
  const bool has_mesh = std::any_of(body.parts.begin(), body.parts.end(), [](const auto& part) {
    return std::holds_alternative<MeshShape>(part.shape);
  });
  if (!has_mesh) return;
  // Like its mass, the hull of a mesh is written by numbers, so that the text needs no other file.
  HullScenario hull;
  hull.shape = PointsShape{convexHull(partPoints(body.parts), reader.where("parts")).vertices()};
  body.hull = hull;
}

/// Hull and material of a craft or a loose body.
void parseSurfaceOf(const ConfigReader& reader, const ScenarioSource& source,
                    const WorldScenario& world, VehicleScenario& body) {
  body.material = reader.choiceOr(0, "material", namesOf(world.materials));
  parseHullOf(reader, source, true, body);
}

void requireName(const ConfigReader& reader, const std::string& name) {
  if (!isGraphName(name)) {
    reader.fail("", "a name is a ROS name: a letter, then letters, digits and _");
  }
}

void checkNames(const ConfigReader& reader, const Scenario& scenario) {
  std::vector<std::string> names = vehicleNames(scenario);
  for (const VehicleScenario& body : scenario.world->bodies) names.push_back(body.name);
  for (const ObstacleScenario& obstacle : scenario.world->obstacles) names.push_back(obstacle.name);
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice != names.end()) {
    reader.fail("", fmt::format("duplicate name {} among vehicles, bodies and obstacles", *twice));
  }
}

void checkTolerance(const ConfigReader& reader, const World& world) {
  double size = 0.0;
  for (const WorldBody& body : world.scene().bodies())
    size = std::max(size, body.hull->data().radius);
  for (const WorldObstacle& obstacle : world.scene().obstacles()) {
    size = std::max(size, obstacle.hull.data().radius);
  }
  if (world.scene().config().tolerance >= kLeastTolerance * size) return;
  reader.fail("tolerance", fmt::format("must be at least {:.3g} m, {:.0e} of the largest body",
                                       kLeastTolerance * size, kLeastTolerance));
}

void checkMasses(const ConfigReader& reader, const World& world) {
  const std::vector<WorldBody>& bodies = world.scene().bodies();
  const auto mass_of = [](const WorldBody& body) {
    return 1.0 / body.model.mobility.inverseMass().x();
  };
  const auto [least, most] = std::minmax_element(
      bodies.begin(), bodies.end(),
      [&](const WorldBody& a, const WorldBody& b) { return mass_of(a) < mass_of(b); });
  if (mass_of(*most) <= kMostMassRatio * mass_of(*least)) return;
  reader.fail(
      "", fmt::format("{} has {:.3g} kg and {} {:.3g} kg: masses of bodies that can meet "
                      "must be within a factor of {:.0f}",
                      least->name, mass_of(*least), most->name, mass_of(*most), kMostMassRatio));
}

void checkStart(const ConfigReader& reader, const Scenario& scenario) {
  const World world = worldOf(scenario);
  checkTolerance(reader, world);
  checkMasses(reader, world);
  std::vector<BodyState> states;
  for (const auto* list : {&scenario.vehicles, &scenario.world->bodies}) {
    for (const VehicleScenario& body : *list) {
      states.push_back(initialState(scenario, body, modelOf(scenario, body).mobility));
    }
  }
  if (const auto overlap = world.overlap(states)) {
    reader.fail(
        "", fmt::format("{} and {} overlap at the start by {:.3g} m: must be at most the "
                        "tolerance, {:.3g} m",
                        overlap->a, overlap->b, overlap->depth, world.scene().config().tolerance));
  }
  world.separateTouching(states);
  if (const auto too_close = world.tooClose(states)) {
    reader.fail("", fmt::format("{} and {} touch at the start and cannot be parted: others are in "
                                "the way",
                                too_close->a, too_close->b));
  }
}

struct HullWriter {
  std::string operator()(const BoxShape& box) const {
    return fmt::format("box: {{size: {}}}", yamlVector(box.size));
  }
  std::string operator()(const SphereShape& sphere) const {
    return fmt::format("sphere: {{radius: {}}}", yamlNumber(sphere.radius));
  }
  std::string operator()(const CylinderShape& cylinder) const {
    return fmt::format("cylinder: {{radius: {}, length: {}}}", yamlNumber(cylinder.radius),
                       yamlNumber(cylinder.length));
  }
  std::string operator()(const PointsShape& cloud) const {
    std::string text = "points: [";
    for (const Vector3& p : cloud.points) {
      text += fmt::format("{}{{p: {}}}", text.back() == '[' ? "" : ", ", yamlVector(p));
    }
    return text + "]";
  }
};

std::string hullText(const HullScenario& hull) {
  return fmt::format("{}, position: {}, rpy: {}", std::visit(HullWriter(), hull.shape),
                     yamlVector(hull.p_HS), yamlVector(hull.rpy));
}

std::string shapeText(const ObstacleScenario& obstacle) {
  if (!obstacle.wall) return hullText(obstacle.hull);
  return fmt::format("{}, position: {}, rpy: {}", wallText(*obstacle.wall),
                     yamlVector(obstacle.hull.p_HS), yamlVector(obstacle.hull.rpy));
}

}  // namespace

namespace {

/// Without a world there are no materials, and hulls only where they stand on a ground.
void parseHullsAlone(const ConfigReader& vehicles, const ScenarioSource& source,
                     Scenario& scenario) {
  for (VehicleScenario& vehicle : scenario.vehicles) {
    const ConfigReader reader = vehicles.map(vehicle.name);
    if (reader.has("material")) reader.fail("material", "needs a world: in the scenario");
    if (scenario.ground) {
      parseHullOf(reader, source, false, vehicle);
    } else if (reader.has("hull")) {
      reader.fail("hull", "needs a world: or a ground: in the scenario");
    }
  }
}

ObstacleScenario parseObstacle(const std::string& name, const ConfigReader& reader,
                               const ScenarioSource& source, const WorldScenario& world) {
  ObstacleScenario obstacle;
  obstacle.name = name;
  obstacle.material = reader.choiceOr(0, "material", namesOf(world.materials));
  obstacle.visual = parseVisual(reader, source);
  if (!reader.has("wall")) {
    obstacle.hull = parseHull(reader, source);
    return obstacle;
  }
  for (const char* key : {"box", "cylinder", "sphere", "mesh", "points"}) {
    if (reader.has(key)) reader.fail(key, "must not stand beside a wall");
  }
  obstacle.wall = parseWall(reader.map("wall"));
  obstacle.hull.p_HS = reader.vectorOr(Vector3::Zero(), "position", kCoordinate);
  obstacle.hull.rpy = reader.vectorOr(Vector3::Zero(), "rpy");
  try {
    for (const HullScenario& piece : piecesOf(obstacle)) convexHull(hullPoints(piece), "wall");
  } catch (const std::invalid_argument& error) {
    reader.fail("wall", error.what());
  }
  return obstacle;
}

void parseObstacles(const ConfigReader& obstacles, const ScenarioSource& source,
                    WorldScenario& world) {
  for (const auto& [name, obstacle] : obstacles.maps()) {
    requireName(obstacle, name);
    obstacle.allowOnly({"box", "cylinder", "sphere", "mesh", "points", "wall", "position", "rpy",
                        "material", "visual"});
    world.obstacles.push_back(parseObstacle(name, obstacle, source, world));
  }
}

void parseBodies(const ConfigReader& bodies, const ScenarioSource& source, BodyModel model,
                 WorldScenario& world) {
  for (const auto& [name, body] : bodies.maps()) {
    body.allowOnly({"mass", "inertia", "center_of_mass", "parts", "drag", "hull", "material",
                    "visual", "initial"});
    world.bodies.push_back(parseMovingBody(name, body, source, model));
    parseSurfaceOf(body, source, world, world.bodies.back());
  }
}

}  // namespace

void parseWorld(const ConfigReader& top, const ScenarioSource& source, Scenario& scenario) {
  const ConfigReader vehicles = top.map("vehicles");
  if (!top.has("world")) {
    parseHullsAlone(vehicles, source, scenario);
    return;
  }
  const ConfigReader reader = top.map("world");
  WorldScenario& world = scenario.world.emplace();
  reader.allowOnly(together(
      {keyNames(kWorldKeys, world), {"materials", "material_pairs", "obstacles", "bodies"}}));
  readKeys(reader, kWorldKeys, world);
  parseMaterials(reader, world);
  for (VehicleScenario& vehicle : scenario.vehicles) {
    parseSurfaceOf(vehicles.map(vehicle.name), source, world, vehicle);
  }
  if (reader.has("obstacles")) parseObstacles(reader.map("obstacles"), source, world);
  if (reader.has("bodies")) parseBodies(reader.map("bodies"), source, scenario.model, world);
  checkNames(reader, scenario);
  checkStart(reader, scenario);
}

std::string surfaceYaml(const VehicleScenario& vehicle, const Scenario& scenario) {
  std::string yaml;
  if (scenario.world) {
    yaml = fmt::format("    material: {}\n",
                       yamlText(scenario.world->materials[vehicle.material].name));
  }
  if (vehicle.hull) yaml += fmt::format("    hull: {{{}}}\n", hullText(*vehicle.hull));
  return yaml;
}

std::string worldYaml(const Scenario& scenario) {
  if (!scenario.world) return "";
  const WorldScenario& world = *scenario.world;
  std::string yaml = "world:\n" + keysText(kWorldKeys, world, "  ", "\n") + "\n  materials:\n";
  for (const MaterialScenario& material : world.materials) {
    yaml += fmt::format("    {}: {{{}}}\n", yamlText(material.name),
                        keysText(kMaterialKeys, material.surface));
  }
  if (!world.material_pairs.empty()) yaml += "  material_pairs:\n";
  for (const MaterialPairScenario& pair : world.material_pairs) {
    yaml += fmt::format(
        "    - {{first: {}, second: {}, {}}}\n", yamlText(world.materials[pair.first].name),
        yamlText(world.materials[pair.second].name), keysText(kMaterialKeys, pair.law));
  }
  if (!world.obstacles.empty()) yaml += "  obstacles:\n";
  for (const ObstacleScenario& obstacle : world.obstacles) {
    yaml += fmt::format("    {}: {{{}, material: {}{}}}\n", yamlText(obstacle.name),
                        shapeText(obstacle), yamlText(world.materials[obstacle.material].name),
                        obstacle.visual ? ", " + visualText(*obstacle.visual) : "");
  }
  return yaml;
}

}  // namespace hovercraft
