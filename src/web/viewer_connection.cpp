#include "hovercraft_sim/web/viewer_connection.h"

#include <boost/asio/post.hpp>
#include <boost/asio/socket_base.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/error.hpp>
#include <boost/beast/http/field.hpp>
#include <chrono>

#include "hovercraft_sim/io/steady_clock.h"
#include "hovercraft_sim/web/client_message.h"

namespace hovercraft_ros {

namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;

namespace {

// s: a handshake, and the answer to a ping, may take so long.
constexpr std::chrono::seconds kHandshake{10};
constexpr std::chrono::seconds kSilence{20};
// B, of the kernel: who takes nothing is noticed soon.
constexpr int kSendBuffer = 131072;

}  // namespace

ViewerConnection::ViewerConnection(beast::tcp_stream&& stream, WebServer& server)
    : stream_(std::move(stream)),
      server_(server),
      rate_(WebServer::kMessagesPerSecond, WebServer::kMessageBurst) {}

void ViewerConnection::accept(const Request& request) {
  beast::error_code gone;
  auto& socket = beast::get_lowest_layer(stream_).socket();
  if (socket.set_option(boost::asio::socket_base::send_buffer_size(kSendBuffer), gone)) return;
  if (socket.set_option(boost::asio::ip::tcp::no_delay(true), gone)) return;
  beast::get_lowest_layer(stream_).expires_never();  // the stream has time-outs of its own
  stream_.set_option(websocket::stream_base::timeout{kHandshake, kSilence, true});
  stream_.read_message_max(kMostMessageBytes);
  stream_.control_callback([this](websocket::frame_type, beast::string_view) {
    if (!isWithinRate()) drop();
  });
  stream_.text(true);
  stream_.async_accept(request, [self = shared_from_this()](const beast::error_code& error) {
    self->onAccepted(error);
  });
}

void ViewerConnection::onAccepted(const beast::error_code& error) {
  if (error) return;
  if (!server_.hasRoomForViewer()) {  // others were quicker
    refuse(websocket::close_code::try_again_later, "too many viewers");
    return;
  }
  id_ = server_.open(shared_from_this());
  read();
}

bool ViewerConnection::isWithinRate() {
  return rate_.take(hovercraft::steadyNow());
}

void ViewerConnection::read() {
  stream_.async_read(buffer_, [self = shared_from_this()](const beast::error_code& error,
                                                          std::size_t) { self->onRead(error); });
}

void ViewerConnection::onRead(const beast::error_code& error) {
  if (error || is_closing_) {
    end();
    return;
  }
  // After a refusal nothing is read: Beast's close does that, and a read beside it that fails
  // waits for the close, as the close waits for it.
  if (!isWithinRate()) {
    refuse(websocket::close_code::policy_error, "too many messages");
    return;
  }
  if (!stream_.got_text()) {
    refuse(websocket::close_code::unknown_data, "text only");
    return;
  }
  const std::string text = beast::buffers_to_string(buffer_.data());
  buffer_.consume(buffer_.size());
  server_.hear(id_, text);
  read();
}

void ViewerConnection::refuse(websocket::close_code code, const char* reason) {
  if (is_closing_) return;
  is_closing_ = true;
  closing_since_ns_ = hovercraft::steadyNow();
  stream_.async_close({code, reason},
                      [self = shared_from_this()](const beast::error_code&) { self->end(); });
}

void ViewerConnection::send(const SharedText& text) {
  if (is_closing_) return;
  if (waiting_.size() == WebServer::kMostWaiting) {
    drop();
    return;
  }
  waiting_.push_back(text);
  writeNext();
}

void ViewerConnection::sendState(const SharedText& text) {
  if (is_closing_) return;
  state_ = text;
  writeNext();
}

void ViewerConnection::writeNext() {
  if (writing_ || is_closing_) return;
  if (!waiting_.empty()) {
    writing_ = std::move(waiting_.front());
    waiting_.pop_front();
  } else if (state_) {
    writing_ = std::move(state_);
    state_.reset();
  } else {
    return;
  }
  write_began_ns_ = hovercraft::steadyNow();
  stream_.async_write(boost::asio::buffer(*writing_),
                      [self = shared_from_this()](const beast::error_code& error, std::size_t) {
                        self->onWritten(error);
                      });
}

void ViewerConnection::onWritten(const beast::error_code& error) {
  writing_.reset();
  if (error) {
    drop();
    return;
  }
  writeNext();
}

bool ViewerConnection::isStalled(std::int64_t now_ns) const {
  const bool is_stuck = writing_ && now_ns - write_began_ns_ > WebServer::kStallNs;
  return is_stuck || (is_closing_ && now_ns - closing_since_ns_ > WebServer::kStallNs);
}

void ViewerConnection::drop() {
  is_closing_ = true;
  closing_since_ns_ = hovercraft::steadyNow();
  waiting_.clear();
  state_.reset();
  beast::get_lowest_layer(stream_).close();  // what is being read or written ends with an error
  boost::asio::post(stream_.get_executor(), [self = shared_from_this()] { self->end(); });
}

void ViewerConnection::end() {
  is_closing_ = true;
  if (id_ == 0) return;
  const ViewerId id = id_;
  id_ = 0;
  server_.close(id);
}

}  // namespace hovercraft_ros
