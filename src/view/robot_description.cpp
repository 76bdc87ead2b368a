#include "hovercraft_sim/view/robot_description.h"

#include <cmath>
#include <fmt/format.h>
#include <variant>

#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/view/vehicle_markers.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Vector3;

constexpr double kLeastThickness = 0.02;  // m: a flat plate is still seen
constexpr double kFanDiameter = 0.14;     // m
constexpr double kFanLength = 0.08;       // m
constexpr double kHemBall = 0.05;         // radius, of the length of a square of the cell's area
constexpr int kConeSlices = 8;

std::string xmlText(const std::string& text) {
  std::string safe;
  for (const char character : text) {
    const bool is_special = character == '<' || character == '>' || character == '&' ||
                            character == '"' || character == '\'';
    safe += is_special ? fmt::format("&#{};", int{character}) : std::string(1, character);
  }
  return safe;
}

std::string numbersText(const Vector3& vector) {
  return fmt::format("{} {} {}", hovercraft::numberText(vector.x()),
                     hovercraft::numberText(vector.y()), hovercraft::numberText(vector.z()));
}

struct VisualPlace {
  Vector3 position = Vector3::Zero();  // m
  Vector3 rpy = Vector3::Zero();       // rad
};

std::string visualText(const VisualPlace& place, const std::string& geometry,
                       const char* material) {
  return fmt::format(
      "    <visual>\n      <origin xyz=\"{}\" rpy=\"{}\"/>\n      <geometry>{}</geometry>\n"
      "      <material name=\"{}\"/>\n    </visual>\n",
      numbersText(place.position), numbersText(place.rpy), geometry, material);
}

std::string boxText(const Vector3& size) {
  return fmt::format("<box size=\"{}\"/>", numbersText(size));
}
std::string cylinderText(double radius, double length) {
  return fmt::format("<cylinder radius=\"{}\" length=\"{}\"/>", hovercraft::numberText(radius),
                     hovercraft::numberText(length));
}
std::string sphereText(double radius) {
  return fmt::format("<sphere radius=\"{}\"/>", hovercraft::numberText(radius));
}
std::string meshText(const std::string& resource, const Vector3& scale) {
  return fmt::format("<mesh filename=\"{}\" scale=\"{}\"/>", xmlText(resource), numbersText(scale));
}

/// The visuals of a shape at a place.
struct ShapeWriter {
  VisualPlace place;

  std::string operator()(const hovercraft::BoxShape& box) const {
    return visualText(place, boxText(box.size), "hull");
  }
  std::string operator()(const hovercraft::CylinderShape& cylinder) const {
    return visualText(place, cylinderText(cylinder.radius, cylinder.length), "hull");
  }
  std::string operator()(const hovercraft::SphereShape& sphere) const {
    return visualText(place, sphereText(sphere.radius), "hull");
  }
  std::string operator()(const hovercraft::MeshShape& mesh) const {
    return visualText(place, meshText("file://" + mesh.file, mesh.scale), "hull");
  }
  std::string operator()(const hovercraft::ConeShape& cone) const {
    std::string stack;
    const hovercraft::Quaternion q_HP = hovercraft::quaternionFromRpy(place.rpy);
    const double height = cone.length / kConeSlices;
    for (int i = 0; i < kConeSlices; ++i) {
      const double middle = (i + 0.5) / kConeSlices;  // from the base, a share of the length
      VisualPlace slice = place;
      slice.position += rotate(q_HP, Vector3(0.0, 0.0, (middle - 0.5) * cone.length));
      stack += visualText(slice, cylinderText((1.0 - middle) * cone.radius, height), "hull");
    }
    return stack;
  }
};

std::string hullText(const hovercraft::VehicleScenario& craft) {
  if (craft.visual) {
    return visualText({craft.visual->p_HV, craft.visual->rpy},
                      meshText(craft.visual->resource, craft.visual->scale), "hull");
  }
  std::string text;
  for (const hovercraft::PartScenario& part : craft.parts) {
    text += std::visit(ShapeWriter{{part.p_HP, part.rpy}}, part.shape);
  }
  if (!text.empty()) return text;
  const Vector3 edges = equivalentBox(craft.mass_properties).cwiseMax(kLeastThickness);
  return visualText({craft.mass_properties.p_HB, Vector3::Zero()}, boxText(edges), "hull");
}

/// A cylinder of URDF lies along z: first about y, then about z.
std::string engineText(const hovercraft::EngineParameters& engine) {
  const Vector3& d = engine.direction;
  const VisualPlace place = {
      engine.p_HE, {0.0, std::atan2(std::hypot(d.x(), d.y()), d.z()), std::atan2(d.y(), d.x())}};
  return visualText(place, cylinderText(0.5 * kFanDiameter, kFanLength), "engine");
}

std::string skirtText(const hovercraft::CushionParameters& cushion) {
  std::string text;
  for (const hovercraft::CushionCell& cell : cushion.cells) {
    for (const hovercraft::HemPoint& point : cell.hem) {
      text += visualText({point.p_HK, Vector3::Zero()}, sphereText(kHemBall * std::sqrt(cell.area)),
                         "skirt");
    }
  }
  return text;
}

std::string inertialText(const hovercraft::MassProperties& body) {
  const auto entry = [&](int row, int column) {
    return hovercraft::numberText(body.I_BBo_B(row, column));
  };
  return fmt::format(
      "    <inertial>\n      <origin xyz=\"{}\" rpy=\"0 0 0\"/>\n      <mass value=\"{}\"/>\n"
      "      <inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" izz=\"{}\"/>\n"
      "    </inertial>\n",
      numbersText(body.p_HB), hovercraft::numberText(body.mass), entry(0, 0), entry(0, 1),
      entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2));
}

}  // namespace

std::string urdfOf(const hovercraft::VehicleScenario& craft, const TfFrames& frames) {
  std::string urdf = fmt::format(
      "<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n"
      "  <material name=\"hull\"><color rgba=\"0.2 0.45 0.75 1\"/></material>\n"
      "  <material name=\"engine\"><color rgba=\"0.25 0.25 0.28 1\"/></material>\n"
      "  <material name=\"skirt\"><color rgba=\"0.1 0.1 0.1 1\"/></material>\n"
      "  <link name=\"{}\">\n",
      xmlText(craft.name), xmlText(frames.of(craft.name)));
  urdf += inertialText(craft.mass_properties) + hullText(craft);
  for (const hovercraft::EngineParameters& engine : craft.engines) {
    const bool is_built_in = engine.min_thrust != 0.0 || engine.max_thrust != 0.0;
    if (is_built_in) urdf += engineText(engine);
  }
  if (craft.cushion) urdf += skirtText(*craft.cushion);
  return urdf + "  </link>\n</robot>\n";
}

}  // namespace hovercraft_ros
