#include <fmt/format.h>
#include <iterator>

#include "hovercraft_sim/analysis/compare.h"
#include "hovercraft_sim/io/number_text.h"

namespace hovercraft {
namespace {

std::string timeText(std::int64_t time_ns) {
  return secondsText(time_ns) + " s";
}

std::string line(const char* name, const ErrorSummary& summary, const char* unit) {
  return fmt::format("  {:<20} max {:<11.4g} at {:<12} RMS {:<11.4g} final {:.4g} {}\n", name,
                     summary.max, timeText(summary.max_time_ns), summary.rms, summary.final, unit);
}

std::string line(const char* side, const UnmatchedSamples& unmatched) {
  if (unmatched.count == 0) return "";
  if (unmatched.count == 1) {
    return fmt::format("  1 sample only in {}, at {}\n", side, timeText(unmatched.first_ns));
  }
  return fmt::format("  {} samples only in {}, the first at {}, the last at {}\n", unmatched.count,
                     side, timeText(unmatched.first_ns), timeText(unmatched.last_ns));
}

std::string judgedText(const CompareOptions& options) {
  std::string judged;
  if (options.position_tolerance) judged += fmt::format("{:g} m", *options.position_tolerance);
  if (options.attitude_tolerance) {
    judged += fmt::format("{}{:g} rad", judged.empty() ? "" : " and ", *options.attitude_tolerance);
  }
  if (!options.attitude_tolerance) judged += ", attitude not judged";
  if (!options.position_tolerance) judged += ", position not judged";
  return judged + (options.relative ? ", relative to the first poses" : "");
}

std::string divergenceText(const Divergence& divergence) {
  if (divergence.is_bits) {
    return fmt::format("  differ first at {}: {} = {} in A, {} in B (B - A = {:.3g})\n",
                       timeText(divergence.time_ns), divergence.quantity, numberText(divergence.a),
                       numberText(divergence.b), divergence.b - divergence.a);
  }
  return fmt::format(
      "  beyond the tolerance first at {}: {} error {:.4g}, allowed {:g} (B - A: x "
      "{:.4g}, y {:.4g}, z {:.4g} m)\n",
      timeText(divergence.time_ns), divergence.quantity, divergence.a, divergence.b,
      divergence.offset_W.x(), divergence.offset_W.y(), divergence.offset_W.z());
}

std::string verdict(const Comparison& comparison, const CompareOptions& options) {
  if (comparison.errors.empty()) return "  no sample of A has a partner in B\n";
  if (comparison.divergence) return divergenceText(*comparison.divergence);
  if (!comparison.is_within) return "  samples are missing\n";
  if (options.position_tolerance || options.attitude_tolerance) {
    return fmt::format("  within {}\n", judgedText(options));
  }
  return fmt::format("  identical to the last bit{}\n",
                     comparison.compared_velocities ? "" : " (poses; velocities are not in both)");
}

}  // namespace

std::string toText(const Comparison& comparison, const CompareOptions& options) {
  std::string text;
  if (!comparison.errors.empty()) {
    text += fmt::format("  {} samples compared, from {} to {}\n", comparison.errors.size(),
                        timeText(comparison.errors.front().time_ns),
                        timeText(comparison.errors.back().time_ns));
    text += line("position, absolute", comparison.position, "m");
    text += line("position, relative", comparison.relative_position, "m");
    text += line("attitude, absolute", comparison.attitude, "rad");
    text += line("attitude, relative", comparison.relative_attitude, "rad");
  }
  text += line("A", comparison.only_in_a);
  text += line("B", comparison.only_in_b);
  return text + verdict(comparison, options);
}

std::string errorsCsv(const Comparison& comparison) {
  fmt::memory_buffer buffer;
  fmt::format_to(std::back_inserter(buffer),
                 "time,position,attitude,relative_position,relative_attitude\n");
  for (const TrajectoryError& error : comparison.errors) {
    appendSeconds(buffer, error.time_ns);
    for (const double number :
         {error.position, error.attitude, error.relative_position, error.relative_attitude}) {
      buffer.push_back(',');
      appendNumber(buffer, number);
    }
    buffer.push_back('\n');
  }
  return fmt::to_string(buffer);
}

}  // namespace hovercraft
