#include <array>
#include <stdexcept>
#include <string>
#include <yaml-cpp/yaml.h>

#include "hovercraft_sim/io/grey_image.h"
#include "hovercraft_sim/records/commands_csv.h"
#include "hovercraft_sim/records/states_csv.h"
#include "hovercraft_sim/scenario/pilot_parser.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/craft_pilot.h"
#include "hovercraft_sim/sim/snapshot.h"

#include "memory_file.h"
#include "targets.h"

namespace hovercraft::fuzz {
namespace {

constexpr int kTicks = 8;

template <class Read>
void answer(const Read& read) {
  try {
    read();
  } catch (const std::invalid_argument&) {  // it names what is wrong
  }
}

Scenario parsed(const std::string& text) {
  return parseScenario(treeOf(text, "input"), {"input", "", {}});
}

void fly(Simulation& simulation) {
  try {
    for (int n = 0; n < kTicks; ++n) {
      const bool commands = n % 4 == 0 && !simulation.hasWaitingCommands();
      for (std::size_t i = 0; commands && i < simulation.scenario().vehicles.size(); ++i) {
        simulation.push({simulation.tick(), i, kAllEngines, {1.0, 0.5 * n, -0.3}});
      }
      simulation.step();
      // What reached its bounds takes the longest, and would do so in each step.
      if (simulation.world() != nullptr && simulation.world()->stalls() > 0) break;
    }
  } catch (const std::logic_error&) {
    throw;
  } catch (const std::runtime_error&) {  // it diverges
  }
}

constexpr const char* kTwoBodies = R"(step_size: 0.002
model: spatial
gravity: [0, 0, -9.81]
vehicles:
  craft:
    parts: [{box: {size: [0.6, 0.4, 0.12]}, mass: 5}]
    engines:
      rear: {position: [-0.25, 0, 0], direction: [1, 0, 0], min_thrust: -1, max_thrust: 4.5, time_constant: 0.1}
      left: {position: [0.2, 0.15, 0], direction: [0, -1, 0], min_thrust: 0, max_thrust: 1.5}
      right: {position: [0.2, -0.15, 0], direction: [0, 1, 0], min_thrust: 0, max_thrust: 1.5}
    initial: {position: [0, 0, 0.06]}
world:
  materials: {default: {friction: 0.3}}
  obstacles: {floor: {box: {size: [4, 4, 1]}, position: [0, 0, -0.5]}}
  bodies:
    crate: {parts: [{box: {size: [0.3, 0.3, 0.3]}, mass: 1}], initial: {position: [0.8, 0, 0.15]}}
)";

/// The scenario of the seeds: a craft and a crate on a floor; in the plane above it.
Scenario twoBodies(BodyModel model, OrientationKind orientation) {
  std::string text = kTwoBodies;
  if (model == BodyModel::kPlanar) {
    text.replace(text.find("spatial"), 7, "planar");
    text.replace(text.find("-0.5]}}"), 4, "-0.6");
  }
  if (orientation == OrientationKind::kMatrix) text += "orientation: matrix\n";
  return parsed(text);
}

std::string asBlock(const std::string& text) {
  std::string block = "  ";
  for (const char c : text) {
    block += c;
    if (c == '\n') block += "  ";
  }
  block.resize(block.size() - 2);
  return "scenario: |\n" + block;
}

/// The text with the hash that its state has, as the message about a wrong one says it.
std::string withRightHash(const std::string& text, const Scenario& scenario) {
  const std::string key = "\nhash: '";
  const std::size_t place = text.find(key);
  if (place == std::string::npos) return text;
  try {
    parseSnapshot(text, "input", scenario);
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    const std::string words = "must be that of the state, ";
    const std::size_t hash = message.find(words);
    if (hash == std::string::npos) return text;
    std::string changed = text;
    changed.replace(place + key.size(), 16, message, hash + words.size(), 16);
    return changed;
  }
  return text;
}

}  // namespace

void readScenario(const std::string& input) {
  answer([&] {
    const Scenario scenario = parsed(input);
    // What is written is the same scenario.
    if (toYaml(parsed(toYaml(scenario))) != toYaml(scenario)) {
      throw std::logic_error("a scenario is not what its text says");
    }
  });
}

void flyScenario(const std::string& input) {
  answer([&] {
    Simulation simulation(parsed(input));
    fly(simulation);
  });
}

void flyPilot(const std::string& input) {
  static const Scenario scenario = twoBodies(BodyModel::kPlanar, OrientationKind::kQuaternion);
  answer([&] {
    CraftPilot pilot(parsePilot(input, "input", scenario), scenario.step_ns);
    Simulation simulation(scenario);
    for (Tick tick = 0; tick < 200 && !pilot.isOver(); ++tick) {
      if (pilot.isDue(tick)) {
        const Motion motion = simulation.motion(pilot.vehicle());
        simulation.push(
            pilot.decide({tick, motion.p_WB, motion.q_WB, motion.twist.v_WB, motion.twist.w_WB}));
      }
      simulation.step();
    }
    pilot.giveUp("enough");
    for (const FlownManoeuvre& flown : pilot.flown()) toText(flown);
  });
}

void readCommandsCsv(const std::string& input) {
  static const Scenario scenario = twoBodies(BodyModel::kPlanar, OrientationKind::kQuaternion);
  const MemoryFile file(input);
  answer([&] {
    CsvCommandSource source(file.path(), scenario, InputKind::kFile);
    while (source.next()) {
    }
  });
}

void readStatesCsv(const std::string& input) {
  const MemoryFile file(input);
  answer([&] { hovercraft::readStatesCsv(file.path()); });
}

void readSnapshot(const std::string& input) {
  static const std::array<Scenario, 3> scenarios = {
      twoBodies(BodyModel::kSpatial, OrientationKind::kQuaternion),
      twoBodies(BodyModel::kSpatial, OrientationKind::kMatrix),
      twoBodies(BodyModel::kPlanar, OrientationKind::kMatrix)};
  // The one that it may belong to.
  const bool is_quaternion = input.find("q_s") != std::string::npos;
  const bool has_contacts = input.find("contacts") != std::string::npos;
  const Scenario& scenario = scenarios[is_quaternion ? 0 : has_contacts ? 1 : 2];
  answer([&] {
    const std::string text = withRightHash(input + asBlock(toYaml(scenario)), scenario);
    Simulation simulation(scenario);
    simulation.restore(parseSnapshot(text, "input", scenario));
    fly(simulation);
  });
}

void readImage(const std::string& input) {
  answer([&] { greyImageOf(input); });
}

}  // namespace hovercraft::fuzz
