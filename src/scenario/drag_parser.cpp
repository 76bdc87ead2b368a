#include "hovercraft_sim/scenario/drag_parser.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/elementary.h"
#include "hovercraft_sim/scenario/craft_keys.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

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

/// One that would give energy to the craft, in any of 720 directions of the air, is refused.
DragPolar parsePolar(const ConfigReader& reader) {
  DragPolar polar;
  reader.allowOnly(together({keyNames(kPolarKeys, polar), {"length", "surge", "sway", "yaw"}}));
  readKeys(reader, kPolarKeys, polar);
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

/// Of each law its key and value, with a comma before them.
struct LawWriter {
  std::string operator()(const DragPolar& polar) const {
    std::string text =
        fmt::format(", polar: {{{}, surge: {}, sway: {}", keysText(kPolarKeys, polar),
                    termsText(polar.surge), termsText(polar.sway));
    if (polar.length > 0.0) {
      text += fmt::format(", length: {}, yaw: {}", yamlNumber(polar.length), termsText(polar.yaw));
    }
    return text + "}";
  }
};

}  // namespace

void parseDrag(const ConfigReader& reader, VehicleScenario& vehicle) {
  reader.allowOnly(together({keyNames(kDragKeys, vehicle.drag), {"polar"}}));
  readKeys(reader, kDragKeys, vehicle.drag);
  if (reader.has("polar")) vehicle.drag_laws.emplace_back(parsePolar(reader.map("polar")));
}

std::string dragYaml(const VehicleScenario& vehicle) {
  std::string text = "    drag: {" + keysText(kDragKeys, vehicle.drag);
  for (const DragLaw& law : vehicle.drag_laws) text += std::visit(LawWriter(), law);
  return text + "}\n";
}

}  // namespace hovercraft
