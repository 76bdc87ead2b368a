#include "hovercraft_sim/web/web_server.h"

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <stdexcept>
#include <utility>
#include <vector>

#include <ros/console.h>

#include "hovercraft_sim/io/steady_clock.h"
#include "hovercraft_sim/report/front_end.h"
#include "hovercraft_sim/web/viewer_connection.h"

namespace hovercraft_ros {

namespace beast = boost::beast;
namespace http = boost::beast::http;
using boost::asio::ip::tcp;

namespace {

constexpr std::chrono::seconds kRequestTime{10};
constexpr std::uint32_t kMostHeaderBytes = 8192;
constexpr std::chrono::milliseconds kAcceptPause{100};  // where no more files can be opened

RequestHead headOf(const ViewerConnection::Request& request) {
  RequestHead head;
  head.method = std::string(request.method_string());
  head.target = std::string(request.target());
  for (const auto& field : request) {
    if (field.name() == http::field::host) head.hosts.emplace_back(field.value());
    if (field.name() == http::field::origin) head.origins.emplace_back(field.value());
  }
  head.is_upgrade = beast::websocket::is_upgrade(request);
  return head;
}

http::status statusOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPage:
    case Verdict::kScript:
      return http::status::ok;
    case Verdict::kWrongHost:
    case Verdict::kWrongOrigin:
      return http::status::forbidden;
    case Verdict::kWrongToken:
      return http::status::unauthorized;
    case Verdict::kWrongMethod:
      return http::status::method_not_allowed;
    case Verdict::kNotFound:
      return http::status::not_found;
    case Verdict::kSocket:  // there is no room
      return http::status::service_unavailable;
    case Verdict::kBadRequest:
      break;
  }
  return http::status::bad_request;
}

const char* reasonOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::kWrongHost:
      return "Host is not localhost, an address, or one of ~hosts\n";
    case Verdict::kWrongOrigin:
      return "Origin is another site\n";
    case Verdict::kWrongToken:
      return "the token is missing or wrong: open /#token=TOKEN\n";
    case Verdict::kWrongMethod:
      return "GET only\n";
    case Verdict::kNotFound:
      return "there are / and /report.js\n";
    case Verdict::kSocket:
      return "too many viewers\n";
    default:
      return "no request that is known here\n";
  }
}

using Response = http::response<http::string_body>;

/// @param host as the request named this server; it was looked at.
void addPolicy(Response& response, const std::string& host) {
  response.set("Content-Security-Policy",
               "default-src 'none'; script-src 'self'; style-src 'unsafe-inline'; img-src data: "
               "blob:; connect-src 'self' ws://" +
                   host + " wss://" + host +
                   "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
  response.set("X-Frame-Options", "DENY");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set(http::field::cache_control, "no-store");
}

Response responseTo(const ViewerConnection::Request& request, Verdict verdict) {
  Response response(statusOf(verdict), 11);
  response.set(http::field::content_type, "text/plain; charset=utf-8");
  response.keep_alive(false);
  if (verdict == Verdict::kPage) {
    response.set(http::field::content_type, "text/html; charset=utf-8");
    response.body() = frontEndLivePage();
  } else if (verdict == Verdict::kScript) {
    response.set(http::field::content_type, "text/javascript; charset=utf-8");
    response.body() = frontEndScript();
  } else {
    response.body() = reasonOf(verdict);
  }
  const bool is_known = verdict != Verdict::kWrongHost && verdict != Verdict::kBadRequest;
  addPolicy(response, is_known ? std::string(request[http::field::host]) : "localhost");
  response.prepare_payload();
  if (request.method() == http::verb::head) response.body().clear();
  return response;
}

/// One request, and its answer: a page, a refusal, or a WebSocket.
class RequestConnection : public std::enable_shared_from_this<RequestConnection> {
 public:
  RequestConnection(tcp::socket&& socket, WebServer& server, std::shared_ptr<std::size_t> count)
      : stream_(std::move(socket)), server_(server), count_(std::move(count)) {
    ++*count_;
    parser_.header_limit(kMostHeaderBytes);
    parser_.body_limit(0);
  }
  RequestConnection(const RequestConnection&) = delete;
  RequestConnection& operator=(const RequestConnection&) = delete;
  ~RequestConnection() { --*count_; }

  void read() {
    stream_.expires_after(kRequestTime);
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](const beast::error_code& error, std::size_t) {
                       if (!error) self->answer();
                     });
  }

 private:
  void answer() {
    request_ = parser_.release();
    const Verdict verdict = verdictOn(headOf(request_), server_.rules());
    if (verdict == Verdict::kSocket && server_.hasRoomForViewer()) {
      std::make_shared<ViewerConnection>(std::move(stream_), server_)->accept(request_);
      return;
    }
    response_ = responseTo(request_, verdict);
    http::async_write(stream_, response_,
                      [self = shared_from_this()](const beast::error_code&, std::size_t) {
                        beast::error_code gone;
                        tcp::socket& socket = self->stream_.socket();
                        if (socket.shutdown(tcp::socket::shutdown_send, gone))
                          self->stream_.close();
                      });
  }

  beast::tcp_stream stream_;
  WebServer& server_;
  std::shared_ptr<std::size_t> count_;
  beast::flat_buffer buffer_;
  http::request_parser<http::empty_body> parser_;
  ViewerConnection::Request request_;
  Response response_;
};

}  // namespace

