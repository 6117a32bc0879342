// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads MCAP files, including those of other programs, and damaged ones as far as possible
/// (docs/mcap.md).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "adapters/mcap/mcap_channel.h"
#include "tagfield/base/error.h"

namespace tagfield {

/// Scans the whole file on construction and checks all CRCs; it does not rely on an index. So a
/// file without a summary, or a truncated one, is readable up to the damage: damaged parts are
/// skipped, with a warning that names the file and the byte.
class McapReader {
 public:
  /// Throws Error if the file does not exist or does not begin like an MCAP file.
  McapReader(const std::string& path, Diagnostics& diagnostics);
  ~McapReader();
  McapReader(const McapReader&) = delete;
  McapReader& operator=(const McapReader&) = delete;

  /// Profile stated by the file, such as "ros2".
  [[nodiscard]] const std::string& profile() const;
  [[nodiscard]] const std::map<McapChannelId, McapChannel>& channels() const;
  /// By their ids in the file, including those that no channel uses.
  [[nodiscard]] const std::map<std::uint16_t, std::shared_ptr<const McapSchema>>& schemas() const;
  /// Number of messages that read() passes on.
  [[nodiscard]] std::uint64_t message_count(McapChannelId channel) const;

  /// Passes each message of the channels in channels(), or of the `wanted` ones among them, to
  /// `tell`, in order of log time; messages with equal times in file order. Holds the chunks whose
  /// times overlap, and skips those without a wanted message. Throws Error if overlapping chunks
  /// exceed 512 MB, or if the file has changed since it was opened.
  void read(const std::function<void(const McapMessage&)>& tell);
  void read(const std::set<McapChannelId>& wanted,
            const std::function<void(const McapMessage&)>& tell);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tagfield
