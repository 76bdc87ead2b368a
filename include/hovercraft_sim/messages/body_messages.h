#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <hovercraft_sim/Contact.h>
#include <ros/time.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/messages/tf_frames.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft_ros {

/// Pose and transform of one loose body at one tick: of its frame `<name>/base_link` (see
/// TfFrames), in which its parts are placed.
class HOVERCRAFT_PUBLIC BodyMessages {
 public:
  /// @param body index into the loose bodies of the scenario's world.
  BodyMessages(const hovercraft::Scenario& scenario, std::size_t body, const TfFrames& frames);

  /// From the simulation as it stands.
  void fill(const hovercraft::Simulation& simulation, const ros::Time& stamp);

  const std::string& name() const { return description_.name; }     // of the body
  const geometry_msgs::PoseStamped& pose() const { return pose_; }  // of its frame in W
  const geometry_msgs::TransformStamped& transform() const {
    return transform_;
  }  // the same for tf

 private:
  hovercraft::VehicleScenario description_;
  std::size_t body_;
  geometry_msgs::PoseStamped pose_;
  geometry_msgs::TransformStamped transform_;
};

/// Of all loose bodies of a scenario.
HOVERCRAFT_PUBLIC std::vector<BodyMessages> bodyMessages(const hovercraft::Scenario& scenario,
                                                         const TfFrames& frames);

/// @param epoch_ns of tick 0 of the episode. An event at time 0, which ROS takes for no time, gets
/// 1 ns.
HOVERCRAFT_PUBLIC hovercraft_sim::Contact toMessage(const hovercraft::ContactEvent& event,
                                                    std::int64_t epoch_ns, std::uint32_t episode,
                                                    const std::string& world_frame);

}  // namespace hovercraft_ros
