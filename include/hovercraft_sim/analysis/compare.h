#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/records/trajectory.h"

namespace hovercraft {

/// Which samples of two trajectories belong together.
enum class SampleMatching {
  kExact,        // those of the same time; each must have its partner
  kCommon,       // those of the same time; the others are passed over
  kInterpolated  // each of A with B at its time (linear, slerp), where B has a sample before and
                 // after
};

struct CompareOptions {
  /// What is allowed, m and rad; 0 or greater. Not set: not judged. If neither is set, the
  /// trajectories must be the same to the last bit.
  std::optional<double> position_tolerance;
  std::optional<double> attitude_tolerance;  // likewise
  /// Judge the error that is left when the difference of the first poses is taken away.
  bool relative = false;
  SampleMatching matching = SampleMatching::kExact;  // which samples are compared
  /// Count the times of each trajectory from its first sample.
  bool from_start = false;
};

/// How far B is from A at one time.
struct TrajectoryError {
  std::int64_t time_ns = 0;            // ns
  double position = 0.0;               // m: |p_B - p_A|, in the same world
  double attitude = 0.0;               // rad: angle of the rotation from A to B
  double relative_position = 0.0;      // the same with both seen from their own first pose
  double relative_attitude = 0.0;      // rad
  Vector3 offset_W = Vector3::Zero();  // m: p_B - p_A
};

/// A course of errors in four numbers, m or rad.
struct ErrorSummary {
  double max = 0.0;              // the greatest
  std::int64_t max_time_ns = 0;  // ns, when it was
  double rms = 0.0;              // root of the mean square
  double final = 0.0;
};

/// Samples that have no partner.
struct UnmatchedSamples {
  std::size_t count = 0;      // of samples
  std::int64_t first_ns = 0;  // ns, of the first one
  std::int64_t last_ns = 0;   // ns, of the last one
};

/// Where two trajectories part for the first time.
struct Divergence {
  std::int64_t time_ns = 0;  // ns
  std::string quantity;      // "position" or "attitude" beyond its tolerance; or the column of the
                             // states CSV whose bits differ
  double a = 0.0;            // of a tolerance: the error; of bits: the number of A
  double b = 0.0;            // of a tolerance: the tolerance; of bits: the number of B
  bool is_bits = false;      // of bits, else of a tolerance
  Vector3 offset_W = Vector3::Zero();  // m, of a tolerance of position: p_B - p_A at that time
};

struct Comparison {
  std::vector<TrajectoryError> errors;  // at each matched time
  ErrorSummary position;
  ErrorSummary attitude;
  ErrorSummary relative_position;
  ErrorSummary relative_attitude;        // likewise: each over the errors above
  UnmatchedSamples only_in_a;            // samples of A without a partner
  UnmatchedSamples only_in_b;            // likewise of B
  std::optional<Divergence> divergence;  // none: they do not part
  bool compared_velocities = false;      // among the bits
  bool is_within = false;  // no divergence, something was matched, and nothing lacks its partner
                           // that must have one
};

/// Compares two trajectories sample by sample; A is the reference. A sample at time 0 needs no
/// partner in a trajectory that cannot hold one.
/// @throws std::invalid_argument if a tolerance is negative or not finite.
HOVERCRAFT_PUBLIC Comparison compareTrajectories(const Trajectory& a, const Trajectory& b,
                                                 const CompareOptions& options);

/// Two trajectories that are to be compared.
struct TrajectoryPair {
  const Trajectory* a = nullptr;
  const Trajectory* b = nullptr;
};

/// Each trajectory of A with that of the same vehicle in B; a single one of A with a single one of
/// B, whatever they are called.
/// @param vehicle the only one to pair; empty: all.
/// @throws std::invalid_argument that names the vehicle that has no partner, or is not there.
HOVERCRAFT_PUBLIC std::vector<TrajectoryPair> pairByVehicle(const std::vector<Trajectory>& a,
                                                            const std::vector<Trajectory>& b,
                                                            const std::string& vehicle = "");

/// A comparison in words and numbers, several lines.
HOVERCRAFT_PUBLIC std::string toText(const Comparison& comparison, const CompareOptions& options);

/// The errors over time as CSV with the header
/// `time,position,attitude,relative_position,relative_attitude` (s, m, rad).
HOVERCRAFT_PUBLIC std::string errorsCsv(const Comparison& comparison);

}  // namespace hovercraft
