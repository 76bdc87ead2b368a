#include "hovercraft_sim/pacing/duration_histogram.h"

#include <algorithm>
#include <cmath>

namespace hovercraft {

// A duration below 8 is its own bucket; above, the bucket is its exponent and its three bits after
// the leading one.
std::size_t DurationHistogram::bucketOf(std::uint64_t duration_ns) {
  constexpr std::uint64_t first_octave = 1U << kBitsPerOctave;
  if (duration_ns < first_octave) return static_cast<std::size_t>(duration_ns);
  int exponent = 0;
  while ((duration_ns >> exponent) >= 2 * first_octave) ++exponent;
  return static_cast<std::size_t>((static_cast<std::uint64_t>(exponent) << kBitsPerOctave) +
                                  (duration_ns >> exponent));
}

std::uint64_t DurationHistogram::upperEnd(std::size_t bucket) {
  constexpr std::size_t first_octave = 1U << kBitsPerOctave;
  if (bucket < 2 * first_octave) return bucket;
  const std::size_t exponent = (bucket >> kBitsPerOctave) - 1;
  const std::uint64_t mantissa = first_octave + bucket % first_octave;
  return ((mantissa + 1) << exponent) - 1;
}

void DurationHistogram::add(std::int64_t duration_ns) {
  const std::int64_t duration = std::max<std::int64_t>(duration_ns, 0);
  ++counts_[bucketOf(static_cast<std::uint64_t>(duration))];
  ++count_;
  maximum_ = std::max(maximum_, duration);
}

std::int64_t DurationHistogram::quantile(double share) const {
  if (count_ == 0) return 0;
  const double wanted = std::max(1.0, std::ceil(share * static_cast<double>(count_)));
  std::uint64_t below = 0;
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
    below += counts_[bucket];
    if (static_cast<double>(below) >= wanted) {
      return std::min(static_cast<std::int64_t>(upperEnd(bucket)), maximum_);
    }
  }
  return maximum_;
}

}  // namespace hovercraft
