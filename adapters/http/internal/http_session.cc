// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <boost/asio/dispatch.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/bind_handler.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/string.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <optional>

#include "adapters/http/admission.h"
#include "adapters/http/embedded.h"
#include "adapters/http/internal/server_context.h"
#include "adapters/http/target.h"
#include "tagfield/base/error.h"

namespace tagfield::http {
namespace {

namespace http = beast::http;

constexpr std::uint64_t kMaxBody = 65'536;
constexpr std::uint32_t kMaxHeader = 16'384;
/// Time limit for receiving a request, and between two of them.
constexpr std::chrono::seconds kPatience(30);

/// Time for a client to receive the last response and stop sending.
constexpr std::chrono::seconds kGoodbye(2);
constexpr std::size_t kMaxDrained = 1U << 20U;

constexpr const char* kPagePolicy =
    "default-src 'self'; script-src 'self' 'unsafe-inline'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; connect-src 'self'; frame-ancestors 'none'";

constexpr const char* kNoPage =
    "<!doctype html><meta charset=utf-8><title>Tagfield</title><p>This tagfield was built without "
    "its page: Node.js (18 or later) and npm were missing, or npm could not get its packages. With "
    "them, build "
    "it again. The world is at <a href=/api/status>/api/status</a>, all of the API in <a "
    "href=/api/openapi.json>/api/openapi.json</a>.";

/// Response that refuses a request for reads; none if it is acceptable.
std::optional<ApiResponse> refusal_of_reads(std::string_view address) {
  const std::optional<Target> target = parsed_target(address);
  if (!target) return api_error(400, "the address is malformed");
  try {
    require_known(*target, {"tag", "antenna", "reader"});
  } catch (const Error& error) {
    return api_error(400, error.what());
  }
  return std::nullopt;
}

class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(ServerContext& context, asio::ip::tcp::socket socket)
      : context_(context),
        stream_(std::move(socket)),
        count_(std::make_shared<ConnectionCount>(context)) {}

  void read();

 private:
  using Response = http::response<http::string_body>;

  void on_header(beast::error_code error);
  [[nodiscard]] bool waits_for_continue() const;
  void answer_expectation();
  void read_body();
  void on_read(beast::error_code error);
  [[nodiscard]] std::optional<ApiResponse> refusal(const Request& request, bool has_body) const;
  void handle(Request request);
  void ask(const Request& request);
  void on_answer(const ApiAnswer& answer);
  void respond(const ApiResponse& answer);
  void respond_file(std::string_view file, const char* type, const char* policy);
  void send(Response response);
  void on_sent(bool is_last, beast::error_code error);
  void close();
  void drain();

