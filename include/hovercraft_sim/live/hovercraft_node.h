#pragma once

#include <csignal>
#include <cstdint>
#include <diagnostic_updater/diagnostic_updater.h>
#include <memory>
#include <optional>
#include <string>
#include <tf2_msgs/TFMessage.h>
#include <vector>

#include <hovercraft_sim/RunEvent.h>
#include <hovercraft_sim/States.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/wall_timer.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "hovercraft_sim/live/clock_source.h"
#include "hovercraft_sim/live/command_schedule.h"
#include "hovercraft_sim/live/graph_watch.h"
#include "hovercraft_sim/live/live_run.h"
#include "hovercraft_sim/live/newcomer_publisher.h"
#include "hovercraft_sim/live/node_config.h"
#include "hovercraft_sim/live/pace_report.h"
#include "hovercraft_sim/live/sensor_interface.h"
#include "hovercraft_sim/live/topic_publisher.h"
#include "hovercraft_sim/live/vehicle_interface.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/messages/body_messages.h"
#include "hovercraft_sim/pacing/lockstep.h"
#include "hovercraft_sim/pacing/pacer.h"
#include "hovercraft_sim/pacing/warning_limiter.h"
#include "hovercraft_sim/sim/run_observer.h"

namespace hovercraft_ros {

/// The simulation behind ROS topics. One thread, the caller of run(), handles callbacks and steps
/// the world; between steps it waits on the callback queue, so that a message or a service is
/// handled at once, also while the simulation is paused. It wakes for the ticks that something is
/// published at, and makes the steps before them together.
class HOVERCRAFT_PUBLIC HovercraftNode : private hovercraft::RunObserver {
 public:
  /// @param handle of the namespace that the craft's namespaces lie in. @param private_handle the
  /// node's own.
  HovercraftNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                 NodeConfig config);

  /// Steps at the wanted pace until ROS is shut down, or the node is told to stop.
  void run();
  /// From a signal handler: run() returns as soon as what it does is done, and stepPaused() breaks
  /// off.
  static void stop() { is_stopped = 1; }

  // Control, from callbacks of run()'s thread.
  /// Makes the steps that are due by now. The node sleeps through steps that nobody can see; a
  /// callback that looks or changes something comes after this, and finds what would be there had
  /// each been made in its time. A node that is behind its pace makes a slice of its backlog only.
  void catchUp();
  void pause() { paused_ = true; }
  void resume();
  bool isPaused() const { return paused_; }
  const NodeConfig& config() const { return config_; }
  const LiveRun& liveRun() const { return run_; }
  /// @param wanted one that breaks isRealTimeFactor() is refused with a warning.
  /// @returns the factor that the node has now.
  double changeRealTimeFactor(double wanted);
  /// Takes commands that act at ticks to come. @param commands of ticks that are not past.
  void schedule(const std::vector<hovercraft::Command>& commands) { schedule_.add(commands); }
  /// Steps now, whatever the pace. @throws std::runtime_error if the node is shut down meanwhile.
  void stepPaused(std::uint32_t steps);
  /// Applies and publishes an event. @throws std::invalid_argument as applyEvent(); nothing has
  /// changed then.
  void apply(const hovercraft_sim::RunEvent& event);

 private:
  void applied(const hovercraft::Command& command) override;
  void contact(const hovercraft::ContactEvent& event) override;
  void sample(const hovercraft::SensorSample& sample) override;
  static bool goesOn();
  void addVehicle(const ros::NodeHandle& handle, std::size_t vehicle);
  void addBody(const ros::NodeHandle& handle, std::size_t body);
  void addSensors(const ros::NodeHandle& handle);
  void addReports(ros::NodeHandle& own);
  void advertiseTransforms(ros::NodeHandle handle);
  void advertiseStates(ros::NodeHandle& own);
  Claims claims() const;
  void publishConstants();
  void publishMap(ros::NodeHandle handle);
  void setRealTimeFactor(double real_time_factor);
  void restartPace();
  bool stands() const;
  bool isIdle() const { return paused_ || lockstep_.awaited().has_value(); }
  const char* accept(hovercraft::Command command, const std::optional<ros::Time>& stamp);
  hovercraft::Tick nextVisibleTick() const;
  bool mayMeetBefore(hovercraft::Tick tick) const;
  std::int64_t waitNs(std::int64_t now_ns) const;
  void advance();
  bool isStepDue(std::int64_t now_ns) const;
  void stepOnce();
  void pushScheduled();
  void awaitCommands();
  void gatherTransforms();
  void gatherStates();
  void publishState();
  void noticeSilence(std::int64_t now_ns);
  void report();
  void reportCommands(diagnostic_updater::DiagnosticStatusWrapper& status, std::size_t vehicle);

  static volatile std::sig_atomic_t is_stopped;
  NodeConfig config_;
  LiveRun run_;
  hovercraft::Lockstep lockstep_;
  CommandSchedule schedule_;
  std::optional<hovercraft::Pacer> pacer_;  // none: as fast as it can
  std::optional<ClockSource> clock_;
  bool paused_;
  std::vector<std::unique_ptr<VehicleInterface>> vehicles_;
  std::vector<BodyMessages> bodies_;                                       // loose ones
  std::vector<NewcomerPublisher<geometry_msgs::PoseStamped>> body_poses_;  // of each
  std::optional<SensorInterface> sensors_;
  TopicPublisher contacts_;
  ros::Publisher map_;
  ros::Publisher scenario_, events_, telemetry_;
  NewcomerPublisher<tf2_msgs::TFMessage> transforms_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  tf2_msgs::TFMessage transforms_message_;
  NewcomerPublisher<hovercraft_sim::States> states_;
  hovercraft_sim::States states_message_;
  std::optional<GraphWatch> graph_watch_;

  PaceReport pace_;
  hovercraft_sim::Telemetry telemetry_message_;
  std::int64_t waiting_since_ns_ = 0;  // for the commands of a lockstep period
  std::int64_t answered_ns_ = 0;       // when the last of them came
  hovercraft::WarningLimiter behind_warnings_;
  hovercraft::WarningLimiter silence_warnings_;
  std::uint64_t reported_stalls_ = 0;
  std::vector<std::uint64_t> reported_drops_;
  std::vector<std::uint64_t> reported_saturations_;
  diagnostic_updater::Updater diagnostics_;
  ros::WallTimer report_timer_;
};

}  // namespace hovercraft_ros
