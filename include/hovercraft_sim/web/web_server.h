#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/web/access.h"
#include "hovercraft_sim/web/driver_seats.h"

namespace hovercraft_ros {

class ViewerConnection;

/// A text that goes to several viewers: kept once.
using SharedText = std::shared_ptr<const std::string>;

/// What becomes of viewers. Called from the io_context.
struct ViewerEvents {
  std::function<void(ViewerId)> on_open;
  std::function<void(ViewerId, const std::string& text)> on_text;  // within rate and size
  std::function<void(ViewerId)> on_close;  // whoever closed; not again after it
};

/// Serves the page and its WebSocket on one port. Nothing that it hands out comes from a file.
/// One thread: that which runs the io_context.
///
/// A viewer that takes nothing for kStallNs, that answers no ping, or that asks for more than its
/// rate allows is dropped. Nobody waits for one: of states that he has not taken yet only the
/// newest is kept, and of other messages kMostWaiting.
class HOVERCRAFT_PUBLIC WebServer {
 public:
  static constexpr std::size_t kMostWaiting = 64;
  static constexpr std::int64_t kStallNs = 5000000000;
  static constexpr double kMessagesPerSecond = 100.0;
  static constexpr double kMessageBurst = 200.0;
  /// Requests that are no viewers, at once.
  static constexpr std::size_t kMostRequests = 32;

  struct Limits {
    std::size_t viewers = 16;
  };

  /// Listens. @throws std::runtime_error that names the address and the port if it cannot.
  WebServer(boost::asio::io_context& io, const boost::asio::ip::tcp::endpoint& endpoint,
            AccessRules rules, Limits limits, ViewerEvents events);
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;
  ~WebServer();

  std::uint16_t port() const;
  void send(ViewerId viewer, const SharedText& text);
  void sendToAll(const SharedText& text);
  /// Of several that wait the last one replaces those before.
  void sendStateToAll(const SharedText& text);
  /// Drops who has taken nothing for too long. To be called several times a second.
  void dropStalled();
  std::size_t viewers() const { return viewers_.size(); }
  /// Closes everything.
  void stop();

  // For the connections:
  const AccessRules& rules() const { return rules_; }
  bool hasRoomForViewer() const { return viewers_.size() < limits_.viewers; }
  ViewerId open(const std::shared_ptr<ViewerConnection>& viewer);
  void close(ViewerId viewer);
  void hear(ViewerId viewer, const std::string& text) { events_.on_text(viewer, text); }

 private:
  void accept();

  boost::asio::io_context& io_;
  boost::asio::ip::tcp::acceptor acceptor_;
  AccessRules rules_;
  Limits limits_;
  ViewerEvents events_;
  std::map<ViewerId, std::shared_ptr<ViewerConnection>> viewers_;
  std::shared_ptr<std::size_t> requests_ = std::make_shared<std::size_t>(0);
  ViewerId last_ = 0;
};

}  // namespace hovercraft_ros
