// SPDX-License-Identifier: Apache-2.0
#include "adapters/http/http_server.h"

#include <fmt/format.h>

#include <boost/asio/ip/host_name.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <thread>

#include "adapters/http/internal/server_context.h"
#include "tagfield/base/error.h"

namespace tagfield::http {
namespace {

using asio::ip::tcp;

constexpr int kMaxConnections = 512;
constexpr std::chrono::milliseconds kRest(100);

tcp::endpoint endpoint_of(const HttpOptions& options) {
  boost::system::error_code error;
  const auto address = asio::ip::make_address(options.address, error);
  if (error) {
    throw Error(fmt::format("'{}' is not an IP address to listen on", options.address));
  }
  return {address, options.port};
}

std::string own_name() {
  boost::system::error_code error;
  std::string name = asio::ip::host_name(error);
  return error ? std::string() : name;
}

}  // namespace

class HttpServer::Impl {
 public:
  Impl(Answerer& answerer, std::shared_ptr<LiveFeed> feed, const HttpOptions& options)
      : context_{answerer, std::move(feed), options, own_name()}, acceptor_(context_.io) {
    const tcp::endpoint endpoint = endpoint_of(options);
    boost::system::error_code error;
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error) {
      throw Error(fmt::format("HTTP can't listen on {} port {}: {}", options.address, options.port,
                              error.message()));
    }
    accept();
    thread_ = std::thread([this] { context_.io.run(); });
  }

  ~Impl() {
    context_.stop = true;
    context_.io.stop();
    thread_.join();
    context_.workers.stop();
    context_.workers.join();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  [[nodiscard]] std::string url() const {
    const tcp::endpoint endpoint = acceptor_.local_endpoint();
    const std::string address = endpoint.address().to_string();
    return endpoint.address().is_v6() ? fmt::format("http://[{}]:{}", address, endpoint.port())
                                      : fmt::format("http://{}:{}", address, endpoint.port());
  }

 private:
  void accept() {
    acceptor_.async_accept([this](boost::system::error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      // Excess connections are refused; if the machine is out of file descriptors, it pauses.
      if (!error && context_.connections < kMaxConnections) {
        socket.set_option(tcp::no_delay(true), error);
        serve_connection(context_, std::move(socket));
      }
      if (!error) return accept();
      rest_.expires_after(kRest);
      rest_.async_wait([this](boost::system::error_code) { accept(); });
    });
  }

  ServerContext context_;
  tcp::acceptor acceptor_;
  asio::steady_timer rest_{context_.io};
  std::thread thread_;
};

void LiveAnswerer::ask(const ApiRequest& request, const std::atomic<bool>& stop,
                       Answered answered) {
  world_.post([this, request, &stop, answered = std::move(answered)](LiveWorld& world) {
    answered(api_.answer(world, request, stop));
  });
}

HttpServer::HttpServer(Answerer& answerer, std::shared_ptr<LiveFeed> feed,
                       const HttpOptions& options)
    : impl_(std::make_unique<Impl>(answerer, std::move(feed), options)) {}
HttpServer::~HttpServer() = default;

std::string HttpServer::url() const { return impl_->url(); }

}  // namespace tagfield::http
