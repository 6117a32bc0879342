// SPDX-License-Identifier: Apache-2.0
/// @file
/// The readers of a live world on TCP ports, an LLRP reader each.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tagfield/live/live_world.h"
#include "tagfield/stream/listeners.h"

namespace tagfield::llrp {

struct LlrpOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 5084;  ///< Of the first reader; the next has the next. 0: any that are free.
  std::int64_t epoch_us = 0;  ///< UTC at the simulated time 0 [µs since 1970]; 0 or more.
  /// Told what clients ask for without effect, and what they lose: one line each.
  std::function<void(const std::string&)> warn = [](const std::string&) {};
};

/// A reader's port.
struct LlrpAddress {
  std::string reader;
  std::string address;
  std::uint16_t port = 0;
};

/// Attach it to the world's outlets and members. Sockets are served in a thread of its own. A
/// reader has one client at a time, as readers do. What comes in is bounded in size and time; of a
/// client that falls behind the oldest reports are dropped, with a count.
class LlrpServer final : public ReadListener, public LiveMember {
 public:
  explicit LlrpServer(const LlrpOptions& options);
  /// Ends all connections.
  ~LlrpServer() override;

  /// Listens, a port for each of the world's readers; `world` must outlive this. Throws Error where
  /// a port can't be listened on, or two tags would have the same EPC.
  void open(LiveWorld& world);
  [[nodiscard]] std::vector<LlrpAddress> addresses() const;
  /// Ends all connections; before the world is gone.
  void close();

  void on_read(const TagRead& read) override;
  void on_step(LiveWorld& world, Time now) override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield::llrp
