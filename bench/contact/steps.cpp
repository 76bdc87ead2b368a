#include "steps.h"

#include <algorithm>
#include <ctime>
#include <fmt/format.h>
#include <iostream>
#include <string>
#include <vector>

#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft::bench {
namespace {

/// Processor time, s.
double processorTime() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
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

Simulation simulationOf(const std::string& yaml) {
  return Simulation(parseScenario(yaml, {"bench", "", {}}));
}

/// ns per step, mean of a block.
double blockTime(Simulation& simulation) {
  constexpr int steps = 2000;
  const double begin = processorTime();
  for (int i = 0; i < steps; ++i) simulation.step();
  return (processorTime() - begin) / steps * 1e9;
}

/// Two scenarios in turn, so that the machine's other work meets both: medians of each, and of the
/// ratios of neighbours.
void compareSteps(const std::string& what, const std::string& first, const std::string& second) {
  Simulation simulations[] = {simulationOf(first), simulationOf(second)};
  std::vector<double> times[2];
  std::vector<double> ratios;
  for (int round = 0; round < 200; ++round) {
    for (int i = 0; i < 2; ++i) times[i].push_back(blockTime(simulations[i]));
    ratios.push_back(times[1].back() / times[0].back());
  }
  std::cout << fmt::format("step, {}: {:.0f} ns and {:.0f} ns, {:.3f} x\n", what, median(times[0]),
                           median(times[1]), median(ratios))
            << std::flush;
}

}  // namespace

void stepCost() {
  compareSteps("planar, without a world and in a pen", craft("planar", ""),
               craft("planar", walls()));
  compareSteps("spatial, without a world and in a pen", craft("spatial", ""),
               craft("spatial", walls()));
  compareSteps("10 and 1000 far obstacles", craft("planar", farObstacles(10)),
               craft("planar", farObstacles(1000)));
}

namespace {

/// A craft that nothing brakes. @param start its motion at the start.
std::string craftAt(const std::string& model, const std::string& integrator,
                    const std::string& gravity, const std::string& start,
                    const std::string& world) {
  const char* engine =
      "{position: [0, 0, 0], direction: [1, 0, 0], min_thrust: 0, max_thrust: 1, timeout: 0}";
  return fmt::format(
      "step_size: 0.001\nintegrator: {}\nmodel: {}\ngravity: {}\nvehicles:\n  craft:\n    parts: "
      "[{{box: {{size: [0.6, 0.4, 0.12]}}, mass: 5}}]\n    engines: {{rear: {}, left: {}, right: "
      "{}}}\n    initial: {}\n{}",
      integrator, model, gravity, engine, engine, engine, start, world);
}

const char* const kFloor =
    "world: {obstacles: {floor: {box: {size: [100000, 20, 1]}, position: [0, 0, -0.5]}}}\n";
const char* const kWall =
    "world: {obstacles: {wall: {box: {size: [4, 0.2, 0.5]}, position: [0, -0.3, 0]}}}\n";

/// Boxes of 0.2 m and 1 kg at these places, on a floor.
std::string boxes(const std::vector<std::string>& places) {
  std::string world =
      "world:\n  materials: {default: {friction: 0.5}}\n  obstacles: {floor: {box: {size: [20, 20, "
      "1]}, position: [0, 0, -0.5]}}\n  bodies:\n";
  for (std::size_t i = 0; i < places.size(); ++i) {
    world += fmt::format(
        "    box_{:02}: {{parts: [{{box: {{size: [0.2, 0.2, 0.2]}}, mass: 1}}], initial: "
        "{{position: {}}}}}\n",
        i, places[i]);
  }
  return craftAt("spatial", "heun", "[0, 0, -9.81]", "{position: [5, 5, 100]}", world);
}

/// @param sway m, how far every other box is off the middle.
std::vector<std::string> stackOf(int count, double sway) {
  std::vector<std::string> places;
  for (int i = 0; i < count; ++i) {
    const double x = i % 2 == 0 ? -sway : sway;
    const double y = i / 2 % 2 == 0 ? -sway : sway;
    places.push_back(fmt::format("[{}, {}, {:.1f}]", x, y, 0.1 + 0.2 * i));
  }
  return places;
}

void timeBoxes(const std::string& what, const std::vector<std::string>& places) {
  Simulation simulation = simulationOf(boxes(places));
  std::vector<double> times;
  for (int i = 0; i < 1000; ++i) {
    const double begin = processorTime();
    simulation.step();
    times.push_back(processorTime() - begin);
  }
  double sum = 0.0;
  for (const double time : times) sum += time;
  std::cout << fmt::format("{}: {:.3f} ms a step in the mean of 1 s, median {:.3f} ms\n", what, sum,
                           1e3 * median(times))
            << std::flush;
}

}  // namespace

void hoverCost() {
  for (const char* const model : {"planar", "spatial"}) {
    for (const char* const integrator : {"heun", "rk4"}) {
      for (const char* const speed : {"0.2", "2", "10"}) {
        const std::string start =
            fmt::format("{{position: [0, 0, 0.063], velocity: [{}, 0, 0]}}", speed);
        compareSteps(fmt::format("{}, {}, 3 mm over a floor at {} m/s", model, integrator, speed),
                     craftAt(model, integrator, "[0, 0, 0]", start, ""),
                     craftAt(model, integrator, "[0, 0, 0]", start, kFloor));
      }
    }
  }
}

void pressedCost() {
  for (const char* const model : {"planar", "spatial"}) {
    compareSteps(fmt::format("{}, rk4, pressed against a wall", model),
                 craftAt(model, "rk4", "[0, -1, 0]", "{}", ""),
                 craftAt(model, "rk4", "[0, -1, 0]", "{}", kWall));
  }
  const char* const start = "{position: [0, 0, 0.06]}";
  compareSteps("spatial, rk4, on a floor", craftAt("spatial", "rk4", "[0, 0, -9.81]", start, ""),
               craftAt("spatial", "rk4", "[0, 0, -9.81]", start, kFloor));
}

void stackCost() {
  for (const int count : {2, 5, 10, 20}) {
    timeBoxes(fmt::format("stack of {} boxes", count), stackOf(count, 0.0));
    timeBoxes(fmt::format("stack of {} boxes, 2 cm off each other", count), stackOf(count, 0.01));
  }
  std::vector<std::string> cube;
  cube.reserve(27);
  for (const double z : {0.1, 0.3, 0.5}) {
    for (const double y : {0.0, 0.2, 0.4}) {
      for (const double x : {0.0, 0.2, 0.4}) {
        cube.push_back(fmt::format("[{:.1f}, {:.1f}, {:.1f}]", x, y, z));
      }
    }
  }
  timeBoxes("27 cubes in a cube", cube);
}

}  // namespace hovercraft::bench
