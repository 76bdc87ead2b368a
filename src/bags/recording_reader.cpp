#include "hovercraft_sim/bags/recording_reader.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/States.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/bags/bag_file.h"
#include "hovercraft_sim/bags/recorded_messages.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/run_events.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/scenario_parser.h"

namespace hovercraft_ros {
namespace {

using hovercraft_sim::AppliedCommand;
using hovercraft_sim::RunEvent;
using hovercraft_sim::State;
using hovercraft_sim::States;

/// Counts from sequence numbers which messages of a topic are missing.
class SequenceCheck {
 public:
  /// @param seq of the next message in the bag. @returns how many are missing before it.
  std::uint32_t missingBefore(std::uint32_t seq) {
    // Publishers of C++ begin with 0; a bag that was written directly holds nothing but 0.
    const std::uint32_t expected = next_.value_or(0);
    next_ = seq + 1;
    return seq > expected ? seq - expected : 0;
  }

 private:
  std::optional<std::uint32_t> next_;
};

/// The numbers of one topic's messages, which an episode counts from 1.
class Numbers {
 public:
  /// @returns false if the number was there already.
  bool add(std::uint64_t number) { return present_.insert(number).second; }

  struct Gap {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
  };
  /// A state names the last number that it rests on.
  void name(std::uint64_t number) { last_named_ = std::max(last_named_, number); }
  /// The first numbers that are missing, if one of them is not above `needed`.
  std::optional<Gap> gapBelow(std::uint64_t needed) {
    while (present_.count(whole_ + 1) > 0) ++whole_;
    if (whole_ >= needed) return std::nullopt;
    const auto next = present_.upper_bound(whole_);
    return Gap{whole_ + 1, next == present_.end() ? last_named_ : *next - 1};
  }

 private:
  std::set<std::uint64_t> present_;
  std::uint64_t whole_ = 0;  // up to here none is missing
  std::uint64_t last_named_ = 0;
};

RunTime timeOf(const AppliedCommand& message) {
  return {message.episode, static_cast<hovercraft::Tick>(message.tick)};
}
RunTime timeOf(const State& message) {
  return {message.episode, static_cast<hovercraft::Tick>(message.tick)};
}
/// A reset and a load stand before everything of the episode that they begin.
RunTime timeOf(const RunEvent& message) {
  const bool begins = message.kind == RunEvent::RESET || message.kind == RunEvent::LOAD;
  return {message.episode, begins ? -1 : static_cast<hovercraft::Tick>(message.tick)};
}

std::string vehicleOfTopic(const std::string& topic) {
  const std::size_t end = topic.rfind('/');
  const std::size_t begin = topic.rfind('/', end - 1);
  return topic.substr(begin + 1, end - begin - 1);
}

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {
    openForReading(bag_, path);
    recording_.source = path;
  }

  Recording read() {
    readScenario();
    findOwnTopics();
    rosbag::View view(bag_, rosbag::TypeQuery(std::vector<std::string>{
                                "hovercraft_sim/AppliedCommand", "hovercraft_sim/RunEvent",
                                "hovercraft_sim/State", "hovercraft_sim/States"}));
    for (const rosbag::MessageInstance& instance : view) {
      const std::string& type = instance.getDataType();
      if (type == ros::message_traits::DataType<State>::value()) {
        readState(instance);
      } else if (type == ros::message_traits::DataType<States>::value()) {
        readStatesOfAll(instance);
      } else if (type == ros::message_traits::DataType<AppliedCommand>::value()) {
        readCommand(instance);
      } else {
        readEvent(instance);
      }
    }
    if (recording_.states.empty()) {
      throw std::invalid_argument(path_ +
                                  ": there is no state (hovercraft_sim/State, States) in it");
    }
    recording_.samples = readSamples(path_, bag_, recording_.scenario);
    sort();
    forgetWhereItStood();
    findGaps();
    recording_.epochs_ns = epochs_ns_;
    return std::move(recording_);
  }

 private:
  void readScenario() {
    rosbag::View view(bag_, rosbag::TypeQuery("std_msgs/String"));
    for (const rosbag::MessageInstance& instance : view) {
      const std::string& topic = instance.getTopic();
      const std::string suffix = "/scenario";
      if (topic.size() < suffix.size() ||
          topic.compare(topic.size() - suffix.size(), suffix.size(), suffix) != 0) {
        continue;
      }
      recording_.scenario_text = messageAs<std_msgs::String>(path_, instance)->data;
      const std::string source = path_ + ": " + topic;
      recording_.scenario =
          hovercraft::parseScenario(recording_.scenario_text, {source, "", {}, {}, true});
      recording_.physics_version = hovercraft::physicsVersionOf(recording_.scenario_text, source);
      return;
    }
    throw std::invalid_argument(path_ +
                                ": there is no scenario in it (std_msgs/String on ~scenario)");
  }

