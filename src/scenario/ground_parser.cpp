#include "hovercraft_sim/scenario/ground_parser.h"

#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

#include "hovercraft_sim/io/base64.h"
#include "hovercraft_sim/io/grey_image.h"
#include "hovercraft_sim/io/input_file.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/scenario/ground_keys.h"
#include "hovercraft_sim/scenario/mesh_parser.h"

namespace hovercraft {
namespace {

PlaneScenario parsePlane(const ConfigReader& reader) {
  PlaneScenario plane;
  parseKeys(reader, kPlaneKeys, plane);
  if (std::abs(norm(plane.normal) - 1.0) > kUnitLength) {
    reader.fail("normal", fmt::format("must have length 1 (it has {:.6g})", norm(plane.normal)));
  }
  if (!(plane.normal.z() > 0.0)) reader.fail("normal", "must point up: z greater than 0");
  return plane;
}

/// The file that the map names, or what a text that needs no file has in its place.
std::string imageOf(const ConfigReader& reader, const ScenarioSource& source) {
  if (reader.has("file") == reader.has("data")) reader.fail("", "must have a file (or data)");
  if (reader.has("file")) {
    try {
      return readWholeFile(filePath(reader, source), kMostImageBytes);
    } catch (const std::invalid_argument& error) {
      reader.fail("file", error.what());
    }
  }
  const std::optional<std::string> bytes = base64Bytes(reader.text("data"));
  if (!bytes) reader.fail("data", "must be the bytes of an image in base64");
  return *bytes;
}

/// The image with its lowest row first, as y goes up: pixels are places, their heights in the
/// middle.
HeightGrid gridOf(const HeightMapScenario& map) {
  const GreyImage image = greyImageOf(map.image);
  HeightGrid grid;
  grid.columns = image.columns;
  grid.rows = image.rows;
  grid.spacing = map.resolution;
  grid.x = map.x + 0.5 * map.resolution;
  grid.y = map.y + 0.5 * map.resolution;
  grid.heights.reserve(image.pixels.size());
  for (std::size_t row = image.rows; row > 0; --row) {
    for (std::size_t column = 0; column < image.columns; ++column) {
      const double share = static_cast<double>(image.pixels[(row - 1) * image.columns + column]) /
                           static_cast<double>(image.most);
      grid.heights.push_back(map.z_min + share * (map.z_max - map.z_min));
    }
  }
  return grid;
}

HeightMapScenario parseHeightMap(const ConfigReader& reader, const ScenarioSource& source) {
  HeightMapScenario map;
  reader.allowOnly(together({{"file", "data"}, keyNames(kHeightMapKeys, map)}));
  readKeys(reader, kHeightMapKeys, map);
  if (!(map.z_max > map.z_min)) reader.fail("z_max", "must be greater than z_min");
  map.image = imageOf(reader, source);
  try {
    map.surface = std::make_shared<const HeightMapGround>(gridOf(map));
  } catch (const std::invalid_argument& error) {
    reader.fail(reader.has("file") ? "file" : "data", error.what());
  }
  return map;
}

struct SurfaceWriter {
  std::string operator()(const PlaneScenario& plane) const {
    return "  plane: {" + keysText(kPlaneKeys, plane) + "}\n";
  }
  std::string operator()(const HeightMapScenario& map) const {
    return fmt::format("  height_map: {{{}, data: \"{}\"}}\n", keysText(kHeightMapKeys, map),
                       base64Text(map.image));
  }
};

struct SurfaceMaker {
  std::shared_ptr<const Ground> operator()(const PlaneScenario& plane) const {
    const Vector3 nhat_W = plane.normal / norm(plane.normal);
    return std::make_shared<PlaneGround>(GroundPlane{nhat_W, nhat_W.z() * plane.height});
  }
  std::shared_ptr<const Ground> operator()(const HeightMapScenario& map) const {
    return map.surface;
  }
};

}  // namespace

std::optional<GroundScenario> parseGround(const ConfigReader& top, const ScenarioSource& source) {
  if (!top.has("ground")) return std::nullopt;
  const ConfigReader reader = top.map("ground");
  reader.allowOnly({"plane", "height_map", "pads"});
  if (reader.has("plane") == reader.has("height_map")) {
    reader.fail("", "must have either plane or height_map");
  }
  GroundScenario ground;
  if (reader.has("plane")) {
    ground.surface = parsePlane(reader.map("plane"));
  } else {
    ground.surface = parseHeightMap(reader.map("height_map"), source);
  }
  if (reader.has("pads")) parseKeys(reader.map("pads"), kPadKeys, ground.pads);
  return ground;
}

std::string groundYaml(const Scenario& scenario) {
  if (!scenario.ground) return "";
  return "ground:\n" + std::visit(SurfaceWriter(), scenario.ground->surface) + "  pads: {" +
         keysText(kPadKeys, scenario.ground->pads) + "}\n";
}

std::shared_ptr<const Ground> surfaceOf(const GroundScenario& ground) {
  return std::visit(SurfaceMaker(), ground.surface);
}

}  // namespace hovercraft
