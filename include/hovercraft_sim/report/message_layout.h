#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

enum class LeafKind { kNumber, kFlag, kTime, kText };

/// One value of a message: a number, a flag, a time or a text.
struct MessageLeaf {
  std::string path;  // as `rostopic echo` takes it: pose.position.x, thrust[0]
  LeafKind kind = LeafKind::kNumber;
};

/// What a leaf holds in one message.
struct LeafValue {
  double number = std::numeric_limits<double>::quiet_NaN();  // a flag is 0 or 1; a time is in s
  std::int64_t integer = 0;                                  // bits of an integer, ns of a time
  std::string_view text;                                     // lies in the message
};

/// How the messages of a topic are laid out, read from the definition that the bag carries. So
/// messages of any type can be read, also where this package knows another definition of it.
/// An array of numbers of fixed length longer than kMostElements has no leaves (a covariance); one
/// of any length, and one of messages, has those of its first kMostElements.
class HOVERCRAFT_PUBLIC MessageLayout {
 public:
  static constexpr std::size_t kMostElements = 16;
  static constexpr std::size_t kMostLeaves = 1024;

  /// @param type such as geometry_msgs/PoseStamped. @param definition as in the header of a
  /// connection: the text of the .msg file, then of each that it names.
  /// @throws std::invalid_argument with the rule if the definition is none.
  MessageLayout(const std::string& type, const std::string& definition);

  const std::vector<MessageLeaf>& leaves() const { return leaves_; }
  [[nodiscard]] std::optional<std::size_t> find(const std::string& path) const;

  /// Reads one message. @param values one for each leaf; those of elements that the message lacks
  /// keep their defaults.
  /// @returns false if the message ends before its layout does.
  bool read(const std::uint8_t* data, std::size_t size, std::vector<LeafValue>& values) const;

 private:
  friend class LayoutParser;
  friend class LayoutWalk;

  enum class Base { kBool, kInteger, kUnsigned, kFloat, kTime, kDuration, kString, kMessage };
  static constexpr int kSingle = -1;
  static constexpr int kAnyLength = -2;
  struct Field {
    std::string name;
    Base base = Base::kBool;
    std::size_t bytes = 0;    // of one element; of a message the least that it takes
    std::size_t message = 0;  // index of messages_
    std::int64_t length = kSingle;
    std::size_t shown = 1;  // elements that have leaves
    std::size_t width = 1;  // leaves of one element
  };
  struct Message {
    std::vector<Field> fields;
    std::size_t least_bytes = 0;
    std::size_t width = 0;
  };

  static LeafKind kindOf(Base base);
  void addLeaves(const Message& message, const std::string& prefix);

  std::vector<Message> messages_;  // the last one is that of the topic
  std::vector<MessageLeaf> leaves_;
};

}  // namespace hovercraft_ros
