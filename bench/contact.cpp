/// What contact costs, and how exact it is: bench_contact [NAME ...]; see bench/README.md.

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fmt/format.h>
#include <iostream>
#include <string>
#include <vector>

#include "hovercraft_sim/sim/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"

namespace {

using hovercraft::Scenario;
using hovercraft::Simulation;
using hovercraft::Vector3;

/// Processor time, s.
double processorTime() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

Scenario parsed(const std::string& yaml) {
  return hovercraft::parseScenario(YAML::Load(yaml), {"bench", "", {}});
}

/// A craft in free flight: no drag, no thrust.
std::string craft(const std::string& model, const std::string& world) {
  const char* engine =
      "{position: [0, 0, 0], direction: [1, 0, 0], min_thrust: 0, max_thrust: 1, timeout: 0}";
  return fmt::format(
      "step_size: 0.001\nintegrator: heun\nmodel: {}\nvehicles:\n  craft:\n    parts: [{{box: "
      "{{size: [0.6, 0.4, 0.12]}}, mass: 5}}]\n    engines: {{rear: {}, left: {}, right: {}}}\n"
      "    initial: {{velocity: [0.5, 0.3, 0], angular_velocity: [0, 0, 0.5]}}\n{}",
      model, engine, engine, engine, world);
}

std::string walls() {
  std::string world = "world:\n  materials: {default: {restitution: 1}}\n  obstacles:\n";
  const char* const places[] = {"[2.1, 0, 0]", "[-2.1, 0, 0]", "[0, 2.1, 0]", "[0, -2.1, 0]"};
  for (int i = 0; i < 4; ++i) {
    world += fmt::format("    wall_{}: {{box: {{size: {}}}, position: {}}}\n", i,
                         i < 2 ? "[0.2, 4.4, 1]" : "[4.4, 0.2, 1]", places[i]);
  }
  return world;
}

std::string farObstacles(int count) {
  std::string world = "world:\n  obstacles:\n";
  for (int i = 0; i < count; ++i) {
    world += fmt::format("    far_{}: {{box: {{size: [1, 1, 1]}}, position: [{}, {}, 0]}}\n", i,
                         10000 + 3 * (i % 40), 10000 + 3 * (i / 40));
  }
  return world;
}

/// The least of several runs: what the machine's other work cannot shorten. ns per step.
double stepTime(const std::string& yaml) {
  Simulation simulation(parsed(yaml));
  double least = 1e9;
  for (int run = 0; run < 60; ++run) {
    const double begin = processorTime();
    for (int i = 0; i < 20000; ++i) simulation.step();
    least = std::min(least, (processorTime() - begin) / 20000 * 1e9);
  }
  return least;
}

void stepCost() {
  for (const char* model : {"planar", "spatial"}) {
    const double none = stepTime(craft(model, ""));
    const double pen = stepTime(craft(model, walls()));
    std::cout << fmt::format("step, {}: {:.0f} ns without a world, {:.0f} ns in a pen, {:.2f} x\n",
                             model, none, pen, pen / none);
  }
  const double ten = stepTime(craft("planar", farObstacles(10)));
  const double thousand = stepTime(craft("planar", farObstacles(1000)));
  std::cout << fmt::format(
      "step: {:.1f} ns with 10 far obstacles, {:.1f} ns with 1000, {:+.1f} %\n", ten, thousand,
      100.0 * (thousand / ten - 1.0));
}

/// 100 boxes fall into a pen.
void heap(double seconds) {
  std::string world =
      "world:\n  tolerance: 2e-5\n"
      "  materials: {default: {restitution: 0, friction: 0.5}}\n  obstacles:\n"
      "    floor: {box: {size: [6, 6, 1]}, position: [0, 0, -0.5]}\n";
  const char* const places[] = {"[1.5, 0, 4]", "[-1.5, 0, 4]", "[0, 1.5, 4]", "[0, -1.5, 4]"};
  for (int i = 0; i < 4; ++i) {
    world += fmt::format("    wall_{}: {{box: {{size: {}}}, position: {}}}\n", i,
                         i < 2 ? "[1, 4, 8]" : "[4, 1, 8]", places[i]);
  }
  world += "  bodies:\n";
  for (int k = 0; k < 100; ++k) {
    const int layer = k / 9;
    const double turn = 0.37 * k;
    world += fmt::format(
        "    box_{:03}: {{parts: [{{box: {{size: [0.2, 0.2, 0.2]}}, mass: 1}}], initial: "
        "{{position: [{}, {}, {}], rpy: [{}, {}, {}]}}}}\n",
        k, 0.5 * (k % 3 - 1) + 0.01 * (k % 7), 0.5 * (k / 3 % 3 - 1) + 0.01 * (k % 5),
        0.3 + 0.45 * layer, turn, 0.7 * turn, 1.3 * turn);
  }
  std::string yaml = craft("spatial", world);
  const std::string start = "initial: {velocity: [0.5, 0.3, 0], angular_velocity: [0, 0, 0.5]}";
  yaml.replace(yaml.find(start), start.size(), "initial: {position: [100, 0, 0]}");
  yaml.insert(0, "gravity: [0, 0, -9.81]\n");
  Simulation simulation(parsed(yaml));
  double stepping = 0.0;
  double least = 1.0;
  for (int i = 1; i <= static_cast<int>(seconds * 1000.0); ++i) {
    const double begin = processorTime();
    simulation.step();
    stepping += processorTime() - begin;
    if (i % 100 == 0) {
      least = std::min(least, simulation.world()->leastGap(simulation.worldStates()));
    }
    if (i % 500 == 0) {
      std::cout << fmt::format(
          "heap: {:.1f} s simulated, {:.2f} s of processor time, {:.2f} x real time, least gap "
          "{:.2g} m, {} steps cut off\n",
          i / 1000.0, stepping, i / 1000.0 / stepping, least, simulation.world()->stalls());
    }
  }
}

/// A tumbling box in a closed pen.
void energy(int bounces) {
  std::string world = "world:\n  materials: {default: {restitution: 1}}\n  obstacles:\n";
  for (int i = 0; i < 6; ++i) {
    Vector3 size(3.0, 3.0, 3.0);
    Vector3 center(0.0, 0.0, 0.0);
    const int axis = i / 2;
    size[axis] = 1.0;
    center[axis] = (i % 2 == 0 ? 1.0 : -1.0) * (0.5 + 0.5 * (1.2 + 0.2 * axis));
    world += fmt::format("    wall_{}: {{box: {{size: [{}, {}, {}]}}, position: [{}, {}, {}]}}\n",
                         i, size.x(), size.y(), size.z(), center.x(), center.y(), center.z());
  }
  std::string yaml = craft("spatial", world);
  const auto set = [&yaml](const std::string& from, const std::string& to) {
    yaml.replace(yaml.find(from), from.size(), to);
  };
  set("heun", "rk4");
  set("step_size: 0.001", "step_size: 0.0005");
  set("size: [0.6, 0.4, 0.12]", "size: [0.2, 0.3, 0.4]");
  set("velocity: [0.5, 0.3, 0], angular_velocity: [0, 0, 0.5]",
      "velocity: [0.9, 0.7, 0.5], angular_velocity: [1, 2, 3]");
  Simulation simulation(parsed(yaml));
  int count = 0;
  simulation.on_contact = [&count](const hovercraft::ContactEvent& /*event*/) { ++count; };
  const double before = simulation.motion(0).energy;
  double drift = 0.0;
  while (count < bounces) {
    simulation.step();
    drift = std::max(drift, std::abs(simulation.motion(0).energy / before - 1.0));
  }
  std::cout << fmt::format(
      "energy: {} elastic bounces in {:.0f} s, largest relative drift {:.2g}\n", count,
      hovercraft::toSeconds(simulation.timeNs()), drift);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) names = {"step", "energy", "heap"};
  for (const std::string& name : names) {
    if (name == "step") stepCost();
    if (name == "energy") energy(10000);
    if (name == "heap") heap(5.0);
  }
  return 0;
}
