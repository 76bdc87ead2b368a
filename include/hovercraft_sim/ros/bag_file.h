#pragma once

#include <string>

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>

namespace hovercraft_ros {

/// True if the file exists and begins as a bag does.
bool isBag(const std::string& path);

/// Opens a bag for reading.
/// @throws std::invalid_argument that names the file and the reason: not there, not a bag, without
/// an index.
void openForReading(rosbag::Bag& bag, const std::string& path);

/// Throws std::invalid_argument: "file: topic at stamp s: rule", the stamp being when the message
/// was received.
[[noreturn]] void failAt(const std::string& path, const rosbag::MessageInstance& message,
                         const std::string& rule);

/// The message as its type.
/// @throws std::invalid_argument if it is of another type.
template <class Message>
boost::shared_ptr<const Message> messageAs(const std::string& path,
                                           const rosbag::MessageInstance& instance) {
  boost::shared_ptr<const Message> message = instance.instantiate<Message>();
  if (!message) {
    failAt(path, instance,
           std::string("the type ") + instance.getDataType() + " must be " +
               ros::message_traits::DataType<Message>::value());
  }
  return message;
}

}  // namespace hovercraft_ros
