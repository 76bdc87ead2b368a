#pragma once

#include <optional>
#include <string>

#include "hovercraft_sim/geometry/mesh_file.h"
#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/scenario_parser.h"

namespace hovercraft {

/// The absolute path that the key `file` of a map names: a path, or a package:// URL.
/// @throws std::invalid_argument
std::string filePath(const ConfigReader& reader, const ScenarioSource& source);

/// The `file` and `scale` of a map `mesh`, the file as an absolute path.
/// @throws std::invalid_argument
MeshShape parseMesh(const ConfigReader& reader, const ScenarioSource& source);

/// The closed mesh that such a map names, with its notes given to the source.
/// @throws std::invalid_argument naming the key `file`.
PolygonMesh loadedBody(const ConfigReader& reader, const MeshShape& shape,
                       const ScenarioSource& source);

/// The vertices of the convex hull of the mesh that such a map names, likewise; it need not be
/// closed.
PointsShape loadedHull(const ConfigReader& reader, const MeshShape& shape,
                       const ScenarioSource& source);

/// The mesh behind the key `visual`, a path or URL or a map of `file`, `scale`, `position`, `rpy`;
/// none if the key is missing. Whether it is there is for RViz to see.
/// @throws std::invalid_argument
[[nodiscard]] std::optional<VisualScenario> parseVisual(const ConfigReader& reader,
                                                        const ScenarioSource& source);

/// `key: value` of a visual, ready for a map of YAML; parseVisual() reads it back.
std::string visualText(const VisualScenario& visual);

/// A question for the user if the body in a mesh has a volume (m³) or a mass (kg) that no craft
/// has: its coordinates may not be metres. Empty otherwise.
std::string scaleHint(double volume, double mass);

}  // namespace hovercraft
