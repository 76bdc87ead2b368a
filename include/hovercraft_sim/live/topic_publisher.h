#pragma once

#include <cstdint>
#include <string>

#include <ros/publication.h>
#include <ros/publisher.h>
#include <ros/serialization.h>
#include <ros/topic_manager.h>

namespace hovercraft_ros {

/// A ros::Publisher that has looked its topic up once. roscpp does it at every publish, in a list
/// of all topics of the node: with many craft that is most of what publishing costs. What
/// subscribers get, and the numbers of the messages (header.seq), are the same. A topic that could
/// not be advertised, as while the node shuts down, is heard by nobody.
class TopicPublisher {
 public:
  TopicPublisher() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): stands in the place of what advertise() returns
  TopicPublisher(const ros::Publisher& publisher)
      : publisher_(publisher),
        publication_(ros::TopicManager::instance()->lookupPublication(publisher_.getTopic())) {}

  explicit operator bool() const { return static_cast<bool>(publication_); }
  /// Whether a message goes anywhere: to a subscriber, or to those to come if the topic is latched.
  bool isHeard() const {
    return publication_ && (publication_->hasSubscribers() || publisher_.isLatched());
  }
  std::uint32_t subscribers() const { return publication_ ? publication_->getNumSubscribers() : 0; }
  /// The full name of the topic.
  std::string topic() const { return publisher_.getTopic(); }

  template <class Message>
  void publish(const Message& message) const {
    if (isHeard()) {
      send(message);
    } else {
      skip();
    }
  }
  /// Publishes without another look whether anyone hears it.
  template <class Message>
  void send(const Message& message) const {
    if (publisher_.isLatched()) {
      publisher_.publish(message);  // it is the ros::Publisher that keeps the last message
    } else if (publication_) {
      publication_->enqueueMessage(ros::serialization::serializeMessage(message));
    }
  }
  /// Counts a message that nobody would hear as published.
  void skip() const {
    if (publication_) publication_->incrementSequence();
  }

 private:
  ros::Publisher publisher_;  // keeps the topic advertised
  ros::PublicationPtr publication_;
};

}  // namespace hovercraft_ros
