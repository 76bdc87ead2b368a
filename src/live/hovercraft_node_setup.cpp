#include <rosgraph_msgs/Clock.h>
#include <utility>

#include <nav_msgs/OccupancyGrid.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/analysis/occupancy.h"
#include "hovercraft_sim/live/hovercraft_node.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/view/robot_description.h"

/// What a node advertises, and what it tells who subscribes; hovercraft_node.cpp has what it does.

namespace hovercraft_ros {
namespace {

constexpr std::uint32_t kContactQueue = 10000;  // every contact belongs in a recording
constexpr std::uint32_t kBodyQueue = 10;
constexpr std::uint32_t kTransformQueue = 100;
constexpr std::uint32_t kStatesQueue = 100;  // as the states of each craft
constexpr std::uint32_t kEventQueue = 1000;  // every event belongs in a recording
constexpr std::uint32_t kTelemetryQueue = 10;
constexpr std::uint32_t kClockQueue = 10;

/// ROS time of tick 0: 0 where this node makes the time, else the wall time of its start.
std::int64_t epochOf(const NodeConfig& config) {
  return config.clock ? 0 : static_cast<std::int64_t>(ros::WallTime::now().toNSec());
}

ClockSource clockOn(ros::NodeHandle handle, double rate) {
  // Latched: a node that starts while the simulation is paused learns the time as well.
  const ros::Publisher publisher =
      handle.advertise<rosgraph_msgs::Clock>("/clock", kClockQueue, true);
  const auto publish = [publisher](const ros::Time& stamp) {
    rosgraph_msgs::Clock clock;
    clock.clock = stamp;
    publisher.publish(clock);
  };
  return {publish, rate};
}

}  // namespace

HovercraftNode::HovercraftNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                               NodeConfig config)
    : config_(std::move(config)),
      run_(config_.scenario, epochOf(config_)),
      lockstep_(config_.scenario.vehicles.size()),
      paused_(config_.paused),
      reported_drops_(config_.scenario.vehicles.size()),
      reported_saturations_(config_.scenario.vehicles.size()),
      diagnostics_(handle, private_handle) {
  ros::NodeHandle own(private_handle);
  for (std::size_t i = 0; i < config_.scenario.vehicles.size(); ++i) addVehicle(handle, i);
  run_.simulation().observe(this);
  bodies_ = bodyMessages(config_.scenario, config_.frames);
  for (std::size_t i = 0; i < bodies_.size(); ++i) addBody(handle, i);
  if (config_.scenario.world) {
    contacts_ = own.advertise<hovercraft_sim::Contact>("contacts", kContactQueue);
  }
  addSensors(handle);
  advertiseTransforms(handle);
  advertiseStates(own);
  scenario_ = own.advertise<std_msgs::String>("scenario", 1, true);
  events_ = own.advertise<hovercraft_sim::RunEvent>("events", kEventQueue);
  telemetry_ = own.advertise<hovercraft_sim::Telemetry>("telemetry", kTelemetryQueue);
  if (config_.clock) clock_.emplace(clockOn(handle, config_.clock_rate));
  publishConstants();
  if (config_.map_height) publishMap(handle);
  graph_watch_.emplace(handle, claims());
  addReports(own);
  setRealTimeFactor(config_.real_time_factor);
}

void HovercraftNode::applied(const hovercraft::Command& command) {
  vehicles_[command.vehicle]->publishApplied(command);
}

void HovercraftNode::contact(const hovercraft::ContactEvent& event) {
  if (!contacts_.isHeard()) return contacts_.skip();
  contacts_.publish(toMessage(event, run_.epochNs(), run_.episode(), config_.frames.world));
}

void HovercraftNode::sample(const hovercraft::SensorSample& sample) {
  sensors_->publish(sample);
}

void HovercraftNode::addVehicle(const ros::NodeHandle& handle, std::size_t vehicle) {
  const auto accept = [this](const hovercraft::Command& command,
                             const std::optional<ros::Time>& stamp) {
    return this->accept(command, stamp);
  };
  // In lockstep the states are latched: a controller answers only those that are waited at.
  const auto stands = [this] { return !config_.lockstep && this->stands(); };
  const hovercraft::VehicleScenario& craft = config_.scenario.vehicles[vehicle];
  ros::NodeHandle(handle, craft.name).setParam(kRobotDescription, urdfOf(craft, config_.frames));
  vehicles_.push_back(std::make_unique<VehicleInterface>(
      handle, run_, vehicle, config_.frames,
      VehicleInterface::Owner{accept, stands, config_.truth_odom}, config_.lockstep));
}

void HovercraftNode::addBody(const ros::NodeHandle& handle, std::size_t body) {
  ros::NodeHandle space(handle, bodies_[body].name());
  const auto present = [this, body]() -> const geometry_msgs::PoseStamped* {
    if (!stands()) return nullptr;
    bodies_[body].fill(run_.simulation(), run_.headerStamp());
    return &bodies_[body].pose();
  };
  body_poses_.emplace_back(space, kPoseTopic, kBodyQueue, present);
}

