// SPDX-License-Identifier: Apache-2.0
/// @file
/// Shared by all connections of a server.
#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <memory>
#include <string>

#include "adapters/http/http_server.h"

namespace tagfield::http {

namespace asio = boost::asio;
namespace beast = boost::beast;
using Request = beast::http::request<beast::http::string_body>;

struct ServerContext {
  Answerer& answerer;
  std::shared_ptr<LiveFeed> feed;
  HttpOptions options;
  std::string own_name;  ///< This machine's.
  std::atomic<int> connections{0};
  std::atomic<bool> stop{false};
  asio::io_context io{1};
  asio::thread_pool workers{1};  ///< For work that would block other requests.
};

/// Counts a connection during its lifetime.
class ConnectionCount {
 public:
  explicit ConnectionCount(ServerContext& context) : context_(&context) { ++context_->connections; }
  ~ConnectionCount() { --context_->connections; }
  ConnectionCount(const ConnectionCount&) = delete;
  ConnectionCount& operator=(const ConnectionCount&) = delete;

 private:
  ServerContext* context_;
};

/// Serves an accepted connection: reads requests and answers them.
void serve_connection(ServerContext& context, asio::ip::tcp::socket socket);

/// Upgrades the connection to a WebSocket that receives frames.
void serve_frames(ServerContext& context, beast::tcp_stream stream, Request request,
                  std::shared_ptr<ConnectionCount> count);

/// Turns the connection into an endless response: a line of JSON per read that matches `request`.
void serve_reads(ServerContext& context, beast::tcp_stream stream, const Request& request,
                 std::shared_ptr<ConnectionCount> count);

}  // namespace tagfield::http
