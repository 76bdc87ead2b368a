#pragma once

#include <cstddef>
#include <vector>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/time.h"

namespace hovercraft {

/// Samples on their way from a sensor to whoever waits for them, first in, first out. A ring of a
/// fixed size: nothing is allocated after it was made.
class SampleQueue {
 public:
  SampleQueue() = default;
  /// @param capacity samples. @param width doubles of each.
  SampleQueue(std::size_t capacity, std::size_t width)
      : width_(width), ticks_(capacity), values_(capacity * width) {}

  std::size_t size() const { return count_; }             // samples that wait
  std::size_t capacity() const { return ticks_.size(); }  // samples that fit
  std::size_t width() const { return width_; }            // doubles of a sample
  bool empty() const { return count_ == 0; }              // whether none waits

  /// A new last sample, measured at `tick`. @returns its values, to be filled.
  double* push(Tick tick) {
    demand(count_ < ticks_.size(), "a queue of samples must not overflow");
    const std::size_t slot = slotOf(count_++);
    ticks_[slot] = tick;
    return values_.data() + slot * width_;
  }
  /// Takes the last one back.
  void dropLast() { --count_; }
  /// Takes the first one away.
  void pop() {
    begin_ = slotOf(1);
    --count_;
  }
  /// @param index 0: the first one.
  Tick tick(std::size_t index) const { return ticks_[slotOf(index)]; }
  /// Of the sample of that index; as many as width().
  const double* values(std::size_t index) const { return values_.data() + slotOf(index) * width_; }

 private:
  std::size_t slotOf(std::size_t index) const { return (begin_ + index) % ticks_.size(); }

  std::size_t width_ = 0;
  std::size_t begin_ = 0;
  std::size_t count_ = 0;
  std::vector<Tick> ticks_;
  std::vector<double> values_;
};

}  // namespace hovercraft
