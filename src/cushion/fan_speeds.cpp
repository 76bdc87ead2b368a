#include <algorithm>
#include <iterator>

#include "hovercraft_sim/cushion/cushion.h"

namespace hovercraft {

double CushionFan::speedAt(double time) const {
  if (speeds.empty()) return speed;
  if (!(time > speeds.front().time)) return speeds.front().speed;
  const auto next =
      std::upper_bound(speeds.begin(), speeds.end(), time,
                       [](double t, const FanSpeedPoint& point) { return t < point.time; });
  if (next == speeds.end()) return speeds.back().speed;
  const FanSpeedPoint& from = *std::prev(next);
  return from.speed + (time - from.time) / (next->time - from.time) * (next->speed - from.speed);
}

double CushionFan::fullSpeed() const {
  double most = speeds.empty() ? speed : 0.0;
  for (const FanSpeedPoint& point : speeds) most = std::max(most, point.speed);
  return most;
}

FanSpeedCourse FanSpeedCourse::piece(double from, double to, double h) const {
  const auto speeds_at = [&](double share) {
    const bool is_early = share < 0.5;
    const FanSpeeds& first = is_early ? start : middle;
    const FanSpeeds& second = is_early ? middle : end;
    const double part = is_early ? 2.0 * share : 2.0 * share - 1.0;
    FanSpeeds speeds;
    for (std::size_t i = 0; i < kMaxFans; ++i) {
      speeds[i] = first[i] + part * (second[i] - first[i]);
    }
    return speeds;
  };
  return {speeds_at(from / h), speeds_at(0.5 * (from + to) / h), speeds_at(to / h)};
}

}  // namespace hovercraft
