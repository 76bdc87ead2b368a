#include "hovercraft_sim/view/markers_node.h"

#include <cmath>
#include <exception>
#include <visualization_msgs/MarkerArray.h>

#include <hovercraft_sim/Wind.h>
#include <ros/console.h>

#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/vehicle_messages.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/view/actuator_markers.h"
#include "hovercraft_sim/view/cushion_markers.h"
#include "hovercraft_sim/view/robot_description.h"
#include "hovercraft_sim/view/vehicle_markers.h"

namespace hovercraft_ros {
namespace {

constexpr double kRefreshPeriod = 0.05;  // s of wall time
constexpr std::uint32_t kDisplayQueue = 10;
constexpr std::size_t kHandleEvery = 4;     // refreshes: the handles follow at 5 Hz
constexpr std::size_t kMostContacts = 200;  // that wait to be sent, and ids of those that are shown

void append(std::vector<visualization_msgs::Marker>& array,
            const std::vector<visualization_msgs::Marker>& markers) {
  array.insert(array.end(), markers.begin(), markers.end());
}

/// What lies beside the scenario's topic: of ~scenario it is NODE/name.
std::string besideScenario(const std::string& scenario, const char* name) {
  return scenario.substr(0, scenario.rfind('/') + 1) + name;
}

std::optional<hovercraft::Pose> poseOf(const geometry_msgs::Pose& message) {
  const hovercraft::Quaternion q = fromMessage(message.orientation);
  const hovercraft::Vector3 p = fromMessage(message.position);
  const bool is_near = p.cwiseAbs().maxCoeff() <= hovercraft::kFarthest;
  const bool is_pose =
      p.allFinite() && is_near && std::abs(hovercraft::squaredNorm(q) - 1.0) < 1e-6;
  if (!is_pose) return std::nullopt;
  return hovercraft::Pose{hovercraft::rotationMatrix(hovercraft::normalized(q)), p};
}

}  // namespace

MarkersNode::MarkersNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : handle_(handle), own_(private_handle) {
  publisher_ = own_.advertise<visualization_msgs::MarkerArray>("markers", kDisplayQueue);
  details_ = own_.advertise<visualization_msgs::MarkerArray>("details", kDisplayQueue);
  scenario_subscriber_ = handle_.subscribe("scenario", 1, &MarkersNode::onScenario, this);
  timer_ = own_.createWallTimer(ros::WallDuration(kRefreshPeriod),
                                [this](const ros::WallTimerEvent&) { publish(); });
}

void MarkersNode::onScenario(const std_msgs::String& message) {
  craft_.clear();
  still_.clear();
  nearest_.reset();
  bodies_.clear();
  world_subscribers_.clear();
  contacts_.clear();
  placer_.reset();
  scenario_ = hovercraft::Scenario();
  try {
    const hovercraft::Scenario scenario =
        hovercraft::parseScenario(message.data, {handle_.resolveName("scenario"), "", {}});
    for (const hovercraft::VehicleScenario& description : scenario.vehicles) watch(description);
    scenario_ = scenario;
    nearest_.emplace(scenario_);
    placer_ = std::make_unique<CraftPlacer>(
        own_, scenario_, besideScenario(handle_.resolveName("scenario"), "set_state"));
    watchBodies();
  } catch (const std::exception& error) {
    ROS_ERROR("Nothing is drawn: %s", error.what());
  }
}

void MarkersNode::watch(const hovercraft::VehicleScenario& description) {
  craft_.push_back(std::make_unique<Craft>());
  Craft* craft = craft_.back().get();
  craft->description = description;
  ros::NodeHandle own(handle_, description.name);
  const boost::function<void(const geometry_msgs::PoseStamped&)> on_pose =
      [craft](const geometry_msgs::PoseStamped& pose) {
        craft->world_frame = pose.header.frame_id;
        craft->pose = pose;
        craft->path.extend(pose.pose.position, pose.header.stamp);
      };
  const boost::function<void(const hovercraft_sim::State&)> on_state =
      [craft](const hovercraft_sim::State& state) {
        craft->path.enter(state.episode, state.header.stamp);
        CraftMotion& motion = craft->motion;
        const bool goes_on =
            motion.state.episode == state.episode && motion.state.tick < state.tick;
        motion.before.reset();
        if (goes_on && !motion.state.header.frame_id.empty()) motion.before = motion.state;
        motion.state = state;
      };
  const boost::function<void(const hovercraft_sim::EngineStatus&)> on_engines =
      [craft](const hovercraft_sim::EngineStatus& engines) { craft->engines = engines; };
  const boost::function<void(const hovercraft_sim::Wind&)> on_wind =
      [craft](const hovercraft_sim::Wind& wind) {
        craft->motion.wind = fromMessage(wind.true_wind);
      };
  craft->subscribers = {
      own.subscribe<hovercraft_sim::Wind>(kWindTopic, kDisplayQueue, on_wind),
      own.subscribe<geometry_msgs::PoseStamped>(kPoseTopic, kDisplayQueue, on_pose),
      own.subscribe<hovercraft_sim::State>(kStateTopic, kDisplayQueue, on_state),
      own.subscribe<hovercraft_sim::EngineStatus>(kEnginesTopic, kDisplayQueue, on_engines)};
  if (!description.actuators.empty()) {
    const boost::function<void(const hovercraft_sim::ActuatorStatusArray&)> on_actuators =
        [craft](const hovercraft_sim::ActuatorStatusArray& status) { craft->actuators = status; };
    craft->subscribers.push_back(own.subscribe<hovercraft_sim::ActuatorStatusArray>(
        kActuatorsTopic, kDisplayQueue, on_actuators));
  }
  if (!description.cushion) return;
  const boost::function<void(const hovercraft_sim::Cushion&)> on_cushion =
      [craft](const hovercraft_sim::Cushion& cushion) { craft->cushion = cushion; };
  craft->subscribers.push_back(
      own.subscribe<hovercraft_sim::Cushion>(kCushionTopic, kDisplayQueue, on_cushion));
}

/// Poses of loose bodies, and contacts.
void MarkersNode::watchBodies() {
  if (!scenario_.world) return;
  for (const hovercraft::VehicleScenario& body : scenario_.world->bodies) {
    const std::string name = body.name;
    const boost::function<void(const geometry_msgs::PoseStamped&)> on_pose =
        [this, name](const geometry_msgs::PoseStamped& pose) { bodies_[name] = pose.pose; };
    world_subscribers_.push_back(handle_.subscribe<geometry_msgs::PoseStamped>(
        name + "/" + kPoseTopic, kDisplayQueue, on_pose));
  }
  world_subscribers_.push_back(
      handle_.subscribe(besideScenario(handle_.resolveName("scenario"), "contacts"), kMostContacts,
                        &MarkersNode::hearContact, this));
}

void MarkersNode::hearContact(const hovercraft_sim::Contact& contact) {
  if (details_.getNumSubscribers() == 0 || contacts_.size() >= kMostContacts) return;
  append(contacts_, contactMarkers(contact, contact_count_));
  contact_count_ = (contact_count_ + 1) % static_cast<int>(kMostContacts);
}

/// What has the same marker at all times: ground, obstacles, and the hulls of loose bodies, which
/// tf moves.
void MarkersNode::makeStill(const std::string& world_frame, const std::string& prefix) {
  still_.clear();
  still_prefix_ = prefix;
  append(still_, groundMarkers(scenario_, world_frame));
  if (!scenario_.world) return;
  std::vector<visualization_msgs::Marker> loose;
  for (const hovercraft::VehicleScenario& body : scenario_.world->bodies) {
    loose.push_back(bodyMarker(body));
  }
  addPrefix(prefix, loose);
  append(still_, loose);
  append(still_, obstacleMarkers(scenario_, world_frame));
}

void MarkersNode::publishDetails() {
  if (details_.getNumSubscribers() == 0) return;
  visualization_msgs::MarkerArray array;
  std::string world_frame;
  std::vector<std::optional<hovercraft::Pose>> poses;
  for (const auto& craft : craft_) {
    poses.push_back(poseOf(craft->pose.pose));
    if (!craft->world_frame.empty()) world_frame = craft->world_frame;
    if (craft->motion.state.header.frame_id.empty()) continue;
    append(array.markers, forceMarkers(craft->description, scenario_.wind, craft->motion));
  }
  if (nearest_ && !world_frame.empty()) {
    for (std::size_t i = poses.size(); i < nearest_->moving().size(); ++i) {
      const auto body = bodies_.find(nearest_->moving()[i]);
      poses.push_back(body == bodies_.end() ? std::nullopt : poseOf(body->second));
    }
    append(array.markers, nearestMarkers(nearest_->find(poses), world_frame));
  }
  append(array.markers, contacts_);
  contacts_.clear();
  if (!array.markers.empty()) details_.publish(array);
}

void MarkersNode::showHandles() {
  if (!placer_) return;
  for (const auto& craft : craft_) {
    if (craft->world_frame.empty()) continue;
    placer_->show(craft->description.name, craft->world_frame, craft->pose.pose);
  }
  placer_->apply();
}

/// For RobotModel, also where no simulation runs, such as while a bag is played.
void MarkersNode::describe(const Craft& craft, const std::string& prefix) {
  ros::NodeHandle space(handle_, craft.description.name);
  const std::string wanted = urdfOf(craft.description, {craft.world_frame, prefix});
  std::string present;  // of this craft, or of one of its name that was there before
  if (space.getParam(kRobotDescription, present) && present == wanted) return;
  space.setParam(kRobotDescription, wanted);
}

void MarkersNode::publish() {
  if (ticks_++ % kHandleEvery == 0) showHandles();
  publishDetails();
  for (const auto& craft : craft_) {
    // The frame of the engines has the prefix.
    const std::string& frame = craft->engines.header.frame_id;
    if (craft->is_described || craft->world_frame.empty() || frame.empty()) continue;
    describe(*craft, prefixOf(frame, craft->description.name));
    craft->is_described = true;
  }
  if (publisher_.getNumSubscribers() == 0) return;
  visualization_msgs::MarkerArray array;
  for (std::size_t i = 0; i < craft_.size(); ++i) {
    const auto& craft = craft_[i];
    if (craft->world_frame.empty()) continue;  // no pose yet: tf does not know the craft
    const std::string prefix = prefixOf(craft->engines.header.frame_id, craft->description.name);
    if (still_.empty() || still_prefix_ != prefix) makeStill(craft->world_frame, prefix);
    std::vector<visualization_msgs::Marker> fixed = craftMarkers(craft->description, i);
    if (craft_.size() > 1) fixed.push_back(nameMarker(craft->description));
    append(fixed, thrustMarkers(craft->description, craft->engines));
    append(fixed, actuatorMarkers(craft->description, craft->actuators));
    append(fixed, cushionMarkers(craft->description, craft->cushion));
    addPrefix(prefix, fixed);
    append(array.markers, fixed);
    array.markers.push_back(
        pathMarker(craft->description, craft->world_frame, craft->path.points()));
  }
  append(array.markers, still_);
  if (!array.markers.empty()) publisher_.publish(array);
}

}  // namespace hovercraft_ros
