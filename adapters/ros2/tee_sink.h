// SPDX-License-Identifier: Apache-2.0
/// @file
/// Duplication of messages to several sinks.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "adapters/ros2/message_sink.h"

namespace tagfield::ros2 {

class TeeSink : public MessageSink {
 public:
  explicit TeeSink(std::vector<std::shared_ptr<MessageSink>> sinks) : sinks_(std::move(sinks)) {}

  std::size_t advertise(const Ros2Topic& topic, const Ros2Type& type) override {
    std::vector<std::size_t>& numbers = topics_.emplace_back();
    for (const auto& sink : sinks_) numbers.push_back(sink->advertise(topic, type));
    return topics_.size() - 1;
  }
  void publish(std::size_t topic, Time stamp, const void* message) override {
    const std::vector<std::size_t>& numbers = topics_.at(topic);
    for (std::size_t i = 0; i < sinks_.size(); ++i) {
      sinks_[i]->publish(numbers[i], stamp, message);
    }
  }
  void finish() override {
    for (const auto& sink : sinks_) sink->finish();
  }

 private:
  std::vector<std::shared_ptr<MessageSink>> sinks_;
  std::vector<std::vector<std::size_t>> topics_;  ///< Each topic's numbers in the sinks.
};

}  // namespace tagfield::ros2
