#include "hovercraft_sim/ros/replay.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <stdexcept>

#include <ros/package.h>

#include "hovercraft_sim/ros/bag_writer.h"
#include "hovercraft_sim/ros/run_events.h"
#include "hovercraft_sim/ros/vehicle_messages.h"
#include "hovercraft_sim/sim/number_text.h"
#include "hovercraft_sim/sim/output_file.h"
#include "hovercraft_sim/sim/scenario_parser.h"
#include "hovercraft_sim/sim/snapshot.h"

namespace hovercraft_ros {
namespace {

using hovercraft_sim::RunEvent;
using hovercraft_sim::State;

std::uint64_t bitsOf(double number) {
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

  std::optional<ReplayDifference> result(const RunTime& time, const std::string& vehicle) const {
    if (field_ == nullptr) return std::nullopt;
    return ReplayDifference{time, vehicle, field_, recorded_, replayed_};
  }

 private:
  const char* field_ = nullptr;
  std::string recorded_;
  std::string replayed_;
};

std::optional<ReplayDifference> difference(const Recording::RecordedState& recorded,
                                           const State& replayed, const std::string& vehicle) {
  const State& state = recorded.state;
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

/// One run again, tick by tick, driven by the lists of a recording.
class Replayer {
 public:
  Replayer(const Recording& recording, const hovercraft::Scenario& scenario,
           const ReplayObserver& observer)
      : recording_(recording),
        is_changed_(hovercraft::toYaml(scenario) != hovercraft::toYaml(recording.scenario)),
        simulation_(scenario),
        observer_(observer),
        samples_(recording.samples, scenario) {
    for (std::size_t i = 0; i < scenario.vehicles.size(); ++i) messages_.emplace_back(scenario, i);
    simulation_.on_applied = observer.on_applied;
    simulation_.on_contact = observer.on_contact;
    simulation_.on_sample = [this](const hovercraft::SensorSample& sample) { take(sample); };
  }

  ReplayResult run(bool compares) {
    for (const Recording::RecordedState& recorded : recording_.states) {
      if (isUnknown(recorded.time)) {
        ++result_.unknown_states;
        continue;
      }
      advanceTo(recorded.time);
      applyEventsOfThisTick(recorded.state.events);  // of a run that stood, states come after them
      tellObserver(recorded.time);
      if (compares && !noteSampleDifference(samples_.difference())) {
        messages_[recorded.vehicle].fill(simulation_, {recorded.state.header.stamp, episode_});
        result_.difference = difference(recorded, messages_[recorded.vehicle].state(),
                                        messages_[recorded.vehicle].name());
        ++result_.compared_states;
      }
      if (result_.difference) break;
    }
    if (compares && !result_.difference) noteMissingSamples();
    result_.compared_samples = samples_.compared();
    result_.hash = simulation_.hash();
    return result_;
  }

 private:
  /// Its stamp is that of the recording's episode.
  void take(const hovercraft::SensorSample& sample) {
    if (observer_.on_sample) observer_.on_sample(sample);
    const auto epoch = recording_.epochs_ns.find(episode_);
    if (epoch == recording_.epochs_ns.end()) return;
    const std::int64_t step_ns = simulation_.scenario().step_ns;
    const std::int64_t stamp_ns = epoch->second + sample.measured * step_ns;
    samples_.add(sample, static_cast<std::uint64_t>(std::max<std::int64_t>(stamp_ns, 1)));
  }

  bool noteSampleDifference(const std::optional<SampleComparison::Difference>& found) {
    if (!found) return false;
    const std::int64_t epoch_ns = recording_.epochs_ns.at(episode_);
    const std::int64_t step_ns = simulation_.scenario().step_ns;
    const hovercraft::Tick tick = (static_cast<std::int64_t>(found->stamp_ns) - epoch_ns) / step_ns;
    result_.difference = ReplayDifference{
        {episode_, tick}, found->vehicle, found->topic, found->recorded, found->replayed};
    return true;
  }

  /// Of a recording without gaps: a sample that was recorded must have come again.
  void noteMissingSamples() {
    if (recording_.states.empty() || result_.unknown_states > 0) return;
    const auto& states = recording_.states;
    const auto epoch = recording_.epochs_ns.find(states.front().time.episode);
    if (epoch == recording_.epochs_ns.end()) return;
    const auto begin_ns = static_cast<std::uint64_t>(std::max<std::int64_t>(epoch->second, 0));
    // What was measured by then may have come later, after the last state.
    const auto end_ns =
        static_cast<std::int64_t>(states.back().state.header.stamp.toNSec()) - longestLatencyNs();
    if (end_ns <= 0) return;
    noteSampleDifference(samples_.missing(begin_ns, static_cast<std::uint64_t>(end_ns)));
  }

  std::int64_t longestLatencyNs() const {
    std::int64_t longest = 0;
    for (const auto& vehicle : simulation_.scenario().vehicles) {
      for (const auto& sensor : vehicle.sensors) longest = std::max(longest, sensor.latency_ns);
    }
    return longest;
  }

  bool beginsEpisode(const RunEvent& event) const {
    return event.kind == RunEvent::RESET || event.kind == RunEvent::LOAD;
  }

  bool isUnknown(const RunTime& time) {
    const auto& gaps = recording_.gaps;
    while (gap_ < gaps.size() && gaps[gap_].begin.episode < time.episode) ++gap_;
    return gap_ < gaps.size() && gaps[gap_].begin.episode == time.episode &&
           !(time < gaps[gap_].begin);
  }

  void advanceTo(const RunTime& time) {
    if (episode_ < time.episode) beginEpisode(time.episode);
    while (simulation_.tick() < time.tick) {
      applyEventsOfThisTick();
      pushCommandsOfThisTick();
      simulation_.step();
      ++result_.simulated_ticks;
    }
  }

  /// What came before the reset or the load that begins an episode does not matter to it.
  void beginEpisode(std::uint32_t episode) {
    while (event_ < recording_.events.size() && recording_.events[event_].episode < episode) {
      ++event_;
    }
    if (event_ == recording_.events.size() || !beginsEpisode(recording_.events[event_])) {
      throw std::invalid_argument(
          fmt::format("{}: lacks the event that began episode {}: record ~events as well",
                      recording_.source, episode));
    }
    episode_ = episode;
    apply(recording_.events[event_++]);
    while (command_ < recording_.commands.size() &&
           recording_.commands[command_].time.episode < episode_) {
      ++command_;
    }
  }

  void apply(const RunEvent& event) {
    try {
      if (event.kind == RunEvent::LOAD && is_changed_) {
        loadMotionOf(event);
      } else {
        applyEvent(event, simulation_);
      }
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("{}: event {} of episode {}: {}", recording_.source,
                                              event.number, event.episode, error.what()));
    }
    if (observer_.on_event) observer_.on_event(event, simulation_);
  }

  /// A snapshot is of the scenario that was recorded. In a changed one the craft start with the
  /// same motion: pose and velocities, whatever momenta they now mean. The air is that of the
  /// changed one where the snapshot has that of the recorded one.
  void loadMotionOf(const RunEvent& event) {
    hovercraft::Simulation recorded(recording_.scenario);
    applyEvent(event, recorded);
    hovercraft::SimulationState state = recorded.state();
    const hovercraft::Scenario& changed = simulation_.scenario();
    if (state.wind_W == recording_.scenario.wind) state.wind_W = changed.wind;
    if (changed.gusts.has_value() != recording_.scenario.gusts.has_value()) {
      hovercraft::Simulation begun(changed);
      begun.reset(state.seed);
      state.gusts = begun.state().gusts;
    }
    simulation_.restore(state);
    for (std::size_t i = 0; i < messages_.size(); ++i) {
      const hovercraft::Motion motion = recorded.motion(i);
      simulation_.setMotion(i, motion.p_WB, motion.q_WB, motion.twist);
    }
  }

  /// @param last number of the last one that is wanted.
  void applyEventsOfThisTick(std::uint64_t last = std::numeric_limits<std::uint64_t>::max()) {
    while (event_ < recording_.events.size()) {
      const RunEvent& event = recording_.events[event_];
      if (beginsEpisode(event) || event.episode != episode_ || event.number > last ||
          static_cast<hovercraft::Tick>(event.tick) != simulation_.tick()) {
        return;
      }
      apply(event);
      ++event_;
    }
  }

  void pushCommandsOfThisTick() {
    while (command_ < recording_.commands.size()) {
      const Recording::RecordedCommand& next = recording_.commands[command_];
      if (next.time.episode != episode_ || next.time.tick != simulation_.tick()) return;
      simulation_.push(next.command);
      ++command_;
    }
  }

  void tellObserver(const RunTime& time) {
    const bool is_new = !told_ || *told_ < time;
    if (is_new && observer_.on_state) observer_.on_state(simulation_);
    told_ = time;
  }

  const Recording& recording_;
  bool is_changed_;  // the scenario is not that of the recording
  hovercraft::Simulation simulation_;
  const ReplayObserver& observer_;
  SampleComparison samples_;
  std::vector<VehicleMessages> messages_;
  std::uint32_t episode_ = 0;
  std::size_t command_ = 0;
  std::size_t event_ = 0;
  std::size_t gap_ = 0;
  std::optional<RunTime> told_;
  ReplayResult result_;
};

std::string verdictOf(const ReplayResult& result, const Recording& recording) {
  const std::string missing_states =
      recording.missing_states == 0
          ? ""
          : fmt::format("; {} states were not recorded", recording.missing_states);
  const std::string samples =
      result.compared_samples == 0
          ? ""
          : fmt::format(" and {} messages of sensors", result.compared_samples);
  const std::string scope =
      fmt::format("{} ticks, {} states{} compared, hash {:016x}{}", result.simulated_ticks,
                  result.compared_states, samples, result.hash, missing_states);
  if (result.difference) {
    const ReplayDifference& found = *result.difference;
    return fmt::format("different: episode {}, tick {}, {}: {} = {} recorded, {} replayed",
                       found.time.episode, found.time.tick, found.vehicle, found.field,
                       found.recorded, found.replayed);
  }
  if (result.unknown_states > 0) {
    std::string missing;
    for (const Recording::Gap& gap : recording.gaps) {
      missing += fmt::format("{}{} (from tick {} on)", missing.empty() ? "" : ", ", gap.missing,
                             gap.begin.tick);
    }
    return fmt::format("identical where it can be checked: {}; {} states cannot: the bag lacks {}",
                       scope, result.unknown_states, missing);
  }
  return "identical: " + scope;
}

}  // namespace

ReplayResult replay(const Recording& recording, const hovercraft::Scenario& scenario, bool compares,
                    const ReplayObserver& observer) {
  return Replayer(recording, scenario, observer).run(compares);
}

int replayBag(const ReplayRequest& request, std::string& verdict) {
  if (!isTopicForTruth(request.truth_odom)) {
    throw std::invalid_argument(
        fmt::format("--truth-odom = {}: {}", request.truth_odom, kTruthOdomRuleText));
  }
  hovercraft::checkOutputs({{"--output", request.output}}, {request.bag});
  const Recording recording = readRecording(request.bag);
  const std::string source = request.bag + ": ~scenario";
  const hovercraft::Scenario scenario = hovercraft::parseScenario(
      recording.scenario_text,
      {source, "", [](const std::string& package) { return ros::package::getPath(package); }},
      {"--set", request.sets});

  std::unique_ptr<BagWriter> writer;
  ReplayObserver observer;
  if (!request.output.empty()) {
    writer = std::make_unique<BagWriter>(request.output, scenario, request.truth_odom);
    observer.on_state = [&writer](const hovercraft::Simulation& state) { writer->state(state); };
    observer.on_contact = [&writer](const hovercraft::ContactEvent& contact) {
      writer->contact(contact);
    };
    observer.on_sample = [&writer](const hovercraft::SensorSample& sample) {
      writer->sample(sample);
    };
    observer.on_applied = [&writer](const hovercraft::Command& command) {
      writer->applied(command);
    };
  }
  if (writer) {
    observer.on_event = [&writer](const RunEvent& event, const hovercraft::Simulation& state) {
      writer->event(event, state);
    };
  }
  const bool compares = request.sets.empty();
  const ReplayResult result = replay(recording, scenario, compares, observer);
  if (writer) writer->close();
  if (!compares) {
    verdict = fmt::format("replayed with changes: {} ticks, hash {:016x}", result.simulated_ticks,
                          result.hash);
    return 0;
  }
  verdict = verdictOf(result, recording);
  if (result.difference) return 1;
  return result.unknown_states == 0 ? 0 : 2;
}

}  // namespace hovercraft_ros
