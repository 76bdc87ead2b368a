#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {

#if defined(__x86_64__)

void FloatingPointEnvironment::setDefault() {
  const std::uint32_t sse = kDefault;
  const std::uint16_t x87 = 0x037f;  // masks of all exceptions, 64 bits, to the nearest
  asm volatile("ldmxcsr %0" : : "m"(sse) : "memory");
  // Stores what the thread has, flags and all, and masks the exceptions: none that is pending
  // comes.
  asm volatile("fnstenv %0" : "=m"(x87_) : : "memory");
  asm volatile("fldcw %0" : : "m"(x87) : "memory");
  is_set_ = true;
}

void FloatingPointEnvironment::restore() {
  asm volatile("fldenv %0" : : "m"(x87_) : "memory");
  asm volatile("ldmxcsr %0" : : "m"(control_) : "memory");
}

#elif defined(__aarch64__)

void FloatingPointEnvironment::setDefault() {
  asm volatile("msr fpcr, xzr" : : : "memory");
  is_set_ = true;
}

void FloatingPointEnvironment::restore() {
  asm volatile("msr fpcr, %0" : : "r"(control_) : "memory");
}

#else

void FloatingPointEnvironment::setDefault() {
  is_set_ = std::fegetenv(&environment_) == 0 && std::fesetenv(FE_DFL_ENV) == 0;
}

void FloatingPointEnvironment::restore() {
  std::fesetenv(&environment_);
}

#endif

}  // namespace hovercraft
