#pragma once

#include <cstdint>
#include <diagnostic_updater/diagnostic_updater.h>
#include <memory>
#include <vector>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>
#include <ros/wall_timer.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include "hovercraft_sim/ros/duration_histogram.h"
#include "hovercraft_sim/ros/node_config.h"
#include "hovercraft_sim/ros/pacer.h"
#include "hovercraft_sim/ros/vehicle_interface.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft_ros {

/// The simulation behind ROS topics. One thread, the caller of run(), handles callbacks and steps
/// the world; between steps it waits on the callback queue, so that a message is handled at once.
class HovercraftNode {
 public:
  /// @param handle of the namespace that the craft's namespaces lie in. @param private_handle the
  /// node's own.
  HovercraftNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                 NodeConfig config);
  HovercraftNode(const HovercraftNode&) = delete;
  HovercraftNode& operator=(const HovercraftNode&) = delete;

  /// Steps at the pace of a steady clock until ROS is shut down.
  void run();

 private:
  void publishConstants();
  void advance();
  void stepOnce(std::int64_t lateness_ns);
  void publishState();
  void reportPace(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportCommands(diagnostic_updater::DiagnosticStatusWrapper& status, std::size_t vehicle);

  ros::Time stamp() const { return stampOf(epoch_, simulation_.timeNs()); }

  NodeConfig config_;
  hovercraft::Simulation simulation_;
  Pacer pacer_;
  ros::Time epoch_;  // of tick 0
  std::vector<std::unique_ptr<VehicleInterface>> vehicles_;
  ros::Publisher scenario_publisher_;
  tf2_ros::TransformBroadcaster transforms_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  std::vector<geometry_msgs::TransformStamped> transform_batch_;

  // Since the last diagnostic report.
  DurationHistogram step_times_;
  DurationHistogram lateness_;
  std::uint64_t late_steps_ = 0;
  std::int64_t given_up_ns_ = 0;
  std::int64_t report_wall_ns_ = 0;
  hovercraft::Tick report_tick_ = 0;
  std::vector<std::uint64_t> reported_drops_;
  std::vector<std::uint64_t> reported_saturations_;
  diagnostic_updater::Updater diagnostics_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace hovercraft_ros
