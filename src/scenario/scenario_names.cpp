#include "hovercraft_sim/scenario/scenario_names.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft {
namespace {

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// Of all kinds that traitsOf() knows, in their order.
template <class Kind>
std::vector<std::string> namesOfKinds() {
  std::vector<std::string> names;
  while (const char* name = traitsOf(static_cast<Kind>(names.size())).name) names.push_back(name);
  return names;
}

}  // namespace

const std::vector<std::string>& integratorNames() {
  static const std::vector<std::string> names = {"euler", "semi_implicit_euler", "heun", "rk4",
                                                 "lie4"};
  return names;
}

const std::vector<std::string>& orientationNames() {
  static const std::vector<std::string> names = {"quaternion", "matrix"};
  return names;
}

const std::vector<std::string>& modelNames() {
  static const std::vector<std::string> names = {"planar", "spatial"};
  return names;
}

const std::vector<std::string>& actuatorKindNames() {
  static const std::vector<std::string> names = namesOfKinds<ActuatorKind>();
  return names;
}

const std::vector<std::string>& gustModelNames() {
  static const std::vector<std::string> names = {"first_order", "dryden"};
  return names;
}

const std::vector<std::string>& tfSourceNames() {
  static const std::vector<std::string> names = {"truth", "odometry", "none"};
  return names;
}

const std::vector<std::string>& sensorKindNames() {
  static const std::vector<std::string> names = namesOfKinds<SensorKind>();
  return names;
}

const std::vector<std::string>& frameNames() {
  static const std::vector<std::string> names = {"world", "body"};
  return names;
}

std::vector<std::string> vehicleNames(const Scenario& scenario) {
  std::vector<std::string> names;
  names.reserve(scenario.vehicles.size());
  for (const VehicleScenario& vehicle : scenario.vehicles) names.push_back(vehicle.name);
  return names;
}

std::size_t vehicleIndex(const Scenario& scenario, const std::string& name) {
  const std::vector<std::string> names = vehicleNames(scenario);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw std::invalid_argument(
        fmt::format("vehicle = {}: must be one of: {}", name, fmt::join(names, ", ")));
  }
  return static_cast<std::size_t>(found - names.begin());
}

bool isGraphName(const std::string& name) {
  return !name.empty() && isLetter(name.front()) &&
         std::all_of(name.begin(), name.end(),
                     [](char c) { return isLetter(c) || isDigit(c) || c == '_'; });
}

}  // namespace hovercraft
