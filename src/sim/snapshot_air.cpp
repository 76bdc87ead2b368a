#include "hovercraft_sim/sim/snapshot_air.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <vector>

#include "hovercraft_sim/scenario/air_parser.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

constexpr std::array<const char*, 3> kAxes = {"along", "across", "vertical"};

void parseGustState(const ConfigReader& reader, GustState& state) {
  reader.allowOnly({kAxes[0], kAxes[1], kAxes[2]});
  auto next = state.begin();
  for (const char* axis : kAxes) {
    const std::vector<double> numbers = reader.numbers(axis, 2);
    if (numbers.size() != 2) reader.fail(axis, "must be 2 numbers");
    next = std::copy(numbers.begin(), numbers.end(), next);
  }
}

}  // namespace

std::string airText(const Scenario& scenario, const SimulationState& state) {
  std::string yaml;
  if (!haveSameBits(state.wind_W, scenario.wind))
    yaml += "wind: " + yamlVector(state.wind_W) + "\n";
  if (state.gusts.empty()) return yaml;
  yaml += "gusts:\n";
  const std::vector<std::string> names = bodyNames(scenario);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const GustState& x = state.gusts[i];
    yaml += fmt::format("  {}: {{along: [{}, {}], across: [{}, {}], vertical: [{}, {}]}}\n",
                        yamlText(names[i]), yamlNumber(x[0]), yamlNumber(x[1]), yamlNumber(x[2]),
                        yamlNumber(x[3]), yamlNumber(x[4]), yamlNumber(x[5]));
  }
  return yaml;
}

void parseAirState(const ConfigReader& reader, const Scenario& scenario, SimulationState& state) {
  state.wind_W = reader.vectorOr(scenario.wind, "wind");
  if (reader.has("wind") && !canBeWind(state.wind_W)) {
    reader.fail("wind", "its speed must be at most 1e6 m/s");
  }
  if (!scenario.gusts) {
    if (reader.has("gusts")) reader.fail("gusts", "there are none in the scenario");
    return;
  }
  const std::vector<std::string> names = bodyNames(scenario);
  const ConfigReader gusts = reader.map("gusts");
  if (gusts.maps().size() != names.size()) {
    reader.fail("gusts", "must hold those of the scenario and no other");
  }
  const std::optional<Gusts> laws = gustsOf(scenario);
  for (const std::string& name : names) {
    GustState& gust = state.gusts.emplace_back();
    parseGustState(gusts.map(name), gust);
    if (!laws->canBe(gust)) gusts.fail(name, "must be within 100 standard deviations of its gusts");
  }
}

void checkAir(const ConfigReader& reader, const Simulation& simulation) {
  for (std::size_t body = 0; body < simulation.state().bodies.size(); ++body) {
    if (simulation.windAt(body).allFinite()) continue;
    reader.fail("", "wind and gusts must make a finite wind");
  }
}

}  // namespace hovercraft
