#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hovercraft_sim/body/mass_properties.h"
#include "hovercraft_sim/body/steppers.h"
#include "hovercraft_sim/contact/material.h"
#include "hovercraft_sim/cushion/cushion.h"
#include "hovercraft_sim/cushion/height_map.h"
#include "hovercraft_sim/cushion/pads.h"
#include "hovercraft_sim/hovercraft/drag.h"
#include "hovercraft_sim/hovercraft/drag_laws.h"
#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/hovercraft/gusts.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/scenario/actuator_scenario.h"
#include "hovercraft_sim/sensors/sensor_parameters.h"

namespace hovercraft {

enum class OrientationKind { kQuaternion, kMatrix };
enum class BodyModel { kPlanar, kSpatial };
/// Which transform of a craft's base_link goes into tf: from the world by its true pose, from its
/// odometry frame by its first odometry sensor, or none.
enum class TfSource { kTruth, kOdometry, kNone };

/// The solids that a craft may be composed of; lengths in m.
struct BoxShape {
  Vector3 size;  // along x, y, z
};
struct CylinderShape {
  double radius;  // of a circle about z
  double length;  // along z
};
struct ConeShape {
  double radius;  // of its base
  double length;  // along z, apex up, origin at the middle of the axis
};
struct SphereShape {
  double radius;  // about the origin
};
struct MeshShape {
  std::string file;                 // as resolved: an absolute path
  Vector3 scale = Vector3::Ones();  // of its coordinates to m
};

/// One homogeneous part of a craft, placed in the hull frame H.
struct PartScenario {
  std::variant<BoxShape, CylinderShape, ConeShape, SphereShape, MeshShape> shape;  // what it is of
  double mass = 0.0;                                                               // kg
  Vector3 p_HP = Vector3::Zero();                                                  // position, m
  Vector3 rpy = Vector3::Zero();  // fixed-axis roll, pitch, yaw, rad
};

/// The vertices of a convex body.
struct PointsShape {
  std::vector<Vector3> points;  // m, in its frame
};

/// The convex body by which something meets others, placed in its frame H. A sphere is a polyhedron
/// of 162 vertices on it, a cylinder a prism of 24 sides in it.
struct HullScenario {
  /// The body, in a frame S of its own.
  std::variant<BoxShape, CylinderShape, SphereShape, PointsShape> shape;
  Vector3 p_HS = Vector3::Zero();  // position, m
  Vector3 rpy = Vector3::Zero();   // rad
};

/// An upright bent wall of one thickness along a line through points of the plane z = 0, m; mitred
/// where it bends. Its height lies half below and half above that plane.
struct WallShape {
  std::vector<std::array<double, 2>> points;  // of its middle line
  bool closed = false;                        // the first point comes again after the last
  double thickness = 0.0;                     // m
  double height = 0.0;                        // m
};

/// What RViz draws in place of a body's shapes: a mesh of any format that it reads.
struct VisualScenario {
  std::string resource;             // URL: package://, file://, ...
  Vector3 scale = Vector3::Ones();  // of its coordinates to m
  Vector3 p_HV = Vector3::Zero();   // position in the frame of the body, m
  Vector3 rpy = Vector3::Zero();    // rad
};

/// One craft. Parts and engines are placed in the hull frame H (base_link); the initial motion is
/// that of the body frame B at the centre of mass, in W.
struct VehicleScenario {
  std::string name;                                      // its key
  MassProperties mass_properties;                        // in H
  std::vector<PartScenario> parts;                       // empty if mass and inertia were given
  std::array<EngineParameters, kEngineCount> engines;    // rear, left, right
  std::array<CommandTopic, kEngineCount> engine_topics;  // likewise
  std::array<bool, kEngineCount> has_engine = {true, true, true};  // else its limits are 0
  std::vector<ActuatorScenario> actuators;                         // by name; ids from 3 on
  Drag drag;                                                       // by body axes
  std::vector<DragLaw> drag_laws;            // besides it, in the order of DragLaw
  std::optional<CushionParameters> cushion;  // none: no cushion
  std::optional<HullScenario>
      hull;  // none: the convex hull of the parts, in a scenario with a world or a ground
  std::optional<VisualScenario> visual;    // none: its shapes are drawn
  std::size_t material = 0;                // index into WorldScenario::materials
  std::vector<SensorParameters> sensors;   // by name
  TfSource tf = TfSource::kTruth;          // of base_link
  Vector3 initial_p_WB = Vector3::Zero();  // m
  Vector3 initial_rpy = Vector3::Zero();   // rad
  Vector3 initial_v_WB = Vector3::Zero();  // m/s
  Vector3 initial_w_WB = Vector3::Zero();  // rad/s
};

/// A plane as ground.
struct PlaneScenario {
  double height = 0.0;                // m, at x = y = 0
  Vector3 normal = Vector3::UnitZ();  // of length 1, z > 0
};

/// Heights as the pixels of an image, named as in the YAML of map_server.
struct HeightMapScenario {
  std::string image;                               // all bytes of a PGM or PNG file
  double resolution = 0.0;                         // m, edge of a pixel
  double x = 0.0, y = 0.0;                         // m, of the lower left corner of the image
  double z_min = 0.0;                              // m, of a pixel of value 0
  double z_max = 0.0;                              // m, of a pixel of the greatest value
  std::shared_ptr<const HeightMapGround> surface;  // as read: one for all that ask it
};

/// Ground besides the obstacles of a world.
struct GroundScenario {
  std::variant<PlaneScenario, HeightMapScenario> surface;
  PadParameters pads;  // of hulls on it
};

struct MaterialScenario {
  std::string name;  // its key
  ContactMaterial surface;
};

/// The law between two materials where it is not the combined one.
struct MaterialPairScenario {
  std::size_t first = 0;   // indices of materials
  std::size_t second = 0;  // likewise
  ContactMaterial law;     // in place of the combined one
};

struct ObstacleScenario {
  std::string name;                      // its key
  HullScenario hull;                     // placed in W
  std::optional<VisualScenario> visual;  // placed in the frame of the hull's shape
  std::size_t material = 0;
  std::optional<WallShape> wall;  // in place of the hull's shape, where the hull is placed
};

/// What the bodies of a scenario meet, and how. Loose bodies are craft whose engines have no
/// thrust.
struct WorldScenario {
  double tolerance = 1e-6;                                      // m
  double rest_speed = 0.01;                                     // m/s
  std::vector<MaterialScenario> materials = {{"default", {}}};  // "default" first, then by name
  std::vector<MaterialPairScenario> material_pairs;             // none: the combined laws
  std::vector<ObstacleScenario> obstacles;                      // by name
  std::vector<VehicleScenario> bodies;                          // by name
};

/// Everything that determines a run except the commands; checked when it was read
/// (scenario_parser.h).
struct Scenario {
  std::int64_t step_ns = 0;                                    // ns
  Integrator integrator = Integrator::kHeun;                   // how a step is made
  OrientationKind orientation = OrientationKind::kQuaternion;  // what is integrated
  BodyModel model = BodyModel::kPlanar;                        // planar or spatial
  Vector3 gravity = Vector3::Zero();                           // m/s², in W
  Vector3 wind = Vector3::Zero();                              // m/s, in W: the mean
  std::optional<GustParameters> gusts;                         // none: the air has the mean wind
  std::int64_t seed = 1;                                       // of all noise
  std::vector<VehicleScenario> vehicles;                       // in the order of their names
  std::optional<WorldScenario> world;    // none: craft pass through each other
  std::optional<GroundScenario> ground;  // none: the obstacles of the world, if there are any

  double stepSize() const { return toSeconds(step_ns); }  // s
};

}  // namespace hovercraft
