#pragma once

#include <optional>

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/Vector3.h>
#include <hovercraft_sim/ActuatorCommand.h>
#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/Engine.h>
#include <hovercraft_sim/ThrustCommand.h>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/sim/command_log.h"
#include "hovercraft_sim/sim/simulation.h"

/// Pure functions between the core's types and ROS messages.

namespace hovercraft_ros {

/// Number by number, in the same unit.
HOVERCRAFT_PUBLIC geometry_msgs::Vector3 toVector3Message(const hovercraft::Vector3& v);
HOVERCRAFT_PUBLIC geometry_msgs::Point toPointMessage(const hovercraft::Vector3& p);
HOVERCRAFT_PUBLIC geometry_msgs::Quaternion toQuaternionMessage(const hovercraft::Quaternion& q);
HOVERCRAFT_PUBLIC hovercraft::Vector3 fromMessage(const geometry_msgs::Vector3& v);
HOVERCRAFT_PUBLIC hovercraft::Vector3 fromMessage(const geometry_msgs::Point& p);
HOVERCRAFT_PUBLIC hovercraft::Quaternion fromMessage(const geometry_msgs::Quaternion& q);

/// Motion of the hull frame H (base_link), which differs from the body frame B by the place of the
/// centre of mass.
struct HullMotion {
  hovercraft::Vector3 p_WH;     // m, in W
  hovercraft::Quaternion q_WH;  // H -> W
  hovercraft::Vector3 v_WH_H;   // velocity of base_link's origin, in base_link's axes, m/s
  hovercraft::Vector3 w_WH_H;   // rad/s, in base_link's axes
};

/// @param p_HB the centre of mass in H, m.
HOVERCRAFT_PUBLIC HullMotion hullMotion(const hovercraft::Motion& motion,
                                        const hovercraft::Vector3& p_HB);

/// The orientation of a frame whose x axis points along `direction` (a unit vector): the shortest
/// turn from x.
HOVERCRAFT_PUBLIC hovercraft::Quaternion turnFromX(const hovercraft::Vector3& direction);

/// Number by number.
HOVERCRAFT_PUBLIC hovercraft_sim::Engine toMessage(const hovercraft::EngineReport& report);
HOVERCRAFT_PUBLIC hovercraft_sim::AppliedCommand toMessage(const hovercraft::Command& command);

/// Its thrusts of all three engines, whichever it is for.
HOVERCRAFT_PUBLIC hovercraft_sim::ThrustCommand toThrustCommand(const hovercraft::Command& command,
                                                                const ros::Time& stamp);
/// Its values for the actuators that it is for, engines among them.
HOVERCRAFT_PUBLIC hovercraft_sim::ActuatorCommand toActuatorCommand(
    const hovercraft::Command& command, const hovercraft::VehicleScenario& craft,
    const ros::Time& stamp);

/// The command that a message asks for; nothing if a thrust is not finite. Its tick is 0: when it
/// acts is for the one who hands it to a simulation.
[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<hovercraft::Command> toCommand(
    const hovercraft_sim::ThrustCommand& message, std::size_t vehicle);
/// For the engine or other actuator of that id, by the command of its kind.
[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<hovercraft::Command> toCommand(double value,
                                                                             std::size_t id,
                                                                             std::size_t vehicle);
/// Nothing too if a name is unknown or stands twice, or there are not as many values as names.
[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<hovercraft::Command> toCommand(
    const hovercraft_sim::ActuatorCommand& message, const hovercraft::VehicleScenario& craft,
    std::size_t vehicle);
/// The command that was recorded, to be applied at its own tick.
HOVERCRAFT_PUBLIC hovercraft::Command toCommand(const hovercraft_sim::AppliedCommand& message,
                                                std::size_t vehicle);

}  // namespace hovercraft_ros
