// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/llrp_server.h"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <deque>
#include <map>
#include <mutex>
#include <thread>

#include "adapters/llrp/llrp_reader.h"
#include "tagfield/base/error.h"
#include "tagfield/gen2/tag_epc.h"

namespace tagfield::llrp {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

/// Bytes queued for a client, above which reports are dropped,
constexpr std::size_t kMaxWaiting = std::size_t{4} << 20U;
/// and above which a client that takes nothing else either is disconnected.
constexpr std::size_t kMaxUnread = 2 * kMaxWaiting;
/// Time limit for the rest of a message, and for a client to receive what was written.
constexpr std::chrono::seconds kPatience(30);
constexpr std::chrono::milliseconds kRest(100);
/// Before and after a response or an event: some clients treat data that arrives together as one
/// message.
constexpr std::chrono::milliseconds kGap(2);

/// Reader, acceptor and connection state of one port.
struct Endpoint {
  Endpoint(LiveWorld& live, std::unique_ptr<LlrpReader> made, asio::io_context& io)
      : world(live), reader(std::move(made)), acceptor(io), rest(io) {}

  LiveWorld& world;
  std::unique_ptr<LlrpReader> reader;  ///< Used by the thread that runs the world.
  tcp::acceptor acceptor;
  asio::steady_timer rest;
  bool has_client = false;  ///< Used by the network thread.
};

/// A client's connection. The network thread reads and writes; the world's thread sends.
class ClientSession final : public ClientLine, public std::enable_shared_from_this<ClientSession> {
 public:
  ClientSession(std::shared_ptr<Endpoint> endpoint, asio::io_context& io, tcp::socket socket)
      : endpoint_(std::move(endpoint)), io_(io), socket_(std::move(socket)), timer_(io), gap_(io) {}

  void begin() {
    endpoint_->has_client = true;
    endpoint_->world.post([self = shared_from_this()](LiveWorld& world) {
      self->endpoint_->reader->connect(world, self);
      asio::post(self->io_, [self] { self->read_header(); });
    });
  }

  void send(const Bytes& message, bool is_report) override {
    {
      const std::lock_guard<std::mutex> guard(lock_);
      waiting_ += message.size();
      queue_.push_back({message, is_report});
      drop_oldest();
      if (waiting_ > kMaxUnread && queue_.size() > 1) {
        asio::post(io_, [self = shared_from_this()] { self->end(); });
        return;
      }
      if (is_woken_) return;
      is_woken_ = true;
    }
    asio::post(io_, [self = shared_from_this()] { self->write(); });
  }
  double level() override {
    const std::lock_guard<std::mutex> guard(lock_);
    return static_cast<double>(waiting_) / static_cast<double>(kMaxWaiting);
  }
  std::int64_t take_dropped() override {
    const std::lock_guard<std::mutex> guard(lock_);
    return std::exchange(dropped_, 0);
  }

 private:
  struct Outgoing {
    Bytes bytes;
    bool is_report;
  };

  /// To be called with the lock held.
  void drop_oldest() {
    for (auto entry = queue_.begin(); entry != queue_.end() && waiting_ > kMaxWaiting;) {
      if (!entry->is_report) {
        ++entry;
        continue;
      }
      waiting_ -= entry->bytes.size();
      ++dropped_;
      entry = queue_.erase(entry);
    }
  }

  void read_header() {
    timer_.cancel();
    asio::async_read(socket_, asio::buffer(header_),
                     [self = shared_from_this()](boost::system::error_code error, std::size_t) {
                       if (error) return self->end();
                       self->read_body();
                     });
  }

  void read_body() {
    std::size_t length = 0;
    try {
      length = length_in(header_.data());
    } catch (const Fault& fault) {
      return refuse(fault);
    }
    message_.assign(header_.begin(), header_.end());
    message_.resize(length);
    expect_within_patience();
    asio::async_read(socket_, asio::buffer(message_.data() + kHeaderSize, length - kHeaderSize),
                     [self = shared_from_this()](boost::system::error_code error, std::size_t) {
                       if (error) return self->end();
                       self->timer_.cancel();
                       self->hand_over();
                     });
  }

  /// Messages are processed one at a time: the next is read when this one is done.
  void hand_over() {
    endpoint_->world.post(
        [self = shared_from_this(), message = message_of(message_)](LiveWorld& world) {
          const bool goes_on = self->endpoint_->reader->on_message(world, message);
          asio::post(self->io_, [self, goes_on] {
            if (goes_on) return self->read_header();
            self->closes_when_sent_ = true;
            self->write();
          });
        });
  }

