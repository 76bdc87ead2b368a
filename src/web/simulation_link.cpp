#include "hovercraft_sim/web/simulation_link.h"

#include <cmath>
#include <dynamic_reconfigure/Reconfigure.h>
#include <exception>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <std_srvs/Trigger.h>
#include <utility>

#include <hovercraft_sim/ActuatorCommand.h>
#include <hovercraft_sim/Reset.h>
#include <hovercraft_sim/Step.h>
#include <ros/console.h>
#include <ros/service.h>
#include <ros/transport_hints.h>

#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/io/steady_clock.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/vehicle_messages.h"
#include "hovercraft_sim/scenario/scenario_parser.h"

namespace hovercraft_ros {

using hovercraft::kEngineCount;

namespace {

constexpr double kUnheard = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kGoneNs = 4000000000;  // telemetry comes once a second
constexpr std::size_t kMostAsked = 8;
constexpr const char* kFactor = "real_time_factor";

/// The values of the engines that are built in, then those of the other actuators.
template <class Engines, class Levels>
std::vector<double> inOrder(const hovercraft::VehicleScenario& craft, const Engines& engines,
                            const Levels& levels) {
  std::vector<double> values;
  for (std::size_t i = 0; i < kEngineCount; ++i) {
    if (craft.has_engine[i]) values.push_back(engines[i]);
  }
  for (std::size_t i = 0; i < craft.actuators.size(); ++i) {
    values.push_back(i < levels.size() ? levels[i] : kUnheard);
  }
  return values;
}

hovercraft::Motion motionOf(const hovercraft_sim::State& state) {
  hovercraft::Motion motion{};
  motion.p_WB = fromMessage(state.pose.position);
  motion.q_WB = fromMessage(state.pose.orientation);
  motion.twist = {fromMessage(state.velocity), fromMessage(state.angular_velocity)};
  return motion;
}

}  // namespace

SimulationLink::SimulationLink(const ros::NodeHandle& handle, const std::string& simulation)
    : handle_(handle), simulation_(handle.resolveName(simulation)) {
  const boost::function<void(const std_msgs::String&)> on_scenario =
      [this](const std_msgs::String& message) { hearScenario(message); };
  scenario_ = handle_.subscribe<std_msgs::String>(simulation_ + "/scenario", 1, on_scenario);
  const boost::function<void(const hovercraft_sim::Telemetry&)> on_telemetry =
      [this](const hovercraft_sim::Telemetry& message) { hearTelemetry(message); };
  telemetry_ =
      handle_.subscribe<hovercraft_sim::Telemetry>(simulation_ + "/telemetry", 2, on_telemetry);
  const boost::function<void(const hovercraft_sim::RunEvent&)> on_event =
      [this](const hovercraft_sim::RunEvent&) { hearEvent(); };
  events_ = handle_.subscribe<hovercraft_sim::RunEvent>(simulation_ + "/events", 10, on_event);
  caller_ = std::thread([this] { callServices(); });
}

SimulationLink::~SimulationLink() {
  {
    const std::lock_guard<std::mutex> lock(asked_mutex_);
    is_over_ = true;
  }
  has_work_.notify_all();
  caller_.join();
}

void SimulationLink::hearScenario(const std_msgs::String& message) {
  try {
    const std::string source = simulation_ + "/scenario";
    auto scene = std::make_shared<LiveScene>();
    scene->scenario = hovercraft::parseScenario(message.data, {source, "", {}});
    for (const auto& craft : scene->scenario.vehicles) scene->controls.push_back(controlsOf(craft));
    scene->message = sceneMessage(scene->scenario, simulation_, message.data);
    subscribeTo(*scene);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      scene_ = scene;
      has_new_scene_ = true;
    }
    // Last: the first state comes at once, and once only where the run stands.
    subscribeToStates(scene->scenario);
  } catch (const std::exception& error) {
    ROS_ERROR("%s", error.what());
  }
}

