#include "hovercraft_sim/scenario/air_parser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/elementary.h"
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

DragPolar::Terms parseTerms(const ConfigReader& polar, const char* key) {
  DragPolar::Terms terms{};
  if (!polar.has(key)) return terms;
  const std::vector<double> numbers = polar.numbers(key, terms.size());
  std::copy(numbers.begin(), numbers.end(), terms.begin());
  return terms;
}

double sumOfMagnitudes(const DragPolar::Terms& terms) {
  double sum = 0.0;
  for (const double term : terms) sum += std::abs(term);
  return sum;
}

/// In which of 720 directions the force has a part along the way of the craft through the air, deg;
/// none.
std::optional<double> drivingDirection(const DragPolar& polar) {
  constexpr int kDirections = 720;
  constexpr double kRounding = 1e-12;  // of all terms
  const double angle = 2.0 * kPi / kDirections;
  const double cos_step = exactCos(angle);
  const double sin_step = exactSin(angle);
  const double scale =
      polar.area_x * sumOfMagnitudes(polar.surge) + polar.area_y * sumOfMagnitudes(polar.sway);
  double cosine = 1.0;
  double sine = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const Vector3 sums = polar.coefficients(cosine, sine);
    const double resists = polar.area_x * sums.x() * cosine + polar.area_y * sums.y() * sine;
    if (!(resists >= -kRounding * scale)) return 360.0 * i / kDirections;
    const double next = cosine * cos_step - sine * sin_step;
    sine = sine * cos_step + cosine * sin_step;
    cosine = next;
  }
  return std::nullopt;
}

std::string termsText(const DragPolar::Terms& terms) {
  std::string text = "[";
  for (std::size_t i = 0; i < terms.size(); ++i) text += (i > 0 ? ", " : "") + yamlNumber(terms[i]);
  return text + "]";
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

std::optional<DragPolar> parsePolar(const ConfigReader& drag) {
  if (!drag.has("polar")) return std::nullopt;
  const ConfigReader reader = drag.map("polar");
  reader.allowOnly({"air_density", "area_x", "area_y", "length", "surge", "sway", "yaw"});
  DragPolar polar;
  polar.air_density = reader.numberOr(polar.air_density, "air_density", kPositive);
  polar.area_x = reader.number("area_x", kNotNegative);
  polar.area_y = reader.number("area_y", kNotNegative);
  polar.surge = parseTerms(reader, "surge");
  polar.sway = parseTerms(reader, "sway");
  polar.yaw = parseTerms(reader, "yaw");
  if (reader.has("yaw")) polar.length = reader.length("length");
  if (!reader.has("yaw") && reader.has("length")) reader.fail("length", "needs yaw");
  if (const auto direction = drivingDirection(polar)) {
    reader.fail("", fmt::format("drives the craft on where it moves through the air at {:.4g} deg "
                                "to the left of its bow: area_x Σ surge_k cos kβ cos β + area_y Σ "
                                "sway_k sin kβ sin β must not be negative",
                                *direction));
  }
  return polar;
}

std::string polarYaml(const VehicleScenario& vehicle) {
  if (!vehicle.polar) return "";
  const DragPolar& polar = *vehicle.polar;
  std::string text =
      fmt::format(", polar: {{air_density: {}, area_x: {}, area_y: {}, surge: {}, sway: {}",
                  yamlNumber(polar.air_density), yamlNumber(polar.area_x), yamlNumber(polar.area_y),
                  termsText(polar.surge), termsText(polar.sway));
  if (polar.length > 0.0) {
    text += fmt::format(", length: {}, yaw: {}", yamlNumber(polar.length), termsText(polar.yaw));
  }
  return text + "}";
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
