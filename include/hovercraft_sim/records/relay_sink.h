#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/sim/run.h"

namespace hovercraft {

/// Hands everything on to another sink: what a sink beside the output of a run begins with.
class HOVERCRAFT_PUBLIC RelaySink : public StateSink {
 public:
  explicit RelaySink(std::unique_ptr<StateSink> next) : next_(std::move(next)) {}

  void state(const Simulation& simulation) override { next_->state(simulation); }
  void applied(const Command& command) override { next_->applied(command); }
  void contact(const ContactEvent& event) override { next_->contact(event); }
  void sample(const SensorSample& sample) override { next_->sample(sample); }
  void flown(const FlownManoeuvre& manoeuvre, std::size_t vehicle, Tick tick) override {
    next_->flown(manoeuvre, vehicle, tick);
  }
  void close() override { next_->close(); }

 private:
  std::unique_ptr<StateSink> next_;
};

}  // namespace hovercraft
