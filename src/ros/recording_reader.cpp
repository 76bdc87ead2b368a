#include "hovercraft_sim/ros/recording_reader.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <stdexcept>
#include <yaml-cpp/yaml.h>

#include <hovercraft_sim/AppliedCommand.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/ros/bag_file.h"
#include "hovercraft_sim/ros/conversions.h"
#include "hovercraft_sim/ros/run_events.h"
#include "hovercraft_sim/sim/scenario_parser.h"

namespace hovercraft_ros {
namespace {

using hovercraft_sim::AppliedCommand;
using hovercraft_sim::RunEvent;
using hovercraft_sim::State;

/// Sees from sequence numbers which messages of a topic are missing.
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
  explicit Reader(const std::string& path) : path_(path) { openForReading(bag_, path); }

  Recording read() {
    readScenario();
    rosbag::View view(bag_, rosbag::TypeQuery(std::vector<std::string>{
                                "hovercraft_sim/AppliedCommand", "hovercraft_sim/RunEvent",
                                "hovercraft_sim/State"}));
    for (const rosbag::MessageInstance& instance : view) {
      if (instance.isType<State>()) {
        readState(instance);
      } else if (instance.isType<AppliedCommand>()) {
        readCommand(instance);
      } else {
        readEvent(instance);
      }
    }
    if (recording_.states.empty()) {
      throw std::invalid_argument(path_ + ": there is no state (hovercraft_sim/State) in it");
    }
    sort();
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
      scenario_ = hovercraft::parseScenario(YAML::Load(recording_.scenario_text),
                                            {path_ + ": " + topic, "", {}});
      return;
    }
    throw std::invalid_argument(path_ +
                                ": there is no scenario in it (std_msgs/String on ~scenario)");
  }

  std::size_t vehicleOf(const rosbag::MessageInstance& instance) const {
    try {
      return vehicleIndex(scenario_, vehicleOfTopic(instance.getTopic()));
    } catch (const std::invalid_argument& error) {
      failAt(path_, instance, error.what());
    }
  }

  void readState(const rosbag::MessageInstance& instance) {
    const auto state = messageAs<State>(path_, instance);
    recording_.missing_states += sequences_[instance.getTopic()].missingBefore(state->header.seq);
    recording_.states.push_back({timeOf(*state), vehicleOf(instance), *state});
  }

  void readCommand(const rosbag::MessageInstance& instance) {
    const auto message = messageAs<AppliedCommand>(path_, instance);
    noteGap(instance.getTopic(), message->header.seq);
    recording_.commands.push_back({timeOf(*message), toCommand(*message, vehicleOf(instance))});
    last_times_[instance.getTopic()] = timeOf(*message);
  }

  void readEvent(const rosbag::MessageInstance& instance) {
    const auto event = messageAs<RunEvent>(path_, instance);
    noteGap(instance.getTopic(), event->header.seq);
    recording_.events.push_back(*event);
    last_times_[instance.getTopic()] = timeOf(*event);
  }

  /// What came before a gap is known up to the last message before it.
  void noteGap(const std::string& topic, std::uint32_t seq) {
    const std::uint32_t missing = sequences_[topic].missingBefore(seq);
    if (missing == 0) return;
    const RunTime last = last_times_.count(topic) > 0 ? last_times_[topic] : RunTime{0, 0};
    if (!(last < recording_.known_until)) return;
    recording_.known_until = last;
    recording_.gap = fmt::format("{} message{} of {} after episode {}, tick {}", missing,
                                 missing == 1 ? "" : "s", topic, last.episode,
                                 std::max<hovercraft::Tick>(last.tick, 0));
  }

  void sort() {
    const auto by_time = [](const auto& a, const auto& b) { return a.time < b.time; };
    std::stable_sort(recording_.commands.begin(), recording_.commands.end(), by_time);
    std::stable_sort(recording_.states.begin(), recording_.states.end(), by_time);
    std::stable_sort(recording_.events.begin(), recording_.events.end(),
                     [](const RunEvent& a, const RunEvent& b) { return timeOf(a) < timeOf(b); });
  }

  std::string path_;
  rosbag::Bag bag_;
  hovercraft::Scenario scenario_;
  Recording recording_;
  std::map<std::string, SequenceCheck> sequences_;
  std::map<std::string, RunTime> last_times_;
};

}  // namespace

Recording readRecording(const std::string& path) {
  return Reader(path).read();
}

}  // namespace hovercraft_ros
