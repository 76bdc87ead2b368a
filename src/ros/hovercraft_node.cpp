#include "hovercraft_sim/ros/hovercraft_node.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/sim/scenario_parser.h"

namespace hovercraft_ros {
namespace {

constexpr double kRealTimeFactor = 1.0;
constexpr double kDiagnosticPeriod = 1.0;  // s of wall time

std::int64_t steadyNow() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

double toMicroseconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) * 1e-3;
}

}  // namespace

HovercraftNode::HovercraftNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                               NodeConfig config)
    : config_(std::move(config)),
      simulation_(config_.scenario),
      pacer_(config_.scenario.step_ns, kRealTimeFactor),
      diagnostics_(handle, private_handle) {
  const ros::WallTime wall = ros::WallTime::now();
  epoch_ = ros::Time(wall.sec, wall.nsec);
  for (std::size_t i = 0; i < config_.scenario.vehicles.size(); ++i) {
    vehicles_.push_back(std::make_unique<VehicleInterface>(
        handle, simulation_, i, config_.world_frame,
        [this](const hovercraft::Command& command) { simulation_.push(command); }));
    diagnostics_.add(config_.scenario.vehicles[i].name + ": commands",
                     [this, i](diagnostic_updater::DiagnosticStatusWrapper& status) {
                       reportCommands(status, i);
                     });
  }
  reported_drops_.resize(vehicles_.size());
  reported_saturations_.resize(vehicles_.size());
  simulation_.on_applied = [this](const hovercraft::Command& command) {
    vehicles_[command.vehicle]->publishApplied(command, stamp());
  };
  ros::NodeHandle own(private_handle);
  scenario_publisher_ = own.advertise<std_msgs::String>("scenario", 1, true);
  publishConstants();

  diagnostics_.setHardwareID("none");
  diagnostics_.add(
      "pace", [this](diagnostic_updater::DiagnosticStatusWrapper& status) { reportPace(status); });
  const double period = own.param("diagnostic_period", kDiagnosticPeriod);
  diagnostics_timer_ =
      own.createWallTimer(ros::WallDuration(period),
                          [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
}

void HovercraftNode::publishConstants() {
  std_msgs::String text;
  text.data = hovercraft::toYaml(config_.scenario);
  scenario_publisher_.publish(text);
  std::vector<geometry_msgs::TransformStamped> frames;
  for (const auto& vehicle : vehicles_) {
    const auto engines =
        vehicle->messages().engineFrames(stampOf(epoch_, config_.scenario.step_ns));
    frames.insert(frames.end(), engines.begin(), engines.end());
  }
  static_transforms_.sendTransform(frames);
}

void HovercraftNode::run() {
  pacer_.restart(simulation_.tick(), steadyNow());
  report_wall_ns_ = steadyNow();
  while (ros::ok()) {
    const std::int64_t wait = pacer_.deadline(simulation_.tick() + 1) - steadyNow();
    ros::WallDuration timeout;
    timeout.fromNSec(std::max<std::int64_t>(wait, 0));
    ros::getGlobalCallbackQueue()->callAvailable(timeout);
    advance();
  }
}

void HovercraftNode::advance() {
  std::int64_t now = steadyNow();
  const std::int64_t given_up = pacer_.giveUpBacklog(simulation_.tick() + 1, now);
  if (given_up > 0) {
    given_up_ns_ += given_up;
    ROS_WARN_THROTTLE(
        1.0, "The simulation falls behind real time: %.3f s given up since the last report",
        hovercraft::toSeconds(given_up_ns_));
  }
  // Only what is due now: steps that come due meanwhile wait until callbacks were handled.
  const std::int64_t due_until = now;
  while (pacer_.deadline(simulation_.tick() + 1) <= due_until) {
    stepOnce(now - pacer_.deadline(simulation_.tick() + 1));
    const std::int64_t after = steadyNow();
    step_times_.add(after - now);
    now = after;
  }
}

void HovercraftNode::stepOnce(std::int64_t lateness_ns) {
  lateness_.add(lateness_ns);
  if (lateness_ns > config_.scenario.step_ns) ++late_steps_;
  simulation_.step();
  if (simulation_.tick() % config_.publish_every == 0) publishState();
}

void HovercraftNode::publishState() {
  transform_batch_.clear();
  for (const auto& vehicle : vehicles_) {
    vehicle->publish(stamp());
    transform_batch_.push_back(vehicle->messages().transform());
  }
  transforms_.sendTransform(transform_batch_);
}

void HovercraftNode::reportPace(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::int64_t now = steadyNow();
  const auto simulated =
      static_cast<double>((simulation_.tick() - report_tick_) * config_.scenario.step_ns);
  const double factor =
      simulated / static_cast<double>(std::max<std::int64_t>(now - report_wall_ns_, 1));
  if (given_up_ns_ > 0) {
    status.summaryf(diagnostic_msgs::DiagnosticStatus::WARN, "Falls behind: %.3f s given up",
                    hovercraft::toSeconds(given_up_ns_));
  } else {
    status.summary(diagnostic_msgs::DiagnosticStatus::OK, "Keeps real time");
  }
  status.addf("Real-time factor", "%.4f", factor);
  status.addf("Step time p50 (us)", "%.2f", toMicroseconds(step_times_.quantile(0.5)));
  status.addf("Step time p99 (us)", "%.2f", toMicroseconds(step_times_.quantile(0.99)));
  status.addf("Lateness p50 (us)", "%.1f", toMicroseconds(lateness_.quantile(0.5)));
  status.addf("Lateness p99 (us)", "%.1f", toMicroseconds(lateness_.quantile(0.99)));
  status.addf("Lateness max (us)", "%.1f", toMicroseconds(lateness_.maximum()));
  status.add("Steps", step_times_.count());
  status.add("Late steps", late_steps_);
  status.addf("Wall time given up (s)", "%.3f", hovercraft::toSeconds(given_up_ns_));
  status.add("Tick", simulation_.tick());
  step_times_.clear();
  lateness_.clear();
  late_steps_ = 0;
  given_up_ns_ = 0;
  report_wall_ns_ = now;
  report_tick_ = simulation_.tick();
}

void HovercraftNode::reportCommands(diagnostic_updater::DiagnosticStatusWrapper& status,
                                    std::size_t vehicle) {
  const std::uint64_t drops = vehicles_[vehicle]->droppedCommands();
  const std::uint64_t saturations = vehicles_[vehicle]->saturatedCommands();
  bool timed_out = false;
  for (int engine = 0; engine < hovercraft::kEngineCount; ++engine) {
    const hovercraft::EngineReport report = simulation_.engineReport(vehicle, engine);
    timed_out = timed_out || report.timed_out;
    status.addf(std::string("Age of command, ") +
                    hovercraft::kEngineNames[static_cast<std::size_t>(engine)] + " (s)",
                "%.3f", report.command_age);
  }
  if (drops > reported_drops_[vehicle]) {
    status.summary(diagnostic_msgs::DiagnosticStatus::WARN, "Dropped commands that are not finite");
  } else if (saturations > reported_saturations_[vehicle]) {
    status.summary(diagnostic_msgs::DiagnosticStatus::WARN, "Saturated commands beyond the limits");
  } else {
    status.summary(diagnostic_msgs::DiagnosticStatus::OK, timed_out ? "Timed out" : "OK");
  }
  status.add("Dropped commands", drops);
  status.add("Saturated commands", saturations);
  reported_drops_[vehicle] = drops;
  reported_saturations_[vehicle] = saturations;
}

}  // namespace hovercraft_ros
