#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/sim/run_observer.h"

namespace hovercraft {

/// Several observers of one run, each told of states at a rate of its own and of all else as it
/// comes.
class HOVERCRAFT_PUBLIC RunOutputs : public RunObserver {
 public:
  /// @param every ticks from one state to the next, > 0; the first is the first that is told.
  void add(std::unique_ptr<RunObserver> observer, Tick every);
  /// RunPlan::every with which each gets its states: the greatest common divisor; 1 without any.
  Tick every() const { return every_ > 0 ? every_ : 1; }

  void applied(const Command& command) override;
  void contact(const ContactEvent& event) override;
  void sample(const SensorSample& sample) override;
  void state(const Simulation& simulation) override;
  void flown(const FlownManoeuvre& manoeuvre, std::size_t vehicle, Tick tick) override;
  void close() override;

 private:
  struct Output {
    std::unique_ptr<RunObserver> observer;
    Tick every;
  };

  std::vector<Output> outputs_;
  Tick every_ = 0;
  std::optional<Tick> first_;
};

}  // namespace hovercraft
