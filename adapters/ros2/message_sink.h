// SPDX-License-Identifier: Apache-2.0
/// @file
/// Sinks of ROS 2 messages: DDS, or a file.
#pragma once

#include <cstddef>
#include <string>

#include "adapters/ros2/ros2_messages.h"
#include "tagfield/base/time.h"

namespace tagfield::ros2 {

/// Quality of service of a topic, like rmw's profiles.
enum class Delivery {
  kReliable,    ///< Each message, to current subscribers, including best-effort ones.
  kBestEffort,  ///< Only the newest, as for a clock.
  kLatched      ///< The last message also to late subscribers (transient local).
};

struct Ros2Topic {
  std::string name;  ///< "/rfid/reads"
  Delivery delivery = Delivery::kReliable;
};

/// Accepts messages of all types. To be called by one thread at a time.
class MessageSink {
 public:
  MessageSink() = default;
  virtual ~MessageSink() = default;
  MessageSink(const MessageSink&) = delete;
  MessageSink& operator=(const MessageSink&) = delete;

  /// Returns the topic's number.
  virtual std::size_t advertise(const Ros2Topic& topic, const Ros2Type& type) = 0;
  /// `message` points to one of the topic's type.
  virtual void publish(std::size_t topic, Time stamp, const void* message) = 0;
  /// To be called after the last message.
  virtual void finish() {}
};

/// A topic of one type in a sink, which must outlive it.
template <class Message>
class Publisher {
 public:
  Publisher(MessageSink& sink, const Ros2Topic& topic)
      : sink_(&sink), topic_(sink.advertise(topic, type_of(Message{}))) {}

  void publish(Time stamp, const Message& message) const {
    sink_->publish(topic_, stamp, &message);
  }

 private:
  MessageSink* sink_;
  std::size_t topic_;
};

}  // namespace tagfield::ros2
