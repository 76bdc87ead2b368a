#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// An actuator of a craft: 0, 1, 2 are the engines rear, left and right, which every craft has; the
/// others follow in the order of their names.
enum class ActuatorId : std::uint8_t { kRear = 0, kLeft = 1, kRight = 2 };

constexpr std::size_t kFirstActuator = 3;  // the first id that is no engine
constexpr std::size_t kMaxActuators = 11;  // the engines and up to 8 more

/// One value of each actuator of a craft, by id: the engines first, then `more` others. It lies in
/// itself and allocates nothing.
template <class T>
class ActuatorArray {
 public:
  /// Of the three engines.
  ActuatorArray() = default;
  /// @param values at least three, at most kMaxActuators.
  ActuatorArray(std::initializer_list<T> values) : size_(checked(values.size())) {
    std::copy(values.begin(), values.end(), values_.begin());
  }
  /// Of the three engines.
  ActuatorArray(const std::array<T, kFirstActuator>& engines) {
    std::copy(engines.begin(), engines.end(), values_.begin());
  }
  /// Of the three engines: rear, left, right. Of numbers only.
  ActuatorArray(const Vector3& engines) {
    for (int i = 0; i < 3; ++i) values_[static_cast<std::size_t>(i)] = engines[i];
  }

  std::size_t size() const { return size_; }  // actuators
  /// New places hold T().
  void resize(std::size_t size) {
    for (std::size_t i = size_; i < checked(size); ++i) values_[i] = T();
    size_ = size;
  }
  /// As the last one. @throws std::logic_error beyond kMaxActuators.
  void append(const T& value) {
    size_ = checked(size_ + 1);
    values_[size_ - 1] = value;
  }

  /// By id; no bounds are checked.
  T& operator[](std::size_t id) { return values_[id]; }
  const T& operator[](std::size_t id) const { return values_[id]; }
  T& operator[](ActuatorId id) { return values_[static_cast<std::size_t>(id)]; }
  const T& operator[](ActuatorId id) const { return values_[static_cast<std::size_t>(id)]; }

  /// In the order of ids.
  T* begin() { return values_.data(); }
  T* end() { return values_.data() + size_; }
  const T* begin() const { return values_.data(); }
  const T* end() const { return values_.data() + size_; }

  friend bool operator==(const ActuatorArray& a, const ActuatorArray& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  static std::size_t checked(std::size_t size) {
    demand(size >= kFirstActuator && size <= kMaxActuators, "a craft has 3 to 11 actuators");
    return size;
  }

  std::array<T, kMaxActuators> values_{};
  std::size_t size_ = kFirstActuator;
};

/// Whether none is infinite or NaN.
inline bool allFinite(const ActuatorArray<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); });
}

}  // namespace hovercraft
