#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <malloc.h>
#include <new>

#ifdef HOVERCRAFT_SANITIZE
#include <sanitizer/allocator_interface.h>
#endif

/// Counts what an executable takes from the heap. To be included by one of its sources only, as it
/// replaces operator new and delete in every form; under the address sanitizer, which has them
/// replaced already, a hook counts instead.

namespace hovercraft::testing {

inline long allocations = 0;
inline long live_bytes = 0;  // taken and not given back
inline long peak_bytes = 0;  // the most that live_bytes was since this was set

inline void noteTaken(std::size_t size) {
  ++allocations;
  live_bytes += static_cast<long>(size);
  peak_bytes = std::max(peak_bytes, live_bytes);
}

#ifdef HOVERCRAFT_SANITIZE

inline const int allocation_hook = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void* /*memory*/, std::size_t size) { noteTaken(size); },
    [](const volatile void* memory) {
      live_bytes -= static_cast<long>(__sanitizer_get_allocated_size(memory));
    });

}  // namespace hovercraft::testing

#else

inline void* countedOrNull(std::size_t size) {
  void* memory = std::malloc(size == 0 ? 1 : size);
  noteTaken(malloc_usable_size(memory));
  return memory;
}

inline void giveBack(void* memory) {
  live_bytes -= static_cast<long>(malloc_usable_size(memory));
  std::free(memory);
}

inline void* counted(std::size_t size) {
  void* memory = countedOrNull(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

inline void* countedAligned(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  void* memory = std::aligned_alloc(step, (size + step - 1) / step * step);
  if (memory == nullptr) throw std::bad_alloc();
  noteTaken(malloc_usable_size(memory));
  return memory;
}

}  // namespace hovercraft::testing

void* operator new(std::size_t size) {
  return hovercraft::testing::counted(size);
}
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return hovercraft::testing::countedOrNull(size);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return hovercraft::testing::countedAligned(size, alignment);
}
void* operator new[](std::size_t size) {
  return hovercraft::testing::counted(size);
}
void* operator new[](std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return hovercraft::testing::countedOrNull(size);
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return hovercraft::testing::countedAligned(size, alignment);
}
void operator delete(void* memory) noexcept {
  hovercraft::testing::giveBack(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
  hovercraft::testing::giveBack(memory);
}
void operator delete(void* memory, const std::nothrow_t& /*tag*/) noexcept {
  hovercraft::testing::giveBack(memory);
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
  hovercraft::testing::giveBack(memory);
}
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
  hovercraft::testing::giveBack(memory);
}
void operator delete[](void* memory) noexcept {
  hovercraft::testing::giveBack(memory);
}
void operator delete[](void* memory, std::size_t /*size*/) noexcept {
  hovercraft::testing::giveBack(memory);
}
void operator delete[](void* memory, const std::nothrow_t& /*tag*/) noexcept {
  hovercraft::testing::giveBack(memory);
}
void operator delete[](void* memory, std::align_val_t /*alignment*/) noexcept {
  hovercraft::testing::giveBack(memory);
}
void operator delete[](void* memory, std::size_t /*size*/,
                       std::align_val_t /*alignment*/) noexcept {
  hovercraft::testing::giveBack(memory);
}

#endif
