#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "hovercraft_sim/body/mass_properties.h"
#include "hovercraft_sim/body/steppers.h"
#include "hovercraft_sim/hovercraft/drag.h"
#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/math/time.h"

namespace hovercraft {

enum class OrientationKind { kQuaternion, kMatrix };
enum class BodyModel { kPlanar, kSpatial };

/// The solids that a craft may be composed of; lengths in m.
struct BoxShape {
  Vector3 size;
};
struct CylinderShape {
  double radius;
  double length;  // along z
};
struct ConeShape {
  double radius;
  double length;  // along z, apex up, origin at the middle of the axis
};
struct SphereShape {
  double radius;
};
struct MeshShape {
  std::string file;  // as resolved: an absolute path
};

/// One homogeneous part of a craft, placed in the hull frame H.
struct PartScenario {
  std::variant<BoxShape, CylinderShape, ConeShape, SphereShape, MeshShape> shape;
  double mass = 0.0;               // kg
  Vector3 p_HP = Vector3::Zero();  // position, m
  Vector3 rpy = Vector3::Zero();   // fixed-axis roll, pitch, yaw, rad
};

/// One craft. Parts and engines are placed in the hull frame H (base_link); the initial motion is
/// that of the body frame B at the centre of mass, in W.
struct VehicleScenario {
  std::string name;
  MassProperties mass_properties;   // in H
  std::vector<PartScenario> parts;  // empty if mass and inertia were given
  std::array<EngineParameters, kEngineCount> engines;
  Drag drag;
  Vector3 initial_p_WB = Vector3::Zero();  // m
  Vector3 initial_rpy = Vector3::Zero();   // rad
  Vector3 initial_v_WB = Vector3::Zero();  // m/s
  Vector3 initial_w_WB = Vector3::Zero();  // rad/s
};

/// Everything that determines a run except the commands; checked when it was read
/// (scenario_parser.h).
struct Scenario {
  std::int64_t step_ns = 0;  // ns
  Integrator integrator = Integrator::kHeun;
  OrientationKind orientation = OrientationKind::kQuaternion;
  BodyModel model = BodyModel::kPlanar;
  Vector3 gravity = Vector3::Zero();  // m/s², in W
  Vector3 wind = Vector3::Zero();     // m/s, in W
  std::int64_t seed = 1;
  std::vector<VehicleScenario> vehicles;  // in the order of their names

  double stepSize() const { return toSeconds(step_ns); }  // s
};

}  // namespace hovercraft
