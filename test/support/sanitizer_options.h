#pragma once

#ifdef HOVERCRAFT_SANITIZE
/// For the main() of a program: it says where it was when undefined behaviour ended it
/// (cmake/hovercraft_core.cmake).
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming): AddressSanitizer's.
extern "C" const char* __asan_default_options() {
  return "handle_sigill=1";
}
#endif
