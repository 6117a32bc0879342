// SPDX-License-Identifier: Apache-2.0
/// @file
/// Contents of MCAP files (https://mcap.dev/spec): topics, schemas, and messages as bytes with
/// times, whose meaning is up to the caller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace tagfield {

using McapChannelId = std::uint16_t;

/// Definition of a channel's messages.
struct McapSchema {
  std::string name;                  ///< "geometry_msgs/msg/PoseStamped".
  std::string encoding = "ros2msg";  ///< Language of `text`.
  std::string text;
};

/// A stream of messages on a topic.
struct McapChannel {
  std::string topic;
  std::shared_ptr<const McapSchema> schema;  ///< Null if there is none.
  std::string message_encoding = "cdr";
  std::map<std::string, std::string> metadata;
};

struct McapMessage {
  McapChannelId channel = 0;
  std::uint32_t sequence = 0;         ///< Counts the messages of a channel.
  std::uint64_t log_time_ns = 0;      ///< When it was recorded, since an arbitrary epoch.
  std::uint64_t publish_time_ns = 0;  ///< When it was sent.
  std::string_view bytes;             ///< Valid only during the call that passes them.
};

/// A chunk is held in memory as a whole. Real files have chunks of 1 to 16 MB; this limit is far
/// above those, yet a small machine can still allocate it if a broken or hostile file claims it.
constexpr std::size_t kMaxMcapChunkBytes = std::size_t{256} << 20U;
/// All schemas and channels of a file are kept until it is closed.
constexpr std::size_t kMaxMcapDefinitionBytes = std::size_t{64} << 20U;
/// Limit of one written message, such that it still fits in a chunk with definitions before it.
constexpr std::size_t kMaxMcapMessageBytes = std::size_t{128} << 20U;

}  // namespace tagfield
