// SPDX-License-Identifier: Apache-2.0
/// @file
/// Messages written to MCAP files and read from them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "adapters/mcap/mcap_reader.h"
#include "adapters/mcap/mcap_writer.h"

namespace tagfield::mcap_test {

/// Topic, sequence, log time, publish time, bytes.
using Sent = std::tuple<std::string, std::uint32_t, std::uint64_t, std::uint64_t, std::string>;

inline McapChannel channel_of(const std::string& topic) {
  const McapSchema schema{"pkg/msg" + topic, "ros2msg", "uint8[] data  # of " + topic + "\n"};
  return {topic, std::make_shared<const McapSchema>(schema), "cdr", {{"topic", topic}}};
}

/// All messages of a file.
inline std::vector<Sent> read_all(const std::string& path, Diagnostics& diagnostics) {
  McapReader reader(path, diagnostics);
  std::vector<Sent> found;
  reader.read([&](const McapMessage& message) {
    found.emplace_back(reader.channels().at(message.channel).topic, message.sequence,
                       message.log_time_ns, message.publish_time_ns, message.bytes);
  });
  return found;
}

inline std::vector<Sent> in_order_of_time(std::vector<Sent> messages) {
  std::stable_sort(messages.begin(), messages.end(), [](const Sent& one, const Sent& other) {
    return std::get<2>(one) < std::get<2>(other);
  });
  return messages;
}

}  // namespace tagfield::mcap_test
