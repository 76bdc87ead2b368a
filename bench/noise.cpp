/// The distribution and the cost of normal variates by counter: moments and tails of N draws, each
/// beside what is expected and in its standard errors; processor time of a draw; a hash of the
/// bits.
///
///   bench_noise [DRAWS] [SEED]       default 10^8 and 1

#include "hovercraft_sim/math/noise.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace {

void printRow(const char* what, double found, double expected, double standard_error) {
  std::printf("| %s | %.10g | %.10g | %+.2f |\n", what, found, expected,
              (found - expected) / standard_error);
}

}  // namespace

int main(int argc, char** argv) {
  const double draws = argc > 1 ? std::strtod(argv[1], nullptr) : 1e8;
  const std::int64_t seed = argc > 2 ? std::strtoll(argv[2], nullptr, 10) : 1;
  const hovercraft::NoiseChannel channel(seed, hovercraft::streamOf("bench/noise/normal"));
  double sums[5] = {};
  double beyond[6] = {};
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  const std::clock_t begin = std::clock();
  for (std::int64_t tick = 0; static_cast<double>(tick) < draws; ++tick) {
    const double z = channel.normal(tick);
    const double square = z * z;
    sums[1] += z;
    sums[2] += square;
    sums[4] += square * square;
    const double size = std::abs(z);
    for (int sigma = 3; sigma <= 5; ++sigma) beyond[sigma] += size > sigma ? 1.0 : 0.0;
    std::uint64_t bits = 0;
    std::memcpy(&bits, &z, sizeof(bits));
    hash = (hash ^ bits) * 0x100000001b3ULL;
  }
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  std::printf(
      "| of %.0f draws, seed %lld | found | expected | standard errors |\n|---|---|---|---|\n",
      draws, static_cast<long long>(seed));
  printRow("mean", sums[1] / draws, 0.0, std::sqrt(1.0 / draws));
  printRow("variance", sums[2] / draws, 1.0, std::sqrt(2.0 / draws));
  printRow("fourth moment", sums[4] / draws, 3.0, std::sqrt(96.0 / draws));
  for (int sigma = 3; sigma <= 5; ++sigma) {
    const double expected = draws * std::erfc(sigma / std::sqrt(2.0));
    char name[32];
    std::snprintf(name, sizeof(name), "beyond %d", sigma);
    printRow(name, beyond[sigma], expected, std::sqrt(expected));
  }
  std::printf("%.1f ns of processor time a draw; hash %016llx\n", 1e9 * seconds / draws,
              static_cast<unsigned long long>(hash));
  return 0;
}
