// SPDX-License-Identifier: Apache-2.0
#include "adapters/mqtt/mqtt_client.h"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

#include "adapters/mqtt/libmosquitto.h"
#include "tagfield/base/error.h"

namespace tagfield {
namespace {

constexpr int kQos = 1;
constexpr int kKeepalive_s = 20;
constexpr std::chrono::seconds kMinDelay(1);
constexpr std::chrono::seconds kMaxDelay(30);
constexpr int kLoop_ms = 100;
/// Time limit for disconnecting.
constexpr std::chrono::milliseconds kGoodbye(300);
/// Messages held by libmosquitto until the broker has acknowledged them; all others wait here.
constexpr std::size_t kMaxHanded = 200;

void init_library() {
  static const int once = libmosquitto().lib_init();
  (void)once;
}

struct Message {
  std::string topic;
  std::string payload;
};

}  // namespace

class MqttClient::Impl {
 public:
  Impl(const MqttUrl& url, MqttOptions options)
      : options_(std::move(options)), name_(broker_name(url)) {
    init_library();
    client_ = libmosquitto().new_(nullptr, true, this);
    if (client_ == nullptr) throw Error("MQTT: there is not enough memory");
    try {
      set_up(url);
      connect(url);
    } catch (...) {
      libmosquitto().destroy(client_);
      throw;
    }
  }

  ~Impl() {
    finish(options_.patience);
    libmosquitto().destroy(client_);
  }

  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void publish(Message message) {
    const std::lock_guard lock(mutex_);
    ++counts_.taken;
    if (is_finished_) {
      ++counts_.lost;
      return;
    }
    waiting_.push_back(std::move(message));
    if (waiting_.size() + handed_ > options_.max_messages) {
      waiting_.pop_front();
      lose(1);
    }
    hand_over();
  }

  void finish(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    if (std::exchange(is_finished_, true)) return;
    std::size_t delivered = counts_.delivered;
    const auto is_done = [this] { return waiting_.empty() && handed_ == 0; };
    while (!is_done()) {
      changed_.wait_for(lock, patience,
                        [&] { return is_done() || counts_.delivered != delivered; });
      if (!is_done() && counts_.delivered == delivered) break;
      delivered = counts_.delivered;
    }
    const std::size_t left = waiting_.size() + handed_;
    waiting_.clear();
    counts_.lost += left;
    is_ending_ = true;
    lock.unlock();
    changed_.notify_all();
    thread_.join();
    if (counts_.lost > 0) {
      warn(fmt::format("{} of {} messages were lost{}", counts_.lost, counts_.taken,
                       left == 0 ? "" : fmt::format(", the last {} of them at the end", left)));
    }
  }

  [[nodiscard]] MqttCounts counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
  }

 private:
  void set_up(const MqttUrl& url) {
    if (!url.user.empty()) {
      require(libmosquitto().username_pw_set(
          client_, url.user.c_str(), url.password.empty() ? nullptr : url.password.c_str()));
    }
    if (url.has_tls) require(libmosquitto().int_option(client_, MOSQ_OPT_TLS_USE_OS_CERTS, 1));
    require(libmosquitto().max_inflight_messages_set(client_, static_cast<unsigned>(kMaxHanded)));
    require(libmosquitto().threaded_set(client_, true));
    libmosquitto().connect_callback_set(client_, [](mosquitto*, void* self, int code) {
      static_cast<Impl*>(self)->on_connect(code);
    });
    libmosquitto().disconnect_callback_set(client_, [](mosquitto*, void* self, int code) {
      static_cast<Impl*>(self)->on_disconnect(code);
    });
    libmosquitto().publish_callback_set(client_, [](mosquitto*, void* self, int /*message*/) {
      static_cast<Impl*>(self)->on_acknowledged();
    });
  }

  void connect(const MqttUrl& url) {
    const int code =
        libmosquitto().connect_async(client_, url.host.c_str(), url.port, kKeepalive_s);
    if (code == MOSQ_ERR_EAI) throw Error(fmt::format("MQTT: the host '{}' is unknown", url.host));
    if (code == MOSQ_ERR_INVAL) require(code);
    // Any other error: the connection will be retried.
    thread_ = std::thread([this] { serve(); });
  }

