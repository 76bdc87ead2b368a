#include "hovercraft_sim/scenario/mesh_parser.h"

#include <filesystem>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>
#include <vector>

#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

// The largest hovercraft (Zubr class) is 57 m long, 25 m wide, 22 m high and weighs 555 t.
constexpr double kMostVolume = 1e5;  // m³
constexpr double kMostMass = 1e6;    // kg
/// A cube of 1 mm.
constexpr double kLeastVolume = 1e-9;  // m³
/// A tenth of the density of air, and somewhat more than that of osmium.
constexpr double kLeastDensity = 0.1;  // kg/m³
constexpr double kMostDensity = 3e4;   // kg/m³

/// The path that a text behind `key` names, without regard to whether it is there.
std::string resolvedPath(const ConfigReader& reader, const char* key,
                         const ScenarioSource& source) {
  std::string file = reader.text(key);
  if (std::filesystem::path(file).is_absolute()) return file;
  if (source.directory.empty()) {
    reader.fail(key,
                "is relative to no folder: must be a package:// URL or an absolute path (or, for a "
                "node, give its parameter scenario_dir)");
  }
  return (std::filesystem::path(source.directory) / file).lexically_normal().string();
}

Vector3 scaleOf(const ConfigReader& reader) {
  return reader.has("scale") ? reader.numberOrVector("scale", kPositive) : Vector3::Ones();
}

void passOn(const std::vector<std::string>& notes, const ScenarioSource& source) {
  if (!source.note) return;
  for (const std::string& note : notes) source.note(source.name + ": " + note);
}

/// A URL for RViz: a path becomes file://.
std::string resourceOf(const ConfigReader& reader, const char* key, const ScenarioSource& source) {
  std::string file = reader.text(key);
  if (file.find("://") != std::string::npos) return file;
  return "file://" + resolvedPath(reader, key, source);
}

}  // namespace

std::string filePath(const ConfigReader& reader, const ScenarioSource& source) {
  const std::string file = reader.text("file");
  const std::string scheme = "package://";
  if (file.rfind(scheme, 0) != 0) return resolvedPath(reader, "file", source);
  const std::size_t slash = file.find('/', scheme.size());
  if (slash == std::string::npos) reader.fail("file", "must be package://PACKAGE/PATH");
  const std::string package = file.substr(scheme.size(), slash - scheme.size());
  const std::string folder = source.package_folder ? source.package_folder(package) : "";
  if (folder.empty()) reader.fail("file", fmt::format("there is no ROS package {}", package));
  return folder + file.substr(slash);
}

MeshShape parseMesh(const ConfigReader& reader, const ScenarioSource& source) {
  reader.allowOnly({"file", "scale"});
  return {filePath(reader, source), scaleOf(reader)};
}

PolygonMesh loadedBody(const ConfigReader& reader, const MeshShape& shape,
                       const ScenarioSource& source) {
  try {
    LoadedMesh loaded = loadClosedMesh(shape.file, shape.scale);
    passOn(loaded.notes, source);
    return std::move(loaded.mesh);
  } catch (const std::invalid_argument& error) {
    reader.fail("file", error.what());
  }
}

PointsShape loadedHull(const ConfigReader& reader, const MeshShape& shape,
                       const ScenarioSource& source) {
  try {
    const LoadedMesh loaded = loadSurface(shape.file, shape.scale);
    passOn(loaded.notes, source);
    return {polyhedronFromMesh(loaded.mesh, NonConvexMesh::kTakeHull, shape.file).vertices()};
  } catch (const std::invalid_argument& error) {
    reader.fail("file", error.what());
  }
}

std::optional<VisualScenario> parseVisual(const ConfigReader& reader,
                                          const ScenarioSource& source) {
  if (!reader.has("visual")) return std::nullopt;
  VisualScenario visual;
  if (!reader.isMap("visual")) {
    visual.resource = resourceOf(reader, "visual", source);
    return visual;
  }
  const ConfigReader map = reader.map("visual");
  map.allowOnly({"file", "scale", "position", "rpy"});
  visual.resource = resourceOf(map, "file", source);
  visual.scale = scaleOf(map);
  visual.p_HV = map.vectorOr(Vector3::Zero(), "position", kCoordinate);
  visual.rpy = map.vectorOr(Vector3::Zero(), "rpy");
  return visual;
}

std::string visualText(const VisualScenario& visual) {
  return fmt::format("visual: {{file: {}, scale: {}, position: {}, rpy: {}}}",
                     yamlText(visual.resource), yamlVector(visual.scale), yamlVector(visual.p_HV),
                     yamlVector(visual.rpy));
}

std::string scaleHint(double volume, double mass) {
  const double density = mass / volume;
  const bool is_large = volume > kMostVolume || mass > kMostMass || density < kLeastDensity;
  const bool is_small = volume < kLeastVolume || density > kMostDensity;
  if (!is_large && !is_small) return "";
  return fmt::format("encloses {:.3g} m^3 and weighs {:.3g} kg, which no craft does: {}", volume,
                     mass,
                     is_large ? "is the file in millimetres? Then take the scale 0.001"
                              : "is its scale right, and the file not in metres already?");
}

}  // namespace hovercraft
