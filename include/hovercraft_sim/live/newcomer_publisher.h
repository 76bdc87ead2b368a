#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <tf2_msgs/TFMessage.h>
#include <utility>

#include <ros/message_traits.h>
#include <ros/node_handle.h>
#include <ros/single_subscriber_publisher.h>
#include <ros/time.h>

#include "hovercraft_sim/live/topic_publisher.h"

namespace hovercraft_ros {

template <class Message>
ros::Time stampOfMessage(const Message& message) {
  return message.header.stamp;
}
/// All transforms of a message are of one tick.
inline ros::Time stampOfMessage(const tf2_msgs::TFMessage& message) {
  return message.transforms.empty() ? ros::Time() : message.transforms.front().header.stamp;
}

/// A publisher that gives the present message to a subscriber who comes while nothing is published,
/// to him alone: nobody gets a stamp twice.
template <class Message>
class NewcomerPublisher {
 public:
  /// The message of the present tick; null while a next one comes by itself.
  using Present = std::function<const Message*()>;

  NewcomerPublisher() = default;

  NewcomerPublisher(ros::NodeHandle& handle, const std::string& topic, std::uint32_t queue,
                    Present present, bool latched = false)
      : topic_(std::make_unique<Topic>()) {
    Topic* const self = topic_.get();
    self->present = std::move(present);
    self->publisher = handle.advertise<Message>(
        topic, queue,
        [self](const ros::SingleSubscriberPublisher& newcomer) { self->greet(newcomer); },
        [self](const ros::SingleSubscriberPublisher& /*gone*/) { self->forgetOne(); },
        ros::VoidConstPtr(), latched);
  }

  /// Whether a message would go anywhere: what nobody hears need not be filled, see skip().
  bool isHeard() const { return topic_->publisher.isHeard(); }

  /// Publishes, whether anyone hears it or not.
  void publish(const Message& message) {
    // Counted before: who comes in between may get it twice, but does not wait in vain.
    topic_->heard = topic_->publisher.subscribers();
    topic_->stamp = stampOfMessage(message);
    ++topic_->published;
    topic_->publisher.send(message);
  }

  /// In place of publish() where nobody heard it: it counts as published. Who has come since then
  /// has nothing yet.
  void skip() {
    topic_->heard = 0;
    ++topic_->published;
    topic_->publisher.skip();
  }

  /// publish() or skip(). @param is_filled what isHeard() said before the message was filled.
  void publishIf(bool is_filled, const Message& message) {
    if (is_filled) {
      publish(message);
    } else {
      skip();
    }
  }

  /// The full name.
  std::string topic() const { return topic_->publisher.topic(); }

 private:
  struct Topic {
    TopicPublisher publisher;
    Present present;
    ros::Time stamp;              // of the last message
    std::uint32_t heard = 0;      // subscribers who are here and have it
    std::uint32_t published = 0;  // messages, to all

    void greet(const ros::SingleSubscriberPublisher& newcomer) {
      const Message* const message = present();
      if (message == nullptr) return;
      if (stampOfMessage(*message) != stamp) heard = 0;
      stamp = stampOfMessage(*message);
      // He may have connected just before the message was published to all.
      if (publisher.subscribers() <= heard) return;
      ++heard;
      Message copy = *message;
      // The number of the last one, so that no reader of a bag misses any.
      std_msgs::Header* const header = ros::message_traits::header(copy);
      if (header != nullptr && published > 0) header->seq = published - 1;
      newcomer.publish(copy);
    }

    void forgetOne() {
      if (heard > 0) --heard;
    }
  };

  std::unique_ptr<Topic> topic_;  // the callbacks of the publisher point to it
};

}  // namespace hovercraft_ros
