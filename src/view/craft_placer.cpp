#include "hovercraft_sim/view/craft_placer.h"

#include <cmath>
#include <visualization_msgs/InteractiveMarker.h>
#include <visualization_msgs/InteractiveMarkerControl.h>
#include <visualization_msgs/InteractiveMarkerFeedback.h>

#include <hovercraft_sim/SetState.h>
#include <ros/console.h>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/messages/conversions.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Quaternion;
using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::InteractiveMarkerFeedback;

constexpr double kHandleSize = 1.2;      // m
constexpr double kLongestSilence = 2.0;  // s of wall time, of one who holds a handle
constexpr double kLeastMove = 0.002;     // m, and of a quaternion: a handle follows by such steps

/// The axis of a control is its x axis.
InteractiveMarkerControl control(const char* name, std::uint8_t mode, double x, double y) {
  InteractiveMarkerControl result;
  result.name = name;
  result.interaction_mode = mode;
  result.orientation.w = std::sqrt(0.5);
  result.orientation.x = std::sqrt(0.5) * x;
  result.orientation.y = std::sqrt(0.5) * y;
  return result;
}

bool isPose(const geometry_msgs::Pose& pose) {
  const double length = hovercraft::squaredNorm(fromMessage(pose.orientation));
  return fromMessage(pose.position).allFinite() && std::isfinite(length) && length > 1e-12;
}

bool isNear(const geometry_msgs::Pose& a, const geometry_msgs::Pose& b) {
  const Quaternion turn = fromMessage(a.orientation) + (-1.0) * fromMessage(b.orientation);
  return hovercraft::norm(fromMessage(a.position) - fromMessage(b.position)) < kLeastMove &&
         hovercraft::norm(turn) < kLeastMove;
}

}  // namespace

geometry_msgs::Pose fittingPose(const geometry_msgs::Pose& wanted, const geometry_msgs::Pose& now,
                                hovercraft::BodyModel model) {
  const hovercraft::FloatingPointEnvironment environment;
  geometry_msgs::Pose pose = wanted;
  Quaternion q = hovercraft::normalized(fromMessage(wanted.orientation));
  if (model == hovercraft::BodyModel::kPlanar) {
    pose.position.z = now.position.z;
    const Quaternion yaw = {q.s, {0.0, 0.0, q.v.z()}};
    q = hovercraft::norm(yaw) > 1e-6 ? hovercraft::normalized(yaw) : Quaternion();
  }
  pose.orientation = toQuaternionMessage(q);
  return pose;
}

CraftPlacer::CraftPlacer(const ros::NodeHandle& own, const hovercraft::Scenario& scenario,
                         const std::string& set_state)
    : model_(scenario.model), server_(own.getNamespace() + "/place") {
  set_state_ = ros::NodeHandle(own).serviceClient<hovercraft_sim::SetState>(set_state);
  for (const hovercraft::VehicleScenario& craft : scenario.vehicles) handles_[craft.name];
}

void CraftPlacer::show(const std::string& craft, const std::string& world_frame,
                       const geometry_msgs::Pose& pose) {
  const auto found = handles_.find(craft);
  if (found == handles_.end()) return;
  Handle& handle = found->second;
  handle.pose = pose;
  handle.world_frame = world_frame;
  const bool is_held = ros::WallTime::now() < handle.held_until;
  if (is_held || (handle.is_there && isNear(pose, handle.shown))) return;
  if (handle.is_there) {
    server_.setPose(craft, pose);
  } else {
    insert(craft, handle);
  }
  handle.is_there = true;
  handle.shown = pose;
  has_changed_ = true;
}

void CraftPlacer::apply() {
  if (has_changed_) server_.applyChanges();
  has_changed_ = false;
}

void CraftPlacer::insert(const std::string& craft, const Handle& handle) {
  visualization_msgs::InteractiveMarker marker;
  marker.header.frame_id = handle.world_frame;
  marker.name = craft;
  marker.description = "place " + craft;
  marker.scale = static_cast<float>(kHandleSize);
  marker.pose = handle.pose;
  // Normal to the plane, and axis of the turn: z.
  marker.controls.push_back(control("plane", InteractiveMarkerControl::MOVE_PLANE, 0.0, 1.0));
  marker.controls.push_back(control("yaw", InteractiveMarkerControl::ROTATE_AXIS, 0.0, 1.0));
  if (model_ == hovercraft::BodyModel::kSpatial) {
    marker.controls.push_back(control("height", InteractiveMarkerControl::MOVE_AXIS, 0.0, 1.0));
  }
  server_.insert(marker, [this](const Feedback& feedback) { take(feedback); });
}

void CraftPlacer::take(const Feedback& feedback) {
  const auto found = handles_.find(feedback->marker_name);
  if (found == handles_.end()) return;
  Handle& handle = found->second;
  if (feedback->event_type == InteractiveMarkerFeedback::MOUSE_DOWN ||
      feedback->event_type == InteractiveMarkerFeedback::POSE_UPDATE ||
      feedback->event_type == InteractiveMarkerFeedback::KEEP_ALIVE) {
    handle.held_until = ros::WallTime::now() + ros::WallDuration(kLongestSilence);
    return;
  }
  if (feedback->event_type != InteractiveMarkerFeedback::MOUSE_UP) return;
  handle.held_until = ros::WallTime();
  // Where it is not where its craft is, it goes back to it.
  handle.shown.position.z = HUGE_VAL;
  const std::string& frame = feedback->header.frame_id;
  if (!isPose(feedback->pose) || (!frame.empty() && frame != handle.world_frame)) {
    ROS_WARN("place %s: not placed: the pose must be finite and in %s", found->first.c_str(),
             handle.world_frame.c_str());
    return;
  }
  place(found->first, handle, feedback->pose);
}

void CraftPlacer::place(const std::string& craft, const Handle& handle,
                        const geometry_msgs::Pose& wanted) {
  hovercraft_sim::SetState call;
  call.request.vehicle = craft;
  call.request.pose = fittingPose(wanted, handle.pose, model_);
  if (!set_state_.call(call)) {
    ROS_WARN("place %s: not placed: no answer of %s", craft.c_str(),
             set_state_.getService().c_str());
  } else if (!call.response.success) {
    ROS_WARN("place %s: not placed: %s", craft.c_str(), call.response.message.c_str());
  }
}

}  // namespace hovercraft_ros
