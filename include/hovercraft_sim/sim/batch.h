#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hovercraft_sim/hovercraft/gusts.h"
#include "hovercraft_sim/hovercraft/hovercraft_model.h"
#include "hovercraft_sim/lanes/instruction_set.h"
#include "hovercraft_sim/lanes/lane_block.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/batch_builder.h"
#include "hovercraft_sim/sim/command_log.h"
#include "hovercraft_sim/sim/simulation_state.h"

namespace hovercraft {

struct BatchOptions {
  int threads = 1;                                               // >= 1, the caller's among them
  std::optional<InstructionSet> instruction_set = std::nullopt;  // none: the widest there is
};

/// Many runs at once, each of one craft that meets nothing: a run has parameters, an initial
/// motion, commands and a seed of its own, and at every tick the bits that Simulation has of the
/// same scenario, whatever the instructions and however many threads. They are made eight side by
/// side, one in each lane of wide registers, many ticks of one block of eight before the next
/// block: fewer commands in between are faster. run() allocates nothing for a tick.
///
/// A scenario must have one craft, orientation by quaternion, and no world, height map or sensors.
/// All runs of a batch have one step_size, integrator and model, the same actuators and kinds of
/// forces and rotors, cells, fans and hem points of cushions, vertices of hulls on a ground, and
/// gusts or none; any number may be another one.
class HOVERCRAFT_PUBLIC Batch {
 public:
  /// Some runs of one scenario. @throws std::invalid_argument that names the key of what a batch
  /// cannot do, or an option.
  explicit Batch(const Scenario& scenario, std::size_t count = 1, const BatchOptions& options = {});
  /// A run of each scenario, at least one. @throws as above and as add().
  explicit Batch(const std::vector<Scenario>& scenarios, const BatchOptions& options = {});

  /// One more run; at tick 0. @throws std::invalid_argument that names the run and the key of what
  /// must be as in the first run, or of what a batch cannot do; the batch is then as before.
  void add(const Scenario& scenario);
  std::size_t size() const { return logs_.size(); }  // runs

  /// Queues a command as Simulation::push() does; its vehicle is 0. After a run diverged it has no
  /// effect.
  void push(std::size_t run, const Command& command);

  /// Makes so many ticks of every run. @param ticks >= 0.
  void run(Tick ticks);

  /// That of all runs but those that diverged.
  Tick tick() const { return tick_; }
  std::int64_t stepNs() const { return kind_.step_ns; }  // ns, of a step
  /// The last tick of a run whose motion is not finite after the step that begins there, as where
  /// Simulation::step() throws: it stays as it was then. None: it goes on.
  [[nodiscard]] std::optional<Tick> divergedAt(std::size_t run) const;

  /// As in Simulation::state(), and of the tick of the run.
  RigidBodyState<Quaternion> body(std::size_t run) const;
  /// By id.
  EngineStates actuators(std::size_t run) const;
  /// The tick that a run is at: tick(), or where it diverged.
  Tick tickOf(std::size_t run) const { return divergedAt(run).value_or(tick_); }
  /// As Simulation::motion().
  Motion motion(std::size_t run) const;
  /// As Simulation::engineReport(). @param id of the actuator.
  EngineReport actuatorReport(std::size_t run, std::size_t id) const;
  /// As Simulation::hash().
  std::uint64_t hash(std::size_t run) const;

  InstructionSet instructionSet() const {
    return instruction_set_;
  }  // that the steps are made with

 private:
  struct Air {
    Gusts gusts;
    GustState state;
    std::int64_t seed;
    Vector3 mean_W;
  };

  struct Around;

  HovercraftModel modelOfRun(const Scenario& scenario) const;
  void growBlocks();
  Tick takeEvents(std::size_t run, Tick tick);
  void advanceBlock(std::size_t block, Tick end);
  Tick nextEvent(std::size_t block, Tick tick, Tick end);
  void blow(std::size_t block, Tick tick, Tick count, Around& around);
  void calm(std::size_t block, Tick begin, const Around& around);
  void addFans(const HovercraftModel& model);
  void turnFans(std::size_t block, Tick tick, Tick count, Around& around) const;
  std::size_t fanRows() const { return 3 * kind_.plan.ground.fan_count; }
  void noteLost(std::size_t block, Tick begin);
  const lanes::Row* moreOf(std::size_t block) const { return more_.data() + block * kind_.rows; }
  std::size_t lanesOf(std::size_t block) const;
  EngineState actuatorState(std::size_t run, std::size_t id) const;
  Vector3 rotorsOf(std::size_t run) const;

  BatchKind kind_;
  int threads_;
  InstructionSet instruction_set_;
  lanes::Advance advance_;
  Tick tick_ = 0;
  std::vector<lanes::Block> blocks_;
  std::vector<lanes::Row> wind_W_;      // three of each block: the mean
  std::vector<lanes::Row> more_;        // of each block: numbers of forces, rotors and the ground
  std::vector<lanes::Row> fan_speeds_;  // of each block, of a cushion: over the first step
  std::vector<std::shared_ptr<const GroundForces>> grounds_;  // of each run with a cushion
  bool fans_follow_time_ = false;                             // of some of them
  std::vector<Mobility> mobilities_;
  std::vector<LaneActuator> actuators_;  // of each run, by id
  std::vector<CommandLog> logs_;
  std::vector<Tick> next_event_;  // of each run: a command or a time-out
  std::vector<Tick> diverged_;    // of each run; the greatest there is: not
  std::vector<Air> airs_;         // of each run; empty without gusts
};

}  // namespace hovercraft
