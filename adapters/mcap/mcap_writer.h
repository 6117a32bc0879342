// SPDX-License-Identifier: Apache-2.0
/// @file
/// Writes MCAP files: chunked, indexed, with a summary (docs/mcap.md). Needs the memory of a chunk,
/// and about a hundred bytes for each that was written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "adapters/mcap/mcap_channel.h"

namespace tagfield {

enum class McapCompression { kNone, kLz4, kZstd };

struct McapOptions {
  std::string profile = "ros2";
  std::string library = "tagfield";
  McapCompression compression = McapCompression::kZstd;
  std::size_t chunk_bytes = std::size_t{1} << 20U;  ///< Before compression; then a chunk is full.
};

/// Writes to PATH.PID.partial, a whole chunk at a time, and finish() moves that to its place.
/// Without it, a file that has a chunk stays as .partial, where McapReader can read it; another is
/// removed. Where the disk is full, or can't be written to for another reason, one call throws
/// Error, which names the path, and the calls after it do nothing.
class McapWriter {
 public:
  /// Throws Error where no file can be made there.
  explicit McapWriter(const std::string& path, const McapOptions& options = {});
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Schemas of one name are one. Throws Error where they differ, for more than 65,535 of either,
  /// and for more than kMostMcapDefinitionBytes.
  McapChannelId add_channel(const McapChannel& channel);

  /// In any order of times. Throws Error for a channel that was not added, and for more than
  /// kMostMcapMessageBytes.
  void write(McapChannelId channel, std::uint64_t log_time_ns, std::uint64_t publish_time_ns,
             std::string_view bytes);

  /// Writes the rest and the summary, waits until all is on the disk, and moves the file to its
  /// place.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tagfield
