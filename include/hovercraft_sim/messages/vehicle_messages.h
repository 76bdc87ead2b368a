#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <hovercraft_sim/ActuatorStatusArray.h>
#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/Cushion.h>
#include <hovercraft_sim/EngineStatus.h>
#include <hovercraft_sim/State.h>
#include <hovercraft_sim/Wind.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/tf_frames.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft_ros {

/// Topics of one craft, relative to its namespace.
constexpr const char* kThrustTopic = "thrust";
constexpr const char* kPoseTopic = "pose";
constexpr const char* kTwistTopic = "twist";
constexpr const char* kOdomTopic = "odom";
constexpr const char* kEnginesTopic = "engines";
constexpr const char* kCushionTopic = "cushion";
constexpr const char* kWindTopic = "wind";
constexpr const char* kActuatorsTopic = "actuators";
constexpr const char* kActuatorCommandTopic = "actuator_command";
constexpr const char* kStateTopic = "state";
constexpr const char* kCommandsTopic = "commands";
/// Of the node: the states of all craft.
constexpr const char* kStatesTopic = "states";

/// Whether the true odometry may be on it: a topic below the craft's namespace, truth/odom, whose
/// first and last parts are no topic of something else.
HOVERCRAFT_PUBLIC bool isTopicForTruth(const std::string& topic);
/// The rule in words, for messages.
constexpr const char* kTruthOdomRuleText =
    "must be a topic below the craft's namespace, such as truth/odom, and not that of something "
    "else";

/// Simulated time as ROS time: epoch + n·h, from whole nanoseconds.
HOVERCRAFT_PUBLIC ros::Time stampOf(const ros::Time& epoch, std::int64_t time_ns);

/// Where a run stands in ROS time.
struct RunStamp {
  ros::Time stamp;            // the time of the tick
  std::uint32_t episode = 0;  // 0 in a run without resets
  std::uint64_t events = 0;   // RunEvents of this episode so far
};

/// Which messages of a craft are wanted: what nobody hears is not filled.
struct MessageParts {
  bool frames = false;     // pose, twist, odom, transform
  bool engines = false;    // EngineStatus
  bool actuators = false;  // ActuatorStatusArray
  bool state = false;      // with its hash
  bool wind = false;       // Wind
  bool cushion = false;    // Cushion

  /// Every message.
  static MessageParts all() { return {true, true, true, true, true, true}; }
};

/// Every message about one craft at one tick; the node publishes them, a bag writer writes them.
/// The messages are kept and filled again, so that their strings are made once.
class HOVERCRAFT_PUBLIC VehicleMessages {
 public:
  /// @param vehicle index into the scenario's vehicles.
  VehicleMessages(const hovercraft::Scenario& scenario, std::size_t vehicle,
                  TfFrames frames = TfFrames());

  /// Whether tf has the craft's true pose.
  bool hasTransform() const { return tf() == hovercraft::TfSource::kTruth; }
  hovercraft::TfSource tf() const { return description_.tf; }  // of the scenario

  /// Fills every message from the simulation as it stands.
  void fill(const hovercraft::Simulation& simulation, const RunStamp& place) {
    fill(simulation, place, MessageParts::all());
  }
  /// Fills those that are wanted; the others stay as they are.
  void fill(const hovercraft::Simulation& simulation, const RunStamp& place,
            const MessageParts& parts);

  /// Numbers the command; states count it from then on. @param place at the command's tick.
  hovercraft_sim::AppliedCommand appliedCommand(const hovercraft::Command& command,
                                                const RunStamp& place);

  /// base_link -> engine_rear, engine_left, engine_right; x along the positive thrust.
  std::vector<geometry_msgs::TransformStamped> engineFrames(const ros::Time& stamp) const;

  /// Of the craft, and its messages as fill() left them.
  const std::string& name() const { return description_.name; }
  const geometry_msgs::PoseStamped& pose() const { return pose_; }
  const geometry_msgs::TwistStamped& twist() const { return twist_; }
  const nav_msgs::Odometry& odom() const { return odom_; }
  const geometry_msgs::TransformStamped& transform() const { return transform_; }
  const hovercraft_sim::EngineStatus& engines() const { return engines_; }
  /// Empty if the craft has no actuators besides its engines.
  const hovercraft_sim::ActuatorStatusArray& actuators() const { return actuators_; }
  bool hasActuators() const { return !actuators_.actuators.empty(); }  // besides its engines
  const hovercraft_sim::State& state() const { return state_; }
  const hovercraft_sim::Wind& wind() const { return wind_; }            // at the craft
  bool hasCushion() const { return description_.cushion.has_value(); }  // of the scenario
  /// Of a craft that has one.
  const hovercraft_sim::Cushion& cushion() const { return cushion_; }

 private:
  void enter(std::uint32_t episode);
  void fillFrames(const HullMotion& hull, const ros::Time& stamp);
  void fillEngines(const hovercraft::Simulation& simulation);
  void fillState(const hovercraft::Simulation& simulation, const RunStamp& place,
                 const hovercraft::Motion& motion);
  void fillCushion(const hovercraft::Simulation& simulation);
  void fillWind(const hovercraft::Simulation& simulation, const HullMotion& hull);
  void fillActuators(const hovercraft::Simulation& simulation);

  hovercraft::VehicleScenario description_;
  std::size_t vehicle_;
  TfFrames frames_;
  std::uint32_t episode_ = 0;
  std::uint64_t commands_ = 0;  // that took effect in that episode
  geometry_msgs::PoseStamped pose_;
  geometry_msgs::TwistStamped twist_;
  nav_msgs::Odometry odom_;
  geometry_msgs::TransformStamped transform_;
  hovercraft_sim::EngineStatus engines_;
  hovercraft_sim::ActuatorStatusArray actuators_;
  hovercraft_sim::State state_;
  hovercraft_sim::Wind wind_;
  hovercraft_sim::Cushion cushion_;
  hovercraft::CushionReport cushion_report_;
};

}  // namespace hovercraft_ros
