#include "hovercraft_sim/scenario/air_parser.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/air_keys.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

/// The speed that carries gusts past, m/s.
double carryingSpeed(const Scenario& scenario) {
  return std::max(norm(scenario.wind), Gusts::kLeastSpeed);
}

void checkGustAxis(const ConfigReader& gusts, const char* key, const GustAxis& axis,
                   const Scenario& scenario) {
  const double speed = carryingSpeed(scenario);
  if (!gusts.has(key) || !(axis.length / speed < scenario.stepSize())) return;
  gusts.map(key).fail("length", fmt::format("must be at least the way of the wind in a step, {} m",
                                            yamlNumber(speed * scenario.stepSize())));
}

}  // namespace

bool canBeWind(const Vector3& wind_W) {
  return norm(wind_W) <= kFastestWind;
}

bool haveSameBits(const Vector3& a, const Vector3& b) {
  for (int i = 0; i < 3; ++i) {
    if (a[i] != b[i] || std::signbit(a[i]) != std::signbit(b[i])) return false;
  }
  return true;
}

void parseAir(const ConfigReader& top, Scenario& scenario) {
  if (!top.has("gusts")) return;
  const ConfigReader reader = top.map("gusts");
  if (!std::isfinite(norm(scenario.wind))) top.fail("wind", "its speed must be finite");
  GustParameters gusts;
  parseKeys(reader, kGustKeys, gusts);
  checkGustAxis(reader, "along", gusts.along, scenario);
  checkGustAxis(reader, "across", gusts.across, scenario);
  checkGustAxis(reader, "vertical", gusts.vertical, scenario);
  if (gusts.along.length + gusts.across.length + gusts.vertical.length == 0.0) {
    reader.fail("", "must have one of along, across, vertical");
  }
  scenario.gusts = gusts;
}

std::string gustsYaml(const Scenario& scenario) {
  if (!scenario.gusts) return "";
  return "gusts: {" + keysText(kGustKeys, *scenario.gusts) + "}\n";
}

std::vector<std::string> bodyNames(const Scenario& scenario) {
  std::vector<std::string> names = vehicleNames(scenario);
  if (!scenario.world) return names;
  for (const VehicleScenario& body : scenario.world->bodies) names.push_back(body.name);
  return names;
}

std::optional<Gusts> gustsOf(const Scenario& scenario) {
  const FloatingPointEnvironment environment;
  if (!scenario.gusts) return std::nullopt;
  return Gusts(*scenario.gusts, carryingSpeed(scenario), scenario.stepSize(), bodyNames(scenario));
}

}  // namespace hovercraft
