#pragma once

#include <boost/make_shared.hpp>
#include <new>
#include <stdexcept>
#include <string>

#include <ros/exception.h>
#include <rosbag/bag.h>
#include <rosbag/message_instance.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/messages/older_messages.h"

namespace hovercraft_ros {

/// Opens a bag for reading, after its structure was checked (bag_check.h).
/// @throws std::invalid_argument that names the file and the reason: not there, not a regular file,
/// not a bag, damaged, without an index.
HOVERCRAFT_PUBLIC void openForReading(rosbag::Bag& bag, const std::string& path);

/// Throws std::invalid_argument: "file: topic at stamp s: rule", the stamp being when the message
/// was received.
[[noreturn]] void failAt(const std::string& path, const rosbag::MessageInstance& message,
                         const std::string& rule);

/// What `read` returns, which reads an open bag: one that is damaged shows itself only then.
/// @throws std::invalid_argument that names the file instead of an exception of rosbag.
template <class Read>
auto readingBag(const std::string& path, const Read& read) {
  try {
    return read();
  } catch (const ros::Exception& error) {
    throw std::invalid_argument(path + ": cannot be read: " + error.what());
  } catch (const std::bad_alloc&) {
    throw std::invalid_argument(path + ": cannot be read: it does not fit into memory");
  }
}

/// The message as its type; one of an older format (older_messages.h) becomes one of today.
/// @throws std::invalid_argument if it is of another type, or damaged.
template <class Message>
boost::shared_ptr<const Message> messageAs(const std::string& path,
                                           const rosbag::MessageInstance& instance) {
  const std::string type = ros::message_traits::DataType<Message>::value();
  boost::shared_ptr<const Message> message;
  try {
    message = instance.instantiate<Message>();
    if constexpr (OlderFormat<Message>::kExists) {
      // Any type with its fields has its MD5 sum: only one of this name is an older one.
      if (!message && instance.getDataType() == type) {
        const auto old = instance.instantiate<typename OlderFormat<Message>::Message>();
        if (old) message = boost::make_shared<Message>(OlderFormat<Message>::upgraded(*old));
      }
    }
  } catch (const ros::Exception& error) {
    failAt(path, instance, "cannot be read as " + type + ": " + error.what());
  } catch (const std::length_error&) {  // of a list whose length is none
    failAt(path, instance, "cannot be read as " + type);
  }
  if (message) return message;
  if (instance.getDataType() == type) failAt(path, instance, type + " has another definition");
  failAt(path, instance, "the type " + instance.getDataType() + " must be " + type);
}

}  // namespace hovercraft_ros