void HovercraftNode::addSensors(const ros::NodeHandle& handle) {
  if (run_.simulation().sensors() == nullptr) return;
  // Where the truth has another name, a stack that listens to odom finds the noisy one.
  const bool is_renamed = config_.truth_odom != kOdomTopic;
  sensors_.emplace(handle, run_, config_.frames, is_renamed ? kOdomTopic : kOdometryTopic,
                   config_.lockstep);
}

void HovercraftNode::advertiseTransforms(ros::NodeHandle handle) {
  const auto present = [this]() -> const tf2_msgs::TFMessage* {
    if (!stands()) return nullptr;
    MessageParts parts;
    parts.frames = true;
    for (const auto& vehicle : vehicles_) vehicle->refresh(parts);
    for (BodyMessages& body : bodies_) body.fill(run_.simulation(), run_.headerStamp());
    gatherTransforms();
    return &transforms_message_;
  };
  transforms_ = {handle, "/tf", kTransformQueue, present};
}

void HovercraftNode::advertiseStates(ros::NodeHandle& own) {
  states_message_.header.frame_id = config_.frames.world;
  states_message_.names = hovercraft::vehicleNames(config_.scenario);
  states_message_.states.resize(vehicles_.size());
  const auto present = [this]() -> const hovercraft_sim::States* {
    if (config_.lockstep || !stands()) return nullptr;
    MessageParts parts;
    parts.state = true;
    for (const auto& vehicle : vehicles_) vehicle->refresh(parts);
    gatherStates();
    return &states_message_;
  };
  states_ = {own, kStatesTopic, kStatesQueue, present, config_.lockstep};
}

void HovercraftNode::addReports(ros::NodeHandle& own) {
  using Status = diagnostic_updater::DiagnosticStatusWrapper;
  diagnostics_.setHardwareID("none");
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    diagnostics_.add(vehicles_[i]->messages().name() + ": commands",
                     [this, i](Status& status) { reportCommands(status, i); });
  }
  diagnostics_.add("pace", [this](Status& status) { toDiagnostics(telemetry_message_, status); });
  diagnostics_.add("other nodes", [this](Status& status) { graph_watch_->report(status); });
  report_timer_ = own.createWallTimer(ros::WallDuration(config_.diagnostic_period),
                                      [this](const ros::WallTimerEvent&) { report(); });
}

/// What nobody else may publish.
Claims HovercraftNode::claims() const {
  Claims claims;
  claims.clock = config_.clock;
  claims.topics.insert(states_.topic());
  for (const auto& vehicle : vehicles_) {
    for (const std::string& topic : vehicle->topics()) claims.topics.insert(topic);
    if (vehicle->messages().tf() != hovercraft::TfSource::kNone) {
      claims.frames.insert(vehicle->messages().transform().child_frame_id);
    }
    for (const auto& frame : vehicle->messages().engineFrames(run_.stampOf(1))) {
      claims.frames.insert(frame.child_frame_id);
    }
  }
  if (sensors_) {
    for (const std::string& topic : sensors_->topics()) claims.topics.insert(topic);
    for (const auto& frame : sensors_->frames()) claims.frames.insert(frame.child_frame_id);
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    claims.topics.insert(body_poses_[i].topic());
    claims.frames.insert(bodies_[i].transform().child_frame_id);
  }
  return claims;
}

void HovercraftNode::publishMap(ros::NodeHandle handle) {
  hovercraft::OccupancyRequest request;
  request.height = *config_.map_height;
  request.resolution = config_.map_resolution;
  const hovercraft::OccupancyMap map = hovercraft::occupancyOf(config_.scenario, request);
  nav_msgs::OccupancyGrid grid;
  grid.header.frame_id = config_.frames.world;
  grid.header.stamp = run_.stampOf(1);
  grid.info.map_load_time = grid.header.stamp;
  grid.info.resolution = static_cast<float>(map.resolution);
  grid.info.width = static_cast<std::uint32_t>(map.width);
  grid.info.height = static_cast<std::uint32_t>(map.height);
  grid.info.origin.position.x = map.origin_x;
  grid.info.origin.position.y = map.origin_y;
  grid.info.origin.orientation.w = 1.0;
  grid.data = map.cells;
  map_ = handle.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
  map_.publish(grid);
}

void HovercraftNode::publishConstants() {
  std_msgs::String text;
  text.data = hovercraft::toYaml(config_.scenario);
  scenario_.publish(text);
  std::vector<geometry_msgs::TransformStamped> frames;
  for (const auto& vehicle : vehicles_) {
    const auto engines = vehicle->messages().engineFrames(run_.stampOf(1));
    frames.insert(frames.end(), engines.begin(), engines.end());
  }
  if (sensors_) {
    const auto sensor_frames = sensors_->frames();
    frames.insert(frames.end(), sensor_frames.begin(), sensor_frames.end());
  }
  static_transforms_.sendTransform(frames);
}

}  // namespace hovercraft_ros
