// SPDX-License-Identifier: Apache-2.0
#include "adapters/epcis/capture_client.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include "adapters/epcis/libcurl.h"
#include "tagfield/base/error.h"
#include "tagfield/base/time.h"
#include "tagfield/events/epcis.h"

namespace tagfield {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kMinDelay(1000);
constexpr milliseconds kMaxDelay(30'000);
/// Interval between checks of whether to give up.
constexpr milliseconds kLook(50);
/// Length of a response in messages.
constexpr std::size_t kMaxAnswer = 300;

/// The URL without user and password, for messages.
std::string shown(const std::string& url) {
  const std::size_t scheme = url.find("://");
  const std::size_t slash = url.find('/', scheme == std::string::npos ? 0 : scheme + 3);
  const std::size_t at = url.rfind('@', slash);
  if (scheme == std::string::npos || at == std::string::npos || at < scheme) return url;
  return url.substr(0, scheme + 3) + url.substr(at + 1);
}

void require_url(const std::string& url) {
  const std::size_t scheme = url.rfind("https://", 0) == 0  ? 8
                             : url.rfind("http://", 0) == 0 ? 7
                                                            : 0;
  const LibCurl& curl = libcurl();
  CURLU* const parts = curl.url();
  const bool is_one =
      scheme > 0 && url.size() > scheme && curl.url_set(parts, CURLUPART_URL, url.c_str(), 0) == 0;
  curl.url_cleanup(parts);
  if (!is_one) {
    throw Error(
        fmt::format("EPCIS capture: '{}' must be http://[user:password@]host[:port]/path, "
                    "or https://",
                    shown(url)));
  }
}

void require_header(const std::string& line) {
  const std::size_t colon = line.find(':');
  const bool is_text = std::all_of(line.begin(), line.end(), [](char c) {
    return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
  });
  if (colon == std::string::npos || colon == 0 || !is_text) {
    throw Error(fmt::format("EPCIS capture: the header '{}' must be 'Name: value'", line));
  }
}

/// The repository's response.
struct Answer {
  long status = 0;      ///< 0 for none.
  std::string text;     ///< Its beginning, or why there is none.
  milliseconds wait{};  ///< The requested delay.
};

bool is_success(const Answer& answer) { return answer.status >= 200 && answer.status < 300; }

bool is_to_be_tried_again(const Answer& answer) {
  return answer.status == 0 || answer.status == 408 || answer.status == 425 ||
         answer.status == 429 || answer.status >= 500;
}

std::string to_string(const Answer& answer) {
  if (answer.status == 0) return answer.text;
  return fmt::format("HTTP {}{}{}", answer.status, answer.text.empty() ? "" : ": ", answer.text);
}

/// One connection, kept open between requests.
class Connection {
 public:
  Connection(const std::string& url, const CaptureOptions& options,
             const std::atomic<bool>& is_ending)
      : handle_(curl_.easy_init()), multi_(curl_.multi_init()), is_ending_(is_ending) {
    if (handle_ == nullptr || multi_ == nullptr)
      throw Error("EPCIS capture: there is not enough memory");
    for (const char* line : {"Content-Type: application/ld+json", "Accept: application/json",
                             "GS1-EPCIS-Version: 2.0.0", "GS1-CBV-Version: 2.0.0", "Expect:"}) {
      headers_ = curl_.slist_append(headers_, line);
    }
    for (const std::string& line : options.headers) {
      headers_ = curl_.slist_append(headers_, line.c_str());
    }
    curl_.easy_setopt(handle_, CURLOPT_URL, url.c_str());
    allow_http_only();
    curl_.easy_setopt(handle_, CURLOPT_HTTPHEADER, headers_);
    curl_.easy_setopt(handle_, CURLOPT_POST, 1L);
    curl_.easy_setopt(handle_, CURLOPT_NOSIGNAL, 1L);
    curl_.easy_setopt(handle_, CURLOPT_USERAGENT, "tagfield");
    curl_.easy_setopt(handle_, CURLOPT_TIMEOUT_MS, static_cast<long>(options.timeout.count()));
    curl_.easy_setopt(handle_, CURLOPT_ERRORBUFFER, error_);
    curl_.easy_setopt(handle_, CURLOPT_WRITEFUNCTION, &Connection::take);
    curl_.easy_setopt(handle_, CURLOPT_WRITEDATA, this);
  }
  ~Connection() {
    curl_.easy_cleanup(handle_);
    curl_.multi_cleanup(multi_);
    curl_.slist_free_all(headers_);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  Answer post(const std::string& document) {
    text_.clear();
    error_[0] = '\0';
    curl_.easy_setopt(handle_, CURLOPT_POSTFIELDSIZE_LARGE,
                      static_cast<curl_off_t>(document.size()));
    curl_.easy_setopt(handle_, CURLOPT_POSTFIELDS, document.c_str());
    const CURLcode code = perform();
    Answer answer;
    if (code != CURLE_OK) {
      answer.text = error_[0] != '\0' ? error_ : curl_.easy_strerror(code);
      return answer;
    }
    curl_.easy_getinfo(handle_, CURLINFO_RESPONSE_CODE, &answer.status);
    curl_off_t wait_s = 0;
    curl_.easy_getinfo(handle_, CURLINFO_RETRY_AFTER, &wait_s);
    answer.wait = std::min(milliseconds(1000 * std::clamp<curl_off_t>(wait_s, 0, 3600)), kMaxDelay);
    answer.text = as_one_line(text_);
    return answer;
  }

 private:
  void allow_http_only() {
#if LIBCURL_VERSION_NUM >= 0x075500
    curl_.easy_setopt(handle_, CURLOPT_PROTOCOLS_STR, "http,https");
#else  // Ubuntu 22.04
    curl_.easy_setopt(handle_, CURLOPT_PROTOCOLS,
                      static_cast<long>(CURLPROTO_HTTP | CURLPROTO_HTTPS));
#endif
  }
  static std::size_t take(char* bytes, std::size_t one, std::size_t count, void* self) {
    std::string& text = static_cast<Connection*>(self)->text_;
    text.append(bytes, std::min(one * count, kMaxAnswer - std::min(text.size(), kMaxAnswer)));
    return one * count;
  }
  /// As curl_easy_perform(), which would check is_ending_ only once a second.
  CURLcode perform() {
    curl_.multi_add_handle(multi_, handle_);
    int under_way = 1;
    while (under_way > 0 && !is_ending_) {
      if (curl_.multi_perform(multi_, &under_way) != CURLM_OK) break;
      if (under_way > 0) {
        curl_.multi_poll(multi_, nullptr, 0, static_cast<int>(kLook.count()), nullptr);
      }
    }
    CURLcode code = CURLE_ABORTED_BY_CALLBACK;
    int others = 0;
    const CURLMsg* const message = curl_.multi_info_read(multi_, &others);
    if (message != nullptr && message->msg == CURLMSG_DONE) code = message->data.result;
    curl_.multi_remove_handle(multi_, handle_);
    return code;
  }

  const LibCurl& curl_ = libcurl();
  CURL* handle_;
  CURLM* multi_;
  const std::atomic<bool>& is_ending_;
  curl_slist* headers_ = nullptr;
  std::string text_;
  char error_[CURL_ERROR_SIZE] = {};  // NOLINT: as libcurl wants it.
};

}  // namespace

class CaptureClient::Impl {
 public:
  Impl(const std::string& url, CaptureOptions options)
      : options_(std::move(options)), name_(shown(url)) {
    require_url(url);
    for (const std::string& line : options_.headers) require_header(line);
    most_ = std::max<std::size_t>(1, options_.events_per_document);
    connection_ = std::make_unique<Connection>(url, options_, is_ending_);
    thread_ = std::thread([this] { serve(); });
  }
  ~Impl() { finish(milliseconds(0), {}); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void capture(const std::string& event) {
    const std::lock_guard lock(mutex_);
    ++counts_.taken;
    if (is_finished_) {
      ++counts_.lost;
      return;
    }
    waiting_.push_back(event);
    if (waiting_.size() + posted_ > options_.max_events) lose_oldest();
    changed_.notify_all();
  }

  void finish(milliseconds patience, const std::function<bool()>& gives_up) {
    std::unique_lock lock(mutex_);
    if (std::exchange(is_finished_, true)) return;
    changed_.notify_all();
    milliseconds silence(0);
    while (!(waiting_.empty() && posted_ == 0) && silence < patience && !(gives_up && gives_up())) {
      const std::uint64_t answers = answers_;
      const bool is_answered = changed_.wait_for(lock, kLook, [&] { return answers_ != answers; });
      silence = is_answered ? milliseconds(0) : silence + kLook;
    }
    const std::size_t left = waiting_.size() + posted_;
    is_ending_ = true;
    lock.unlock();
    changed_.notify_all();
    thread_.join();
    tell_the_end(left);
  }

  [[nodiscard]] CaptureCounts counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
  }

  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  void serve() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return is_ending_ || !waiting_.empty(); });
      if (is_ending_) return;
      const std::vector<std::string> events = next();
      lock.unlock();
      const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
      const std::string document = epcis_document(events, Time(since_1970));
      const Answer answer = connection_->post(document);
      lock.lock();
      posted_ = 0;
      if (is_ending_ && answer.status == 0) {
        give_back(events);
        return;
      }
      heed(answer, events, lock);
    }
  }

  std::vector<std::string> next() {
    const std::size_t count = std::min(most_, waiting_.size());
    const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(count);
    std::vector<std::string> events(std::make_move_iterator(waiting_.begin()),
                                    std::make_move_iterator(end));
    waiting_.erase(waiting_.begin(), end);
    posted_ = count;
    return events;
  }

  void give_back(const std::vector<std::string>& events) {
    waiting_.insert(waiting_.begin(), events.begin(), events.end());
  }

  void heed(const Answer& answer, const std::vector<std::string>& events,
            std::unique_lock<std::mutex>& lock) {
    if (is_success(answer)) {
      counts_.captured += events.size();
      if (std::exchange(was_away_, false)) warn("it accepts events again");
      delay_ = kMinDelay;
      said_something();
    } else if (answer.status == 413 && events.size() > 1) {
      most_ = std::max<std::size_t>(1, events.size() / 2);
      give_back(events);
      said_something();
    } else if (is_to_be_tried_again(answer)) {
      give_back(events);
      if (!std::exchange(was_away_, true)) warn(to_string(answer) + "; trying again");
      const milliseconds wait = answer.wait.count() > 0 ? answer.wait : delay_;
      changed_.wait_for(lock, wait, [this] { return is_ending_.load(); });
      delay_ = std::min(2 * delay_, kMaxDelay);
    } else {
      if (counts_.refused == 0) warn("refuses: " + to_string(answer));
      counts_.refused += events.size();
      said_something();
    }
  }

  void said_something() {
    ++answers_;
    changed_.notify_all();
  }

  /// The first loss is reported immediately, the total at the end.
  void lose_oldest() {
    if (counts_.lost == 0) {
      warn(fmt::format("the queue of {} events is full: the oldest are lost from now on",
                       options_.max_events));
    }
    waiting_.pop_front();
    ++counts_.lost;
  }

  void tell_the_end(std::size_t left) {
    const std::lock_guard lock(mutex_);
    left = std::min(left, waiting_.size());
    counts_.lost += waiting_.size();
    waiting_.clear();
    if (counts_.lost > 0) {
      warn(fmt::format("{} of {} events were lost{}", counts_.lost, counts_.taken,
                       left == 0 ? "" : fmt::format(", the last {} of them at the end", left)));
    }
    if (counts_.refused > 0) {
      warn(fmt::format("{} of {} events were refused", counts_.refused, counts_.taken));
    }
  }

  void warn(const std::string& line) const {
    if (options_.warn) options_.warn(fmt::format("EPCIS capture: {}: {}", name_, line));
  }

  CaptureOptions options_;
  std::string name_;
  std::unique_ptr<Connection> connection_;  ///< Used by the thread only.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> waiting_;
  std::size_t posted_ = 0;     ///< In progress.
  std::size_t most_ = 1;       ///< In the next document.
  std::uint64_t answers_ = 0;  ///< Conclusive ones.
  CaptureCounts counts_;
  bool was_away_ = false;
  bool is_finished_ = false;
  std::atomic<bool> is_ending_ = false;
  milliseconds delay_ = kMinDelay;
  std::thread thread_;
};

CaptureClient::CaptureClient(const std::string& url, const CaptureOptions& options)
    : impl_(std::make_unique<Impl>(url, options)) {}

CaptureClient::~CaptureClient() = default;

void CaptureClient::capture(const std::string& event) { impl_->capture(event); }

void CaptureClient::finish(std::chrono::milliseconds patience,
                           const std::function<bool()>& gives_up) {
  impl_->finish(patience, gives_up);
}

CaptureCounts CaptureClient::counts() const { return impl_->counts(); }

std::string CaptureClient::name() const { return impl_->name(); }

}  // namespace tagfield
