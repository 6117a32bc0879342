// SPDX-License-Identifier: Apache-2.0
// Reads or writes files with our code, to be checked against other implementations
// (tests/mcap/mcap_test.py):
//
//   mcap_sample write PATH none|lz4|zstd CHUNK_BYTES MESSAGES
//   mcap_sample read PATH      the profile, a line a channel, a line a message; warnings as errors
#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "adapters/mcap/mcap_reader.h"
#include "adapters/mcap/mcap_writer.h"

namespace {

using tagfield::McapChannelId;
using tagfield::McapCompression;
using tagfield::McapSchema;

McapCompression compression_of(const std::string& name) {
  if (name == "none") return McapCompression::kNone;
  return name == "lz4" ? McapCompression::kLz4 : McapCompression::kZstd;
}

/// Message i is on channel i % 3, has i % 50 bytes of the value i, and every fifth is 2 s late.
void write_messages(tagfield::McapWriter& writer, std::uint64_t count) {
  const auto text = std::make_shared<const McapSchema>(
      McapSchema{"std_msgs/msg/String", "ros2msg", "string data\n"});
  const auto point = std::make_shared<const McapSchema>(
      McapSchema{"geometry_msgs/msg/Point", "ros2msg", "float64 x\nfloat64 y\nfloat64 z\n"});
  std::vector<McapChannelId> channels;
  channels.push_back(writer.add_channel({"/text", text, "cdr", {{"offered_qos_profiles", ""}}}));
  channels.push_back(writer.add_channel({"/pose", point, "cdr", {}}));
  channels.push_back(writer.add_channel({"/text/größer", text, "cdr", {{"a", "1"}, {"b", "2"}}}));
  (void)writer.add_channel({"/silent", point, "cdr", {}});
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t time = 1'700'000'000'000'000'000 + i * 100'000'000;
    writer.write(channels[i % 3], i % 5 == 0 ? time + 2'000'000'000 : time, time,
                 std::string(i % 50, static_cast<char>(i % 256)));
  }
}

void write(const std::vector<std::string>& words) {
  tagfield::McapOptions options;
  options.compression = compression_of(words.at(2));
  options.chunk_bytes = std::stoul(words.at(3));
  tagfield::McapWriter writer(words.at(1), options);
  write_messages(writer, std::stoul(words.at(4)));
  writer.finish();
}

void read(const std::string& path) {
  tagfield::Diagnostics diagnostics;
  tagfield::McapReader reader(path, diagnostics);
  std::cout << reader.profile() << '\n';
  for (const auto& [id, channel] : reader.channels()) {
    std::cout << channel.topic << ' ' << channel.schema->name;
    for (const auto& [key, value] : channel.metadata) std::cout << ' ' << key << '=' << value;
    std::cout << '\n';
  }
  reader.read([&](const tagfield::McapMessage& message) {
    std::cout << fmt::format("{} {} {} {} ", reader.channels().at(message.channel).topic,
                             message.sequence, message.log_time_ns, message.publish_time_ns);
    for (const char byte : message.bytes) {
      std::cout << fmt::format("{:02x}", static_cast<unsigned char>(byte));
    }
    std::cout << '\n';
  });
  for (const std::string& warning : diagnostics.warnings()) std::cerr << warning << '\n';
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  try {
    if (words.at(0) == "write") write(words);
    if (words.at(0) == "read") read(words.at(1));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
