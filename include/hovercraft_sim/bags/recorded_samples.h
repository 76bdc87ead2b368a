#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <rosbag/bag.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/messages/sensor_messages.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft_ros {

/// A message of a sensor as a bag holds it: by its bytes, but for the names of frames and the
/// number that a publisher gives it.
struct RecordedSample {
  std::size_t vehicle = 0;     // index into the scenario's vehicles
  std::size_t sensor = 0;      // index into the craft's sensors
  bool is_velocity = false;    // of GNSS: the second one of its two messages
  std::uint64_t stamp_ns = 0;  // of the measurement
  std::uint64_t digest = 0;    // FNV-1a of the bytes
};

/// The messages of the scenario's sensors in a bag, by topic: .../VEHICLE/TOPIC, and of
/// several that fit the longest. The first odometry
/// sensor's may also be on `odom`, where its frame tells it from the truth.
/// @throws std::invalid_argument that names file, topic and time of a message that is damaged.
HOVERCRAFT_PUBLIC std::vector<RecordedSample> readSamples(const std::string& path,
                                                          const rosbag::Bag& bag,
                                                          const hovercraft::Scenario& scenario);

/// Compares the samples of a run with those of a recording, bit for bit.
class HOVERCRAFT_PUBLIC SampleComparison {
 public:
  /// @param recorded as readSamples(). @param scenario of the run.
  SampleComparison(const std::vector<RecordedSample>& recorded,
                   const hovercraft::Scenario& scenario);

  struct Difference {
    std::uint64_t stamp_ns = 0;
    std::string vehicle;   // name
    std::string topic;     // relative to its namespace
    std::string recorded;  // digest, or "nothing"
    std::string replayed;  // likewise
  };

  /// A sample of the run; one that was not recorded is fewer to compare.
  void add(const hovercraft::SensorSample& sample, std::uint64_t stamp_ns);
  /// The first one that differed.
  const std::optional<Difference>& difference() const { return difference_; }
  /// The first recorded one with a stamp in (begin, end], ns, that the run did not have.
  [[nodiscard]] std::optional<Difference> missing(std::uint64_t begin_ns,
                                                  std::uint64_t end_ns) const;
  std::uint64_t compared() const { return compared_; }  // messages, so far

 private:
  using Key = std::tuple<std::uint64_t, std::size_t, std::size_t, bool>;  // stamp first
  struct Entry {
    std::uint64_t digest = 0;
    bool found = false;
  };

  void compare(const Key& key, std::uint64_t digest);
  Difference differenceAt(const Key& key) const;

  std::vector<SensorMessages> messages_;
  std::map<Key, Entry> recorded_;
  std::optional<Difference> difference_;
  std::uint64_t compared_ = 0;
};

}  // namespace hovercraft_ros
