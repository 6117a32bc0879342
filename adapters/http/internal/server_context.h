// SPDX-License-Identifier: Apache-2.0
/// @file
/// What all connections of a server share.
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
  asio::thread_pool workers{1};  ///< For what would hold up others.
};

/// Counts a connection as long as it lives.
class ConnectionCount {
 public:
  explicit ConnectionCount(ServerContext& context) : context_(&context) { ++context_->connections; }
  ~ConnectionCount() { --context_->connections; }
  ConnectionCount(const ConnectionCount&) = delete;
  ConnectionCount& operator=(const ConnectionCount&) = delete;

 private:
  ServerContext* context_;
};

/// A connection that has been accepted: reads requests and answers them.
void serve_connection(ServerContext& context, asio::ip::tcp::socket socket);

/// Goes on as a WebSocket that gets frames.
void serve_frames(ServerContext& context, beast::tcp_stream stream, Request request,
                  std::shared_ptr<ConnectionCount> count);

/// Goes on as an answer without end: a line of JSON each read that `request` asks for.
void serve_reads(ServerContext& context, beast::tcp_stream stream, const Request& request,
                 std::shared_ptr<ConnectionCount> count);

}  // namespace tagfield::http
