#include "hovercraft_sim/analysis/hover_report.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/cushion_builder.h"
#include "hovercraft_sim/scenario/scenario_names.h"

namespace hovercraft {
namespace {

constexpr Integrator kIntegrators[] = {Integrator::kEuler, Integrator::kSemiImplicitEuler,
                                       Integrator::kHeun, Integrator::kRungeKutta4};
constexpr double kTurn = 2.0 * kPi;  // rad

/// In the order of HoverStatus.
constexpr const char* kStatusNames[] = {"hovers", "too_heavy", "too_light", "not_level"};
constexpr const char* kStatusTexts[] = {
    "hovers", "does not lift off: the fans carry less than the weight",
    "does not come down: the fans carry it at any height",
    "does not hover level: the centre of mass is too far from the middle of the cells"};

HoverReport hoverReportOn(const Scenario& scenario, const VehicleScenario& vehicle) {
  HoverReport report;
  report.vehicle = vehicle.name;
  report.mass = vehicle.mass_properties.mass;
  const HoverBody body = hoverBodyOf(scenario, vehicle);
  report.weight = body.mass * body.gravity;
  for (const CushionCell& cell : vehicle.cushion->cells) {
    report.area += cell.area;
    for (const HemPoint& hem : cell.hem) report.hem_length += hem.length;
  }
  const Cushion cushion = *cushionOf(vehicle);
  report.hover = hoverOf(cushion, body, cushion.fullSpeeds());
  report.mass_flow = vehicle.cushion->air_density * report.hover.flow;
  return report;
}

std::string hoverLine(const char* name, double value, const char* unit) {
  return fmt::format("  {:<20}{:>14.6g} {}\n", name, value, unit);
}

std::string longestStepText(double step) {
  return std::isinf(step) ? "any" : fmt::format("{:.4g}", step);
}

std::string modesText(const Hover& hover) {
  std::string text =
      fmt::format("  {:<8}{:>11}{:>9}{:>9}{:>9}", "", "omega 1/s", "Hz", "zeta", "margin");
  for (const Integrator integrator : kIntegrators) {
    text += fmt::format("  {:>10}", integratorNames()[static_cast<std::size_t>(integrator)]);
  }
  text += "  (longest stable step, s)\n";
  for (std::size_t i = 0; i < kHoverMotions; ++i) {
    const HoverMode& mode = hover.modes[i];
    text +=
        fmt::format("  {:<8}{:>11.5g}{:>9.4g}{:>9.3g}{:>9.3g}", kHoverMotionNames[i],
                    mode.frequency(), mode.frequency() / kTurn, mode.dampingRatio(), mode.margin);
    for (const Integrator integrator : kIntegrators) {
      const std::size_t width =
          std::max<std::size_t>(10, integratorNames()[static_cast<std::size_t>(integrator)].size());
      text += fmt::format("  {:>{}}", longestStepText(longestStableStep(integrator, mode)), width);
    }
    text += "\n";
  }
  return text;
}

std::string hoverText(const HoverReport& report) {
  const Hover& hover = report.hover;
  std::string text = fmt::format("vehicle {}: {}\n", report.vehicle,
                                 kStatusTexts[static_cast<std::size_t>(hover.status)]);
  text += hoverLine("weight", report.weight, "N");
  text += hoverLine("area of the cells", report.area, "m^2");
  text += hoverLine("hem length", report.hem_length, "m");
  text += hoverLine("lift-off speed", hover.lift_off_speed, "of the fans' nominal speed");
  if (hover.status != HoverStatus::kHovers) return text;
  text += hoverLine("gap", hover.gap, "m");
  text += hoverLine("pressure", hover.pressure, "Pa");
  text += hoverLine("flow", hover.flow, "m^3/s");
  text += hoverLine("power", hover.power, "W (in the air)");
  text += hoverLine("momentum drag", report.mass_flow, "N s/m");
  text += hoverLine("height", hover.height, "m (centre of mass)");
  text += hoverLine("roll", hover.roll, "rad");
  text += hoverLine("pitch", hover.pitch, "rad");
  text += hoverLine("load on the skirt", hover.skirt_load, "N");
  return text + modesText(hover);
}

std::string jsonNumber(double number) {
  return std::isfinite(number) ? numberText(number + 0.0) : "null";
}

std::string modeJson(const HoverMode& mode) {
  std::string steps;
  for (const Integrator integrator : kIntegrators) {
    steps += fmt::format("{}\"{}\": {}", steps.empty() ? "" : ", ",
                         integratorNames()[static_cast<std::size_t>(integrator)],
                         jsonNumber(longestStableStep(integrator, mode)));
  }
  return fmt::format(
      "{{\"frequency\": {}, \"damping_ratio\": {}, \"margin\": {}, \"longest_step\": {{{}}}}}",
      jsonNumber(mode.frequency()), jsonNumber(mode.dampingRatio()), jsonNumber(mode.margin),
      steps);
}

std::string hoverJson(const HoverReport& report) {
  const Hover& hover = report.hover;
  std::string json = fmt::format(
      "{{\"vehicle\": \"{}\", \"status\": \"{}\", \"weight\": {}, \"area\": {}, \"hem_length\": "
      "{}, \"lift_off_speed\": {}, ",
      report.vehicle, kStatusNames[static_cast<std::size_t>(hover.status)],
      jsonNumber(report.weight), jsonNumber(report.area), jsonNumber(report.hem_length),
      jsonNumber(hover.lift_off_speed));
  if (hover.status != HoverStatus::kHovers) return json + "\"hover\": null}";
  json += fmt::format(
      "\"hover\": {{\"gap\": {}, \"pressure\": {}, \"flow\": {}, \"power\": {}, \"mass_flow\": {}, "
      "\"height\": {}, \"roll\": {}, \"pitch\": {}, \"skirt_load\": {}",
      jsonNumber(hover.gap), jsonNumber(hover.pressure), jsonNumber(hover.flow),
      jsonNumber(hover.power), jsonNumber(report.mass_flow), jsonNumber(hover.height),
      jsonNumber(hover.roll), jsonNumber(hover.pitch), jsonNumber(hover.skirt_load));
  for (std::size_t i = 0; i < kHoverMotions; ++i) {
    json += fmt::format(", \"{}\": {}", kHoverMotionNames[i], modeJson(hover.modes[i]));
  }
  return json + "}}";
}

}  // namespace

std::vector<HoverReport> hoverReports(const Scenario& scenario, const std::string& vehicle) {
  const FloatingPointEnvironment environment;
  std::vector<HoverReport> reports;
  std::string names;
  for (const VehicleScenario& candidate : scenario.vehicles) {
    if (!candidate.cushion) continue;
    names += (names.empty() ? "" : ", ") + candidate.name;
    if (!vehicle.empty() && candidate.name != vehicle) continue;
    reports.push_back(hoverReportOn(scenario, candidate));
  }
  if (!reports.empty()) return reports;
  if (names.empty()) throw std::invalid_argument("no vehicle of the scenario has a cushion");
  throw std::invalid_argument(fmt::format(
      "--vehicle {}: the scenario has no such vehicle with a cushion; it has {}", vehicle, names));
}

std::string toText(const std::vector<HoverReport>& reports) {
  const FloatingPointEnvironment environment;
  std::string text;
  for (const HoverReport& report : reports) text += (text.empty() ? "" : "\n") + hoverText(report);
  return text;
}

std::string toJson(const std::vector<HoverReport>& reports) {
  const FloatingPointEnvironment environment;
  if (reports.size() == 1) return hoverJson(reports.front()) + "\n";
  std::string members;
  for (const HoverReport& report : reports) {
    members += fmt::format("{}\"{}\": {}", members.empty() ? "" : ",\n", report.vehicle,
                           hoverJson(report));
  }
  return "{\"vehicles\": {\n" + members + "}}\n";
}

}  // namespace hovercraft
