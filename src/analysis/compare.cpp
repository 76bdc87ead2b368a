#include "hovercraft_sim/analysis/compare.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <stdexcept>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/time.h"

namespace hovercraft {
namespace {

/// A sample of A and what stands for B at its time.
struct Pair {
  TrajectorySample a;
  TrajectorySample b;
};

struct Matched {
  std::vector<Pair> pairs;
  UnmatchedSamples only_in_a;
  UnmatchedSamples only_in_b;
};

void addUnmatched(UnmatchedSamples& unmatched, std::int64_t time_ns) {
  if (unmatched.count++ == 0) unmatched.first_ns = time_ns;
  unmatched.last_ns = time_ns;
}

std::vector<TrajectorySample> samplesOf(const Trajectory& trajectory, bool from_start) {
  std::vector<TrajectorySample> samples = trajectory.samples;
  if (!from_start || samples.empty()) return samples;
  const std::int64_t start_ns = samples.front().time_ns;
  for (TrajectorySample& sample : samples) sample.time_ns -= start_ns;
  return samples;
}

Matched matchedByTime(const std::vector<TrajectorySample>& a,
                      const std::vector<TrajectorySample>& b) {
  Matched matched;
  auto in_b = b.begin();
  for (const TrajectorySample& sample : a) {
    for (; in_b != b.end() && in_b->time_ns < sample.time_ns; ++in_b) {
      addUnmatched(matched.only_in_b, in_b->time_ns);
    }
    if (in_b != b.end() && in_b->time_ns == sample.time_ns) {
      matched.pairs.push_back({sample, *in_b++});
    } else {
      addUnmatched(matched.only_in_a, sample.time_ns);
    }
  }
  for (; in_b != b.end(); ++in_b) addUnmatched(matched.only_in_b, in_b->time_ns);
  return matched;
}

/// Along the shorter arc from a to b at constant speed (Shoemake 1985).
Quaternion slerp(const Quaternion& a, const Quaternion& b, double part) {
  const double cosine = a.s * b.s + dot(a.v, b.v);
  const Quaternion near_b = cosine < 0.0 ? -1.0 * b : b;
  const double angle = 0.5 * angleBetween(a, b);
  if (std::sin(angle) == 0.0) return a;
  return (std::sin((1.0 - part) * angle) / std::sin(angle)) * a +
         (std::sin(part * angle) / std::sin(angle)) * near_b;
}

TrajectorySample interpolated(const TrajectorySample& before, const TrajectorySample& after,
                              std::int64_t time_ns) {
  if (before.time_ns == time_ns) return before;
  const double part = static_cast<double>(time_ns - before.time_ns) /
                      static_cast<double>(after.time_ns - before.time_ns);
  const auto between = [part](const Vector3& u, const Vector3& v) -> Vector3 {
    return u + part * (v - u);
  };
  return {time_ns, between(before.p_WB, after.p_WB), slerp(before.q_WB, after.q_WB, part),
          between(before.v_WB, after.v_WB), between(before.w_WB, after.w_WB)};
}

Matched matchedByInterpolation(const std::vector<TrajectorySample>& a,
                               const std::vector<TrajectorySample>& b) {
  Matched matched;
  for (const TrajectorySample& sample : a) {
    const auto after = std::lower_bound(b.begin(), b.end(), sample.time_ns,
                                        [](const TrajectorySample& candidate, std::int64_t time) {
                                          return candidate.time_ns < time;
                                        });
    const bool is_at = after != b.end() && after->time_ns == sample.time_ns;
    if (after == b.end() || (after == b.begin() && !is_at)) {
      addUnmatched(matched.only_in_a, sample.time_ns);
      continue;
    }
    const TrajectorySample& before = is_at ? *after : *(after - 1);
    matched.pairs.push_back({sample, interpolated(before, *after, sample.time_ns)});
  }
  return matched;
}

struct RelativePose {
  Vector3 p;
  Quaternion q;
};

/// The pose of a sample as seen from the first one.
RelativePose seenFrom(const TrajectorySample& first, const TrajectorySample& sample) {
  const Quaternion inverse = conjugate(normalized(first.q_WB));
  return {rotate(inverse, sample.p_WB - first.p_WB), inverse * sample.q_WB};
}

std::vector<TrajectoryError> errorsOf(const std::vector<Pair>& pairs) {
  std::vector<TrajectoryError> errors;
  errors.reserve(pairs.size());
  for (const Pair& pair : pairs) {
    const RelativePose a = seenFrom(pairs.front().a, pair.a);
    const RelativePose b = seenFrom(pairs.front().b, pair.b);
    errors.push_back({pair.a.time_ns, norm(pair.b.p_WB - pair.a.p_WB),
                      angleBetween(pair.a.q_WB, pair.b.q_WB), norm(b.p - a.p),
                      angleBetween(a.q, b.q), pair.b.p_WB - pair.a.p_WB});
  }
  return errors;
}

ErrorSummary summaryOf(const std::vector<TrajectoryError>& errors, double TrajectoryError::*error) {
  ErrorSummary summary;
  double sum_of_squares = 0.0;
  for (const TrajectoryError& at : errors) {
    const double value = at.*error;
    sum_of_squares += value * value;
    summary.final = value;
    if (value <= summary.max) continue;
    summary.max = value;
    summary.max_time_ns = at.time_ns;
  }
  if (!errors.empty()) summary.rms = std::sqrt(sum_of_squares / static_cast<double>(errors.size()));
  return summary;
}

constexpr const char* kColumns[] = {"x",  "y",  "z",  "qx", "qy", "qz", "qw",
                                    "vx", "vy", "vz", "wx", "wy", "wz"};
constexpr std::size_t kPoseColumns = 7;
constexpr std::size_t kAllColumns = 13;

double columnOf(const TrajectorySample& sample, std::size_t column) {
  const auto i = static_cast<Eigen::Index>(column);
  if (column < 3) return sample.p_WB[i];
  if (column < 6) return sample.q_WB.v[i - 3];
  if (column == 6) return sample.q_WB.s;
  return column < 10 ? sample.v_WB[i - 7] : sample.w_WB[i - 10];
}

bool haveSameBits(double a, double b) {
  std::uint64_t bits_a = 0;
  std::uint64_t bits_b = 0;
  std::memcpy(&bits_a, &a, sizeof(bits_a));
  std::memcpy(&bits_b, &b, sizeof(bits_b));
  return bits_a == bits_b;
}

std::optional<Divergence> firstDifferentBit(const std::vector<Pair>& pairs, bool with_velocities) {
  for (const Pair& pair : pairs) {
    for (std::size_t column = 0; column < (with_velocities ? kAllColumns : kPoseColumns);
         ++column) {
      const double a = columnOf(pair.a, column);
      const double b = columnOf(pair.b, column);
      if (haveSameBits(a, b)) continue;
      return Divergence{pair.a.time_ns, kColumns[column], a, b, true, pair.b.p_WB - pair.a.p_WB};
    }
  }
  return std::nullopt;
}

std::optional<Divergence> firstBeyond(const std::vector<TrajectoryError>& errors,
                                      const CompareOptions& options) {
  for (const TrajectoryError& error : errors) {
    const double position = options.relative ? error.relative_position : error.position;
    const double attitude = options.relative ? error.relative_attitude : error.attitude;
    // Written so that an error that is not a number counts as beyond.
    if (options.position_tolerance && !(position <= *options.position_tolerance)) {
      return Divergence{error.time_ns, "position",    position, *options.position_tolerance,
                        false,         error.offset_W};
    }
    if (options.attitude_tolerance && !(attitude <= *options.attitude_tolerance)) {
      return Divergence{error.time_ns, "attitude",    attitude, *options.attitude_tolerance,
                        false,         error.offset_W};
    }
  }
  return std::nullopt;
}

void checkTolerance(const std::optional<double>& tolerance, const char* name, const char* unit) {
  if (!tolerance || (std::isfinite(*tolerance) && *tolerance >= 0.0)) return;
  throw std::invalid_argument(
      fmt::format("{} = {} {}: must be 0 or greater, and finite", name, *tolerance, unit));
}

/// Samples without a partner, but for one at time 0 that the other trajectory cannot hold.
std::size_t missedBy(const Trajectory& other, const UnmatchedSamples& unmatched) {
  const bool is_forgiven = !other.holds_time_zero && unmatched.count > 0 && unmatched.first_ns == 0;
  return unmatched.count - (is_forgiven ? 1 : 0);
}

}  // namespace

Comparison compareTrajectories(const Trajectory& a, const Trajectory& b,
                               const CompareOptions& options) {
  const FloatingPointEnvironment environment;
  checkTolerance(options.position_tolerance, "position tolerance", "m");
  checkTolerance(options.attitude_tolerance, "attitude tolerance", "rad");
  const auto samples_a = samplesOf(a, options.from_start);
  const auto samples_b = samplesOf(b, options.from_start);
  const Matched matched = options.matching == SampleMatching::kInterpolated
                              ? matchedByInterpolation(samples_a, samples_b)
                              : matchedByTime(samples_a, samples_b);
  Comparison comparison;
  comparison.errors = errorsOf(matched.pairs);
  comparison.position = summaryOf(comparison.errors, &TrajectoryError::position);
  comparison.attitude = summaryOf(comparison.errors, &TrajectoryError::attitude);
  comparison.relative_position = summaryOf(comparison.errors, &TrajectoryError::relative_position);
  comparison.relative_attitude = summaryOf(comparison.errors, &TrajectoryError::relative_attitude);
  comparison.only_in_a = matched.only_in_a;
  comparison.only_in_b = matched.only_in_b;
  comparison.compared_velocities = a.has_velocities && b.has_velocities;
  comparison.divergence = options.position_tolerance || options.attitude_tolerance
                              ? firstBeyond(comparison.errors, options)
                              : firstDifferentBit(matched.pairs, comparison.compared_velocities);
  const bool all_have_partners =
      options.matching != SampleMatching::kExact ||
      (missedBy(b, matched.only_in_a) == 0 && missedBy(a, matched.only_in_b) == 0);
  comparison.is_within = !comparison.divergence && !comparison.errors.empty() && all_have_partners;
  return comparison;
}

}  // namespace hovercraft
