/// @file
/// A live world over HTTP and WebSocket: its page, its API, its reads.
#pragma once

#include <cstdint>
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

/// Serves in a thread of its own. What comes in is bounded in size, number and time, and must be
/// meant for this machine: requests under another host's name, or commands of another site's pages,
/// are refused. A client that falls behind loses its oldest frames and reads, with a count.
class HttpServer {
 public:
  /// `world` and `api` must outlive this. Throws Error where the address can't be listened on.
  HttpServer(LiveWorld& world, Api& api, std::shared_ptr<LiveFeed> feed,
             const HttpOptions& options);
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
