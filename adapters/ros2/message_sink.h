// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where ROS 2 messages go: into DDS, or a file.
#pragma once

#include <cstddef>
#include <string>

#include "adapters/ros2/ros2_messages.h"
#include "tagfield/base/time.h"

namespace tagfield::ros2 {

/// How a topic is delivered, as rmw's profiles are.
enum class Delivery {
  kReliable,    ///< Each message, to those who listen. Best-effort readers hear them too.
  kBestEffort,  ///< The newest, as of a clock.
  kLatched      ///< The last one also to those who come later (transient local).
};

struct Ros2Topic {
  std::string name;  ///< "/rfid/reads"
  Delivery delivery = Delivery::kReliable;
};

/// Takes messages of all types. Calls come from one thread at a time.
class MessageSink {
 public:
  MessageSink() = default;
  virtual ~MessageSink() = default;
  MessageSink(const MessageSink&) = delete;
  MessageSink& operator=(const MessageSink&) = delete;

  /// Gives the topic's number.
  virtual std::size_t advertise(const Ros2Topic& topic, const Ros2Type& type) = 0;
  /// `message` is of the topic's type.
  virtual void publish(std::size_t topic, Time stamp, const void* message) = 0;
  /// No more messages come.
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
