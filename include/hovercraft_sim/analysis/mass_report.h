#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hovercraft_sim/body/mass_properties.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft {

/// The mass properties of one body, as the tool `mass_properties` shows them.
struct BodyReport {
  std::string vehicle;                  // its name; empty for a mesh file
  MassProperties properties;            // H: the hull frame, or the frame of the mesh file
  std::optional<double> volume;         // m³; unknown where mass and inertia were given by hand
  std::vector<std::string> notes = {};  // what the user should know of a mesh file
};

/// What the tool `mass_properties` was asked for.
struct MassReportRequest {
  std::string file;               // a scenario if it ends in .yaml or .yml, else a mesh
  std::optional<double> density;  // kg/m³, of a mesh; 1 if neither this nor the mass is given
  std::optional<double> mass;     // kg, of a mesh
  std::optional<Vector3> scale;   // of the coordinates of a mesh to m; 1 if it is not given
  std::string vehicle;            // of a scenario; empty: every one
  bool json = false;
};

/// The bodies of the file that the request names: a mesh, or vehicles in the scenario's order.
/// @param load_scenario reads a scenario file.
/// @throws std::invalid_argument for whatever in the request or its file is bad.
HOVERCRAFT_PUBLIC std::vector<BodyReport> bodiesOf(
    const MassReportRequest& request,
    const std::function<Scenario(const std::string& path)>& load_scenario);

/// Text for people: one paragraph for each body, 9 significant digits.
HOVERCRAFT_PUBLIC std::string toText(const std::vector<BodyReport>& bodies);

/// One JSON object, numbers as appendNumber(), ending in a line break. A single body is the object
/// itself: vehicle (of a scenario), mass, volume (null if unknown), center_of_mass, inertia (3 × 3,
/// about the centre of mass), principal_moments (ascending), principal_axes (one unit vector for
/// each moment; right-handed). Several are in {"vehicles": {NAME: object, ...}}.
HOVERCRAFT_PUBLIC std::string toJson(const std::vector<BodyReport>& bodies);

}  // namespace hovercraft
