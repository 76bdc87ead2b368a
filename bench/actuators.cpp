/// Time of one step of a craft with other actuators than its three engines, at 1 kHz, against the
/// craft of three in the same run. `bench_actuators` lets all take turns and prints the least of
/// each; `bench_actuators CASE STEPS` makes steps of one alone, for callgrind.

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "driven_craft.h"

namespace hovercraft::bench {
namespace {

constexpr int kTurns = 21;
constexpr int kStepsOfATurn = 20000;
constexpr Tick kCommandPeriod = 100;  // steps, 10 Hz

/// A fan at a corner of the craft.
ActuatorScenario fanAt(double x, double y, double free_speed) {
  ActuatorScenario fan;
  fan.name = "fan";
  fan.motion.p_HE = {x, y, 0.05};
  fan.motion.direction = {x < 0.0 ? 1.0 : -1.0, 0.0, 0.0};
  fan.motion.max_thrust = 1.5;
  fan.motion.time_constant = 0.1;
  fan.free_speed = free_speed;
  return fan;
}

Scenario fourFans(Scenario scenario, double free_speed) {
  VehicleScenario& craft = scenario.vehicles[0];
  craft.engines = {};
  craft.has_engine = {false, false, false};
  for (const double x : {-0.2, 0.2}) {
    for (const double y : {-0.15, 0.15}) craft.actuators.push_back(fanAt(x, y, free_speed));
  }
  return scenario;
}

Scenario craftOf(const std::string& which) {
  Scenario scenario =
      drivenCraft(Integrator::kHeun, OrientationKind::kQuaternion, BodyModel::kSpatial);
  VehicleScenario& craft = scenario.vehicles[0];
  if (which == "four_fans") return fourFans(scenario, 0.0);
  if (which == "four_fans_that_lose_thrust") return fourFans(scenario, 12.0);
  if (which == "three_normalized") {
    for (EngineParameters& engine : craft.engines) {
      engine.command.unit = CommandUnit::kNormalized;
    }
  }
  if (which == "three_with_tables") {
    for (EngineParameters& engine : craft.engines) {
      for (int i = 0; i < 17; ++i) engine.command.table.push_back({0.1 * i, 0.05 * i});
    }
  }
  if (which == "three_with_rotors") {
    for (EngineParameters& engine : craft.engines) engine.rotor = {1e-5, 900.0, 1.0};
  }
  if (which == "fan_and_rudder") {
    craft.engines = {};
    craft.has_engine = {false, false, false};
    craft.actuators.push_back(fanAt(-0.2, 0.0, 12.0));
    ActuatorScenario rudder;
    rudder.name = "rudder";
    rudder.kind = ActuatorKind::kRudder;
    rudder.fan = "fan";
    rudder.diameter = 0.2;
    rudder.area = 0.02;
    rudder.lift_slope = 3.0;
    rudder.motion.max_thrust = 0.5;
    rudder.motion.min_thrust = -0.5;
    craft.actuators.push_back(rudder);
  }
  return scenario;
}

class Run {
 public:
  explicit Run(const std::string& name) : name_(name), simulation_(craftOf(name)) {}

  void steps(int count) {
    const std::size_t actuators = simulation_.state().engines[0].size();
    for (int i = 0; i < count; ++i) {
      const Tick tick = simulation_.tick();
      if (tick % kCommandPeriod == 0) {
        Command command{tick, 0, kAllEngines, demandedThrusts()};
        command.thrusts.resize(actuators);
        for (std::size_t id = kFirstActuator; id < actuators; ++id) {
          command.thrusts[id] = 0.3;
          command.engines = static_cast<EngineMask>(command.engines | maskOf(id));
        }
        simulation_.push(command);
      }
      simulation_.step();
    }
  }
  void timeOneTurn() {
    const auto begin = std::chrono::steady_clock::now();
    steps(kStepsOfATurn);
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
    least_ = std::min(least_, took.count() / kStepsOfATurn);
  }
  const std::string& name() const { return name_; }
  double least() const { return least_; }  // ns a step

 private:
  std::string name_;
  Simulation simulation_;
  double least_ = std::numeric_limits<double>::max();
};

void compareAll() {
  std::vector<Run> runs;
  for (const char* name : {"three", "four_fans", "four_fans_that_lose_thrust", "fan_and_rudder",
                           "three_normalized", "three_with_tables", "three_with_rotors"}) {
    runs.emplace_back(name);
  }
  for (int turn = 0; turn < kTurns; ++turn) {
    for (Run& run : runs) run.timeOneTurn();
  }
  for (const Run& run : runs) {
    std::cout << run.name() << ": " << run.least() << " ns a step, "
              << run.least() / runs[0].least() << " times the craft of three\n";
  }
}

}  // namespace
}  // namespace hovercraft::bench

int main(int argc, char** argv) {
  try {
    if (argc == 3) {
      hovercraft::bench::Run(argv[1]).steps(static_cast<int>(std::strtol(argv[2], nullptr, 10)));
    } else {
      hovercraft::bench::compareAll();
    }
  } catch (const std::exception& error) {
    std::cerr << "bench_actuators: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