WebServer::WebServer(boost::asio::io_context& io, const tcp::endpoint& endpoint, AccessRules rules,
                     Limits limits, ViewerEvents events)
    : io_(io),
      acceptor_(io),
      rules_(std::move(rules)),
      limits_(limits),
      events_(std::move(events)) {
  try {
    acceptor_.open(endpoint.protocol());
    acceptor_.set_option(boost::asio::socket_base::reuse_address(true));
    acceptor_.bind(endpoint);
    acceptor_.listen(boost::asio::socket_base::max_listen_connections);
  } catch (const boost::system::system_error& error) {
    throw std::runtime_error("cannot listen on " + endpoint.address().to_string() + " port " +
                             std::to_string(endpoint.port()) + ": " + error.code().message());
  }
  accept();
}

WebServer::~WebServer() = default;

std::uint16_t WebServer::port() const {
  return acceptor_.local_endpoint().port();
}

void WebServer::accept() {
  acceptor_.async_accept([this](const beast::error_code& error, tcp::socket socket) {
    if (error == boost::asio::error::operation_aborted || !acceptor_.is_open()) return;
    if (error) {
      const auto pause = std::make_shared<boost::asio::steady_timer>(io_, kAcceptPause);
      pause->async_wait([this, pause](const beast::error_code&) {
        if (acceptor_.is_open()) accept();
      });
      return;
    }
    // One too many is closed at once.
    if (*requests_ < kMostRequests) {
      std::make_shared<RequestConnection>(std::move(socket), *this, requests_)->read();
    }
    accept();
  });
}

ViewerId WebServer::open(const std::shared_ptr<ViewerConnection>& viewer) {
  const ViewerId id = ++last_;
  viewers_.emplace(id, viewer);
  events_.on_open(id);
  return id;
}

void WebServer::close(ViewerId viewer) {
  if (viewers_.erase(viewer) > 0) events_.on_close(viewer);
}

void WebServer::send(ViewerId viewer, const SharedText& text) {
  const auto found = viewers_.find(viewer);
  if (found != viewers_.end()) found->second->send(text);
}

void WebServer::sendToAll(const SharedText& text) {
  for (const auto& [id, viewer] : viewers_) viewer->send(text);
}

void WebServer::sendStateToAll(const SharedText& text) {
  for (const auto& [id, viewer] : viewers_) viewer->sendState(text);
}

void WebServer::dropStalled() {
  const std::int64_t now_ns = hovercraft::steadyNow();
  for (const auto& [id, viewer] : viewers_) {
    if (viewer->isStalled(now_ns)) viewer->drop();
  }
}

void WebServer::stop() {
  beast::error_code error;
  if (acceptor_.close(error)) ROS_WARN_STREAM("the port stays open: " << error.message());
  for (const auto& [id, viewer] : viewers_) viewer->drop();
}

}  // namespace hovercraft_ros