  ServerContext& context_;
  beast::tcp_stream stream_;
  std::shared_ptr<ConnectionCount> count_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::optional<Response> response_;
  bool keep_alive_ = false;
  unsigned version_ = 11;
  std::array<char, 4096> drained_{};
  std::size_t drained_bytes_ = 0;
};

void HttpSession::read() {
  parser_.emplace();
  parser_->body_limit(kMaxBody);
  parser_->header_limit(kMaxHeader);
  stream_.expires_after(kPatience);
  http::async_read_header(stream_, buffer_, *parser_,
                          [self = shared_from_this()](beast::error_code error, std::size_t) {
                            self->on_header(error);
                          });
}

void HttpSession::on_header(beast::error_code error) {
  if (error) return on_read(error);
  if (waits_for_continue()) return answer_expectation();
  read_body();
}

/// Whether the client sends the body only after a "100 Continue", as curl does with long ones.
bool HttpSession::waits_for_continue() const {
  const Request& request = parser_->get();
  return request.version() >= 11 && !parser_->is_done() && buffer_.size() == 0 &&
         beast::iequals(request[http::field::expect], "100-continue");
}

void HttpSession::answer_expectation() {
  static constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
  if (const auto refused = refusal(parser_->get(), true)) {
    keep_alive_ = false;  // Nobody knows whether the body will come.
    version_ = parser_->get().version();
    return respond(*refused);
  }
  asio::async_write(stream_, asio::buffer(kContinue),
                    [self = shared_from_this()](beast::error_code error, std::size_t) {
                      if (error) return self->close();
                      self->read_body();
                    });
}

void HttpSession::read_body() {
  http::async_read(
      stream_, buffer_, *parser_,
      [self = shared_from_this()](beast::error_code error, std::size_t) { self->on_read(error); });
}

void HttpSession::on_read(beast::error_code error) {
  keep_alive_ = false;
  if (error == http::error::body_limit) {
    respond(api_error(413, fmt::format("a body is at most {} bytes", kMaxBody)));
  } else if (error == http::error::header_limit) {
    respond(api_error(431, fmt::format("headers are at most {} bytes", kMaxHeader)));
  } else if (error == http::error::end_of_stream || error == beast::error::timeout ||
             error == asio::error::operation_aborted || error == asio::error::connection_reset) {
    close();
  } else if (error) {
    respond(api_error(400, "this is not an HTTP request"));
  } else {
    handle(parser_->release());
  }
}

/// Whether a request for a WebSocket is complete; Beast would refuse others in plain text.
bool is_handshake(const Request& request) {
  constexpr std::size_t kKey = 24;
  const auto key = request[http::field::sec_websocket_key];
  return key.size() == kKey && request[http::field::sec_websocket_version] == "13";
}

/// Response that refuses the request; none if it is acceptable.
std::optional<ApiResponse> HttpSession::refusal(const Request& request, bool has_body) const {
  const auto field = [&](http::field name) {
    const auto value = request[name];
    return std::string_view(value.data(), value.size());
  };
  const std::string_view host = field(http::field::host);
  if (!is_own_host(host, context_.own_name)) {
    return api_error(403, "the Host header names a machine other than this one");
  }
  const bool is_get = request.method() == http::verb::get;
  const bool is_upgrade = beast::websocket::is_upgrade(request);
  if ((!is_get || is_upgrade) && !is_own_origin(field(http::field::origin), host)) {
    return api_error(403, "pages of other sites may not command this world");
  }
  const std::string bearer = "Bearer " + context_.options.token;
  if (!is_get && !context_.options.token.empty() &&
      !is_same_secret(field(http::field::authorization), bearer)) {
    return api_error(
        401, "commands need 'Authorization: Bearer TOKEN', with the token printed at start");
  }
  if (has_body && field(http::field::content_type).substr(0, 16) != "application/json") {
    return api_error(415, "a body must be of the type application/json");
  }
  return std::nullopt;
}

void HttpSession::handle(Request request) {
  keep_alive_ = request.keep_alive();
  version_ = request.version();
  if (const auto refused = refusal(request, !request.body().empty())) return respond(*refused);
  const auto target = request.target();
  const std::string_view path = std::string_view(target.data(), target.size());
  const bool is_get = request.method() == http::verb::get;
  if (is_get && beast::websocket::is_upgrade(request)) {
    if (path != "/api/live" || !context_.feed)
      return respond(api_error(404, "WebSockets are at /api/live"));
    if (!is_handshake(request)) {
      return respond(api_error(400,
                               "a WebSocket needs Sec-WebSocket-Key (16 bytes in base64) and "
                               "Sec-WebSocket-Version: 13"));
    }
    stream_.expires_never();
    return serve_frames(context_, std::move(stream_), std::move(request), count_);
  }
  if (is_get && context_.feed && path.substr(0, path.find('?')) == "/api/reads") {
    if (const auto refused = refusal_of_reads(path)) return respond(*refused);
    return serve_reads(context_, std::move(stream_), request, count_);
  }
  if (is_get && path == "/") {
    return respond_file(page_file().empty() ? kNoPage : page_file(), "text/html; charset=utf-8",
                        kPagePolicy);
  }
  if (is_get && path == "/api/openapi.json") {
    return respond_file(openapi_file(), "application/json", "default-src 'none'");
  }
  ask(request);
}

void HttpSession::ask(const Request& request) {
  const auto method = request.method_string();
  const auto target = request.target();
  ApiRequest asked{{method.data(), method.size()}, {target.data(), target.size()}, request.body()};
  context_.answerer.ask(asked, context_.stop, [self = shared_from_this()](ApiAnswer answer) {
    asio::post(self->context_.io, [self, answer = std::move(answer)] { self->on_answer(answer); });
  });
}

void HttpSession::on_answer(const ApiAnswer& answer) {
  if (const auto* response = std::get_if<ApiResponse>(&answer)) return respond(*response);
  const auto& work = std::get<std::function<ApiResponse()>>(answer);
  asio::post(context_.workers, [self = shared_from_this(), work] {
    ApiResponse response;
    try {
      response = work();
    } catch (const std::exception& error) {
      response = api_error(400, error.what());
    }
    asio::post(self->context_.io,
               [self, response = std::move(response)] { self->respond(response); });
  });
}

void HttpSession::respond(const ApiResponse& answer) {
  Response response(static_cast<http::status>(answer.status), version_);
  response.set(http::field::content_type, "application/json");
  response.set("Content-Security-Policy", "default-src 'none'; frame-ancestors 'none'");
  response.body() = answer.body + "\n";
  send(std::move(response));
}

void HttpSession::respond_file(std::string_view file, const char* type, const char* policy) {
  Response response(http::status::ok, version_);
  response.set(http::field::content_type, type);
  response.set("Content-Security-Policy", policy);
  response.body().assign(file);
  send(std::move(response));
}

void HttpSession::send(Response response) {
  response.set(http::field::server, "tagfield");
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.keep_alive(keep_alive_);
  response.prepare_payload();
  response_ = std::move(response);
  stream_.expires_after(kPatience);
  http::async_write(stream_, *response_,
                    [self = shared_from_this()](beast::error_code error, std::size_t) {
                      self->on_sent(self->response_->need_eof(), error);
                    });
}

void HttpSession::on_sent(bool is_last, beast::error_code error) {
  if (error || is_last) return close();
  response_.reset();
  read();
}

void HttpSession::close() {
  beast::error_code unheard;
  stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, unheard);
  stream_.expires_after(kGoodbye);
  drain();
}

/// Closing a socket before everything was read resets the connection, and the response with the
/// reason would be lost.
void HttpSession::drain() {
  stream_.async_read_some(asio::buffer(drained_),
                          [self = shared_from_this()](beast::error_code error, std::size_t bytes) {
                            self->drained_bytes_ += bytes;
                            if (!error && self->drained_bytes_ < kMaxDrained) self->drain();
                          });
}

}  // namespace

void serve_connection(ServerContext& context, asio::ip::tcp::socket socket) {
  std::make_shared<HttpSession>(context, std::move(socket))->read();
}

}  // namespace tagfield::http
