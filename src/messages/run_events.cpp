#include "hovercraft_sim/messages/run_events.h"

#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <vector>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/scenario/air_parser.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/sim/command_source.h"
#include "hovercraft_sim/sim/request_rules.h"
#include "hovercraft_sim/sim/snapshot.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Vector3;
using hovercraft_sim::RunEvent;

void require(bool holds, const std::string& rule) {
  if (!holds) throw std::invalid_argument(rule);
}

void requireFinite(const Vector3& v, const char* name) {
  require(v.allFinite(), fmt::format("{}: must be finite", name));
}

void requirePlanar(const hovercraft::Quaternion& q, const Vector3& v_H, const Vector3& w_H) {
  require(q.v.x() == 0.0 && q.v.y() == 0.0,
          "pose.orientation: the model is planar: x and y must be 0 (yaw only)");
  require(v_H.z() == 0.0, "twist.linear: the model is planar: z must be 0");
  require(w_H.x() == 0.0 && w_H.y() == 0.0,
          "twist.angular: the model is planar: x and y must be 0");
}

/// @throws std::invalid_argument if it is none.
Vector3 windOf(const RunEvent& event) {
  require(isWind(event), kWindRuleText);
  return {event.values[0], event.values[1], event.values[2]};
}

/// The id of the actuator of a fault. @throws std::invalid_argument with the names there are.
std::size_t actuatorIndex(const hovercraft::VehicleScenario& craft, const std::string& name) {
  const auto id = hovercraft::actuatorIdOf(craft, name);
  if (id) return *id;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < hovercraft::kFirstActuator + craft.actuators.size(); ++i) {
    if (i >= hovercraft::kFirstActuator || craft.has_engine[i]) {
      names.push_back(hovercraft::actuatorName(craft, i));
    }
  }
  throw std::invalid_argument(
      fmt::format("name = {}: must be one of: {}", name, fmt::join(names, ", ")));
}

}  // namespace

bool isWind(const RunEvent& event) {
  const auto& wind = event.values;
  return event.name == "wind" && wind.size() == 3 &&
         hovercraft::canBeWind(Vector3(wind[0], wind[1], wind[2]));
}

bool isFault(const RunEvent& event) {
  const auto& fault = event.values;
  return !event.name.empty() && fault.size() == 2 && fault[0] >= 0.0 && fault[0] <= 1.0 &&
         (fault[1] == 0.0 || fault[1] == 1.0);
}

RunEvent resetEvent(std::int64_t seed) {
  RunEvent event;
  event.kind = RunEvent::RESET;
  event.seed = seed;
  return event;
}

RunEvent loadEvent(const std::string& snapshot) {
  RunEvent event;
  event.kind = RunEvent::LOAD;
  event.snapshot = snapshot;
  return event;
}

RunEvent setStateEvent(const hovercraft::Scenario& scenario,
                       const hovercraft_sim::SetState::Request& request) {
  const hovercraft::FloatingPointEnvironment environment;
  const std::size_t vehicle = vehicleIndex(scenario, request.vehicle);
  const Vector3 p_WH = fromMessage(request.pose.position);
  const hovercraft::Quaternion q_WH = fromMessage(request.pose.orientation);
  const Vector3 v_H = fromMessage(request.twist.linear);
  const Vector3 w_H = fromMessage(request.twist.angular);
  requireFinite(p_WH, "pose.position");
  hovercraft::requireSettable({v_H, w_H}, {"twist.linear", "twist.angular"});
  require(
      std::abs(hovercraft::norm(q_WH) - 1.0) <= hovercraft::kUnitLength,
      fmt::format("pose.orientation: must have length 1 (it has {:.6g})", hovercraft::norm(q_WH)));
  if (scenario.model == hovercraft::BodyModel::kPlanar) requirePlanar(q_WH, v_H, w_H);

  const hovercraft::Matrix3 R_WH = hovercraft::rotationMatrix(hovercraft::normalized(q_WH));
  const Vector3 p_HB_W = hovercraft::times(R_WH, scenario.vehicles[vehicle].mass_properties.p_HB);
  const Vector3 w_W = hovercraft::times(R_WH, w_H);
  RunEvent event;
  event.kind = RunEvent::SET_STATE;
  event.vehicle = request.vehicle;
  event.pose.position = toPointMessage(p_WH + p_HB_W);
  event.pose.orientation = request.pose.orientation;
  event.twist.linear =
      toVector3Message(hovercraft::times(R_WH, v_H) + hovercraft::cross(w_W, p_HB_W));
  event.twist.angular = toVector3Message(w_W);
  return event;
}

