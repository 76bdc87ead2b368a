#pragma once

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>

#include "hovercraft_sim/web/rate_limiter.h"
#include "hovercraft_sim/web/web_server.h"

namespace hovercraft_ros {

/// One viewer's WebSocket.
class ViewerConnection : public std::enable_shared_from_this<ViewerConnection> {
 public:
  using Request = boost::beast::http::request<boost::beast::http::empty_body>;

  /// @param server outlives the connection.
  ViewerConnection(boost::beast::tcp_stream&& stream, WebServer& server);

  /// Answers the request that asks for a WebSocket, and begins to read.
  void accept(const Request& request);
  void send(const SharedText& text);
  /// Replaces a state that still waits.
  void sendState(const SharedText& text);
  /// Whether what is being sent, or a close, has not been taken for WebServer::kStallNs.
  bool isStalled(std::int64_t now_ns) const;
  /// At once, without a word.
  void drop();

 private:
  void onAccepted(const boost::beast::error_code& error);
  void read();
  void onRead(const boost::beast::error_code& error);
  void writeNext();
  void onWritten(const boost::beast::error_code& error);
  /// Says why, and closes.
  void refuse(boost::beast::websocket::close_code code, const char* reason);
  void end();
  bool isWithinRate();

  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  WebServer& server_;
  boost::beast::flat_buffer buffer_;
  RateLimiter rate_;
  std::deque<SharedText> waiting_;
  SharedText state_;    // waits
  SharedText writing_;  // is being sent
  std::int64_t write_began_ns_ = 0;
  std::int64_t closing_since_ns_ = 0;
  ViewerId id_ = 0;  // 0: not open
  bool is_closing_ = false;
};

}  // namespace hovercraft_ros
