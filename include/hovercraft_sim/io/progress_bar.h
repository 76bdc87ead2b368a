#pragma once

#include <chrono>
#include <cstdint>
#include <ostream>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// A line on a terminal that shows how much is done; it is drawn at most ten times a second.
class HOVERCRAFT_PUBLIC ProgressBar {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param whole what counts as all done, > 0.
  ProgressBar(std::ostream& terminal, std::int64_t whole);
  /// Wipes the line.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(std::int64_t done, Clock::time_point now = Clock::now());

 private:
  std::ostream& terminal_;
  std::int64_t whole_;
  bool drawn_ = false;
  Clock::time_point last_;
};

}  // namespace hovercraft
