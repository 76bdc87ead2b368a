#pragma once

#include <cstdint>
#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <hovercraft_sim/Telemetry.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/pacing/duration_histogram.h"

namespace hovercraft_ros {

/// How a run kept its pace since the last report.
class HOVERCRAFT_PUBLIC PaceReport {
 public:
  /// @param duration_ns of the step with what it published.
  void addStep(std::int64_t duration_ns) { step_times_.add(duration_ns); }
  /// Of a step that was waited for. @param lateness_ns from its deadline to its start.
  /// @param bound_ns beyond which it counts as late.
  void addLateness(std::int64_t lateness_ns, std::int64_t bound_ns);
  void addGivenUp(std::int64_t wall_ns) { given_up_ns_ += wall_ns; }
  std::int64_t givenUp() const { return given_up_ns_; }

  /// Begins the next report at this wall time.
  void restart(std::int64_t now_ns);

  /// Fills the figures of the report; who and when is left to the caller.
  /// @param step_ns simulated time of a step.
  void fill(hovercraft_sim::Telemetry& telemetry, std::int64_t now_ns, std::int64_t step_ns) const;

 private:
  hovercraft::DurationHistogram step_times_;
  hovercraft::DurationHistogram lateness_;
  std::uint64_t late_steps_ = 0;
  std::int64_t given_up_ns_ = 0;
  std::int64_t begin_ns_ = 0;
};

/// The same figures for /diagnostics.
HOVERCRAFT_PUBLIC void toDiagnostics(const hovercraft_sim::Telemetry& telemetry,
                                     diagnostic_updater::DiagnosticStatusWrapper& status);

}  // namespace hovercraft_ros
