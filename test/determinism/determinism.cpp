/// determinism FOLDER [--record | LAST_TICK]: flies the runs of FOLDER/hashes.txt, to LAST_TICK or
/// to their end, and says which differ from what was recorded; exit status 0 if none does.
/// --record writes the hashes anew.
///
/// Beside the verdict it prints a hash of the states without and with contact, and one of what the
/// C library's exp, sin, cos and pow return. No state depends on it: where it differs between two
/// machines, the state hashes were put to a test.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <fmt/format.h>
#include <fstream>
#include <iostream>

#include "hovercraft_sim/sim/state_hash.h"

#include "../support/sanitizer_options.h"
#include "recorded_runs.h"

namespace {

using namespace hovercraft;
using namespace hovercraft::testing;

/// @param arguments how many of each function.
std::uint64_t hashOfLibm(int arguments) {
  StateHash hash;
  for (int i = 1; i <= arguments; ++i) {
    // Not known to the compiler, which would compute the functions itself.
    const volatile double x = i * 0.0123456789;
    for (const double y : {std::exp(x / 100.0), std::sin(x), std::cos(x), std::pow(x, 1.7)}) {
      hash.add(y);
    }
  }
  return hash.value();
}

/// @returns whether every run is as recorded.
bool check(const std::string& folder, Tick last_tick) {
  bool all_equal = true;
  StateHash of_free;
  StateHash of_contact;
  const auto runs = readRecordedRuns(folder);
  for (const RecordedRun& run : runs) {
    const auto flown = fly(folder, run, last_tick);
    StateHash& of_kind = hasContact(folder, run) ? of_contact : of_free;
    for (const std::uint64_t hash : flown) of_kind.add(hash);
    const std::string difference = firstDifference(run, flown);
    if (difference.empty()) continue;
    all_equal = false;
    std::cerr << "DIFFERENT " << difference << '\n';
  }
  std::cout << fmt::format("{} {:016x} contact {:016x} libm {:016x}\n",
                           all_equal ? "identical" : "DIFFERENT", of_free.value(),
                           of_contact.value(), hashOfLibm(100000));
  return all_equal;
}

void record(const std::string& folder) {
  auto runs = readRecordedRuns(folder);
  for (RecordedRun& run : runs) {
    const auto flown = fly(folder, run, kLastTick);
    std::copy(flown.begin(), flown.end(), run.hashes.begin());
  }
  std::ofstream(folder + "/hashes.txt") << textOf(runs);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc == 2) return check(argv[1], kLastTick) ? 0 : 1;
    if (argc == 3 && std::strcmp(argv[2], "--record") != 0) {
      return check(argv[1], std::stoll(argv[2])) ? 0 : 1;
    }
    if (argc == 3) {
      record(argv[1]);
      return 0;
    }
    std::cerr << "usage: determinism FOLDER [--record | LAST_TICK]\n";
  } catch (const std::exception& error) {
    std::cerr << "determinism: " << error.what() << '\n';
  }
  return 2;
}