void SimulationLink::subscribeTo(const LiveScene& scene) {
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  subscribers_.clear();
  std::vector<CraftCommands> commands;
  LiveState state;
  for (std::size_t i = 0; i < scene.scenario.vehicles.size(); ++i) {
    const hovercraft::VehicleScenario& craft = scene.scenario.vehicles[i];
    ros::NodeHandle space(handle_, craft.name);
    const boost::function<void(const hovercraft_sim::AppliedCommand&)> on_command =
        [this, i](const hovercraft_sim::AppliedCommand& message) { hearCommand(i, message); };
    CraftCommands of_craft;
    of_craft.has_engines_only = craft.actuators.empty();
    of_craft.publisher =
        of_craft.has_engines_only
            ? space.advertise<hovercraft_sim::ThrustCommand>(kThrustTopic, 10)
            : space.advertise<hovercraft_sim::ActuatorCommand>(kActuatorCommandTopic, 10);
    commands.push_back(of_craft);
    subscribers_.push_back(space.subscribe<hovercraft_sim::AppliedCommand>(
        kCommandsTopic, 10, on_command, ros::VoidConstPtr(), hints));
    LiveBody body;
    body.position = {kUnheard, kUnheard, kUnheard};
    body.applied.assign(scene.controls[i].size(), kUnheard);
    body.demanded = body.applied;
    state.craft.push_back(std::move(body));
  }
  if (scene.scenario.world) {
    for (std::size_t i = 0; i < scene.scenario.world->bodies.size(); ++i) {
      const boost::function<void(const geometry_msgs::PoseStamped&)> on_pose =
          [this, i](const geometry_msgs::PoseStamped& message) { hearPose(i, message); };
      subscribers_.push_back(handle_.subscribe<geometry_msgs::PoseStamped>(
          scene.scenario.world->bodies[i].name + "/" + kPoseTopic, 2, on_pose, ros::VoidConstPtr(),
          hints));
      LiveBody body;
      body.position = {kUnheard, kUnheard, kUnheard};
      state.bodies.push_back(std::move(body));
    }
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  commands_ = std::move(commands);
  state_ = std::move(state);
  has_new_state_ = false;
  scene_.reset();  // until the new one is there
}

void SimulationLink::subscribeToStates(const hovercraft::Scenario& scenario) {
  states_.clear();
  for (std::size_t i = 0; i < scenario.vehicles.size(); ++i) {
    const boost::function<void(const hovercraft_sim::State&)> on_state =
        [this, i](const hovercraft_sim::State& message) { hearState(i, message); };
    states_.push_back(handle_.subscribe<hovercraft_sim::State>(
        scenario.vehicles[i].name + "/" + kStateTopic, 2, on_state, ros::VoidConstPtr(),
        ros::TransportHints().tcpNoDelay()));
  }
}

/// A run that stands publishes nothing, but it greets newcomers with its state.
void SimulationLink::hearEvent() {
  std::shared_ptr<const LiveScene> scene;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (pace_.is_paused) scene = scene_;
  }
  if (scene) subscribeToStates(scene->scenario);
}

void SimulationLink::hearState(std::size_t craft, const hovercraft_sim::State& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!scene_ || craft >= state_.craft.size()) return;
  const hovercraft::VehicleScenario& description = scene_->scenario.vehicles[craft];
  const HullMotion hull = hullMotion(motionOf(message), description.mass_properties.p_HB);
  LiveBody& body = state_.craft[craft];
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    body.position[i] = hull.p_WH[axis];
    body.velocity[i] = hull.v_WH_H[axis];
    body.angular_velocity[i] = hull.w_WH_H[axis];
    body.orientation[i] = hull.q_WH.v[axis];
  }
  body.orientation[3] = hull.q_WH.s;
  body.applied = inOrder(description, message.thrust, message.actuators);
  if (message.episode != state_.episode) {
    for (LiveBody& each : state_.craft) each.demanded.assign(each.demanded.size(), kUnheard);
  }
  state_.tick = message.tick;
  state_.episode = message.episode;
  state_.time = static_cast<double>(message.tick) * scene_->scenario.stepSize();
  has_new_state_ = true;
}

void SimulationLink::hearCommand(std::size_t craft, const hovercraft_sim::AppliedCommand& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!scene_ || craft >= state_.craft.size()) return;
  const hovercraft::VehicleScenario& description = scene_->scenario.vehicles[craft];
  std::vector<double>& demanded = state_.craft[craft].demanded;
  const std::array<double, kEngineCount> thrusts = {message.rear, message.left, message.right};
  std::size_t place = 0;
  for (std::size_t i = 0; i < kEngineCount; ++i) {
    if (!description.has_engine[i]) continue;
    if ((message.engines & (1U << i)) != 0U) demanded[place] = thrusts[i];
    ++place;
  }
  for (std::size_t i = 0; i < message.ids.size() && i < message.values.size(); ++i) {
    const std::size_t at = place + message.ids[i] - kEngineCount;
    if (message.ids[i] >= kEngineCount && at < demanded.size()) demanded[at] = message.values[i];
  }
}

void SimulationLink::hearPose(std::size_t body, const geometry_msgs::PoseStamped& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (body >= state_.bodies.size()) return;
  const auto& [position, orientation] = std::tie(message.pose.position, message.pose.orientation);
  state_.bodies[body].position = {position.x, position.y, position.z};
  state_.bodies[body].orientation = {orientation.x, orientation.y, orientation.z, orientation.w};
}

