#pragma once

namespace hovercraft::testing {

/// Under the sanitizers a test takes twenty to thirty times as long, and a fault that they see
/// shows in a few cases as in many. So a test of very many cases, or steps, takes one in kShare
/// there; a prime, so that no row or column of a table is left out whole.
#ifdef HOVERCRAFT_SANITIZE
inline constexpr int kShare = 7;
#else
inline constexpr int kShare = 1;
#endif

/// @returns how many of `whole` cases or steps this build takes.
constexpr int shareOf(int whole) {
  return (whole + kShare - 1) / kShare;
}

}  // namespace hovercraft::testing
