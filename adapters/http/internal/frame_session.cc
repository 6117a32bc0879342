// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <deque>
#include <mutex>

#include "adapters/http/internal/server_context.h"

namespace tagfield::http {
namespace {

namespace websocket = beast::websocket;

/// Two seconds' worth: a client that is further behind loses the oldest.
constexpr std::size_t kMaxFrames = 40;
constexpr std::size_t kMaxMessage = 4096;

class FrameSession final : public FrameClient, public std::enable_shared_from_this<FrameSession> {
 public:
  FrameSession(ServerContext& context, beast::tcp_stream stream,
               std::shared_ptr<ConnectionCount> count)
      : context_(context), socket_(std::move(stream)), count_(std::move(count)) {}

  void begin(Request request) {
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(kMaxMessage);
    request_ = std::move(request);
    socket_.async_accept(request_, [self = shared_from_this()](beast::error_code error) {
      if (error) return;
      self->context_.feed->add(std::weak_ptr<FrameClient>(self));
      self->read();
    });
  }

  void on_frame(std::shared_ptr<const std::string> frame) override {
    {
      const std::lock_guard<std::mutex> guard(lock_);
      if (frames_.size() >= kMaxFrames) {
        frames_.pop_front();
        ++dropped_;
      }
      frames_.push_back(std::move(frame));
      if (is_woken_) return;
      is_woken_ = true;
    }
    asio::post(context_.io, [self = shared_from_this()] { self->write(); });
  }

 private:
  /// Messages from a page are ignored; they only show that it is still there.
  void read() {
    socket_.async_read(incoming_,
                       [self = shared_from_this()](beast::error_code error, std::size_t) {
                         if (error) return self->end();
                         self->incoming_.consume(self->incoming_.size());
                         self->read();
                       });
  }

  /// The next frame; none if the queue is empty, and the next frame has to restart writing.
  std::shared_ptr<const std::string> next() {
    const std::lock_guard<std::mutex> guard(lock_);
    if (dropped_ > 0) {
      auto message =
          std::make_shared<const std::string>(fmt::format("{{\"dropped\":{}}}", dropped_));
      dropped_ = 0;
      return message;
    }
    is_woken_ = !frames_.empty();
    if (!is_woken_) return nullptr;
    auto frame = std::move(frames_.front());
    frames_.pop_front();
    return frame;
  }

  void write() {
    if (has_ended_) return;
    outgoing_ = next();
    if (!outgoing_) return;
    socket_.text(true);
    socket_.async_write(asio::buffer(*outgoing_),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          if (error) return self->end();
                          self->write();
                        });
  }

  void end() {
    has_ended_ = true;
    beast::get_lowest_layer(socket_).close();
  }

  ServerContext& context_;
  websocket::stream<beast::tcp_stream> socket_;
  std::shared_ptr<ConnectionCount> count_;
  Request request_;
  beast::flat_buffer incoming_;
  std::shared_ptr<const std::string> outgoing_;
  bool has_ended_ = false;

  std::mutex lock_;  ///< Guards the following, which the simulation thread fills.
  std::deque<std::shared_ptr<const std::string>> frames_;
  std::int64_t dropped_ = 0;
  bool is_woken_ = false;
};

}  // namespace

void serve_frames(ServerContext& context, beast::tcp_stream stream, Request request,
                  std::shared_ptr<ConnectionCount> count) {
  std::make_shared<FrameSession>(context, std::move(stream), std::move(count))
      ->begin(std::move(request));
}

}  // namespace tagfield::http