void SimulationLink::hearTelemetry(const hovercraft_sim::Telemetry& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  heard_ns_ = hovercraft::steadyNow();
  pace_.is_there = true;
  pace_.is_paused = message.paused != 0;
  pace_.wanted = message.wanted_real_time_factor;
  pace_.reached = message.real_time_factor;
}

std::shared_ptr<const LiveScene> SimulationLink::takeScene() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!has_new_scene_) return nullptr;
  has_new_scene_ = false;
  return scene_;
}

std::optional<LiveState> SimulationLink::takeState() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!has_new_state_) return std::nullopt;
  has_new_state_ = false;
  return state_;
}

LivePace SimulationLink::pace() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  LivePace pace = pace_;
  pace.is_there = pace.is_there && hovercraft::steadyNow() - heard_ns_ < kGoneNs;
  return pace;
}

bool SimulationLink::ask(std::function<std::string()> call, Answer answer) {
  {
    const std::lock_guard<std::mutex> lock(asked_mutex_);
    if (asked_.size() >= kMostAsked) return false;
    asked_.emplace_back([call = std::move(call), answer = std::move(answer)] { answer(call()); });
  }
  has_work_.notify_one();
  return true;
}

void SimulationLink::callServices() {
  std::unique_lock<std::mutex> lock(asked_mutex_);
  while (!is_over_) {
    if (asked_.empty()) {
      has_work_.wait(lock);
      continue;
    }
    const std::function<void()> work = std::move(asked_.front());
    asked_.pop_front();
    lock.unlock();
    work();
    lock.lock();
  }
}

template <class Service>
std::string SimulationLink::call(const char* name, Service& service) const {
  const std::string whole = simulation_ + "/" + name;
  if (!ros::service::call(whole, service)) return whole + " does not answer";
  if (!service.response.success) return service.response.message;
  return "";
}

bool SimulationLink::setPaused(bool paused, Answer answer) {
  const auto work = [this, paused] {
    std_srvs::Trigger trigger;
    std::string failure = call(paused ? "pause" : "resume", trigger);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (failure.empty()) pace_.is_paused = paused;
    return failure;
  };
  return ask(work, std::move(answer));
}

bool SimulationLink::step(std::uint32_t steps, Answer answer) {
  const auto work = [this, steps] {
    hovercraft_sim::Step step;
    step.request.steps = steps;
    return call("step", step);
  };
  return ask(work, std::move(answer));
}

bool SimulationLink::reset(std::optional<std::int64_t> seed, Answer answer) {
  const auto work = [this, seed] {
    hovercraft_sim::Reset reset;
    reset.request.with_seed = static_cast<std::uint8_t>(seed.has_value());
    reset.request.seed = seed.value_or(0);
    return call("reset", reset);
  };
  return ask(work, std::move(answer));
}

bool SimulationLink::setPace(double factor, Answer answer) {
  const auto work = [this, factor]() -> std::string {
    dynamic_reconfigure::Reconfigure service;
    dynamic_reconfigure::DoubleParameter parameter;
    parameter.name = kFactor;
    parameter.value = factor;
    service.request.config.doubles.push_back(parameter);
    const std::string whole = simulation_ + "/set_parameters";
    if (!ros::service::call(whole, service)) return whole + " does not answer";
    for (const auto& set : service.response.config.doubles) {
      if (set.name != kFactor || set.value == factor) continue;
      return fmt::format("a real-time factor of {:.9g} is refused: must be 0 or 1e-6 to 1000",
                         factor);
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    pace_.wanted = factor;
    return "";
  };
  return ask(work, std::move(answer));
}

void SimulationLink::drive(std::size_t craft, const std::map<std::string, double>& levels) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (craft >= commands_.size()) return;
  CraftCommands& commands = commands_[craft];
  if (!commands.has_engines_only) {
    hovercraft_sim::ActuatorCommand message;
    for (const auto& [name, level] : levels) {
      message.names.push_back(name);
      message.values.push_back(level);
    }
    commands.publisher.publish(message);
    return;
  }
  // One message of it commands all engines.
  for (const auto& [name, level] : levels) {
    if (name == hovercraft::kEngineNames[0]) commands.thrusts.rear = level;
    if (name == hovercraft::kEngineNames[1]) commands.thrusts.left = level;
    if (name == hovercraft::kEngineNames[2]) commands.thrusts.right = level;
  }
  commands.publisher.publish(commands.thrusts);
}

}  // namespace hovercraft_ros
