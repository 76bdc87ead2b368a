/// Our step beside that of other engines: one free body per world, 1 ms a step, pushed by a force
/// fixed to the body; and the attitude error of the same body, free, after 10 s. Prints Markdown;
/// with a file name as its argument it also writes the errors as CSV, in the columns of
/// bench/accuracy.
///
/// The engines take turns in short rounds and the medians of the rounds are compared: what else
/// runs on the machine slows all of them alike. Time is the process's, not the wall's.

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <exception>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <vector>

#include "hovercraft_sim/math/time.h"

#include "driven_craft.h"
#include "peer.h"

namespace hovercraft::bench {
namespace {

constexpr int kRounds = 101;
constexpr int kStepsPerRound = 2000;
constexpr double kStep = 0.001;  // s

struct Entry {
  const char* engine;
  const char* method;
  MakePeer make;
};

std::vector<Entry> entries() {
  return {
      {"hovercraft_sim", "heun", makeOurHeun},
      {"hovercraft_sim", "rk4", makeOurRungeKutta4},
#ifdef HOVERCRAFT_BENCH_MUJOCO
      {"MuJoCo " HOVERCRAFT_BENCH_MUJOCO, "Euler", makeMujocoEuler},
      {"MuJoCo " HOVERCRAFT_BENCH_MUJOCO, "RK4", makeMujocoRungeKutta4},
#endif
#ifdef HOVERCRAFT_BENCH_BULLET
      {"Bullet " HOVERCRAFT_BENCH_BULLET " (double)", "world", makeBullet},
#endif
#ifdef HOVERCRAFT_BENCH_ODE
      {"ODE " HOVERCRAFT_BENCH_ODE " (double)", "quick step", makeOde},
#endif
  };
}

double processSeconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

/// The whole step of the driven craft: engines with lag, limits and time-out, drag, wind.
class DrivenCraft : public Peer {
 public:
  DrivenCraft()
      : simulation_(drivenCraft(Integrator::kRungeKutta4, OrientationKind::kQuaternion,
                                BodyModel::kSpatial)) {
    simulation_.push({0, 0, kAllEngines, demandedThrusts()});
  }
  void step(const Vector3& /*f_B*/) override { simulation_.step(); }
  Quaternion attitude() const override { return simulation_.motion(0).q_WB; }

 private:
  Simulation simulation_;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Nanoseconds per step of each, the medians of rounds that all take part in.
std::vector<double> stepTimes(const std::vector<std::unique_ptr<Peer>>& peers) {
  const Vector3 f_B = {0.3, 0.1, 0.2};
  std::vector<std::vector<double>> times(peers.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < peers.size(); ++i) {
      const double begin = processSeconds();
      for (int n = 0; n < kStepsPerRound; ++n) peers[i]->step(f_B);
      times[i].push_back(1e9 * (processSeconds() - begin) / kStepsPerRound);
    }
  }
  std::vector<double> medians;
  medians.reserve(times.size());
  for (const std::vector<double>& rounds : times) medians.push_back(median(rounds));
  return medians;
}

double errorAfterFlight(const Entry& entry, const FreeCase& body, double h) {
  const std::unique_ptr<Peer> peer = entry.make(body, h);
  const auto steps = std::llround(body.duration / h);
  const Vector3 none = Vector3::Zero();
  for (std::int64_t n = 0; n < steps; ++n) peer->step(none);
  return attitudeError(body, peer->attitude());
}

void compare(std::ostream& csv) {
  const FreeCase body = asymmetricBody();
  std::vector<std::unique_ptr<Peer>> peers;
  for (const Entry& entry : entries()) peers.push_back(entry.make(body, kStep));
  peers.push_back(std::make_unique<DrivenCraft>());
  const std::vector<double> times = stepTimes(peers);
  const double our_time = times[1];
  const double driven_time = times.back();

  std::cout << fmt::format(
      "| engine | method | step (ns) | times our rk4 | times our whole driven rk4 | attitude error "
      "after {} s (rad) |\n"
      "|---|---|---|---|---|---|\n",
      body.duration);
  for (std::size_t i = 0; i < times.size() - 1; ++i) {
    const Entry entry = entries()[i];
    std::cout << fmt::format("| {} | {} | {:.0f} | {:.1f} | {:.1f} | {:.1e} |\n", entry.engine,
                             entry.method, times[i], times[i] / our_time, times[i] / driven_time,
                             errorAfterFlight(entry, body, kStep));
    for (const std::int64_t step_ns : comparedStepsNs()) {
      csv << fmt::format("{},{},{},{},{:.6e},\n", body.name, entry.engine, entry.method,
                         toSeconds(step_ns), errorAfterFlight(entry, body, toSeconds(step_ns)));
    }
  }
  std::cout << fmt::format(
      "| hovercraft_sim | rk4, whole driven craft | {:.0f} | {:.1f} | 1.0 | |\n", driven_time,
      driven_time / our_time);
}

}  // namespace
}  // namespace hovercraft::bench

int main(int argc, char** argv) {
  try {
    std::ofstream csv = hovercraft::bench::errorTable(argc > 1 ? argv[1] : nullptr);
    hovercraft::bench::compare(csv);
  } catch (const std::exception& error) {
    std::cerr << "peers: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
