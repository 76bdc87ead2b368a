#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/air_parser.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/state_hash.h"

/// The air of a simulation: its mean wind, and gusts at each body.

namespace hovercraft {

void Simulation::setWind(const Vector3& wind_W) {
  const FloatingPointEnvironment environment;
  demand(wind_W.allFinite(), "a wind must be checked before");
  state_.wind_W = wind_W;
  refreshWind();
}

/// What the bodies have around them in the step to come.
void Simulation::refreshWind() {
  for (std::size_t body = 0; body < inputs_.size(); ++body) {
    Vector3 wind_W = state_.wind_W;
    if (gusts_) wind_W += gustInWorld(wind_W, gusts_->velocity(state_.gusts[body]));
    inputs_[body].environment.wind_W = wind_W;
  }
}

void Simulation::blow() {
  const FloatingPointEnvironment environment;
  for (std::size_t body = 0; body < state_.gusts.size(); ++body) {
    gusts_->advance(body, state_.seed, state_.tick, state_.gusts[body]);
  }
  refreshWind();
}

/// The air determines the future where it is not what the scenario says for ever.
void Simulation::addAir(StateHash& hash, std::size_t first, std::size_t last) const {
  if (!gusts_ && haveSameBits(state_.wind_W, scenario_.wind)) return;
  hash.add(state_.wind_W);
  if (!gusts_) return;
  for (std::size_t body = first; body < last; ++body) {
    for (const double number : state_.gusts[body]) hash.add(number);
  }
}

}  // namespace hovercraft
