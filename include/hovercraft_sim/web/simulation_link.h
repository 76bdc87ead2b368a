#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <geometry_msgs/PoseStamped.h>
#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/RunEvent.h>
#include <hovercraft_sim/State.h>
#include <hovercraft_sim/Telemetry.h>
#include <hovercraft_sim/ThrustCommand.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/web/craft_controls.h"
#include "hovercraft_sim/web/server_messages.h"

namespace hovercraft_ros {

/// A scenario as it was received, and what is made of it once.
struct LiveScene {
  hovercraft::Scenario scenario;
  std::vector<std::vector<CraftControl>> controls;  // of each craft
  std::string message;                              // sceneMessage()
};

/// What the simulation says, as it is now, and what is asked of it. Of each craft it hears `state`
/// alone, and `commands` and events, which come only when somebody does something: that is what it
/// costs the simulation, however many viewers there are.
///
/// Messages are taken by ROS's threads, and read from another one. Services are called one after
/// the other, by a thread of its own: whoever asks waits for nothing.
class HOVERCRAFT_PUBLIC SimulationLink {
 public:
  /// Receives why something that was asked for did not happen; empty: it did. Called by the thread
  /// of the services.
  using Answer = std::function<void(const std::string& failure)>;

  /// @param simulation its node, relative to the handle.
  SimulationLink(const ros::NodeHandle& handle, const std::string& simulation);
  SimulationLink(const SimulationLink&) = delete;
  SimulationLink& operator=(const SimulationLink&) = delete;
  ~SimulationLink();

  /// A scenario that has come since the last call.
  std::shared_ptr<const LiveScene> takeScene();
  /// The state, if there is a newer one than at the last call.
  [[nodiscard]] std::optional<LiveState> takeState();
  LivePace pace() const;

  /// @returns false if too much is asked for already.
  bool setPaused(bool paused, Answer answer);
  bool step(std::uint32_t steps, Answer answer);
  bool reset(std::optional<std::int64_t> seed, Answer answer);
  bool setPace(double factor, Answer answer);

  /// Commands actuators of one craft; the others keep their last commands. @param levels finite, by
  /// names that the craft has.
  void drive(std::size_t craft, const std::map<std::string, double>& levels);

 private:
  /// The node takes an ActuatorCommand only of a craft that has other actuators than engines.
  struct CraftCommands {
    ros::Publisher publisher;
    bool has_engines_only = true;
    hovercraft_sim::ThrustCommand thrusts;  // that were sent last
  };

  void hearScenario(const std_msgs::String& message);
  void subscribeTo(const LiveScene& scene);
  void subscribeToStates(const hovercraft::Scenario& scenario);
  void hearEvent();
  void hearState(std::size_t craft, const hovercraft_sim::State& state);
  void hearCommand(std::size_t craft, const hovercraft_sim::AppliedCommand& command);
  void hearPose(std::size_t body, const geometry_msgs::PoseStamped& pose);
  void hearTelemetry(const hovercraft_sim::Telemetry& telemetry);
  bool ask(std::function<std::string()> call, Answer answer);
  void callServices();
  template <class Service>
  HOVERCRAFT_HIDDEN std::string call(const char* name, Service& service) const;

  ros::NodeHandle handle_;
  std::string simulation_;
  mutable std::mutex mutex_;  // of everything down to the next line
  std::shared_ptr<const LiveScene> scene_;
  bool has_new_scene_ = false;
  LiveState state_;
  bool has_new_state_ = false;
  LivePace pace_;
  std::int64_t heard_ns_ = 0;  // of the last telemetry, steady clock
  std::vector<CraftCommands> commands_;

  std::vector<ros::Subscriber> subscribers_;  // of the scenario's craft; ROS's thread alone
  std::vector<ros::Subscriber> states_;
  ros::Subscriber scenario_;
  ros::Subscriber events_;
  ros::Subscriber telemetry_;

  std::mutex asked_mutex_;
  std::condition_variable has_work_;
  std::deque<std::function<void()>> asked_;
  bool is_over_ = false;
  std::thread caller_;
};

}  // namespace hovercraft_ros
