#include "hovercraft_sim/ros/markers_node.h"

#include <exception>
#include <visualization_msgs/MarkerArray.h>

#include <ros/console.h>

#include "hovercraft_sim/ros/cushion_markers.h"
#include "hovercraft_sim/ros/vehicle_markers.h"
#include "hovercraft_sim/ros/vehicle_messages.h"
#include "hovercraft_sim/sim/scenario_parser.h"

namespace hovercraft_ros {
namespace {

constexpr double kRefreshPeriod = 0.05;  // s of wall time
constexpr std::uint32_t kDisplayQueue = 10;

void append(std::vector<visualization_msgs::Marker>& array,
            const std::vector<visualization_msgs::Marker>& markers) {
  array.insert(array.end(), markers.begin(), markers.end());
}

}  // namespace

MarkersNode::MarkersNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : handle_(handle) {
  ros::NodeHandle own(private_handle);
  publisher_ = own.advertise<visualization_msgs::MarkerArray>("markers", kDisplayQueue);
  scenario_subscriber_ = handle_.subscribe("scenario", 1, &MarkersNode::onScenario, this);
  timer_ = own.createWallTimer(ros::WallDuration(kRefreshPeriod),
                               [this](const ros::WallTimerEvent&) { publish(); });
}

void MarkersNode::onScenario(const std_msgs::String& message) {
  craft_.clear();
  still_.clear();
  scenario_ = hovercraft::Scenario();
  try {
    const hovercraft::Scenario scenario =
        hovercraft::parseScenario(message.data, {handle_.resolveName("scenario"), "", {}});
    for (const hovercraft::VehicleScenario& description : scenario.vehicles) watch(description);
    scenario_ = scenario;
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
        craft->path.extend(pose.pose.position, pose.header.stamp);
      };
  const boost::function<void(const hovercraft_sim::State&)> on_state =
      [craft](const hovercraft_sim::State& state) {
        craft->path.enter(state.episode, state.header.stamp);
      };
  const boost::function<void(const hovercraft_sim::EngineStatus&)> on_engines =
      [craft](const hovercraft_sim::EngineStatus& engines) { craft->engines = engines; };
  craft->subscribers = {
      own.subscribe<geometry_msgs::PoseStamped>(kPoseTopic, kDisplayQueue, on_pose),
      own.subscribe<hovercraft_sim::State>(kStateTopic, kDisplayQueue, on_state),
      own.subscribe<hovercraft_sim::EngineStatus>(kEnginesTopic, kDisplayQueue, on_engines)};
  if (!description.cushion) return;
  const boost::function<void(const hovercraft_sim::Cushion&)> on_cushion =
      [craft](const hovercraft_sim::Cushion& cushion) { craft->cushion = cushion; };
  craft->subscribers.push_back(
      own.subscribe<hovercraft_sim::Cushion>(kCushionTopic, kDisplayQueue, on_cushion));
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

void MarkersNode::publish() {
  if (publisher_.getNumSubscribers() == 0) return;
  visualization_msgs::MarkerArray array;
  for (const auto& craft : craft_) {
    if (craft->world_frame.empty()) continue;  // no pose yet: tf does not know the craft
    const std::string prefix = prefixOf(craft->engines.header.frame_id, craft->description.name);
    if (still_.empty() || still_prefix_ != prefix) makeStill(craft->world_frame, prefix);
    std::vector<visualization_msgs::Marker> fixed = craftMarkers(craft->description);
    append(fixed, thrustMarkers(craft->description, craft->engines));
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
