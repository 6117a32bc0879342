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
  std::uint16_t port = 8080;  ///< 0 for any free one.
  /// Token that commands must carry ("Authorization: Bearer …"); "" for none.
  std::string token;
};

/// Answers API requests, from any thread.
class Answerer {
 public:
  using Answered = std::function<void(ApiAnswer)>;

  Answerer() = default;
  virtual ~Answerer() = default;
  Answerer(const Answerer&) = delete;
  Answerer& operator=(const Answerer&) = delete;

  /// Calls `answered` once, from any thread, or drops it if the request will never be answered.
  virtual void ask(const ApiRequest& request, const std::atomic<bool>& stop, Answered answered) = 0;
};

/// Answers from a live world, between two of its steps.
class LiveAnswerer final : public Answerer {
 public:
  /// Both must outlive this.
  LiveAnswerer(LiveWorld& world, Api& api) : world_(world), api_(api) {}
  void ask(const ApiRequest& request, const std::atomic<bool>& stop, Answered answered) override;

 private:
  LiveWorld& world_;
  Api& api_;
};

/// Serves on its own thread. Input is limited in size, number and time, and must be addressed to
/// this machine: requests for another host name, and commands from other sites' pages, are refused.
/// A client that falls behind loses its oldest frames and reads, and gets their number.
class HttpServer {
 public:
  /// `answerer` must outlive this. `feed`: the source of frames and reads; null for none. Throws
  /// Error if the server can't listen on the address.
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
