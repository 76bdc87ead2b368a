#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <ros/node_handle.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/web/client_message.h"
#include "hovercraft_sim/web/driver_seats.h"
#include "hovercraft_sim/web/simulation_link.h"
#include "hovercraft_sim/web/web_config.h"
#include "hovercraft_sim/web/web_server.h"

namespace hovercraft_ros {

/// Between viewers and a simulation: tells them what it says, and asks of it what they ask for. One
/// thread runs it; ROS and the services have theirs (SimulationLink).
class HOVERCRAFT_PUBLIC WebNode {
 public:
  /// Listens from now on. @param handle of the namespace that the simulation lies in.
  /// @throws std::runtime_error if the port cannot be had.
  WebNode(const ros::NodeHandle& handle, const WebConfig& config);
  WebNode(const WebNode&) = delete;
  WebNode& operator=(const WebNode&) = delete;
  ~WebNode();

  /// Until ROS is to stop.
  void run();
  std::uint16_t port() const { return server_.port(); }

 private:
  void open(ViewerId id);
  void close(ViewerId id);
  void hear(ViewerId id, const std::string& text);

  void act(ViewerId id, const DriveMessage& message);
  void act(ViewerId id, const SeatMessage& message);
  void act(ViewerId id, const PauseMessage& message);
  void act(ViewerId id, const StepMessage& message);
  void act(ViewerId id, const ResetMessage& message);
  void act(ViewerId id, const PaceMessage& message);
  void act(ViewerId id, const NameMessage& message);
  /// Tells everybody what one has done, or him alone why it failed.
  SimulationLink::Answer answerTo(ViewerId id, const std::string& deed);
  void noteTo(ViewerId id, const std::string& text);

  void tick();
  void showNews();
  void showScene();
  void stopCraft();
  void showSeats();
  void showPace();
  [[nodiscard]] std::optional<std::size_t> craftNamed(const std::string& name) const;
  std::string nameOf(ViewerId id) const;
  std::vector<Viewer> viewers() const;

  boost::asio::io_context io_;
  WebServer server_;
  boost::asio::steady_timer timer_;
  std::int64_t period_ns_;  // from state to state
  std::int64_t last_news_ns_ = 0;
  std::map<ViewerId, std::string> names_;
  std::shared_ptr<const LiveScene> scene_;
  SharedText scene_text_;
  SharedText state_text_;  // the last one, for newcomers
  std::vector<std::string> craft_;
  DriverSeats seats_{0};
  std::string shown_pace_;
  SimulationLink link_;  // its threads end first
};

}  // namespace hovercraft_ros
