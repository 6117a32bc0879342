// SPDX-License-Identifier: Apache-2.0
/// @file
/// Writes MCAP files: chunked, indexed, with a summary (docs/mcap.md). Uses the memory of one
/// chunk, and about a hundred bytes for each chunk written.
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
  std::size_t chunk_bytes = std::size_t{1} << 20U;  ///< Size of a full chunk before compression.
};

/// Writes to PATH.PID.partial, a whole chunk at a time; finish() renames it to PATH. Without
/// finish(), a file that has a chunk stays as .partial, which McapReader can read; otherwise it is
/// removed. If the disk is full or writing fails for another reason, one call throws Error, which
/// names the path, and later calls do nothing.
class McapWriter {
 public:
  /// Throws Error if the file can't be created.
  explicit McapWriter(const std::string& path, const McapOptions& options = {});
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Schemas with the same name are shared. Throws Error if they differ, for more than 65,535
  /// schemas or channels, and for more than kMaxMcapDefinitionBytes.
  McapChannelId add_channel(const McapChannel& channel);

  /// Times can be in any order. Throws Error for a channel that was not added, and for more than
  /// kMaxMcapMessageBytes.
  void write(McapChannelId channel, std::uint64_t log_time_ns, std::uint64_t publish_time_ns,
             std::string_view bytes);

  /// Writes the rest and the summary, waits until everything is on the disk, and renames the file
  /// to PATH.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tagfield
