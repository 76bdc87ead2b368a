#include "hovercraft_sim/bags/replay.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <stdexcept>

#include <ros/package.h>

#include "hovercraft_sim/bags/bag_writer.h"
#include "hovercraft_sim/bags/state_difference.h"
#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/io/output_file.h"
#include "hovercraft_sim/messages/run_events.h"
#include "hovercraft_sim/messages/vehicle_messages.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/version.h"
#include "hovercraft_sim/sim/snapshot.h"

namespace hovercraft_ros {
namespace {

using hovercraft_sim::RunEvent;

/// One run again, tick by tick, driven by the lists of a recording.
class Replayer : private hovercraft::RunObserver {
 public:
  Replayer(const Recording& recording, const hovercraft::Scenario& scenario,
           RecordingObserver* observer)
      : recording_(recording),
        is_changed_(hovercraft::toYaml(scenario) != hovercraft::toYaml(recording.scenario)),
        is_older_(recording.physics_version != hovercraft::kPhysicsVersion),
        simulation_(scenario),
        observer_(observer),
        samples_(recording.samples, scenario) {
    for (std::size_t i = 0; i < scenario.vehicles.size(); ++i) messages_.emplace_back(scenario, i);
    simulation_.observe(this);
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
      if (compares) compare(recorded);
      if (result_.difference && !is_older_) break;
    }
    if (compares && !result_.difference) noteMissingSamples();
    result_.compared_samples = samples_.compared();
    result_.hash = simulation_.hash();
    return result_;
  }

 private:
  /// A recording of an older physics version parts from the run somewhere: how far is asked then.
  void compare(const Recording::RecordedState& recorded) {
    VehicleMessages& messages = messages_[recorded.vehicle];
    const bool is_known = result_.difference || noteSampleDifference(samples_.difference());
    if (is_known && !is_older_) return;
    messages.fill(simulation_, {recorded.state.header.stamp, episode_});
    ++result_.compared_states;
    if (!is_known) result_.difference = difference(recorded, messages.state(), messages.name());
    const auto& a = recorded.state.pose.position;
    const auto& b = messages.state().pose.position;
    const double error =
        hovercraft::norm(hovercraft::Vector3(b.x, b.y, b.z) - hovercraft::Vector3(a.x, a.y, a.z));
    if (!(error > result_.largest_error)) return;
    result_.largest_error = error;
    result_.largest_error_time = recorded.time;
    result_.largest_error_vehicle = messages.name();
  }

  void applied(const hovercraft::Command& command) override {
    if (observer_ != nullptr) observer_->applied(command);
  }

  void contact(const hovercraft::ContactEvent& event) override {
    if (observer_ != nullptr) observer_->contact(event);
  }

  /// Its stamp is that of the recording's episode.
  void sample(const hovercraft::SensorSample& sample) override {
    if (observer_ != nullptr) observer_->sample(sample);
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
        applyEvent(event, simulation_, true);
      }
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("{}: event {} of episode {}: {}", recording_.source,
                                              event.number, event.episode, error.what()));
    }
    if (observer_ != nullptr) observer_->event(event, simulation_);
  }

  /// A snapshot is of the scenario that was recorded. In a changed one the craft start with the
  /// same motion: pose and velocities, whatever momenta they now mean. The air is that of the
  /// changed one where the snapshot has that of the recorded one.
  void loadMotionOf(const RunEvent& event) {
    hovercraft::Simulation recorded(recording_.scenario);
    applyEvent(event, recorded, true);
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
    if (is_new && observer_ != nullptr) observer_->state(simulation_);
    told_ = time;
  }

  const Recording& recording_;
  bool is_changed_;  // the scenario is not that of the recording
  bool is_older_;    // other equations made its states
  hovercraft::Simulation simulation_;
  RecordingObserver* observer_;
  SampleComparison samples_;
  std::vector<VehicleMessages> messages_;
  std::uint32_t episode_ = 0;
  std::size_t command_ = 0;
  std::size_t event_ = 0;
  std::size_t gap_ = 0;
  std::optional<RunTime> told_;
  ReplayResult result_;
};

std::string errorOf(const ReplayResult& result) {
  if (!(result.largest_error > 0.0)) return "no position differs";
  return fmt::format("the largest error of a position, of {}, is {:.3g} m at episode {}, tick {}",
                     result.largest_error_vehicle, result.largest_error,
                     result.largest_error_time.episode, result.largest_error_time.tick);
}

/// What stands before the verdict on a recording whose states other equations made.
std::string olderText(const Recording& recording) {
  if (recording.physics_version == hovercraft::kPhysicsVersion) return "";
  return fmt::format("recorded by physics version {}, replayed by {}: ", recording.physics_version,
                     hovercraft::kPhysicsVersion);
}

std::string verdictOf(const ReplayResult& result, const Recording& recording) {
  const std::string older = olderText(recording);
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
    if (!older.empty()) {
      return fmt::format(
          "{}the first difference is at episode {}, tick {}, {}: {} = {} recorded, "
          "{} replayed; {}",
          older, found.time.episode, found.time.tick, found.vehicle, found.field, found.recorded,
          found.replayed, errorOf(result));
    }
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
    return fmt::format(
        "{}identical where it can be checked: {}; {} states cannot: the bag lacks "
        "{}",
        older, scope, result.unknown_states, missing);
  }
  return older + "identical: " + scope;
}

}  // namespace

ReplayResult replay(const Recording& recording, const hovercraft::Scenario& scenario, bool compares,
                    RecordingObserver* observer) {
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
      {source,
       "",
       [](const std::string& package) { return ros::package::getPath(package); },
       {},
       true},
      {"--set", request.sets});

  std::unique_ptr<BagWriter> writer;
  if (!request.output.empty()) {
    writer = std::make_unique<BagWriter>(request.output, scenario, request.truth_odom);
  }
  const bool compares = request.sets.empty();
  const ReplayResult result = replay(recording, scenario, compares, writer.get());
  if (writer) writer->close();
  if (!compares) {
    verdict = fmt::format("replayed with changes: {} ticks, hash {:016x}", result.simulated_ticks,
                          result.hash);
    return 0;
  }
  verdict = verdictOf(result, recording);
  if (result.difference) return recording.physics_version == hovercraft::kPhysicsVersion ? 1 : 2;
  return result.unknown_states == 0 ? 0 : 2;
}

}  // namespace hovercraft_ros