  std::size_t vehicleOf(const rosbag::MessageInstance& instance) {
    return vehicleNamed(vehicleOfTopic(instance.getTopic()), instance);
  }

  std::size_t vehicleNamed(const std::string& name, const rosbag::MessageInstance& instance) {
    try {
      const auto known = vehicles_.find(name);  // of a fleet the list is long
      if (known != vehicles_.end()) return known->second;
      return vehicles_[name] = vehicleIndex(recording_.scenario, name);
    } catch (const std::invalid_argument& error) {
      failAt(path_, instance, error.what());
    }
  }

  /// Where a bag has both, a craft's own topic counts.
  void findOwnTopics() {
    rosbag::View view(bag_, rosbag::TypeQuery("hovercraft_sim/State"));
    for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
      has_own_topic_.insert(vehicleOfTopic(connection->topic));
    }
  }

  void readState(const rosbag::MessageInstance& instance) {
    const auto state = hovercraft_ros::readState(path_, instance);
    takeState(instance, *state, vehicleOf(instance), state->header.seq);
  }

  void readStatesOfAll(const rosbag::MessageInstance& instance) {
    const auto message = readStates(path_, instance);
    for (std::size_t i = 0; i < message->states.size(); ++i) {
      const std::string& name = message->names[i];
      if (has_own_topic_.count(name) > 0) continue;
      takeState(instance, message->states[i], vehicleNamed(name, instance), message->header.seq);
    }
  }

  /// @param seq of the message that it came in.
  void takeState(const rosbag::MessageInstance& instance, const State& state, std::size_t vehicle,
                 std::uint32_t seq) {
    const RunTime time = timeOf(state);
    const auto [last, is_first] = last_times_.emplace(vehicle, time);
    if (!is_first && !(last->second < time)) failAsTwoRuns(instance);
    last->second = time;
    checkStamp(state, instance);
    recording_.missing_states += sequences_[vehicle].missingBefore(seq);
    commands_[{time.episode, vehicle}].name(state.commands);
    events_[time.episode].name(state.events);
    recording_.states.push_back({time, vehicle, state});
  }

  void readCommand(const rosbag::MessageInstance& instance) {
    const std::size_t vehicle = vehicleOf(instance);
    const auto message = readAppliedCommand(path_, instance, recording_.scenario.vehicles[vehicle]);
    if (!commands_[{message->episode, vehicle}].add(message->number)) failAsTwoRuns(instance);
    recording_.commands.push_back({timeOf(*message), toCommand(*message, vehicle)});
  }

  void readEvent(const rosbag::MessageInstance& instance) {
    const auto event = readRunEvent(path_, instance);
    if (!events_[event->episode].add(event->number)) failAsTwoRuns(instance);
    recording_.events.push_back(*event);
  }

  /// stamp = epoch + tick · h, with one epoch in an episode. So a damaged tick is seen, and no
  /// replay runs towards one that was never reached. Only a load can put an epoch before time 0.
  void checkStamp(const State& state, const rosbag::MessageInstance& instance) {
    const auto stamp_ns = static_cast<std::int64_t>(state.header.stamp.toNSec());
    const auto tick = static_cast<hovercraft::Tick>(state.tick);
    const std::int64_t step_ns = recording_.scenario.step_ns;
    const bool is_in_time = tick <= std::numeric_limits<std::int64_t>::max() / step_ns &&
                            (state.episode != 0 || tick * step_ns <= stamp_ns);
    if (!is_in_time) {
      failAt(path_, instance,
             fmt::format("tick = {}: must not be more steps than its stamp allows", tick));
    }
    // ROS takes time 0 for no time: what is of tick 0 is then stamped as tick 1.
    if (tick == 0 && stamp_ns == step_ns) return;
    const std::int64_t epoch_ns = stamp_ns - tick * step_ns;
    if (epochs_ns_.emplace(state.episode, epoch_ns).first->second == epoch_ns) return;
    failAt(path_, instance,
           fmt::format("tick = {}: from tick to tick of an episode, stamps must go on by the step "
                       "size",
                       tick));
  }

