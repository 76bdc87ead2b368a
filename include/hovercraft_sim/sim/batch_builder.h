#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/hovercraft/hovercraft_model.h"
#include "hovercraft_sim/lanes/lane_block.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft {

/// What all runs of a batch have in common.
struct BatchKind {
  std::int64_t step_ns = 0;                   // ns
  Integrator integrator = Integrator::kHeun;  // of all steps
  BodyModel model = BodyModel::kPlanar;       // planar or spatial
  bool has_gusts = false;                     // whether the air is that of each run
  std::vector<std::string> actuator_names;    // besides the engines
  lanes::StepPlan plan;                       // of a step
  std::size_t rows = 0;                       // numbers of its forces, rotors and ground
};

/// What a run knows of an actuator between its events.
struct LaneActuator {
  EngineDynamics::Rule rule;                // limits and lag
  double commanded = 0.0;                   // as received
  Tick command_tick = EngineState::kNever;  // of the last command
};

/// The model of the craft of a scenario. @throws std::invalid_argument that names the key of what a
/// batch cannot do.
HovercraftModel batchableModelOf(const Scenario& scenario);

/// @param model of the scenario.
BatchKind batchKindOf(const Scenario& scenario, const HovercraftModel& model);

/// @throws std::invalid_argument that begins with the name and names the key in which a run differs
/// where it must not.
void requireSameKind(const BatchKind& kind, const BatchKind& first, const std::string& name);

/// Where a run lies in its block.
struct LanePlace {
  lanes::Block& block;  // that it lies in
  lanes::Row* wind_W;   // three rows, m/s
  lanes::Row* more;     // numbers of forces, rotors and the ground
  std::size_t lane;     // column of the run
};

/// Writes constants and the initial state of a run.
void writeLane(const Scenario& scenario, const HovercraftModel& model,
               const EngineDynamics& dynamics, const LanePlace& place);

/// A block of craft that stand and on which nothing acts.
lanes::Block idleBlock();

}  // namespace hovercraft
