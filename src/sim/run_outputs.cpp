#include "hovercraft_sim/sim/run_outputs.h"

#include <numeric>
#include <utility>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft {

void RunOutputs::add(std::unique_ptr<RunObserver> observer, Tick every) {
  demand(every > 0, "an output is told every n-th tick, n > 0");
  outputs_.push_back({std::move(observer), every});
  every_ = std::gcd(every_, every);
}

void RunOutputs::applied(const Command& command) {
  for (const Output& output : outputs_) output.observer->applied(command);
}

void RunOutputs::contact(const ContactEvent& event) {
  for (const Output& output : outputs_) output.observer->contact(event);
}

void RunOutputs::sample(const SensorSample& sample) {
  for (const Output& output : outputs_) output.observer->sample(sample);
}

void RunOutputs::state(const Simulation& simulation) {
  if (!first_) first_ = simulation.tick();
  const Tick passed = simulation.tick() - *first_;
  for (const Output& output : outputs_) {
    if (passed % output.every == 0) output.observer->state(simulation);
  }
}

void RunOutputs::flown(const FlownManoeuvre& manoeuvre, std::size_t vehicle, Tick tick) {
  for (const Output& output : outputs_) output.observer->flown(manoeuvre, vehicle, tick);
}

void RunOutputs::close() {
  for (const Output& output : outputs_) output.observer->close();
}

}  // namespace hovercraft
