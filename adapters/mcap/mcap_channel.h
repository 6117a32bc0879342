// SPDX-License-Identifier: Apache-2.0
/// @file
/// What MCAP files hold (https://mcap.dev/spec): topics, schemas, and messages as bytes with times.
/// What the bytes mean is for others to know.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace tagfield {

using McapChannelId = std::uint16_t;

/// What the messages of a channel are made of.
struct McapSchema {
  std::string name;                  ///< "geometry_msgs/msg/PoseStamped".
  std::string encoding = "ros2msg";  ///< What language `text` is in.
  std::string text;
};

/// A stream of messages on a topic.
struct McapChannel {
  std::string topic;
  std::shared_ptr<const McapSchema> schema;  ///< Null where there is none.
  std::string message_encoding = "cdr";
  std::map<std::string, std::string> metadata;
};

struct McapMessage {
  McapChannelId channel = 0;
  std::uint32_t sequence = 0;         ///< Counts the messages of a channel.
  std::uint64_t log_time_ns = 0;      ///< When it was recorded, since any epoch.
  std::uint64_t publish_time_ns = 0;  ///< When it was sent.
  std::string_view bytes;             ///< Gone after the call that hands them over.
};

/// A chunk is held in memory as a whole. Files in use have chunks of 1 to 16 MB; this is far more
/// than those, and still can be had on a small machine where a broken or hostile file claims it.
constexpr std::size_t kMostMcapChunkBytes = std::size_t{256} << 20U;
/// All schemas and channels of a file are held until it is closed.
constexpr std::size_t kMostMcapDefinitionBytes = std::size_t{64} << 20U;
/// Of one message that is written: with definitions before it, it still fits a chunk.
constexpr std::size_t kMostMcapMessageBytes = std::size_t{128} << 20U;

}  // namespace tagfield
