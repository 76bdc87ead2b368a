#pragma once

#include <array>
#include <cstdint>

namespace hovercraft {

using PhiloxCounter = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;

constexpr int kPhiloxRounds = 10;

constexpr PhiloxCounter philoxRound(const PhiloxCounter& counter, const PhiloxKey& key) {
  constexpr std::uint64_t kMultipliers[2] = {0xD2511F53U, 0xCD9E8D57U};
  const std::uint64_t first = kMultipliers[0] * counter[0];
  const std::uint64_t second = kMultipliers[1] * counter[2];
  return {static_cast<std::uint32_t>(second >> 32U) ^ counter[1] ^ key[0],
          static_cast<std::uint32_t>(second),
          static_cast<std::uint32_t>(first >> 32U) ^ counter[3] ^ key[1],
          static_cast<std::uint32_t>(first)};
}
constexpr PhiloxKey nextPhiloxKey(const PhiloxKey& key) {
  constexpr PhiloxKey kWeyl = {0x9E3779B9U, 0xBB67AE85U};  // golden ratio, sqrt(3) - 1
  return {key[0] + kWeyl[0], key[1] + kWeyl[1]};
}

/// Philox4x32-10 (Salmon, Moraes, Dror, Shaw: Parallel Random Numbers: As Easy as 1, 2, 3, 2011):
/// 128 random bits that are a pure function of counter and key. Integer arithmetic only, so the
/// same on every machine.
constexpr PhiloxCounter philox4x32(PhiloxCounter counter, PhiloxKey key) {
  for (int round = 0; round < kPhiloxRounds; ++round) {
    counter = philoxRound(counter, key);
    key = nextPhiloxKey(key);
  }
  return counter;
}

/// philox4x32() of three counters at once: the same bits. Its rounds wait for multiplications, so
/// three take little longer than one.
constexpr std::array<PhiloxCounter, 3> threePhilox4x32(std::array<PhiloxCounter, 3> counters,
                                                       PhiloxKey key) {
  for (int round = 0; round < kPhiloxRounds; ++round) {
    counters = {philoxRound(counters[0], key), philoxRound(counters[1], key),
                philoxRound(counters[2], key)};
    key = nextPhiloxKey(key);
  }
  return counters;
}

}  // namespace hovercraft