RunEvent applyWrenchEvent(const hovercraft::Scenario& scenario,
                          const hovercraft_sim::ApplyWrench::Request& request,
                          const TfFrames& frames, hovercraft::Tick tick) {
  vehicleIndex(scenario, request.vehicle);
  hovercraft::requireApplicable(
      {fromMessage(request.wrench.force), fromMessage(request.wrench.torque)}, scenario.model,
      {"wrench.force", "wrench.torque"});
  const std::string base_frame = frames.of(request.vehicle);
  require(
      request.frame_id == frames.world || request.frame_id == base_frame,
      fmt::format("frame_id = {}: must be {} or {}", request.frame_id, frames.world, base_frame));
  const std::int64_t duration_ns = request.duration.toNSec();
  require(duration_ns > 0, "duration: must be greater than 0");
  RunEvent event;
  event.kind = RunEvent::APPLY_WRENCH;
  event.vehicle = request.vehicle;
  event.wrench = request.wrench;
  event.in_body_axes = static_cast<std::uint8_t>(request.frame_id == base_frame ? 1 : 0);
  event.end_tick =
      static_cast<std::uint64_t>(tick + hovercraft::firstTickAt(duration_ns, scenario.step_ns));
  return event;
}

RunEvent setWindEvent(const hovercraft_sim::SetWind::Request& request) {
  RunEvent event;
  event.kind = kSetWind;
  event.name = "wind";
  event.values = {request.wind.x, request.wind.y, request.wind.z};
  windOf(event);
  return event;
}

RunEvent setActuatorEvent(const hovercraft::Scenario& scenario,
                          const hovercraft_sim::SetActuator::Request& request) {
  const std::size_t vehicle = vehicleIndex(scenario, request.vehicle);
  actuatorIndex(scenario.vehicles[vehicle], request.name);
  require(request.efficiency >= 0.0 && request.efficiency <= 1.0,
          fmt::format("efficiency = {}: must be 0 to 1", request.efficiency));
  RunEvent event;
  event.kind = kSetActuator;
  event.vehicle = request.vehicle;
  event.name = request.name;
  event.values = {request.efficiency, request.stuck != 0 ? 1.0 : 0.0};
  return event;
}

namespace {

void setActuator(const RunEvent& event, hovercraft::Simulation& simulation) {
  require(isFault(event), kFaultRuleText);
  const hovercraft::Scenario& scenario = simulation.scenario();
  const std::size_t vehicle = vehicleIndex(scenario, event.vehicle);
  simulation.setActuator(vehicle, actuatorIndex(scenario.vehicles[vehicle], event.name),
                         event.values[0], event.values[1] != 0.0);
}

void setMotion(const RunEvent& event, hovercraft::Simulation& simulation) {
  const std::size_t vehicle = vehicleIndex(simulation.scenario(), event.vehicle);
  const Vector3 p_WB = fromMessage(event.pose.position);
  const hovercraft::Quaternion q_WB = fromMessage(event.pose.orientation);
  const hovercraft::Twist twist = {fromMessage(event.twist.linear),
                                   fromMessage(event.twist.angular)};
  require(p_WB.cwiseAbs().maxCoeff() <= hovercraft::kFarthest,
          "pose.position: must be at most 1e30 m, of either sign");
  const hovercraft::Motion motion = simulation.motionAfterSetting(vehicle, p_WB, q_WB, twist);
  require(motion.momentum_W.allFinite() && motion.angular_momentum_W.allFinite() &&
              std::isfinite(motion.energy),
          "pose, twist: the momenta and the energy must be finite");
  if (const auto overlap = simulation.overlapAt(vehicle, p_WB, q_WB)) {
    throw std::invalid_argument(
        fmt::format("pose: {} and {} would overlap by {:.3g} m: must be apart", overlap->a,
                    overlap->b, overlap->depth));
  }
  simulation.setMotion(vehicle, p_WB, q_WB, twist);
}

void load(const RunEvent& event, hovercraft::Simulation& simulation, bool may_be_older) {
  const auto state =
      hovercraft::parseSnapshot(event.snapshot, "snapshot", simulation.scenario(), may_be_older);
  // A live command takes effect at once, so none can stand before it that takes effect later.
  for (const hovercraft::Command& command : state.commands.waiting()) {
    require(command.tick == state.tick,
            fmt::format("snapshot: commands: tick = {}: must be that of the snapshot, {}",
                        command.tick, state.tick));
  }
  simulation.restore(state);
}

}  // namespace

void applyEvent(const RunEvent& event, hovercraft::Simulation& simulation, bool may_be_older) {
  const hovercraft::FloatingPointEnvironment environment;
  const hovercraft::Scenario& scenario = simulation.scenario();
  switch (event.kind) {
    case RunEvent::RESET:
      simulation.reset(event.seed);
      return;
    case RunEvent::LOAD:
      load(event, simulation, may_be_older);
      return;
    case RunEvent::SET_STATE:
      setMotion(event, simulation);
      return;
    case RunEvent::APPLY_WRENCH: {
      using Frame = hovercraft::ExternalWrench::Frame;
      simulation.applyWrench({vehicleIndex(scenario, event.vehicle),
                              event.in_body_axes != 0 ? Frame::kBody : Frame::kWorld,
                              {fromMessage(event.wrench.force), fromMessage(event.wrench.torque)},
                              static_cast<hovercraft::Tick>(event.end_tick)});
      return;
    }
    case kSetWind:
      simulation.setWind(windOf(event));
      return;
    case kSetActuator:
      setActuator(event, simulation);
      return;
    default:
      throw std::invalid_argument(fmt::format("kind = {}: is no event that is known", event.kind));
  }
}

}  // namespace hovercraft_ros
