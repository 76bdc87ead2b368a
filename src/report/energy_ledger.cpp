#include <algorithm>

#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/report/run_parts.h"

namespace hovercraft_ros {

using hovercraft::Quaternion;
using hovercraft::Vector3;

namespace {

/// Powers at one state, W.
struct Powers {
  double engines = 0.0;
  double drag = 0.0;
};

double powerOf(const hovercraft::Wrench& wrench_B, const Vector3& v_B, const Vector3& w_B) {
  return hovercraft::dot(wrench_B.force, v_B) + hovercraft::dot(wrench_B.torque, w_B);
}

/// The columns of a state that its energy depends on.
class States {
 public:
  explicit States(const TopicSamples& state) {
    static const std::array<const char*, kCount> paths = {"pose.orientation.x",
                                                          "pose.orientation.y",
                                                          "pose.orientation.z",
                                                          "pose.orientation.w",
                                                          "velocity.x",
                                                          "velocity.y",
                                                          "velocity.z",
                                                          "angular_velocity.x",
                                                          "angular_velocity.y",
                                                          "angular_velocity.z",
                                                          "thrust[0]",
                                                          "thrust[1]",
                                                          "thrust[2]",
                                                          "energy",
                                                          "episode"};
    for (std::size_t i = 0; i < kCount; ++i) columns_[i] = state.column(paths[i]);
  }

  bool areWhole() const {
    return std::all_of(columns_.begin(), columns_.end(),
                       [](const auto* c) { return c != nullptr; });
  }
  double energy(std::size_t i) const { return (*columns_[13])[i]; }
  double episode(std::size_t i) const { return (*columns_[14])[i]; }

  Powers powers(std::size_t i, const hovercraft::EngineGeometry& geometry,
                const hovercraft::VehicleScenario& craft, const Vector3& wind) const {
    const Quaternion q_BW = conjugate(Quaternion{(*columns_[3])[i], vector(0, i)});
    const Vector3 v_W = vector(4, i);
    const Vector3 v_B = rotate(q_BW, v_W);
    const Vector3 w_B = rotate(q_BW, vector(7, i));
    Powers powers;
    powers.engines = powerOf(geometry.wrenchInBody(vector(10, i)), v_B, w_B);
    const Vector3 u_B = rotate(q_BW, v_W - wind);
    powers.drag = powerOf(craft.drag.wrenchInBody(u_B, w_B), v_B, w_B);
    for (const hovercraft::DragLaw& law : craft.drag_laws) {
      powers.drag += powerOf(hovercraft::wrenchInBody(law, u_B), v_B, w_B);
    }
    return powers;
  }

 private:
  static constexpr std::size_t kCount = 15;
  Vector3 vector(std::size_t first, std::size_t i) const {
    return {(*columns_[first])[i], (*columns_[first + 1])[i], (*columns_[first + 2])[i]};
  }

  std::array<const std::vector<double>*, kCount> columns_{};
};

/// The wind at each state, in the world.
class Winds {
 public:
  Winds(const BodyTopics& topics, const Vector3& mean) : mean_(mean) {
    if (topics.wind == nullptr || topics.wind->stamps_ns != topics.state->stamps_ns) return;
    for (const char* path : {"true_wind.x", "true_wind.y", "true_wind.z"}) {
      if (const auto* column = topics.wind->column(path)) columns_.push_back(column);
    }
  }
  Vector3 at(std::size_t i) const {
    if (columns_.size() < 3) return mean_;
    return {(*columns_[0])[i], (*columns_[1])[i], (*columns_[2])[i]};
  }

 private:
  Vector3 mean_;
  std::vector<const std::vector<double>*> columns_;
};

}  // namespace

std::optional<EnergyLedger> ledgerOf(const BodyTopics& topics,
                                     const hovercraft::VehicleScenario& vehicle,
                                     const Vector3& mean_wind, std::int64_t zero_ns,
                                     const std::vector<std::int64_t>& contacts_ns) {
  const TopicSamples& state = *topics.state;
  const States states(state);
  const Winds winds(topics, mean_wind);
  if (!states.areWhole() || state.size() < 2) return std::nullopt;
  const hovercraft::EngineGeometry geometry(vehicle.engines, vehicle.mass_properties.p_HB);
  EnergyLedger ledger;
  ledger.begin = states.energy(0);
  ledger.end = states.energy(state.size() - 1);
  Powers before = states.powers(0, geometry, vehicle, winds.at(0));
  for (std::size_t i = 1; i < state.size(); ++i) {
    const Powers now = states.powers(i, geometry, vehicle, winds.at(i));
    const double gain = states.energy(i) - states.energy(i - 1);
    const std::int64_t begin_ns = state.stamps_ns[i - 1] - zero_ns;
    const std::int64_t end_ns = state.stamps_ns[i] - zero_ns;
    // A reset puts the craft where it is for nothing.
    const bool is_one_run = states.episode(i) == states.episode(i - 1);
    const double seconds = is_one_run ? 1e-9 * static_cast<double>(end_ns - begin_ns) : 0.0;
    const double engines = 0.5 * (before.engines + now.engines) * seconds;
    const double drag = 0.5 * (before.drag + now.drag) * seconds;
    const auto contact = std::upper_bound(contacts_ns.begin(), contacts_ns.end(), begin_ns);
    const bool has_contact = contact != contacts_ns.end() && *contact <= end_ns;
    ledger.engines += engines;
    ledger.drag += drag;
    (has_contact ? ledger.contacts : ledger.others) += gain - engines - drag;
    before = now;
  }
  return ledger;
}

}  // namespace hovercraft_ros
