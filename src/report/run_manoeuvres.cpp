#include <algorithm>
#include <array>

#include "hovercraft_sim/report/run_parts.h"

namespace hovercraft_ros {
namespace {

constexpr double kGreatestSeconds = 1e9;    // of a manoeuvre: beyond it a message is none
constexpr std::size_t kLongestText = 4096;  // bytes

/// The craft's name in the name of a topic of its namespace.
std::string craftOf(const std::string& topic) {
  const std::size_t begin = topic.rfind('/', 0) == 0 ? 1 : 0;
  const std::size_t slash = topic.rfind('/');
  return slash == std::string::npos || slash < begin ? "" : topic.substr(begin, slash - begin);
}

}  // namespace

std::vector<RunManoeuvre> manoeuvresOf(const std::string& topic, const TopicSamples& samples,
                                       std::int64_t zero_ns) {
  const std::array words = {samples.textColumn("name"), samples.textColumn("kind"),
                            samples.textColumn("text")};
  const std::array numbers = {samples.column("complete"), samples.column("execute"),
                              samples.column("end")};
  if (std::count(words.begin(), words.end(), nullptr) > 0) return {};
  if (std::count(numbers.begin(), numbers.end(), nullptr) > 0) return {};
  const auto& [names, kinds, texts] = words;
  const auto& [completes, executes, ends] = numbers;
  std::vector<RunManoeuvre> manoeuvres;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double seconds = (*ends)[i] - (*executes)[i];
    if (!(seconds >= 0.0 && seconds <= kGreatestSeconds)) continue;
    RunManoeuvre manoeuvre;
    manoeuvre.craft = craftOf(topic);
    manoeuvre.name = (*names)[i];
    manoeuvre.kind = (*kinds)[i];
    manoeuvre.is_complete = (*completes)[i] != 0.0;
    manoeuvre.end_ns = samples.stamps_ns[i] - zero_ns;
    // Simulated times count from tick 0 of an episode, stamps through all of them.
    manoeuvre.execute_ns = manoeuvre.end_ns - static_cast<std::int64_t>(1e9 * seconds);
    manoeuvre.text = (*texts)[i].substr(0, kLongestText);
    manoeuvres.push_back(std::move(manoeuvre));
  }
  return manoeuvres;
}

}  // namespace hovercraft_ros
