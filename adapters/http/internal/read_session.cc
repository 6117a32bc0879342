// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/chunk_encode.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/serializer.hpp>
#include <boost/beast/http/write.hpp>
#include <deque>
#include <mutex>

#include "adapters/http/internal/server_context.h"
#include "adapters/http/target.h"

namespace tagfield::http {
namespace {

namespace http = beast::http;

/// Reads queued for a client: one that is further behind loses the oldest.
constexpr std::size_t kMaxReads = 20'000;
/// A client that receives nothing for this long is considered gone.
constexpr std::chrono::seconds kWritePatience(60);

class ReadSession final : public ReadClient, public std::enable_shared_from_this<ReadSession> {
 public:
  ReadSession(ServerContext& context, beast::tcp_stream stream, Target target,
              std::shared_ptr<ConnectionCount> count)
      : context_(context),
        stream_(std::move(stream)),
        count_(std::move(count)),
        target_(std::move(target)) {}

  void begin(unsigned version) {
    header_.version(version);
    header_.result(http::status::ok);
    header_.set(http::field::server, "tagfield");
    header_.set(http::field::content_type, "application/jsonl");
    header_.set(http::field::cache_control, "no-store");
    header_.chunked(true);
    serializer_ = std::make_unique<http::response_serializer<http::empty_body>>(header_);
    stream_.expires_after(kWritePatience);
    http::async_write_header(stream_, *serializer_,
                             [self = shared_from_this()](beast::error_code error, std::size_t) {
                               if (error) return;
                               self->context_.feed->add(std::weak_ptr<ReadClient>(self));
                               self->watch();
                             });
  }

  void on_reads(std::shared_ptr<const ReadLines> reads) override {
    {
      const std::lock_guard<std::mutex> guard(lock_);
      waiting_ += reads->lines.size();
      batches_.push_back(std::move(reads));
      while (waiting_ > kMaxReads && batches_.size() > 1) {
        waiting_ -= batches_.front()->lines.size();
        dropped_ += batches_.front()->lines.size();
        batches_.pop_front();
      }
      if (is_woken_) return;
      is_woken_ = true;
    }
    asio::post(context_.io, [self = shared_from_this()] { self->write(); });
  }

 private:
  /// Detects the end of the connection; nothing more is expected.
  void watch() {
    stream_.expires_never();
    stream_.async_read_some(incoming_.prepare(512),
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                              if (error) return self->end();
                              self->watch();
                            });
  }

  [[nodiscard]] bool wants(const TagRead& read) const {
    const auto is = [&](const char* key, const std::string& value) {
      const auto wanted = target_.query(key);
      return !wanted || *wanted == value;
    };
    return is("tag", read.tag) && is("antenna", read.antenna) && is("reader", read.reader);
  }

  /// All queued reads that match the request.
  std::string take() {
    std::deque<std::shared_ptr<const ReadLines>> batches;
    std::string text;
    {
      const std::lock_guard<std::mutex> guard(lock_);
      batches.swap(batches_);
      waiting_ = 0;
      if (dropped_ > 0) text = fmt::format("{{\"dropped\": {}}}\n", dropped_);
      dropped_ = 0;
      is_woken_ = !batches.empty();
    }
    for (const auto& batch : batches) {
      for (std::size_t i = 0; i < batch->reads.size(); ++i) {
        if (wants(batch->reads[i])) text += batch->lines[i];
      }
    }
    return text;
  }

  [[nodiscard]] bool is_woken() {
    const std::lock_guard<std::mutex> guard(lock_);
    return is_woken_;
  }

  void write() {
    if (has_ended_) return;
    outgoing_ = take();
    if (outgoing_.empty()) {
      if (is_woken()) asio::post(context_.io, [self = shared_from_this()] { self->write(); });
      return;
    }
    stream_.expires_after(kWritePatience);
    asio::async_write(stream_, http::make_chunk(asio::buffer(outgoing_)),
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        if (error) return self->end();
                        self->write();
                      });
  }

  void end() {
    has_ended_ = true;
    stream_.close();
  }

  ServerContext& context_;
  beast::tcp_stream stream_;
  std::shared_ptr<ConnectionCount> count_;
  Target target_;
  http::response<http::empty_body> header_;
  std::unique_ptr<http::response_serializer<http::empty_body>> serializer_;
  beast::flat_buffer incoming_;
  std::string outgoing_;
  bool has_ended_ = false;

  std::mutex lock_;  ///< Guards the following, which the simulation thread fills.
  std::deque<std::shared_ptr<const ReadLines>> batches_;
  std::size_t waiting_ = 0;  ///< Number of reads in them.
  std::size_t dropped_ = 0;
  bool is_woken_ = false;
};

}  // namespace

void serve_reads(ServerContext& context, beast::tcp_stream stream, const Request& request,
                 std::shared_ptr<ConnectionCount> count) {
  const auto text = request.target();
  std::make_shared<ReadSession>(context, std::move(stream),
                                parsed_target({text.data(), text.size()}).value_or(Target{}),
                                std::move(count))
      ->begin(request.version());
}

}  // namespace tagfield::http
