#pragma once

#include <array>
#include <cfenv>
#include <cstdint>
#include <string>

namespace hovercraft::testing {

/// What a program may have made of the floating-point environment of its thread.
enum class Foreign : std::uint8_t {
  kFlushToZero,
  kDenormalsAreZero,
  kFastMath,  // both, as -ffast-math sets them when a program starts
  kUpward,
  kDownward,
  kTowardZero,
  kTraps,           // every exception traps, as after feenableexcept()
  kShortMantissas,  // of the x87: 24 bits
};
constexpr std::array<Foreign, 8> kForeign = {
    Foreign::kFlushToZero, Foreign::kDenormalsAreZero, Foreign::kFastMath, Foreign::kUpward,
    Foreign::kDownward,    Foreign::kTowardZero,       Foreign::kTraps,    Foreign::kShortMantissas,
};

inline std::string nameOf(Foreign foreign) {
  constexpr std::array<const char*, kForeign.size()> kNames = {
      "flush-to-zero", "denormals-are-zero", "both",  "upward",
      "downward",      "toward zero",        "traps", "short mantissas"};
  return kNames[static_cast<std::size_t>(foreign)];
}

/// The control registers of the thread, with the exception flags where they are part of them.
struct ControlRegisters {
  std::uint64_t main = 0;  // MXCSR, FPCR
  std::uint16_t x87 = 0;

  bool operator==(const ControlRegisters& other) const {
    return main == other.main && x87 == other.x87;
  }
};

inline ControlRegisters controlRegisters() {
  ControlRegisters registers;
#if defined(__x86_64__)
  std::uint32_t sse = 0;
  asm volatile("stmxcsr %0" : "=m"(sse) : : "memory");
  asm volatile("fnstcw %0" : "=m"(registers.x87) : : "memory");
  registers.main = sse;
#elif defined(__aarch64__)
  asm volatile("mrs %0, fpcr" : "=r"(registers.main) : : "memory");
#endif
  return registers;
}

/// While it lives, the thread has a foreign environment.
class InForeignEnvironment {
 public:
  explicit InForeignEnvironment(Foreign foreign) {
    std::fegetenv(&environment_);
    switch (foreign) {
      case Foreign::kFlushToZero:
        set(kFlush);
        return;
      case Foreign::kDenormalsAreZero:
        set(kDenormals);
        return;
      case Foreign::kFastMath:
        set(kFlush | kDenormals);
        return;
      case Foreign::kUpward:
        std::fesetround(FE_UPWARD);
        return;
      case Foreign::kDownward:
        std::fesetround(FE_DOWNWARD);
        return;
      case Foreign::kTowardZero:
        std::fesetround(FE_TOWARDZERO);
        return;
      case Foreign::kTraps:
        feenableexcept(FE_ALL_EXCEPT);
        return;
      case Foreign::kShortMantissas:
        setShortMantissas();
        return;
    }
  }
  ~InForeignEnvironment() {
    std::fesetenv(&environment_);
#if defined(__aarch64__)
    asm volatile("msr fpcr, xzr" : : : "memory");
#endif
  }
  InForeignEnvironment(const InForeignEnvironment&) = delete;
  InForeignEnvironment& operator=(const InForeignEnvironment&) = delete;

 private:
#if defined(__x86_64__)
  static constexpr std::uint32_t kFlush = 0x8000;
  static constexpr std::uint32_t kDenormals = 0x0040;

  static void set(std::uint32_t bits) {
    std::uint32_t sse = 0;
    asm volatile("stmxcsr %0" : "=m"(sse) : : "memory");
    sse |= bits;
    asm volatile("ldmxcsr %0" : : "m"(sse) : "memory");
  }
  static void setShortMantissas() {
    const std::uint16_t control = 0x007f;
    asm volatile("fldcw %0" : : "m"(control) : "memory");
  }
#elif defined(__aarch64__)
  static constexpr std::uint64_t kFlush = 1U << 24U;  // of operands too
  static constexpr std::uint64_t kDenormals = kFlush;

  static void set(std::uint64_t bits) {
    asm volatile("msr fpcr, %0" : : "r"(bits) : "memory");
  }
  static void setShortMantissas() {}
#else
  static constexpr int kFlush = 0;
  static constexpr int kDenormals = 0;

  static void set(int /*bits*/) {}
  static void setShortMantissas() {}
#endif

  std::fenv_t environment_{};
};

}  // namespace hovercraft::testing
