#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// Where a column lies among the packed bytes of a page, and what its whole numbers mean:
/// value = least + step * whole number; kGap is no value.
struct PackedColumn {
  std::size_t begin = 0;  // byte
  std::size_t count = 0;  // values
  double least = 0.0;
  double step = 0.0;
};

/// The numbers of a page as bytes: whole numbers, each as the difference from the one before
/// (times: from the difference before), zigzag, in groups of seven bits with the lowest first, and
/// runs of 0 as 0 and their length - 1. Curves take a byte or two a value, what does not change
/// takes none. For pictures only: a value is rounded to its step.
class HOVERCRAFT_PUBLIC PackedNumbers {
 public:
  static constexpr int kCurveBits = 16;     // of the range of a curve
  static constexpr int kPositionBits = 20;  // 1 mm of 1 km

  /// @param bits steps that the range of the values is divided into; values that are not finite
  /// (or beyond 1e300) become gaps. @param stride every stride-th value is taken.
  PackedColumn add(const std::vector<double>& values, int bits, std::size_t stride = 1);
  /// Times in ns, kept to the ns; `least` and `step` make s of them.
  PackedColumn addTimes(const std::vector<std::int64_t>& times_ns, std::size_t stride = 1);

  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  void put(std::uint64_t value);
  void putDifference(std::int64_t difference);
  void endRun();

  std::vector<std::uint8_t> bytes_;
  std::uint64_t zeros_ = 0;
};

}  // namespace hovercraft_ros
