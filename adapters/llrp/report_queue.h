// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reports of a reader that wait for its client.
#pragma once

#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "adapters/llrp/wire.h"

namespace tagfield::llrp {

/// Reports kept for a disconnected client.
inline constexpr std::size_t kMaxPending = 10'000;

/// Encoded TagReportData, the oldest first.
class ReportQueue {
 public:
  /// To be sent. `may_drop`: nobody takes them at present, so the oldest beyond kMaxPending go.
  void add(std::vector<Bytes> reports, bool may_drop);
  /// Kept, at most kMaxPending, until a client asks for them: those of a ROSpec without a trigger.
  void keep(std::vector<Bytes> reports);
  /// The kept ones are to be sent, too.
  void release_kept(bool may_drop);

  [[nodiscard]] bool is_empty() const { return pending_.empty(); }
  /// Removes as many as one message holds, and returns its body.
  ByteWriter take_message();
  /// Number of reports dropped since the last call.
  std::int64_t take_dropped() { return std::exchange(dropped_, 0); }

 private:
  void shorten(std::deque<Bytes>& queue);

  std::deque<Bytes> pending_;
  std::deque<Bytes> kept_;
  std::int64_t dropped_ = 0;
};

}  // namespace tagfield::llrp
