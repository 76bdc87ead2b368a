#include "hovercraft_sim/live/node_services.h"

#include <exception>
#include <functional>
#include <std_srvs/Trigger.h>
#include <stdexcept>
#include <string>

#include <hovercraft_sim/ApplyWrench.h>
#include <hovercraft_sim/Reset.h>
#include <hovercraft_sim/ScheduleCommands.h>
#include <hovercraft_sim/SetActuator.h>
#include <hovercraft_sim/SetState.h>
#include <hovercraft_sim/SetWind.h>
#include <hovercraft_sim/Snapshot.h>
#include <hovercraft_sim/Step.h>

#include "hovercraft_sim/messages/run_events.h"
#include "hovercraft_sim/sim/snapshot.h"

namespace hovercraft_ros {
namespace {

/// Bound on one ~step: an hour at 1 kHz. Whoever wants more asks again, and callbacks are served
/// between.
constexpr std::uint32_t kMostStepsAsked = 3600000;

template <class Service>
ros::ServiceServer serve(HovercraftNode& node, ros::NodeHandle& handle, const std::string& name,
                         const std::function<void(const typename Service::Request&,
                                                  typename Service::Response&)>& answer) {
  const boost::function<bool(typename Service::Request&, typename Service::Response&)> callback =
      [&node, answer](typename Service::Request& request, typename Service::Response& response) {
        try {
          node.catchUp();
          answer(request, response);
          response.success = 1;
        } catch (const std::exception& error) {
          response.success = 0;
          response.message = error.what();
        }
        return true;
      };
  return handle.advertiseService(name, callback);
}

template <class Response>
void tellTickAndHash(const LiveRun& run, Response& response) {
  response.tick = static_cast<std::uint64_t>(run.simulation().tick());
  response.episode = run.episode();
  response.hash = run.simulation().hash();
}

void step(HovercraftNode& node, const hovercraft_sim::Step::Request& request) {
  if (!node.isPaused()) throw std::invalid_argument("the simulation must be paused first: ~pause");
  if (node.config().lockstep) {
    throw std::invalid_argument("in lockstep it is the commands that move the simulation: ~resume");
  }
  if (request.steps > kMostStepsAsked) {
    throw std::invalid_argument("steps = " + std::to_string(request.steps) + ": must be at most " +
                                std::to_string(kMostStepsAsked));
  }
  node.stepPaused(request.steps);
}

}  // namespace

NodeServices::NodeServices(const ros::NodeHandle& private_handle, HovercraftNode& node)
    : node_(node) {
  ros::NodeHandle own(private_handle);
  serveTime(own);
  serveEvents(own);
  serveStates(own);
}

void NodeServices::serveTime(ros::NodeHandle& own) {
  servers_.push_back(serve<std_srvs::Trigger>(
      node_, own, "pause", [this](const auto& /*request*/, auto& /*response*/) { node_.pause(); }));
  servers_.push_back(serve<std_srvs::Trigger>(
      node_, own, "resume",
      [this](const auto& /*request*/, auto& /*response*/) { node_.resume(); }));
  servers_.push_back(
      serve<hovercraft_sim::Step>(node_, own, "step", [this](const auto& request, auto& response) {
        step(node_, request);
        tellTickAndHash(node_.liveRun(), response);
      }));
  servers_.push_back(serve<hovercraft_sim::ScheduleCommands>(
      node_, own, "schedule", [this](const auto& request, auto& response) {
        const hovercraft::Tick tick = node_.liveRun().simulation().tick();
        response.tick = static_cast<std::uint64_t>(tick);
        response.episode = node_.liveRun().episode();
        const NodeConfig& config = node_.config();
        if (config.lockstep) {
          response.control_period = static_cast<std::uint64_t>(config.control_period);
        }
        node_.schedule(scheduledCommands(config.scenario, request, response.episode, tick));
      }));
}

void NodeServices::serveEvents(ros::NodeHandle& own) {
  servers_.push_back(serve<hovercraft_sim::SetState>(
      node_, own, "set_state", [this](const auto& request, auto& response) {
        node_.apply(setStateEvent(node_.config().scenario, request));
        response.tick = static_cast<std::uint64_t>(node_.liveRun().simulation().tick());
      }));
  servers_.push_back(serve<hovercraft_sim::ApplyWrench>(
      node_, own, "apply_wrench", [this](const auto& request, auto& response) {
        const hovercraft::Tick tick = node_.liveRun().simulation().tick();
        const auto event =
            applyWrenchEvent(node_.config().scenario, request, node_.config().frames, tick);
        node_.apply(event);
        response.tick = static_cast<std::uint64_t>(tick);
        response.end_tick = event.end_tick;
      }));
  servers_.push_back(serve<hovercraft_sim::SetWind>(
      node_, own, "set_wind", [this](const auto& request, auto& response) {
        node_.apply(setWindEvent(request));
        response.tick = static_cast<std::uint64_t>(node_.liveRun().simulation().tick());
      }));
  servers_.push_back(serve<hovercraft_sim::SetActuator>(
      node_, own, "set_actuator", [this](const auto& request, auto& response) {
        node_.apply(setActuatorEvent(node_.config().scenario, request));
        response.tick = static_cast<std::uint64_t>(node_.liveRun().simulation().tick());
      }));
}

void NodeServices::serveStates(ros::NodeHandle& own) {
  servers_.push_back(serve<hovercraft_sim::Reset>(
      node_, own, "reset", [this](const auto& request, auto& response) {
        const bool with_seed = request.with_seed != 0;
        node_.apply(resetEvent(with_seed ? request.seed : node_.config().scenario.seed));
        response.episode = node_.liveRun().episode();
        response.hash = node_.liveRun().simulation().hash();
      }));
  servers_.push_back(serve<hovercraft_sim::Snapshot>(
      node_, own, "save", [this](const auto& request, auto& response) {
        hovercraft::saveSnapshot(node_.liveRun().simulation(), request.file);
        tellTickAndHash(node_.liveRun(), response);
      }));
  servers_.push_back(serve<hovercraft_sim::Snapshot>(
      node_, own, "load", [this](const auto& request, auto& response) {
        const std::string text = hovercraft::readSnapshotText(request.file);  // it names the file
        try {
          node_.apply(loadEvent(text));
        } catch (const std::invalid_argument& error) {
          throw std::invalid_argument(request.file + ": " + error.what());
        }
        tellTickAndHash(node_.liveRun(), response);
      }));
}

}  // namespace hovercraft_ros
