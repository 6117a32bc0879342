// SPDX-License-Identifier: Apache-2.0
/// @file
/// Events of a live world for viewers: frames for pages, reads for programs.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "adapters/http/laser_view.h"
#include "tagfield/files/read_json.h"
#include "tagfield/live/live_estimates.h"
#include "tagfield/live/live_world.h"
#include "tagfield/stream/listeners.h"

namespace tagfield::http {

/// Reads of one step, each as a line of JSON.
struct ReadLines {
  std::vector<TagRead> reads;
  std::vector<std::string> lines;  ///< One per read, each ending in a newline.
};

/// Receives frames. Called by the simulation thread, so it must return immediately.
class FrameClient {
 public:
  FrameClient() = default;
  virtual ~FrameClient() = default;
  FrameClient(const FrameClient&) = delete;
  FrameClient& operator=(const FrameClient&) = delete;
  virtual void on_frame(std::shared_ptr<const std::string> frame) = 0;
};

/// Same, but receives reads.
class ReadClient {
 public:
  ReadClient() = default;
  virtual ~ReadClient() = default;
  ReadClient(const ReadClient&) = delete;
  ReadClient& operator=(const ReadClient&) = delete;
  virtual void on_reads(std::shared_ptr<const ReadLines> reads) = 0;
};

/// An outlet and a member of a live world. Nothing is formatted while there are no clients.
class LiveFeed final : public ReadListener, public LiveMember {
 public:
  /// `start`: UTC at the simulated time 0, since 1970.
  explicit LiveFeed(Time start) : start_(start) {}

  // Further content of frames; to be called before the world runs.
  void add(std::shared_ptr<const LiveEstimates> estimates) { estimates_ = std::move(estimates); }
  void add(std::unique_ptr<LaserView> lasers) { lasers_ = std::move(lasers); }

  // Callable from any thread; a client that no longer exists is dropped.
  void add(std::weak_ptr<FrameClient> client);
  void add(std::weak_ptr<ReadClient> client);
  [[nodiscard]] std::int64_t reads() const { return count_; }

  void on_read(const TagRead& read) override;
  void on_step(LiveWorld& world, Time now) override;
  void on_tasks(LiveWorld& world) override;

 private:
  /// A tag's last read by an antenna, and how often it was read.
  struct LastRead {
    TagRead read;
    int count = 0;
  };
  /// Clock state of the world in a frame.
  struct Going {
    Time now;
    bool is_paused = false;
    double speed = 0.0;
    std::uint64_t revision = 0;
    bool operator==(const Going& other) const {
      return now == other.now && is_paused == other.is_paused && speed == other.speed &&
             revision == other.revision;
    }
  };
  template <class Client, class Message>
  void tell(std::vector<std::weak_ptr<Client>>& clients, std::atomic<bool>& any,
            const Message& message, void (Client::*take)(Message));
  void tell_reads(const LiveWorld& world);
  void tell_frame(const LiveWorld& world);
  std::string frame_of(const LiveWorld& world, const Going& going, bool is_new);

  std::mutex lock_;  ///< Guards the clients.
  std::vector<std::weak_ptr<FrameClient>> frame_clients_;
  std::vector<std::weak_ptr<ReadClient>> read_clients_;
  std::atomic<bool> has_frame_clients_{false};
  std::atomic<bool> has_new_client_{false};  ///< Of frames: it needs a complete one.
  std::atomic<bool> has_read_clients_{false};
  std::atomic<std::int64_t> count_{0};

  // Used by the simulation thread only.
  Time start_;
  AntennaPorts ports_;
  std::vector<TagRead> fresh_;
  std::map<std::pair<std::string, std::string>, LastRead> last_;  ///< By tag and antenna.
  std::chrono::steady_clock::time_point framed_{};
  Going sent_;  ///< As in the last frame.
  std::shared_ptr<const LiveEstimates> estimates_;
  std::uint64_t estimate_sent_ = 0;
  std::unique_ptr<LaserView> lasers_;
};

}  // namespace tagfield::http
