#pragma once

#include <cfenv>
#include <cstdint>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// While it lives, this thread computes in the default floating-point environment of IEEE 754: to
/// the nearest, with denormal numbers (no flush-to-zero, no denormals-are-zero), no exception
/// traps. Where the thread had another one, it comes back to the last bit at the end, with its
/// exception flags and masks; else nothing is changed, and the flags are what the arithmetic
/// leaves.
///
/// A program that is linked with -ffast-math sets flush-to-zero when it starts, as does a plug-in
/// or a shared library that was; fesetround() and feenableexcept() change it too. What the library
/// computes of a state must not depend on it, so its functions have such a guard. They read the
/// environment each time, for a few instructions: a callback may change it.
///
/// Header-only functions, such as the steppers, take the environment as they find it: put one of
/// these before them.
class FloatingPointEnvironment {
 public:
  FloatingPointEnvironment() {
    if (isOther()) setDefault();
  }
  ~FloatingPointEnvironment() {
    if (is_set_) restore();
  }
  FloatingPointEnvironment(const FloatingPointEnvironment&) = delete;
  FloatingPointEnvironment& operator=(const FloatingPointEnvironment&) = delete;

  /// The number, computed here: a compiler takes arithmetic for independent of the environment, and
  /// moves it past whoever changes that. For what a function takes or returns in registers.
  static double computed(double number) {
#if defined(__x86_64__)
    asm volatile("" : "+x"(number) : : "memory");
    return number;
#elif defined(__aarch64__)
    asm volatile("" : "+w"(number) : : "memory");
    return number;
#else
    const volatile double held = number;
    return held;
#endif
  }

 private:
  HOVERCRAFT_PUBLIC void setDefault();
  HOVERCRAFT_PUBLIC void restore();

#if defined(__x86_64__)
  // MXCSR: the masks of all exceptions; rounding, flush-to-zero and denormals-are-zero are 0. The
  // flags, its six lowest bits, are no part of it. The x87 is not read, as no double is computed
  // there: fesetround() and feenableexcept() set both. (The C library's strtod and printf take the
  // direction of rounding from the x87.)
  static constexpr std::uint32_t kControls = 0xffc0;
  static constexpr std::uint32_t kDefault = 0x1f80;

  bool isOther() {
    // The clobber keeps the compiler from moving what follows before it.
    asm volatile("stmxcsr %0" : "=m"(control_) : : "memory");
    return (control_ & kControls) != kDefault;
  }

  std::uint32_t control_;
  unsigned char x87_[28];  // as fnstenv stores it
#elif defined(__aarch64__)
  bool isOther() {
    asm volatile("mrs %0, fpcr" : "=r"(control_) : : "memory");
    return control_ != 0;
  }

  std::uint64_t control_;
#else
  static bool isOther() {
    return true;
  }

  std::fenv_t environment_;
#endif
  bool is_set_ = false;
};

}  // namespace hovercraft
