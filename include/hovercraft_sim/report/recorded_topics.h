#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/report/message_layout.h"

namespace hovercraft_ros {

/// All that was recorded on one topic, as columns, in the order of stamps.
struct TopicSamples {
  std::string topic;
  std::string type;
  std::vector<MessageLeaf> leaves;  // those that were kept
  /// header.stamp, or when it was received where there is none, ns of ROS time.
  std::vector<std::int64_t> stamps_ns;
  std::vector<std::int64_t> received_ns;
  std::vector<std::vector<double>> numbers;     // one column a leaf; empty for a text
  std::vector<std::vector<std::string>> texts;  // one column a leaf; empty for a number
  std::vector<std::int64_t> last_integers;      // of each leaf, in the last message

  std::size_t size() const { return stamps_ns.size(); }
  /// The column of a leaf; nullptr if there is none.
  const std::vector<double>* column(const std::string& path) const;
  const std::vector<std::string>* textColumn(const std::string& path) const;
};

/// A bag as columns.
struct RecordedTopics {
  std::string path;
  std::map<std::string, TopicSamples> topics;  // by name
  std::vector<std::string> notes;              // what could not be read, a sentence each

  const TopicSamples* find(const std::string& topic) const;
};

/// @param done, whole messages of the bag.
using ReadingProgress = std::function<void(std::int64_t done, std::int64_t whole)>;

/// Reads a bag. Topics that hold no number that a page would show (tf, logs, pictures) are passed
/// over. A topic that cannot be read is left out, with a note.
/// @throws std::invalid_argument with the file and the rule: no bag, damaged, without an index.
HOVERCRAFT_PUBLIC RecordedTopics readTopics(const std::string& path,
                                            const ReadingProgress& progress = {});

}  // namespace hovercraft_ros
