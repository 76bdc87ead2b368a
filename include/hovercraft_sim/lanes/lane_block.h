#pragma once

#include <cstddef>
#include <cstdint>

#include "hovercraft_sim/lanes/ground_plan.h"

/// Many craft side by side: the numbers of a block of them as rows, one column for each craft, and
/// what is done to all of a block. The module lanes knows no scenario and no Eigen: its sources are
/// compiled once for each instruction set, and an inline function of another header that got into
/// one of them could be the one that the linker keeps for a processor without it.

namespace hovercraft::lanes {

/// Craft of a block: as many as the widest pack of doubles has.
constexpr std::size_t kBlockLanes = 8;
/// Actuators of a craft, the engines among them.
constexpr std::size_t kMostActuators = 11;

/// Bound on constants and levels of craft in the plane, so that what their steps leave out is
/// finite (lane_planar.h).
constexpr double kMostOfPlanar = 1e100;

/// One number of each craft of a block.
struct alignas(64) Row {
  double of[kBlockLanes];  // one a column
};
/// A mask for each craft of a block: all bits, or none.
struct alignas(64) MaskRow {
  std::int64_t of[kBlockLanes];  // -1 or 0
};

/// Three components of a vector, or the nine entries of a matrix, column by column.
using Rows3 = Row[3];
using Rows9 = Row[9];  // column by column

/// What does not change while a craft moves; SI units, frames as in HovercraftModel.
struct BlockConstants {
  Row inverse_mass;                // 1/kg
  Rows9 inverse_inertia_B;         // 1/(kg m²)
  Rows9 engine_force;              // column i: force of 1 N of engine i, in B
  Rows9 engine_torque;             // likewise its moment about the centre of mass, m
  Rows3 drag_linear;               // N s/m
  Rows3 drag_quadratic;            // N s²/m²
  Rows3 drag_angular_linear;       // N m s
  Rows3 drag_angular_quadratic;    // N m s²
  Rows3 weight_W;                  // N
  Row half_decay[kMostActuators];  // exp(-h/2τ)
  Row full_decay[kMostActuators];  // exp(-h/τ)
  MaskRow lags[kMostActuators];    // where it has a time constant
  bool is_planar;                  // of the planar model, and no constant is beyond kMostOfPlanar
};

/// What a craft is at a tick: RigidBodyState of a quaternion, and levels of its actuators.
struct BlockState {
  Rows3 p_WB;                            // m
  Row q_s;                               // of q_WB
  Rows3 q_v;                             // likewise
  Rows3 momentum_W;                      // kg m/s, in W
  Rows3 angular_momentum_W;              // kg m²/s, in W
  Row level[kMostActuators];             // N, or what their kinds say
  MaskRow moves;                         // none: the craft's motion diverged, it stays as it is
  std::int64_t lost_after[kBlockLanes];  // steps of the last advance before a craft was lost
};

struct Block {
  BlockConstants constants;    // of its craft
  BlockState state;            // at the tick
  Row demand[kMostActuators];  // after limits and time-out; N, or levels
};

enum class Method { kEuler, kSemiImplicitEuler, kHeun, kRungeKutta4, kLie4 };

/// The forces of actuators besides the engines and their numbers, Row by Row, in this order:
/// - kFan: place (3), direction (3), 1/V0
/// - kPropeller: place, direction, diameter, thrust scale, torque scale, k (3), q (3)
/// - kRudder: place, direction, across (3), rho S/2, lift slope, drag at rest, its growth,
///   1/(rho A); then those of its fan or propeller
/// - kPolar: rho, areas (2), length, surge (6), sway (6), yaw (6)
enum class ForceKind : std::uint8_t { kNone, kFan, kPropeller, kRudder, kPolar };

/// Numbers of each kind.
constexpr std::size_t kFanRows = 7;
constexpr std::size_t kPropellerRows = 15;
constexpr std::size_t kRudderRows = 14;
constexpr std::size_t kPolarTerms = 6;
constexpr std::size_t kPolarRows = 4 + 3 * kPolarTerms;
/// Scale and axis (3) of a rotor.
constexpr std::size_t kRotorRows = 4;

/// A force that each craft of a batch has, with numbers of its own.
struct ForceStep {
  ForceKind kind = ForceKind::kNone;      // what it is
  ForceKind fan_kind = ForceKind::kNone;  // of a rudder
  std::size_t id = 0;                     // its actuator
  std::size_t fan_id = 0;                 // of that fan
  std::size_t first_row = 0;              // of its numbers
};

/// A rotor that each craft of a batch has.
struct RotorStep {
  std::size_t id = 0;
  bool by_square_root = false;  // of the level; else it is in proportion
  std::size_t first_row = 0;
};

constexpr std::size_t kMostForces = kMostActuators + 1;  // and some laws of drag

/// What is the same for all craft of a batch.
struct StepPlan {
  Method method = Method::kHeun;                 // how a step is made
  double h = 0.0;                                // s
  std::size_t actuator_count = 3;                // the three engines among them
  double free_translation[3] = {1.0, 1.0, 1.0};  // 1 where the model moves, in W
  double free_rotation[3] = {1.0, 1.0, 1.0};     // likewise
  ForceStep forces[kMostForces];                 // in the order of the model
  std::size_t force_count = 0;                   // how many
  RotorStep rotors[kMostActuators];              // likewise
  std::size_t rotor_count = 0;                   // how many
  GroundPlan ground;                             // cushion and pads

  /// Besides engines, drag and weight.
  [[gnu::always_inline]] bool hasMoreForces() const {
    return force_count > 0 || rotor_count > 0 || ground.isThere();
  }
};

/// Some steps of a block, in which neither a command nor a time-out changes what is demanded.
struct BlockSteps {
  Block* block = nullptr;       // whose craft move
  const Row* more = nullptr;    // numbers of forces, rotors and the ground
  const Row* wind_W = nullptr;  // three rows, m/s
  std::size_t wind_stride = 0;  // rows from one step's wind to the next one's; 0: constant
  std::int64_t count = 0;       // steps
  /// Speeds of the cushion's fans, a row each: at the start, in the middle and at the end of a
  /// step.
  const Row* fan_speeds = nullptr;
  std::size_t fan_stride = 0;  // likewise
};

/// Makes the steps, each with the operations and in the order of Simulation::step(): the same bits.
/// A craft whose state would not be sound after a step stays as it is before it, `moves` is none
/// then, and lost_after says how many steps were made. The floating-point environment must be the
/// default one.
using Advance = void (*)(const StepPlan&, const BlockSteps&);

}  // namespace hovercraft::lanes
