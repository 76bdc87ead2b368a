#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/philox.h"
#include "hovercraft_sim/math/time.h"

namespace hovercraft {

/// A standard normal variate, a pure function of 64 random bits: the top bit is the sign (1:
/// negative), the next 52 bits k choose the tail p = (k + 1/2) 2^-53, and the magnitude is the
/// normal quantile Φ⁻¹(1 - p) by Wichura's AS 241 (PPND16, Applied Statistics 37, 1988). The law is
/// the normal one in 2^53 atoms of equal weight; the largest magnitude is 8.2924. Absolute error at
/// most 4.1e-15. Only + - * / and sqrt: the same bits on every machine.
HOVERCRAFT_PUBLIC double normalFromBits(std::uint64_t bits);

/// FNV-1a (Fowler, Noll, Vo), 32 bits, of a name's bytes.
constexpr std::uint32_t streamOf(std::string_view name) {
  std::uint32_t hash = 2166136261U;
  for (const char letter : name) {
    hash ^= static_cast<unsigned char>(letter);
    hash *= 16777619U;
  }
  return hash;
}

/// White noise of one channel of one source ("vehicle/source/channel"). A draw is a function of
/// seed, channel, tick and number alone: nothing is remembered, the order of draws does not matter,
/// and no other channel can change it.
class HOVERCRAFT_PUBLIC NoiseChannel {
 public:
  /// @param seed of the run. @param stream from streamOf() or NoiseStreams.
  NoiseChannel(std::int64_t seed, std::uint32_t stream)
      : key_{lowWord(seed), highWord(seed)}, stream_(stream) {}

  /// 64 random bits. @param draw its number among those of this tick.
  std::uint64_t bits(Tick tick, std::uint32_t draw = 0) const {
    const PhiloxCounter words = wordsOf(tick, draw);
    return (std::uint64_t{words[1]} << 32U) | words[0];
  }

  /// A standard normal variate, of bits().
  double normal(Tick tick, std::uint32_t draw = 0) const {
    return normalFromBits(bits(tick, draw));
  }

  /// Two independent ones of one draw, of which the first is normal().
  std::array<double, 2> normals(Tick tick, std::uint32_t draw) const {
    const PhiloxCounter words = wordsOf(tick, draw);
    return {normalFromBits((std::uint64_t{words[1]} << 32U) | words[0]),
            normalFromBits((std::uint64_t{words[3]} << 32U) | words[2])};
  }

  /// Uniform in [0, 1): a multiple of 2^-53.
  double uniform(Tick tick, std::uint32_t draw = 0) const {
    constexpr double kUnit = 1.0 / 9007199254740992.0;  // 2^-53
    return static_cast<double>(bits(tick, draw) >> 11U) * kUnit;
  }

 private:
  PhiloxCounter wordsOf(Tick tick, std::uint32_t draw) const {
    return philox4x32({lowWord(tick), highWord(tick), stream_, draw}, key_);
  }
  static constexpr std::uint32_t lowWord(std::int64_t number) {
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(number));
  }
  static constexpr std::uint32_t highWord(std::int64_t number) {
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(number) >> 32U);
  }

  PhiloxKey key_;
  std::uint32_t stream_;
};

/// The names of a run's noise channels: no two may share a stream.
class HOVERCRAFT_PUBLIC NoiseStreams {
 public:
  /// @param name "vehicle/source/channel". @returns its stream.
  /// @throws std::invalid_argument with both names if another one has the same stream, or if it was
  /// added before.
  std::uint32_t add(const std::string& name);

 private:
  std::map<std::uint32_t, std::string> names_;
};

}  // namespace hovercraft
