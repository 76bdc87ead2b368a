#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hovercraft_sim/hovercraft/step_inputs.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/scenario/actuator_forces.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sensors/sensor_suite.h"
#include "hovercraft_sim/sim/simulation_state.h"
#include "hovercraft_sim/world/world.h"

namespace hovercraft {

class RunObserver;
class StateHash;

/// A scenario in motion: steps of fixed length, counted by a tick. No clock, no thread, no
/// allocation in step(); the same scenario and the same commands at the same ticks give the same
/// bits, whatever the program was compiled with and whatever the floating-point environment of its
/// thread is (FloatingPointEnvironment). An observer is told in the thread's own.
class HOVERCRAFT_PUBLIC Simulation {
 public:
  /// At tick 0. @param scenario as a parser checked it.
  explicit Simulation(Scenario scenario);

  /// Queues a command; one whose tick has passed is a mistake of the caller.
  void push(const Command& command);
  /// Whether a command waits for its tick.
  bool hasWaitingCommands() const { return !state_.commands.empty(); }

  /// Puts a craft somewhere else, with other velocities: from the current tick on. Its engines stay
  /// as they are.
  /// @param motion of the body frame B, velocities in W; finite, q_WB a unit quaternion, and
  /// possible in the scenario's model (the caller has checked).
  void setMotion(std::size_t vehicle, const Vector3& p_WB, const Quaternion& q_WB,
                 const Twist& twist);

  /// What motion() would say after setMotion() with the same arguments.
  Motion motionAfterSetting(std::size_t vehicle, const Vector3& p_WB, const Quaternion& q_WB,
                            const Twist& twist) const;

  /// The body that a craft would overlap there by more than the tolerance, or be too close to for a
  /// gap to be made; none without a world.
  [[nodiscard]] std::optional<WorldOverlap> overlapAt(std::size_t vehicle, const Vector3& p_WB,
                                                      const Quaternion& q_WB) const;

  /// Adds a wrench from the current tick until its end tick.
  void applyWrench(const ExternalWrench& wrench);

  /// Faults of an actuator from the current tick on (EngineState). @param id of an engine that the
  /// craft has, or of another actuator. @param efficiency 0 to 1; 1: sound.
  void setActuator(std::size_t vehicle, std::size_t id, double efficiency, bool stuck);

  /// Another mean wind from the current tick on; gusts go on, along and across the new one.
  /// @param wind_W m/s, finite.
  void setWind(const Vector3& wind_W);
  /// The wind at a body in the step that begins now, gusts included, m/s in W. @param body vehicles
  /// first, then loose ones.
  Vector3 windAt(std::size_t body) const { return inputs_[body].environment.wind_W; }

  /// Back to the scenario's start at tick 0: no command, no wrench is left. @param seed of the new
  /// run.
  void reset(std::int64_t seed);

  /// Goes on from a state of the same scenario, at its tick; commands that waited give way to its.
  void restore(const SimulationState& state);
  /// Everything that changes; with scenario() the whole of it.
  const SimulationState& state() const { return state_; }

  /// Applies the commands that are due and moves every craft from tick n to n + 1.
  /// @throws std::runtime_error that names the craft if its state would not be finite afterwards:
  /// the step is too long for the forces. The tick, every motion, thrust and contact are then those
  /// before the step; the commands that were due have taken effect.
  void step();

  const Scenario& scenario() const { return scenario_; }  // as given
  Tick tick() const { return state_.tick; }  // steps since the beginning of the episode
  /// Simulated time at the current tick, ns.
  std::int64_t timeNs() const { return state_.tick * scenario_.step_ns; }

  /// Of the centre of mass. @param vehicle index into Scenario::vehicles.
  Motion motion(std::size_t vehicle) const;
  /// Of a loose body.
  Motion bodyMotion(std::size_t body) const;
  /// Null if the scenario has no world.
  const World* world() const { return scenario_.world ? &world_ : nullptr; }
  /// @param engine id of an engine or another actuator.
  EngineReport engineReport(std::size_t vehicle, int engine) const;
  /// Cells of the cushion of a craft; 0 without one.
  std::size_t cellCount(std::size_t vehicle) const;
  /// The cushion of a craft as it is now; no cells without one. @param report replaced.
  void cushionReport(std::size_t vehicle, CushionReport& report) const;

  /// Hash of what determines the future of one craft, or of all: FNV-1a, 64 bits (ARCHITECTURE.md).
  std::uint64_t hash(std::size_t vehicle) const;
  std::uint64_t hash() const;

  /// Hash of what determines the samples to come of one craft's sensors, or of all: memories, and
  /// samples on their way. 0 without sensors. Sensors act on no body, and hash() does not know
  /// them.
  std::uint64_t sensorHash(std::size_t vehicle) const;
  std::uint64_t sensorHash() const;
  /// The next tick after this one at which a sample may be delivered; the greatest there is without
  /// sensors.
  Tick nextSampleTick() const;
  /// Null if no craft has sensors.
  const SensorSuite* sensors() const { return sensors_ ? &*sensors_ : nullptr; }

  /// Who is told from now on of commands, contacts and samples; null: nobody.
  /// @param observer outlives the simulation, or its own place here.
  void observe(RunObserver* observer) { observer_ = observer; }
  RunObserver* observer() const { return observer_; }

 private:
  void applyDueCommands();
  void endWrenches();
  void turnFans(std::size_t vehicle);
  void prepareInputs();
  void takeResult();
  void refreshWind();
  void blow();
  void addAir(StateHash& hash, std::size_t first, std::size_t last) const;
  void addFaults(StateHash& hash, std::size_t first, std::size_t last) const;
  void readSensors();
  Vector3 rotorsOf(std::size_t body) const;
  SensedBodies sensedBodies();
  [[noreturn]] void failAsDiverged(std::size_t body) const;
  void sortRecords();
  ContactEvent eventOf(const ContactRecord& record) const;
  std::size_t vehicleCount() const { return engine_dynamics_.size(); }
  const HovercraftModel& modelOf(std::size_t body) const {
    return world_.scene().bodies()[body].model;
  }
  BodyState placed(std::size_t vehicle, const Vector3& p_WB, const Quaternion& q_WB,
                   const Twist& twist) const;
  Motion motionOf(std::size_t body, const BodyState& state) const;

  RunObserver* observer_ = nullptr;
  Scenario scenario_;
  World world_;
  std::shared_ptr<const Ground> ground_;       // what cushions blow on; none
  std::shared_ptr<const Ground> bare_ground_;  // what pads stand on; none
  std::optional<Gusts> gusts_;
  std::vector<EngineDynamics> engine_dynamics_;    // of each vehicle
  std::vector<std::vector<FanDrive>> fan_drives_;  // likewise
  SimulationState state_;
  std::vector<StepInputs> inputs_;  // of each body, in the step that is made
  std::vector<Tick> steady_until_;  // until which the thrusts of a craft stay as they are there
  std::optional<SensorSuite> sensors_;
  std::vector<Vector3> rotors_B_;  // for them: of the rotors of each craft, if one has some
  StepResult result_;              // of it, until all of it is known to be sound
};

}  // namespace hovercraft
