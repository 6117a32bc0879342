// SPDX-License-Identifier: Apache-2.0
/// @file
/// The readers of a live world on TCP ports, one LLRP reader per port.
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
  std::uint16_t port = 5084;  ///< Of the first reader; the others follow. 0 for any free ones.
  std::int64_t epoch_us = 0;  ///< UTC at the simulated time 0 [µs since 1970]; 0 or more.
  /// Receives client requests without effect, and client losses, one line each.
  std::function<void(const std::string&)> warn = [](const std::string&) {};
};

/// A reader's port.
struct LlrpAddress {
  std::string reader;
  std::string address;
  std::uint16_t port = 0;
};

/// Attach it to the world's outlets and members. Sockets are served on a separate thread. As with
/// real readers, each accepts one client at a time. Input is limited in size and time; if a client
/// falls behind, the oldest reports are dropped and counted.
class LlrpServer final : public ReadListener, public LiveMember {
 public:
  explicit LlrpServer(const LlrpOptions& options);
  /// Ends all connections.
  ~LlrpServer() override;

  /// Listens on one port per reader of the world; `world` must outlive this. Throws Error if a port
  /// can't be opened, or if two tags would have the same EPC.
  void open(LiveWorld& world);
  [[nodiscard]] std::vector<LlrpAddress> addresses() const;
  /// Ends all connections; to be called before the world is destroyed.
  void close();

  void on_read(const TagRead& read) override;
  void on_step(LiveWorld& world, Time now) override;
  /// Throws Error if the tag would have the EPC of another one.
  void check_new_tag(const LiveWorld& world, const TagSpec& tag) override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield::llrp
