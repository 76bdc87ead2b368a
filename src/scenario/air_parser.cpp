#include "hovercraft_sim/scenario/air_parser.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

const NumberRule kSigma = {[](double x) { return x >= 0.0 && x <= kFastestWind; },
                           "must be 0 to 1e6"};

/// The speed that carries gusts past, m/s.
double carryingSpeed(const Scenario& scenario) {
  return std::max(norm(scenario.wind), Gusts::kLeastSpeed);
}

GustAxis parseGustAxis(const ConfigReader& gusts, const char* key, const Scenario& scenario) {
  GustAxis axis;
  if (!gusts.has(key)) return axis;
  const ConfigReader reader = gusts.map(key);
  reader.allowOnly({"sigma", "length"});
  axis.sigma = reader.number("sigma", kSigma);
  axis.length = reader.length("length");
  const double speed = carryingSpeed(scenario);
  if (axis.length / speed < scenario.stepSize()) {
    reader.fail("length", fmt::format("must be at least the way of the wind in a step, {} m",
                                      yamlNumber(speed * scenario.stepSize())));
  }
  return axis;
}

std::string axisText(const char* key, const GustAxis& axis) {
  if (axis.length == 0.0) return "";
  return fmt::format(", {}: {{sigma: {}, length: {}}}", key, yamlNumber(axis.sigma),
                     yamlNumber(axis.length));
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
  scenario.wind = top.vectorOr(Vector3::Zero(), "wind");
  if (!top.has("gusts")) return;
  const ConfigReader reader = top.map("gusts");
  reader.allowOnly({"model", "along", "across", "vertical"});
  if (!std::isfinite(norm(scenario.wind))) top.fail("wind", "its speed must be finite");
  GustParameters gusts;
  gusts.model = static_cast<GustModel>(
      reader.choiceOr(static_cast<std::size_t>(gusts.model), "model", gustModelNames()));
  gusts.along = parseGustAxis(reader, "along", scenario);
  gusts.across = parseGustAxis(reader, "across", scenario);
  gusts.vertical = parseGustAxis(reader, "vertical", scenario);
  if (gusts.along.length + gusts.across.length + gusts.vertical.length == 0.0) {
    reader.fail("", "must have one of along, across, vertical");
  }
  scenario.gusts = gusts;
}

std::string gustsYaml(const Scenario& scenario) {
  if (!scenario.gusts) return "";
  const GustParameters& gusts = *scenario.gusts;
  return fmt::format("gusts: {{model: {}{}{}{}}}\n",
                     gustModelNames()[static_cast<std::size_t>(gusts.model)],
                     axisText("along", gusts.along), axisText("across", gusts.across),
                     axisText("vertical", gusts.vertical));
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
