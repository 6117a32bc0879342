// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads MCAP files, of other programs too, and broken ones as far as they go (docs/mcap.md).
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

/// Looks at the whole file when it is made, and checks all CRCs; no index is relied on. So a file
/// without a summary, or one that was cut off, is as good as what is left of it: what is broken is
/// left out, with a warning that names the file and the byte.
class McapReader {
 public:
  /// Throws Error where there is no file, or one that does not begin as MCAP does.
  McapReader(const std::string& path, Diagnostics& diagnostics);
  ~McapReader();
  McapReader(const McapReader&) = delete;
  McapReader& operator=(const McapReader&) = delete;

  /// What the file says that it keeps to, such as "ros2".
  [[nodiscard]] const std::string& profile() const;
  [[nodiscard]] const std::map<McapChannelId, McapChannel>& channels() const;
  /// By their numbers in the file; also those that no channel has.
  [[nodiscard]] const std::map<std::uint16_t, std::shared_ptr<const McapSchema>>& schemas() const;
  /// Messages that read() tells of.
  [[nodiscard]] std::uint64_t message_count(McapChannelId channel) const;

  /// Tells each message of a channel in channels(), or of those of them that are `wanted`, in order
  /// of log time; those of one time in the order of the file. Holds the chunks whose times overlap,
  /// and passes over those without a wanted message. Throws Error where those are more
  /// than 512 MB, or the file was changed since it was opened.
  void read(const std::function<void(const McapMessage&)>& tell);
  void read(const std::set<McapChannelId>& wanted,
            const std::function<void(const McapMessage&)>& tell);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tagfield