  /// Closes the connection after data that is not LLRP, with an error message.
  void refuse(const Fault& fault) {
    ByteWriter body;
    body.parameter(287, [&] {
      body.u16(static_cast<std::uint16_t>(fault.status()));
      body.text(fault.what());
    });
    closes_when_sent_ = true;
    send(to_bytes({100, 0, body.written()}), false);
  }

  void expect_within_patience() {
    timer_.expires_after(kPatience);
    timer_.async_wait([weak = weak_from_this()](boost::system::error_code error) {
      if (const auto self = weak.lock(); self && !error) self->end();
    });
  }

  void write() {
    if (has_ended_ || is_writing_) return;
    {
      const std::lock_guard<std::mutex> guard(lock_);
      is_woken_ = !queue_.empty();
      if (is_woken_) {
        outgoing_ = std::move(queue_.front().bytes);
        is_report_ = queue_.front().is_report;
        queue_.pop_front();
        waiting_ -= outgoing_.size();
      }
    }
    if (!is_woken()) {
      if (closes_when_sent_) end();
      return;
    }
    is_writing_ = true;
    asio::async_write(socket_, asio::buffer(outgoing_),
                      [self = shared_from_this()](boost::system::error_code error, std::size_t) {
                        if (error) return self->end();
                        self->on_written();
                      });
  }

  void on_written() {
    if (is_report_ && is_report_next()) {
      is_writing_ = false;
      return write();
    }
    gap_.expires_after(kGap);
    gap_.async_wait([self = shared_from_this()](boost::system::error_code) {
      self->is_writing_ = false;
      self->write();
    });
  }

  bool is_report_next() {
    const std::lock_guard<std::mutex> guard(lock_);
    return !queue_.empty() && queue_.front().is_report;
  }

  bool is_woken() {
    const std::lock_guard<std::mutex> guard(lock_);
    return is_woken_;
  }

  void end() {
    if (has_ended_) return;
    has_ended_ = true;
    timer_.cancel();
    boost::system::error_code unheard;
    socket_.shutdown(tcp::socket::shutdown_both, unheard);
    socket_.close(unheard);
    endpoint_->has_client = false;
    endpoint_->world.post(
        [self = shared_from_this()](LiveWorld&) { self->endpoint_->reader->disconnect(*self); });
  }

  std::shared_ptr<Endpoint> endpoint_;
  asio::io_context& io_;
  tcp::socket socket_;
  asio::steady_timer timer_;
  asio::steady_timer gap_;
  std::array<std::uint8_t, kHeaderSize> header_{};
  Bytes message_;
  Bytes outgoing_;
  bool is_report_ = false;  ///< Of the message being sent.
  bool is_writing_ = false;
  bool closes_when_sent_ = false;
  bool has_ended_ = false;

  std::mutex lock_;  ///< Guards the following, which the world's thread fills.
  std::deque<Outgoing> queue_;
  std::size_t waiting_ = 0;  ///< Bytes in it.
  std::int64_t dropped_ = 0;
  bool is_woken_ = false;
};

/// Refuses a connection: another client is already connected.
void turn_away(tcp::socket socket, std::uint64_t utc_us) {
  ByteWriter body;
  body.parameter(246, [&] {
    body.parameter(kUtcTimestamp, [&] { body.u64(utc_us); });
    body.parameter(256, [&] { body.u16(2); });
  });
  const auto message = std::make_shared<Bytes>(to_bytes({63, 1, body.written()}));
  const auto kept = std::make_shared<tcp::socket>(std::move(socket));
  asio::async_write(*kept, asio::buffer(*message),
                    [kept, message](boost::system::error_code, std::size_t) {});
}

/// A client could not distinguish two tags with the same EPC.
[[noreturn]] void refuse_same_epc(const std::string& earlier, const TagSpec& tag) {
  fail(tag.location, fmt::format("tags '{}' and '{}' would have the same EPC, {}", earlier, tag.id,
                                 to_hex(epc_of_id(tag.id))));
}

void require_different_epcs(const Scenario& scenario) {
  std::map<Words, std::string> seen;
  for (const TagSpec& tag : scenario.tags) {
    const auto [other, is_new] = seen.emplace(epc_of_id(tag.id), tag.id);
    if (!is_new) refuse_same_epc(other->second, tag);
  }
}

}  // namespace

