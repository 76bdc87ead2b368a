#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/live/pace_report.h"

#include "../support/numbers.h"

namespace hovercraft_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using hovercraft::testing::kNow;
using hovercraft_sim::Telemetry;

constexpr std::int64_t kPacedStepNs = 2000000;
constexpr std::int64_t kSecond = 1000000000;
constexpr double kBucket = 0.125;  // a quantile is right to one bucket of the histogram

std::string valueOf(const DiagnosticStatus& status, const std::string& key) {
  for (const auto& entry : status.values) {
    if (entry.key == key) return entry.value;
  }
  return "no such key";
}

/// Of one second: 250 steps of 10 us, every tenth of 1 ms; 20 were waited for, 3 of these began 5
/// ms late, the others 0.1 ms.
Telemetry filled() {
  PaceReport report;
  report.restart(kNow);
  for (int i = 0; i < 250; ++i) report.addStep(i % 10 == 0 ? 1000000 : 10000);
  for (int i = 0; i < 20; ++i) report.addLateness(i < 3 ? 5000000 : 100000, kPacedStepNs);
  report.addGivenUp(200000000);
  report.addGivenUp(50000000);
  Telemetry telemetry;
  report.fill(telemetry, kNow + kSecond, kPacedStepNs);
  return telemetry;
}

TEST(PaceReport, SaysHowThePaceWasKept) {
  const Telemetry telemetry = filled();
  EXPECT_DOUBLE_EQ(telemetry.real_time_factor, 0.5);  // 250 steps of 2 ms in 1 s
  EXPECT_NEAR(telemetry.step_time_p50, 1e-5, kBucket * 1e-5);
  EXPECT_NEAR(telemetry.step_time_p99, 1e-3, kBucket * 1e-3);
  EXPECT_NEAR(telemetry.lateness_p50, 1e-4, kBucket * 1e-4);
  EXPECT_NEAR(telemetry.lateness_p99, 5e-3, kBucket * 5e-3);
  EXPECT_EQ(telemetry.late_steps, 3U);
  EXPECT_DOUBLE_EQ(telemetry.time_given_up, 0.25);
}

TEST(PaceReport, AStepThatBeginsOneStepSizeAfterItsDeadlineIsNotLateYet) {
  PaceReport report;
  report.addLateness(kPacedStepNs, kPacedStepNs);
  Telemetry telemetry;
  report.fill(telemetry, kNow, kPacedStepNs);
  EXPECT_EQ(telemetry.late_steps, 0U);
  report.addLateness(kPacedStepNs + 1, kPacedStepNs);
  report.fill(telemetry, kNow, kPacedStepNs);
  EXPECT_EQ(telemetry.late_steps, 1U);
}

TEST(PaceReport, RestartForgetsEverything) {
  PaceReport report;
  report.addStep(1000);
  report.addLateness(kSecond, kPacedStepNs);
  report.addGivenUp(kSecond);
  report.restart(kNow);
  EXPECT_EQ(report.givenUp(), 0);
  Telemetry telemetry;
  report.fill(telemetry, kNow, kPacedStepNs);  // no time has passed: no division by 0
  EXPECT_EQ(telemetry.real_time_factor, 0.0);
  EXPECT_EQ(telemetry.lateness_p99, 0.0);
  EXPECT_EQ(telemetry.late_steps, 0U);
}

TEST(PaceReport, TheDiagnosticsHaveTheFiguresInTheirUnits) {
  Telemetry telemetry;
  telemetry.real_time_factor = 0.98765;
  telemetry.wanted_real_time_factor = 1.0;
  telemetry.step_time_p50 = 12.5e-6;
  telemetry.step_time_p99 = 250e-6;
  telemetry.lateness_p50 = 60e-6;
  telemetry.lateness_p99 = 1.5e-3;
  telemetry.late_steps = 7;
  telemetry.tick = 4321;
  telemetry.episode = 2;
  diagnostic_updater::DiagnosticStatusWrapper status;
  toDiagnostics(telemetry, status);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  EXPECT_EQ(status.message, "Keeps its pace");
  EXPECT_EQ(valueOf(status, "Real-time factor"), "0.9877");
  EXPECT_EQ(valueOf(status, "Wanted real-time factor"), "1");
  EXPECT_EQ(valueOf(status, "Step time p50 (us)"), "12.50");
  EXPECT_EQ(valueOf(status, "Step time p99 (us)"), "250.00");
  EXPECT_EQ(valueOf(status, "Lateness p50 (us)"), "60.0");
  EXPECT_EQ(valueOf(status, "Lateness p99 (us)"), "1500.0");
  EXPECT_EQ(valueOf(status, "Late steps"), "7");
  EXPECT_EQ(valueOf(status, "Wall time given up (s)"), "0.000");
  EXPECT_EQ(valueOf(status, "Tick"), "4321");
  EXPECT_EQ(valueOf(status, "Episode"), "2");
}

TEST(PaceReport, TheDiagnosticsNameWhoIsWaitedForBeforeAnythingElse) {
  Telemetry telemetry;
  const auto status_of = [&telemetry] {
    diagnostic_updater::DiagnosticStatusWrapper status;
    toDiagnostics(telemetry, status);
    return status;
  };
  telemetry.contact_stalls = 3;
  EXPECT_EQ(status_of().level, DiagnosticStatus::WARN);
  EXPECT_EQ(status_of().message, "Contact: the rest of a step was left out");
  EXPECT_EQ(valueOf(status_of(), "Steps with contact cut off"), "3");
  telemetry.time_given_up = 0.25;
  EXPECT_EQ(status_of().level, DiagnosticStatus::WARN);
  EXPECT_EQ(status_of().message, "Falls behind: 0.250 s given up");
  telemetry.paused = 1;
  EXPECT_EQ(status_of().level, DiagnosticStatus::OK);
  EXPECT_EQ(status_of().message, "Paused");
  telemetry.waiting_for = "alpha";
  EXPECT_EQ(status_of().level, DiagnosticStatus::WARN);
  EXPECT_EQ(status_of().message, "Waits for a command of alpha");
}

}  // namespace
}  // namespace hovercraft_ros
