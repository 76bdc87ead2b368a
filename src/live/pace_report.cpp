#include "hovercraft_sim/live/pace_report.h"

#include <algorithm>

#include "hovercraft_sim/math/time.h"

namespace hovercraft_ros {
namespace {

constexpr double kMicroseconds = 1e6;  // in a second

}  // namespace

void PaceReport::addLateness(std::int64_t lateness_ns, std::int64_t bound_ns) {
  lateness_.add(lateness_ns);
  if (lateness_ns > bound_ns) ++late_steps_;
}

void PaceReport::restart(std::int64_t now_ns) {
  *this = PaceReport();
  begin_ns_ = now_ns;
}

void PaceReport::fill(hovercraft_sim::Telemetry& telemetry, std::int64_t now_ns,
                      std::int64_t step_ns) const {
  using hovercraft::toSeconds;
  const double wall = toSeconds(std::max<std::int64_t>(now_ns - begin_ns_, 1));
  telemetry.real_time_factor = static_cast<double>(step_times_.count()) * toSeconds(step_ns) / wall;
  telemetry.step_time_p50 = toSeconds(step_times_.quantile(0.5));
  telemetry.step_time_p99 = toSeconds(step_times_.quantile(0.99));
  telemetry.lateness_p50 = toSeconds(lateness_.quantile(0.5));
  telemetry.lateness_p99 = toSeconds(lateness_.quantile(0.99));
  telemetry.late_steps = late_steps_;
  telemetry.time_given_up = toSeconds(given_up_ns_);
}

void toDiagnostics(const hovercraft_sim::Telemetry& telemetry,
                   diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  if (!telemetry.waiting_for.empty()) {
    status.summary(DiagnosticStatus::WARN, "Waits for a command of " + telemetry.waiting_for);
  } else if (telemetry.paused != 0) {
    status.summary(DiagnosticStatus::OK, "Paused");
  } else if (telemetry.time_given_up > 0.0) {
    status.summaryf(DiagnosticStatus::WARN, "Falls behind: %.3f s given up",
                    telemetry.time_given_up);
  } else if (telemetry.contact_stalls > 0) {
    status.summary(DiagnosticStatus::WARN, "Contact: the rest of a step was left out");
  } else {
    status.summary(DiagnosticStatus::OK, "Keeps its pace");
  }
  status.addf("Real-time factor", "%.4f", telemetry.real_time_factor);
  status.addf("Wanted real-time factor", "%.4g", telemetry.wanted_real_time_factor);
  status.addf("Step time p50 (us)", "%.2f", kMicroseconds * telemetry.step_time_p50);
  status.addf("Step time p99 (us)", "%.2f", kMicroseconds * telemetry.step_time_p99);
  status.addf("Lateness p50 (us)", "%.1f", kMicroseconds * telemetry.lateness_p50);
  status.addf("Lateness p99 (us)", "%.1f", kMicroseconds * telemetry.lateness_p99);
  status.add("Late steps", telemetry.late_steps);
  status.addf("Wall time given up (s)", "%.3f", telemetry.time_given_up);
  status.add("Steps with contact cut off", telemetry.contact_stalls);
  status.add("Tick", telemetry.tick);
  status.add("Episode", telemetry.episode);
}

}  // namespace hovercraft_ros