  [[noreturn]] void failAsTwoRuns(const rosbag::MessageInstance& instance) const {
    failAt(path_, instance, "more than one run is in this bag; record each into a bag of its own");
  }

  /// A recorder that comes to a run that stands is given the state of that tick. Where a reset or a
  /// load follows at once, it is all that the bag has of the episode before: nothing is missing of
  /// what was recorded then.
  void forgetWhereItStood() {
    auto& states = recording_.states;
    const RunTime first = states.front().time;
    const auto is_of_it = [&](const RunTime& time) { return time.episode == first.episode; };
    const auto end = std::find_if(states.begin(), states.end(),
                                  [&](const auto& recorded) { return !is_of_it(recorded.time); });
    const bool moves = std::any_of(states.begin(), end,
                                   [&](const auto& recorded) { return first < recorded.time; });
    const bool has_more =
        std::any_of(recording_.events.begin(), recording_.events.end(),
                    [&](const RunEvent& event) { return is_of_it(timeOf(event)); }) ||
        std::any_of(recording_.commands.begin(), recording_.commands.end(),
                    [&](const auto& command) { return is_of_it(command.time); });
    if (end != states.end() && !moves && !has_more) states.erase(states.begin(), end);
  }

  /// States say how many commands and events they rest on.
  void findGaps() {
    std::map<std::size_t, RunTime> whole;  // the last state without a gap, by vehicle
    for (const Recording::RecordedState& recorded : recording_.states) {
      const std::uint32_t episode = recorded.time.episode;
      if (!recording_.gaps.empty() && recording_.gaps.back().begin.episode == episode) continue;
      const auto& [time, vehicle, state] = recorded;
      if (const auto gap = events_[episode].gapBelow(state.events)) {
        noteGap(time, *gap, "event", "");
      } else if (const auto lost = commands_[{episode, vehicle}].gapBelow(state.commands)) {
        const RunTime after = whole.emplace(vehicle, RunTime{episode, -1}).first->second;
        noteGap(firstStateAfter(after.episode == episode ? after : RunTime{episode, -1}), *lost,
                "command", " of " + recording_.scenario.vehicles[vehicle].name);
      } else {
        whole[vehicle] = time;
      }
    }
  }

  /// The command may have taken effect from there on: where bodies meet, in other vehicles too,
  /// whose states may be there when those of the vehicle itself are lost as well.
  RunTime firstStateAfter(const RunTime& time) const {
    const auto later = [](const RunTime& t, const Recording::RecordedState& recorded) {
      return t < recorded.time;
    };
    return std::upper_bound(recording_.states.begin(), recording_.states.end(), time, later)->time;
  }

  void noteGap(const RunTime& begin, const Numbers::Gap& gap, const char* what,
               const std::string& whose) {
    const std::string numbers = gap.first == gap.last
                                    ? fmt::format("{} {}", what, gap.first)
                                    : fmt::format("{}s {} to {}", what, gap.first, gap.last);
    recording_.gaps.push_back(
        {begin, fmt::format("{}{} in episode {}", numbers, whose, begin.episode)});
  }

  void sort() {
    const auto by_time = [](const auto& a, const auto& b) { return a.time < b.time; };
    std::stable_sort(recording_.commands.begin(), recording_.commands.end(), by_time);
    std::sort(recording_.states.begin(), recording_.states.end(), [](const auto& a, const auto& b) {
      return a.time < b.time || (!(b.time < a.time) && a.vehicle < b.vehicle);
    });
    std::stable_sort(recording_.events.begin(), recording_.events.end(),
                     [](const RunEvent& a, const RunEvent& b) { return timeOf(a) < timeOf(b); });
  }

  std::string path_;
  rosbag::Bag bag_;
  Recording recording_;
  std::map<std::string, std::size_t> vehicles_;                        // that were met, by name
  std::set<std::string> has_own_topic_;                                // names of craft
  std::map<std::size_t, SequenceCheck> sequences_;                     // of the states, by vehicle
  std::map<std::size_t, RunTime> last_times_;                          // of the states, by vehicle
  std::map<std::pair<std::uint32_t, std::size_t>, Numbers> commands_;  // by episode and vehicle
  std::map<std::uint32_t, Numbers> events_;                            // by episode
  std::map<std::uint32_t, std::int64_t> epochs_ns_;                    // by episode
};

}  // namespace

Recording readRecording(const std::string& path) {
  return readingBag(path, [&] { return Reader(path).read(); });
}

}  // namespace hovercraft_ros
