#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft {

/// The fastest mean wind, and the greatest sigma of gusts, that a run is given, m/s: far beyond any
/// air, and far from where its square overflows.
constexpr double kFastestWind = 1e6;

/// Whether a mean wind (m/s) may be set while a run goes on: finite, at most kFastestWind.
HOVERCRAFT_PUBLIC bool canBeWind(const Vector3& wind_W);

/// Whether two finite vectors have the same bits, signs of zeros too.
bool haveSameBits(const Vector3& a, const Vector3& b);

/// The key `gusts` of a scenario whose step size and wind are known.
/// @throws std::invalid_argument with key path and rule.
void parseAir(const ConfigReader& top, Scenario& scenario);

/// The text of `gusts` for toYaml(); empty without them.
std::string gustsYaml(const Scenario& scenario);

/// The names of all bodies, vehicles first, then loose ones.
std::vector<std::string> bodyNames(const Scenario& scenario);

/// The gusts of a run; none without them.
[[nodiscard]] std::optional<Gusts> gustsOf(const Scenario& scenario);

}  // namespace hovercraft
