#include "hovercraft_sim/analysis/mass_report.h"

#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>
#include <variant>

#include "hovercraft_sim/geometry/mesh_file.h"
#include "hovercraft_sim/geometry/volume_moments.h"
#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/mesh_parser.h"

namespace hovercraft {
namespace {

struct VolumeOfShape {
  double operator()(const BoxShape& box) const { return boxVolume(box.size); }
  double operator()(const CylinderShape& cylinder) const {
    return cylinderVolume(cylinder.radius, cylinder.length);
  }
  double operator()(const ConeShape& cone) const { return coneVolume(cone.radius, cone.length); }
  double operator()(const SphereShape& sphere) const { return sphereVolume(sphere.radius); }
  double operator()(const MeshShape& mesh) const {
    return volumeMoments(loadClosedMesh(mesh.file, mesh.scale).mesh).volume;
  }
};

BodyReport reportOn(const VehicleScenario& vehicle) {
  BodyReport report{vehicle.name, vehicle.mass_properties, std::nullopt};
  if (vehicle.parts.empty()) return report;
  double volume = 0.0;
  for (const PartScenario& part : vehicle.parts) volume += std::visit(VolumeOfShape{}, part.shape);
  report.volume = volume;
  return report;
}

std::vector<BodyReport> vehiclesOf(const MassReportRequest& request, const Scenario& scenario) {
  std::vector<BodyReport> reports;
  std::string names;
  for (const VehicleScenario& vehicle : scenario.vehicles) {
    names += (names.empty() ? "" : ", ") + vehicle.name;
    if (!request.vehicle.empty() && vehicle.name != request.vehicle) continue;
    reports.push_back(reportOn(vehicle));
  }
  if (reports.empty()) {
    throw std::invalid_argument(fmt::format("--vehicle {}: {} has no such vehicle; it has {}",
                                            request.vehicle, request.file, names));
  }
  return reports;
}

BodyReport reportOnMesh(const MassReportRequest& request) {
  LoadedMesh loaded = loadClosedMesh(request.file, request.scale.value_or(Vector3::Ones()));
  const PolygonMesh& mesh = loaded.mesh;
  BodyReport report;
  report.properties = request.mass
                          ? meshMassProperties(mesh, *request.mass)
                          : meshMassPropertiesOfDensity(mesh, request.density.value_or(1.0));
  report.volume = volumeMoments(mesh).volume;
  checkInertia(report.properties.I_BBo_B, request.file + ": inertia");
  report.notes = std::move(loaded.notes);
  const std::string hint = scaleHint(*report.volume, report.properties.mass);
  if (!hint.empty()) report.notes.push_back("mesh file '" + request.file + "': " + hint);
  return report;
}

/// A number for JSON. Adding 0 turns -0 into 0.
std::string exact(double number) {
  return numberText(number + 0.0);
}

std::string jsonOf(const Vector3& v) {
  return fmt::format("[{}, {}, {}]", exact(v.x()), exact(v.y()), exact(v.z()));
}

/// Rows of a matrix, or columns of its transpose.
std::string jsonOfRows(const Matrix3& rows) {
  return fmt::format("[{}, {}, {}]", jsonOf(rows.row(0)), jsonOf(rows.row(1)), jsonOf(rows.row(2)));
}

std::string jsonOf(const BodyReport& body) {
  const PrincipalInertia principal = principalInertia(body.properties.I_BBo_B);
  const std::string vehicle =
      body.vehicle.empty() ? "" : fmt::format("\"vehicle\": \"{}\", ", body.vehicle);
  return fmt::format(
      "{{{}\"mass\": {}, \"volume\": {}, \"center_of_mass\": {}, \"inertia\": {}, "
      "\"principal_moments\": {}, \"principal_axes\": {}}}",
      vehicle, exact(body.properties.mass), body.volume ? exact(*body.volume) : "null",
      jsonOf(body.properties.p_HB), jsonOfRows(body.properties.I_BBo_B), jsonOf(principal.moments),
      jsonOfRows(principal.axes.transpose()));
}

std::string alignedColumns(const Vector3& v) {
  return fmt::format("{:>16.9g}{:>16.9g}{:>16.9g}", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

/// Rows of a matrix below each other, each behind a name and before a remark.
std::string lines(const std::array<std::string, 3>& names, const Matrix3& rows,
                  const std::string& remark) {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 row = rows.row(static_cast<Eigen::Index>(i));
    text += fmt::format("  {:<18}{}{}\n", names[i], alignedColumns(row), remark);
  }
  return text;
}

std::string textOf(const BodyReport& body) {
  const PrincipalInertia principal = principalInertia(body.properties.I_BBo_B);
  std::string text = body.vehicle.empty() ? "" : "vehicle " + body.vehicle + "\n";
  text += fmt::format("  {:<18}{:>16.9g} kg\n", "mass", body.properties.mass);
  text += body.volume
              ? fmt::format("  {:<18}{:>16.9g} m^3\n", "volume", *body.volume)
              : fmt::format("  {:<18}{:>16}, as mass and inertia are given\n", "volume", "unknown");
  text += fmt::format("  {:<18}{} m\n", "center_of_mass", alignedColumns(body.properties.p_HB));
  text += lines({"inertia", "", ""}, body.properties.I_BBo_B, " kg m^2");
  text +=
      fmt::format("  {:<18}{} kg m^2\n", "principal_moments", alignedColumns(principal.moments));
  text += lines({"principal_axes", "", ""}, principal.axes.transpose(), "");
  return text;
}

}  // namespace

std::vector<BodyReport> bodiesOf(
    const MassReportRequest& request,
    const std::function<Scenario(const std::string& path)>& load_scenario) {
  const FloatingPointEnvironment environment;
  if (request.density && request.mass) {
    throw std::invalid_argument("--density and --mass: only one of them can be given");
  }
  const std::string extension = std::filesystem::path(request.file).extension().string();
  if (extension == ".yaml" || extension == ".yml") {
    if (request.density || request.mass) {
      throw std::invalid_argument(
          fmt::format("--{}: is for a mesh; the vehicles of {} have their own mass",
                      request.density ? "density" : "mass", request.file));
    }
    if (request.scale) {
      throw std::invalid_argument(
          fmt::format("--scale: is for a mesh; in {} a mesh has a scale of its own", request.file));
    }
    return vehiclesOf(request, load_scenario(request.file));
  }
  if (!request.vehicle.empty()) {
    throw std::invalid_argument(
        fmt::format("--vehicle {}: is for a scenario (.yaml or .yml), but {} is a mesh",
                    request.vehicle, request.file));
  }
  return {reportOnMesh(request)};
}

std::string toText(const std::vector<BodyReport>& bodies) {
  const FloatingPointEnvironment environment;
  std::string text;
  for (const BodyReport& body : bodies) text += (text.empty() ? "" : "\n") + textOf(body);
  return text;
}

std::string toJson(const std::vector<BodyReport>& bodies) {
  const FloatingPointEnvironment environment;
  if (bodies.size() == 1) return jsonOf(bodies.front()) + "\n";
  std::string members;
  for (const BodyReport& body : bodies) {
    members +=
        fmt::format("{}\"{}\": {}", members.empty() ? "" : ",\n", body.vehicle, jsonOf(body));
  }
  return "{\"vehicles\": {\n" + members + "}}\n";
}

}  // namespace hovercraft