class LlrpServer::Impl {
 public:
  explicit Impl(const LlrpOptions& asked) : options_(asked) {}
  ~Impl() {
    close();
    // Breaks the reference cycle between a reader and its client's connection.
    for (const auto& endpoint : endpoints_) endpoint->reader.reset();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void close() {
    io_.stop();
    if (thread_.joinable()) thread_.join();
  }

  void open(LiveWorld& world) {
    require_different_epcs(world.scenario());
    const auto tags = std::make_shared<TagStore>();
    std::uint16_t port = options_.port;
    for (const std::string& name : world.readers()) {
      auto reader = std::make_unique<LlrpReader>(
          name, tags, static_cast<std::uint64_t>(options_.epoch_us), options_.warn);
      const auto endpoint = std::make_shared<Endpoint>(world, std::move(reader), io_);
      listen(*endpoint, port);
      endpoints_.push_back(endpoint);
      accept(endpoint);
      if (port != 0) ++port;
    }
    thread_ = std::thread([this] { io_.run(); });
  }

  [[nodiscard]] std::vector<LlrpAddress> addresses() const {
    std::vector<LlrpAddress> all;
    for (const auto& endpoint : endpoints_) {
      const tcp::endpoint local = endpoint->acceptor.local_endpoint();
      all.push_back({endpoint->reader->name(), local.address().to_string(), local.port()});
    }
    return all;
  }

  [[nodiscard]] const std::vector<std::shared_ptr<Endpoint>>& endpoints() const {
    return endpoints_;
  }

 private:
  void listen(Endpoint& endpoint, std::uint16_t port) const {
    boost::system::error_code error;
    const auto address = asio::ip::make_address(options_.address, error);
    if (error) throw Error(fmt::format("'{}' is not an IP address to listen on", options_.address));
    const tcp::endpoint local(address, port);
    endpoint.acceptor.open(local.protocol(), error);
    if (!error) endpoint.acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) endpoint.acceptor.bind(local, error);
    if (!error) endpoint.acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error) {
      throw Error(fmt::format("LLRP can't listen on {} port {}: {}", options_.address, port,
                              error.message()));
    }
  }

  void accept(const std::shared_ptr<Endpoint>& endpoint) {
    endpoint->acceptor.async_accept(
        [this, endpoint](boost::system::error_code error, tcp::socket socket) {
          if (error == asio::error::operation_aborted) return;
          if (error) return rest(endpoint);
          socket.set_option(tcp::no_delay(true), error);
          if (endpoint->has_client) {
            turn_away(std::move(socket), static_cast<std::uint64_t>(options_.epoch_us));
          } else {
            std::make_shared<ClientSession>(endpoint, io_, std::move(socket))->begin();
          }
          accept(endpoint);
        });
  }

  /// Pauses when the machine is out of file descriptors.
  void rest(const std::shared_ptr<Endpoint>& endpoint) {
    endpoint->rest.expires_after(kRest);
    endpoint->rest.async_wait([this, endpoint](boost::system::error_code) { accept(endpoint); });
  }

  LlrpOptions options_;
  asio::io_context io_{1};
  std::vector<std::shared_ptr<Endpoint>> endpoints_;
  std::thread thread_;
};

LlrpServer::LlrpServer(const LlrpOptions& options) : impl_(std::make_unique<Impl>(options)) {}
LlrpServer::~LlrpServer() = default;

void LlrpServer::open(LiveWorld& world) { impl_->open(world); }
void LlrpServer::close() { impl_->close(); }
std::vector<LlrpAddress> LlrpServer::addresses() const { return impl_->addresses(); }

void LlrpServer::on_read(const TagRead& read) {
  for (const auto& endpoint : impl_->endpoints()) endpoint->reader->on_read(read);
}

void LlrpServer::on_step(LiveWorld& world, Time now) {
  for (const auto& endpoint : impl_->endpoints()) endpoint->reader->on_step(world, now);
}

void LlrpServer::check_new_tag(const LiveWorld& world, const TagSpec& tag) {
  const Words epc = epc_of_id(tag.id);
  for (const TagSpec& other : world.scenario().tags) {
    // A tag with the same ID that has gone is replaced.
    if (other.id != tag.id && epc_of_id(other.id) == epc) refuse_same_epc(other.id, tag);
  }
}

}  // namespace tagfield::llrp
