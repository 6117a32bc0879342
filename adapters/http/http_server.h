// SPDX-License-Identifier: Apache-2.0
/// @file
/// A live world over HTTP and WebSocket: its page, its API, its reads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "adapters/http/api.h"
#include "adapters/http/live_feed.h"

namespace tagfield::http {

struct HttpOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;  ///< 0: any that is free.
  /// That commands must bring ("Authorization: Bearer …"); "" for none.
  std::string token;
};

/// Who answers requests to the API; from any thread.
class Answerer {
 public:
  using Answered = std::function<void(ApiAnswer)>;

  Answerer() = default;
  virtual ~Answerer() = default;
  Answerer(const Answerer&) = delete;
  Answerer& operator=(const Answerer&) = delete;

  /// Calls `answered` once, from whatever thread, or drops it where nobody will answer any more.
  virtual void ask(const ApiRequest& request, const std::atomic<bool>& stop, Answered answered) = 0;
};

/// By a live world, between two of its steps.
class LiveAnswerer final : public Answerer {
 public:
  /// Both must outlive this.
  LiveAnswerer(LiveWorld& world, Api& api) : world_(world), api_(api) {}
  void ask(const ApiRequest& request, const std::atomic<bool>& stop, Answered answered) override;

 private:
  LiveWorld& world_;
  Api& api_;
};

/// Serves in a thread of its own. What comes in is bounded in size, number and time, and must be
/// meant for this machine: requests under another host's name, or commands of another site's pages,
/// are refused. A client that falls behind loses its oldest frames and reads, with a count.
class HttpServer {
 public:
  /// `answerer` must outlive this. `feed`: of what happens; null where nothing does. Throws Error
  /// where the address can't be listened on.
  HttpServer(Answerer& answerer, std::shared_ptr<LiveFeed> feed, const HttpOptions& options);
  /// Ends all connections.
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// "http://127.0.0.1:8080".
  [[nodiscard]] std::string url() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield::http
