#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// Quantiles of many durations in constant memory: buckets that grow by an eighth, from 8 ns to 146
/// years. A quantile is exact to one bucket (12.5 %); count and maximum are exact.
class HOVERCRAFT_PUBLIC DurationHistogram {
 public:
  /// @param duration_ns negative counts as 0.
  void add(std::int64_t duration_ns);
  void clear() { *this = DurationHistogram(); }

  std::uint64_t count() const { return count_; }
  std::int64_t maximum() const { return maximum_; }
  /// Upper end of the bucket that holds the given share of all durations, ns; 0 if there are none.
  /// @param share in [0, 1].
  std::int64_t quantile(double share) const;

 private:
  static constexpr int kBitsPerOctave = 3;  // 8 buckets each time the duration doubles
  static constexpr std::size_t kBuckets = 64U << kBitsPerOctave;

  static std::size_t bucketOf(std::uint64_t duration_ns);
  static std::uint64_t upperEnd(std::size_t bucket);

  std::array<std::uint64_t, kBuckets> counts_{};
  std::uint64_t count_ = 0;
  std::int64_t maximum_ = 0;
};

}  // namespace hovercraft
