#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <vector>

#include "hovercraft_sim/bags/recording_reader.h"
#include "hovercraft_sim/bags/replay.h"
#include "hovercraft_sim/io/number_text.h"

namespace hovercraft_ros {

inline std::uint64_t bitsOf(double number) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof(bits));
  return bits;
}

/// The first of several numbers that differ in their bits.
class FieldComparison {
 public:
  void add(const char* field, double recorded, double replayed) {
    if (field_ != nullptr || bitsOf(recorded) == bitsOf(replayed)) return;
    field_ = field;
    recorded_ = hovercraft::numberText(recorded);
    replayed_ = hovercraft::numberText(replayed);
  }
  void add(const char* field, const geometry_msgs::Vector3& a, const geometry_msgs::Vector3& b) {
    add(field, a.x, b.x);
    add(field, a.y, b.y);
    add(field, a.z, b.z);
  }
  void add(const char* field, const std::vector<double>& a, const std::vector<double>& b) {
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) add(field, a[i], b[i]);
    if (field_ != nullptr || a.size() == b.size()) return;
    field_ = field;
    recorded_ = fmt::format("{} numbers", a.size());
    replayed_ = fmt::format("{} numbers", b.size());
  }
  void addHash(const char* field, std::uint64_t recorded, std::uint64_t replayed) {
    if (field_ != nullptr || recorded == replayed) return;
    field_ = field;
    recorded_ = fmt::format("{:016x}", recorded);
    replayed_ = fmt::format("{:016x}", replayed);
  }

  [[nodiscard]] std::optional<ReplayDifference> result(const RunTime& time,
                                                       const std::string& vehicle) const {
    if (field_ == nullptr) return std::nullopt;
    return ReplayDifference{time, vehicle, field_, recorded_, replayed_};
  }

 private:
  const char* field_ = nullptr;
  std::string recorded_;
  std::string replayed_;
};

/// The first field, in the order of State.msg, whose bits differ.
[[nodiscard]] inline std::optional<ReplayDifference> difference(
    const Recording::RecordedState& recorded, const hovercraft_sim::State& replayed,
    const std::string& vehicle) {
  const hovercraft_sim::State& state = recorded.state;
  FieldComparison fields;
  fields.add("position.x", state.pose.position.x, replayed.pose.position.x);
  fields.add("position.y", state.pose.position.y, replayed.pose.position.y);
  fields.add("position.z", state.pose.position.z, replayed.pose.position.z);
  fields.add("orientation.x", state.pose.orientation.x, replayed.pose.orientation.x);
  fields.add("orientation.y", state.pose.orientation.y, replayed.pose.orientation.y);
  fields.add("orientation.z", state.pose.orientation.z, replayed.pose.orientation.z);
  fields.add("orientation.w", state.pose.orientation.w, replayed.pose.orientation.w);
  fields.add("velocity", state.velocity, replayed.velocity);
  fields.add("angular_velocity", state.angular_velocity, replayed.angular_velocity);
  fields.add("momentum", state.momentum, replayed.momentum);
  fields.add("angular_momentum", state.angular_momentum, replayed.angular_momentum);
  for (std::size_t i = 0; i < state.thrust.size(); ++i) {
    fields.add("thrust", state.thrust[i], replayed.thrust[i]);
  }
  fields.add("energy", state.energy, replayed.energy);
  fields.add("actuators", state.actuators, replayed.actuators);
  fields.add("extra", state.extra, replayed.extra);
  fields.addHash("sensor_hash", state.sensor_hash, replayed.sensor_hash);
  fields.addHash("hash", state.hash, replayed.hash);
  return fields.result(recorded.time, vehicle);
}

}  // namespace hovercraft_ros
