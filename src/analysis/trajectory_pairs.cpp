#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

#include "hovercraft_sim/analysis/compare.h"

namespace hovercraft {
namespace {

const Trajectory* find(const std::vector<Trajectory>& trajectories, const std::string& vehicle) {
  const auto found =
      std::find_if(trajectories.begin(), trajectories.end(),
                   [&](const Trajectory& trajectory) { return trajectory.vehicle == vehicle; });
  return found == trajectories.end() ? nullptr : &*found;
}

std::string namesOf(const std::vector<Trajectory>& trajectories) {
  std::string names;
  for (const Trajectory& trajectory : trajectories) {
    const std::string& name = trajectory.vehicle;
    names += (names.empty() ? "" : ", ") + (name.empty() ? "one without a name" : name);
  }
  return names.empty() ? "none" : names;
}

/// The trajectory of the vehicle, or the only one if that has no name.
const Trajectory& required(const std::vector<Trajectory>& trajectories, const std::string& vehicle,
                           const char* side) {
  const Trajectory* found = find(trajectories, vehicle);
  if (found == nullptr && trajectories.size() == 1) found = find(trajectories, "");
  if (found != nullptr) return *found;
  throw std::invalid_argument(fmt::format("vehicle = {}: {} does not have it; it has {}", vehicle,
                                          side, namesOf(trajectories)));
}

}  // namespace

std::vector<TrajectoryPair> pairByVehicle(const std::vector<Trajectory>& a,
                                          const std::vector<Trajectory>& b,
                                          const std::string& vehicle) {
  if (!vehicle.empty()) return {{&required(a, vehicle, "A"), &required(b, vehicle, "B")}};
  if (a.size() == 1 && b.size() == 1) return {{&a.front(), &b.front()}};
  std::vector<TrajectoryPair> pairs;
  pairs.reserve(a.size());
  for (const Trajectory& trajectory : a) {
    pairs.push_back({&trajectory, &required(b, trajectory.vehicle, "B")});
  }
  for (const Trajectory& trajectory : b) required(a, trajectory.vehicle, "A");
  if (pairs.empty()) throw std::invalid_argument("A has no trajectory, and neither has B");
  return pairs;
}

}  // namespace hovercraft
