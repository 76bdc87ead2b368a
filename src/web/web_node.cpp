#include "hovercraft_sim/web/web_node.h"

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/post.hpp>
#include <chrono>
#include <fmt/format.h>
#include <utility>

#include <ros/console.h>
#include <ros/init.h>
#include <ros/spinner.h>

#include "hovercraft_sim/io/steady_clock.h"

namespace hovercraft_ros {
namespace {

// How often it looks for news and for drivers that fell silent: with DriverSeats::kDeadManNs less
// than 0.3 s.
constexpr std::chrono::milliseconds kTick{10};
constexpr double kSecondNs = 1e9;

SharedText shared(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

boost::asio::ip::tcp::endpoint endpointOf(const WebConfig& config) {
  return {boost::asio::ip::make_address(config.address), config.port};
}

}  // namespace

WebNode::WebNode(const ros::NodeHandle& handle, const WebConfig& config)
    : server_(io_, endpointOf(config), config.access, {static_cast<std::size_t>(config.viewers)},
              {[this](ViewerId id) { open(id); },
               [this](ViewerId id, const std::string& text) { hear(id, text); },
               [this](ViewerId id) { close(id); }}),
      timer_(io_),
      period_ns_(static_cast<std::int64_t>(kSecondNs / config.rate)),
      link_(handle, config.simulation) {}

WebNode::~WebNode() = default;

void WebNode::run() {
  ros::AsyncSpinner spinner(1);
  spinner.start();
  tick();
  io_.run();
  spinner.stop();
}

void WebNode::tick() {
  if (!ros::ok()) {
    server_.stop();
    io_.stop();
    return;
  }
  stopCraft();
  const std::int64_t now_ns = hovercraft::steadyNow();
  // Half a tick early is nearer than half a tick late.
  const std::int64_t slack_ns = std::chrono::nanoseconds(kTick).count() / 2;
  if (now_ns - last_news_ns_ >= period_ns_ - slack_ns) {
    last_news_ns_ = now_ns;
    showNews();
  }
  timer_.expires_after(kTick);
  timer_.async_wait([this](const boost::system::error_code& error) {
    if (!error) tick();
  });
}

void WebNode::stopCraft() {
  const std::int64_t now_ns = hovercraft::steadyNow();
  if (seats_.lapse(now_ns)) showSeats();
  for (const std::size_t craft : seats_.takeStops(now_ns)) {
    std::map<std::string, double> levels;
    for (const CraftControl& control : scene_->controls[craft]) {
      if (!control.holds) levels[control.name] = 0.0;
    }
    link_.drive(craft, levels);
  }
}

void WebNode::showNews() {
  server_.dropStalled();
  showScene();
  showPace();
  const auto state = link_.takeState();
  if (!state || !scene_) return;
  state_text_ = shared(stateMessage(*state));
  server_.sendStateToAll(state_text_);
}

void WebNode::showScene() {
  const auto scene = link_.takeScene();
  if (!scene) return;
  scene_ = scene;
  scene_text_ = shared(scene->message);
  state_text_.reset();
  craft_.clear();
  for (const auto& vehicle : scene->scenario.vehicles) craft_.push_back(vehicle.name);
  seats_ = DriverSeats(craft_.size());
  server_.sendToAll(scene_text_);
  showSeats();
}

void WebNode::showPace() {
  const std::string pace = paceMessage(link_.pace());
  if (pace == shown_pace_) return;
  shown_pace_ = pace;
  server_.sendToAll(shared(pace));
}

void WebNode::showSeats() {
  server_.sendToAll(shared(seatsMessage(seats_, craft_, viewers())));
}

std::vector<Viewer> WebNode::viewers() const {
  std::vector<Viewer> viewers;
  viewers.reserve(names_.size());
  for (const auto& [id, name] : names_) viewers.push_back({id, name});
  return viewers;
}

std::string WebNode::nameOf(ViewerId id) const {
  const auto found = names_.find(id);
  return found == names_.end() ? "somebody who has left" : found->second;
}

std::optional<std::size_t> WebNode::craftNamed(const std::string& name) const {
  const auto found = std::find(craft_.begin(), craft_.end(), name);
  if (found == craft_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - craft_.begin());
}

void WebNode::open(ViewerId id) {
  names_[id] = "viewer " + std::to_string(id);
  server_.send(id, shared(helloMessage({id, names_[id]})));
  if (scene_text_) server_.send(id, scene_text_);
  server_.send(id, shared(paceMessage(link_.pace())));
  if (state_text_) server_.send(id, state_text_);
  showSeats();
}

void WebNode::close(ViewerId id) {
  names_.erase(id);
  seats_.leaveAll(id);
  stopCraft();
  showSeats();
}

void WebNode::noteTo(ViewerId id, const std::string& text) {
  server_.send(id, shared(noteMessage(text, true)));
}

void WebNode::hear(ViewerId id, const std::string& text) {
  const auto message = parseClientMessage(text);
  if (!message) {
    noteTo(id, "a message that is not one of doc/web.md");
    return;
  }
  std::visit([&](const auto& each) { act(id, each); }, *message);
}

void WebNode::act(ViewerId id, const DriveMessage& message) {
  const auto craft = craftNamed(message.craft);
  if (!craft) return noteTo(id, "there is no such craft");
  const std::vector<CraftControl>& controls = scene_->controls[*craft];
  for (const auto& demand : message.levels) {
    const std::string& name = demand.first;
    const bool is_known =
        std::any_of(controls.begin(), controls.end(),
                    [&](const CraftControl& control) { return control.name == name; });
    if (!is_known) return noteTo(id, "the craft has no such actuator");
  }
  // Not said: he may have lost the seat while this was on its way.
  if (!seats_.drive(*craft, id, hovercraft::steadyNow())) return;
  if (!message.levels.empty()) link_.drive(*craft, message.levels);
}

void WebNode::act(ViewerId id, const SeatMessage& message) {
  const auto craft = craftNamed(message.craft);
  if (!craft) return noteTo(id, "there is no such craft");
  if (message.take) {
    if (!seats_.take(*craft, id, hovercraft::steadyNow())) {
      noteTo(id, nameOf(*seats_.driver(*craft)) + " drives " + craft_[*craft]);
    }
  } else {
    seats_.leave(*craft, id);
    stopCraft();
  }
  showSeats();
}

SimulationLink::Answer WebNode::answerTo(ViewerId id, const std::string& deed) {
  return [this, id, deed](const std::string& failure) {
    boost::asio::post(io_, [this, id, deed, failure] {
      if (failure.empty()) {
        showPace();
        server_.sendToAll(shared(noteMessage(nameOf(id) + " " + deed, false)));
      } else {
        noteTo(id, failure);
      }
    });
  };
}

namespace {
constexpr const char* kBusy = "too much is asked for already";
}  // namespace

void WebNode::act(ViewerId id, const PauseMessage& message) {
  const char* const deed = message.paused ? "paused the run" : "resumed the run";
  if (!link_.setPaused(message.paused, answerTo(id, deed))) noteTo(id, kBusy);
}

void WebNode::act(ViewerId id, const StepMessage& message) {
  const std::string deed = fmt::format("made {} steps", message.steps);
  if (!link_.step(message.steps, answerTo(id, deed))) noteTo(id, kBusy);
}

void WebNode::act(ViewerId id, const ResetMessage& message) {
  const std::string deed =
      message.seed ? fmt::format("reset the run, seed {}", *message.seed) : "reset the run";
  if (!link_.reset(message.seed, answerTo(id, deed))) noteTo(id, kBusy);
}

void WebNode::act(ViewerId id, const PaceMessage& message) {
  const std::string deed = fmt::format("set the real-time factor to {:.9g}", message.factor);
  if (!link_.setPace(message.factor, answerTo(id, deed))) noteTo(id, kBusy);
}

void WebNode::act(ViewerId id, const NameMessage& message) {
  const bool is_blank = message.name.find_first_not_of(' ') == std::string::npos;
  names_[id] = is_blank ? "viewer " + std::to_string(id) : message.name;
  showSeats();
}

}  // namespace hovercraft_ros
