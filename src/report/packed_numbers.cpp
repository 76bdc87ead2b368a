#include "hovercraft_sim/report/packed_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hovercraft_sim/report/run_data.h"

namespace hovercraft_ros {
namespace {

/// The range of such values is a double, too.
bool isDrawn(double value) {
  return std::abs(value) <= kGreatestDrawn;
}

}  // namespace

void PackedNumbers::put(std::uint64_t value) {
  while (value >= 0x80U) {
    bytes_.push_back(static_cast<std::uint8_t>(value | 0x80U));
    value >>= 7U;
  }
  bytes_.push_back(static_cast<std::uint8_t>(value));
}

void PackedNumbers::endRun() {
  if (zeros_ == 0) return;
  put(0);
  put(zeros_ - 1);
  zeros_ = 0;
}

void PackedNumbers::putDifference(std::int64_t difference) {
  if (difference == 0) {
    ++zeros_;
    return;
  }
  endRun();
  const auto bits = static_cast<std::uint64_t>(difference);
  put((bits << 1U) ^ (difference < 0 ? ~std::uint64_t{0} : 0));
}

PackedColumn PackedNumbers::add(const std::vector<double>& values, int bits, std::size_t stride) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const double value : values) {
    if (!isDrawn(value)) continue;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  PackedColumn column;
  column.begin = bytes_.size();
  const auto steps = static_cast<double>((std::int64_t{1} << static_cast<unsigned>(bits)) - 2);
  const bool is_flat = !(most > least);
  column.least = std::isfinite(least) ? least : 0.0;
  column.step = is_flat ? 0.0 : (most - least) / steps;
  std::int64_t before = 0;
  for (std::size_t i = 0; i < values.size(); i += stride) {
    std::int64_t whole = 0;  // a gap
    if (isDrawn(values[i])) {
      const double share = column.step > 0.0 ? (values[i] - column.least) / column.step : 0.0;
      whole = 1 + static_cast<std::int64_t>(std::llround(std::clamp(share, 0.0, steps)));
    }
    putDifference(whole - before);
    before = whole;
    ++column.count;
  }
  endRun();
  return column;
}

PackedColumn PackedNumbers::addTimes(const std::vector<std::int64_t>& times_ns,
                                     std::size_t stride) {
  PackedColumn column;
  column.begin = bytes_.size();
  column.step = 1e-9;
  std::int64_t before = 0;
  std::int64_t difference_before = 0;
  for (std::size_t i = 0; i < times_ns.size(); i += stride) {
    const std::int64_t difference = times_ns[i] - before;
    putDifference(difference - difference_before);
    before = times_ns[i];
    difference_before = difference;
    ++column.count;
  }
  endRun();
  return column;
}

}  // namespace hovercraft_ros