  /// libmosquitto's own thread gives up if the first attempt fails.
  void serve() {
    while (libmosquitto().loop(client_, kLoop_ms, 1) == MOSQ_ERR_SUCCESS || wait_to_reconnect()) {
      const std::lock_guard lock(mutex_);
      if (is_ending_) break;
    }
    libmosquitto().disconnect(client_);
    const auto end = std::chrono::steady_clock::now() + kGoodbye;
    while (std::chrono::steady_clock::now() < end &&
           libmosquitto().loop(client_, kLoop_ms, 1) == MOSQ_ERR_SUCCESS) {
    }
  }

  /// Reconnects after a delay; false if the client is to end.
  bool wait_to_reconnect() {
    std::unique_lock lock(mutex_);
    if (!std::exchange(was_away_, true)) warn("the broker can't be reached; trying again");
    const bool ends = changed_.wait_for(lock, delay_, [this] { return is_ending_; });
    delay_ = std::min(2 * delay_, kMaxDelay);
    lock.unlock();
    if (!ends) libmosquitto().reconnect_async(client_);
    return !ends;
  }

  void require(int code) const {
    if (code != MOSQ_ERR_SUCCESS) {
      throw Error(fmt::format("MQTT: {}: {}", name_, libmosquitto().strerror(code)));
    }
  }

  void on_connect(int code) {
    const std::lock_guard lock(mutex_);
    is_connected_ = code == 0;
    if (code != 0) {
      warn(fmt::format("the broker refuses the connection: {}",
                       libmosquitto().connack_string(code)));
      return;
    }
    if (std::exchange(was_away_, false)) warn("connected");
    delay_ = kMinDelay;
    hand_over();
  }

  void on_disconnect(int code) {
    const std::lock_guard lock(mutex_);
    if (std::exchange(is_connected_, false) && code != 0) {
      was_away_ = true;
      warn("the connection is broken; trying again");
    }
  }

  void on_acknowledged() {
    const std::lock_guard lock(mutex_);
    --handed_;
    ++counts_.delivered;
    hand_over();
    changed_.notify_all();
  }

  /// Passes messages to libmosquitto up to the limit, which only queues them: its thread sends.
  void hand_over() {
    while (is_connected_ && handed_ < kMaxHanded && !waiting_.empty()) {
      const Message message = std::move(waiting_.front());
      waiting_.pop_front();
      const int code = libmosquitto().publish(client_, nullptr, message.topic.c_str(),
                                              static_cast<int>(message.payload.size()),
                                              message.payload.data(), kQos, false);
      // Without a connection the message is also kept, and sent after the next one is made.
      if (code == MOSQ_ERR_SUCCESS || code == MOSQ_ERR_NO_CONN || code == MOSQ_ERR_CONN_LOST) {
        ++handed_;
      } else {
        lose(1);
      }
    }
  }

  /// The first loss is reported immediately, the total at the end.
  void lose(std::size_t count) {
    if (counts_.lost == 0) {
      warn(fmt::format("the queue of {} messages is full: the oldest are lost from now on",
                       options_.max_messages));
    }
    counts_.lost += count;
  }

  void warn(const std::string& line) const {
    if (options_.warn) options_.warn(fmt::format("MQTT: {}: {}", name_, line));
  }

  MqttOptions options_;
  std::string name_;
  mosquitto* client_ = nullptr;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Message> waiting_;
  std::size_t handed_ = 0;  ///< Passed to libmosquitto but not acknowledged.
  MqttCounts counts_;
  bool is_connected_ = false;
  bool was_away_ = false;
  bool is_finished_ = false;
  bool is_ending_ = false;
  std::chrono::seconds delay_ = kMinDelay;
  std::thread thread_;
};

MqttClient::MqttClient(const MqttUrl& url, const MqttOptions& options)
    : impl_(std::make_unique<Impl>(url, options)) {}

MqttClient::~MqttClient() = default;

void MqttClient::publish(const std::string& topic, const std::string& payload) {
  impl_->publish({topic, payload});
}

void MqttClient::finish(std::chrono::milliseconds patience) { impl_->finish(patience); }

MqttCounts MqttClient::counts() const { return impl_->counts(); }

}  // namespace tagfield
