#include "hovercraft_sim/python/stepped_simulation.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/python/command_list.h"
#include "hovercraft_sim/scenario/air_parser.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/request_rules.h"
#include "hovercraft_sim/sim/run.h"
#include "hovercraft_sim/sim/snapshot.h"

namespace hovercraft_python {

using hovercraft::Quaternion;
using hovercraft::Vector3;

namespace {

/// Steps between two looks at whether a call is to end.
constexpr std::int64_t kStepsPerLook = 4096;

void require(bool holds, const std::string& rule) {
  if (!holds) throw std::invalid_argument(rule);
}

Vector3 asVector(const Triple& values) {
  return {values[0], values[1], values[2]};
}

void requirePlanar(const Quaternion& q, const Vector3& v, const Vector3& w) {
  require(q.v.x() == 0.0 && q.v.y() == 0.0,
          "orientation: the model is planar: x and y must be 0 (yaw only)");
  require(v.z() == 0.0, "velocity: the model is planar: z must be 0");
  require(w.x() == 0.0 && w.y() == 0.0, "angular_velocity: the model is planar: x and y must be 0");
}

}  // namespace

/// A call has the simulation for itself.
class SteppedSimulation::Lock : public CallLock {
 public:
  explicit Lock(SteppedSimulation& of)
      : CallLock(of.mutex_, "the simulation is stepping: a signal handler must leave it alone") {}
};

SteppedSimulation::SteppedSimulation(ScenarioPointer scenario, std::optional<std::int64_t> seed)
    : scenario_(std::move(scenario)), simulation_(*scenario_) {
  if (seed) simulation_.reset(*seed);
}

void SteppedSimulation::requireTime(std::int64_t count) const {
  const auto most = static_cast<std::int64_t>(hovercraft::kMaxNanoseconds) / scenario_->step_ns;
  require(count >= 0, fmt::format("n = {}: must be 0 or greater", count));
  require(count <= most - simulation_.tick(),
          fmt::format("n = {}: must not go beyond {:.0f} s", count,
                      hovercraft::kMaxNanoseconds * 1e-9));
}

void SteppedSimulation::step(std::int64_t count, const Interrupt& interrupt) {
  const Lock lock(*this);
  requireTime(count);
  for (std::int64_t i = 0; i < count; ++i) {
    if (i % kStepsPerLook == kStepsPerLook - 1) interrupt();
    try {
      simulation_.step();
    } catch (const std::runtime_error& error) {  // the motion diverges
      throw std::invalid_argument(error.what());
    }
  }
}

Recording SteppedSimulation::run(std::vector<hovercraft::Command> commands, double duration,
                                 std::int64_t every, const Interrupt& interrupt) {
  const Lock lock(*this);
  require(every >= 1, fmt::format("every = {}: must be 1 or greater", every));
  const std::int64_t duration_ns = nanosecondsOf("duration", duration);
  require(duration_ns > 0, "duration: must be greater than 0");
  const hovercraft::Tick ticks = hovercraft::firstTickAt(duration_ns, scenario_->step_ns);
  requireTime(ticks);
  const hovercraft::Tick first = simulation_.tick();
  require(commands.empty() || commands.front().tick >= first,
          fmt::format("commands: time: must not be before that of the simulation, {} s",
                      hovercraft::toSeconds(simulation_.timeNs())));
  hovercraft::RunPlan plan;
  plan.last_tick = first + ticks;
  plan.every = every;
  std::exception_ptr interruption;  // what the caller asked for is no divergence
  plan.steer = [&](hovercraft::Simulation& now) {
    if ((now.tick() - first) % kStepsPerLook != kStepsPerLook - 1) return true;
    try {
      interrupt();
    } catch (...) {
      interruption = std::current_exception();
    }
    return interruption == nullptr;
  };
  Recorder recorder(simulation_.scenario(), static_cast<std::uint64_t>(ticks / every) + 1);
  CommandList source(std::move(commands));
  try {
    hovercraft::run(simulation_, source, recorder, plan);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
  if (interruption) std::rethrow_exception(interruption);
  return std::move(recorder.recording);
}

void SteppedSimulation::command(hovercraft::Command command) {
  const Lock lock(*this);
  command.tick = simulation_.tick();
  simulation_.push(command);
}

void SteppedSimulation::applyWrench(const std::string& vehicle, const PushedWrench& wrench) {
  using Frame = hovercraft::ExternalWrench::Frame;
  const Lock lock(*this);
  const std::size_t index = craftIndex(*scenario_, vehicle);
  const hovercraft::Wrench acting = {asVector(wrench.force), asVector(wrench.torque)};
  hovercraft::requireApplicable(acting, scenario_->model, {"force", "torque"});
  require(wrench.frame == "world" || wrench.frame == "body",
          fmt::format("frame = {}: must be world or body", wrench.frame));
  const std::int64_t duration_ns = nanosecondsOf("duration", wrench.duration);
  require(duration_ns > 0, "duration: must be greater than 0");
  // More do not come from a controller; each of them is looked at in each step.
  require(simulation_.state().wrenches.size() < 10000, "wrenches: at most 10000 may act at a time");
  simulation_.applyWrench(
      {index, wrench.frame == "world" ? Frame::kWorld : Frame::kBody, acting,
       simulation_.tick() + hovercraft::firstTickAt(duration_ns, scenario_->step_ns)});
}

void SteppedSimulation::setMotion(const std::string& vehicle, const SetMotion& motion) {
  const hovercraft::FloatingPointEnvironment environment;
  const Lock lock(*this);
  const std::size_t index = craftIndex(*scenario_, vehicle);
  const Vector3 p_WB = asVector(motion.position);
  require(p_WB.allFinite(), "position: must be finite");
  const hovercraft::Twist twist = {asVector(motion.velocity), asVector(motion.angular_velocity)};
  hovercraft::requireSettable(twist, {"velocity", "angular_velocity"});
  const Quadruple& q = motion.orientation;
  const Quaternion q_WB = {q[3], Vector3(q[0], q[1], q[2])};
  const double length = hovercraft::norm(q_WB);
  require(std::abs(length - 1.0) <= hovercraft::kUnitLength,
          fmt::format("orientation: must have length 1 (it has {:.6g})", length));
  if (scenario_->model == hovercraft::BodyModel::kPlanar) {
    requirePlanar(q_WB, twist.v_WB, twist.w_WB);
  }
  require(p_WB.cwiseAbs().maxCoeff() <= hovercraft::kFarthest,
          "position: must be at most 1e30 m, of either sign");
  const hovercraft::Motion after = simulation_.motionAfterSetting(index, p_WB, q_WB, twist);
  require(after.momentum_W.allFinite() && after.angular_momentum_W.allFinite() &&
              std::isfinite(after.energy),
          "position, velocity: the momenta and the energy must be finite");
  if (const auto overlap = simulation_.overlapAt(index, p_WB, q_WB)) {
    throw std::invalid_argument(
        fmt::format("position: {} and {} would overlap by {:.3g} m: must be apart", overlap->a,
                    overlap->b, overlap->depth));
  }
  simulation_.setMotion(index, p_WB, q_WB, twist);
}

void SteppedSimulation::setWind(const Triple& wind) {
  const Lock lock(*this);
  const Vector3 wind_W(wind[0], wind[1], wind[2]);
  require(hovercraft::canBeWind(wind_W),
          "wind: must be three finite numbers, and its speed at most 1e6 m/s");
  simulation_.setWind(wind_W);
}

void SteppedSimulation::reset(std::int64_t seed) {
  const Lock lock(*this);
  simulation_.reset(seed);
}

SavedState SteppedSimulation::save() {
  const Lock lock(*this);
  return {scenario_, simulation_.state()};
}

void SteppedSimulation::restore(const SavedState& saved) {
  const Lock lock(*this);
  require(saved.scenario == scenario_ || toYaml(*saved.scenario) == toYaml(*scenario_),
          "saved: must come from a simulation of the same scenario");
  simulation_.restore(saved.state);
}

std::string SteppedSimulation::snapshot() {
  const Lock lock(*this);
  return hovercraft::toSnapshot(simulation_);
}

void SteppedSimulation::restoreSnapshot(const std::string& text) {
  const Lock lock(*this);
  const hovercraft::SimulationState state =
      hovercraft::parseSnapshot(text, "snapshot", simulation_.scenario());
  for (const hovercraft::Command& command : state.commands.waiting()) {
    require(command.tick == state.tick,
            fmt::format("snapshot: commands: tick = {}: must be that of the snapshot, {}",
                        command.tick, state.tick));
  }
  simulation_.restore(state);
}

std::uint64_t SteppedSimulation::hash() {
  const Lock lock(*this);
  return simulation_.hash();
}

std::uint64_t SteppedSimulation::sensorHash() {
  const Lock lock(*this);
  return simulation_.sensorHash();
}

std::int64_t SteppedSimulation::tick() {
  const Lock lock(*this);
  return simulation_.tick();
}

std::int64_t SteppedSimulation::timeNs() {
  const Lock lock(*this);
  return simulation_.timeNs();
}

std::int64_t SteppedSimulation::seed() {
  const Lock lock(*this);
  return simulation_.state().seed;
}

std::vector<StateRow> SteppedSimulation::states() {
  const Lock lock(*this);
  std::vector<StateRow> rows;
  rows.reserve(simulation_.state().bodies.size());
  for (std::size_t body = 0; body < simulation_.state().bodies.size(); ++body) {
    rows.push_back(stateRow(simulation_, body));
  }
  return rows;
}

std::vector<ActuatorRow> SteppedSimulation::actuators(std::size_t vehicle) {
  const Lock lock(*this);
  return actuatorRows(simulation_, vehicle);
}

}  // namespace hovercraft_python
