// SPDX-License-Identifier: Apache-2.0
/// @file
/// This process' connection to the ROS 1 master, for programs that must keep running without one.
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tagfield/base/time.h"

namespace tagfield {

/// Simulated time as ROS time. Throws Error if it is negative or after 2106, which ros::Time can't
/// express.
ros::Time to_ros(Time time);
Time from_ros(const ros::Time& time);

/// Whether this process' node already publishes `topic` (any resolvable name), through any code.
bool advertised_here(const std::string& name_space, const std::string& topic);

/// One topic of a RosLink.
class RosEndpoint {
 public:
  RosEndpoint() = default;
  virtual ~RosEndpoint() = default;
  RosEndpoint(const RosEndpoint&) = delete;
  RosEndpoint& operator=(const RosEndpoint&) = delete;
  /// Called by RosLink when a master is available: for the first time, or again for a new master.
  virtual void connect() = 0;
};

struct RosTopic {
  std::string name_space;  ///< "" for the process' own.
  std::string name;        ///< Relative or absolute; private ones ("~x") through the namespace.
  std::uint32_t queue = 1000;
  bool latched = false;
  /// Publish nothing if this process' node publishes the topic already.
  bool alone = false;
};

/// Registers this process as publisher of `topic` with a new master, without disturbing existing
/// connections.
void register_publisher_again(const ros::Publisher& publisher, const std::string& data_type);

/// A published topic. Messages are dropped until there is a master for the first time.
template <class Message>
class RosPublisher final : public RosEndpoint {
 public:
  explicit RosPublisher(RosTopic topic) : topic_(std::move(topic)) {}

  void publish(const Message& message) {
    const std::lock_guard lock(mutex_);
    if (topic_.latched) latest_ = message;
    if (publisher_) publisher_.publish(message);
  }
  /// Whether there are subscribers, so that a large message is worth generating.
  [[nodiscard]] bool is_heard() const {
    const std::lock_guard lock(mutex_);
    return publisher_ && publisher_.getNumSubscribers() > 0;
  }

  void connect() override {
    const ros::Publisher known = publisher();
    if (known) {
      register_publisher_again(known, ros::message_traits::datatype<Message>());
      return;
    }
    if (topic_.alone && advertised_here(topic_.name_space, topic_.name)) return;
    ros::NodeHandle node(topic_.name_space);
    ros::Publisher fresh = node.advertise<Message>(topic_.name, topic_.queue, topic_.latched);
    const std::lock_guard lock(mutex_);
    publisher_ = fresh;
    if (latest_ && publisher_) publisher_.publish(*latest_);
  }

 private:
  [[nodiscard]] ros::Publisher publisher() const {
    const std::lock_guard lock(mutex_);
    return publisher_;
  }

  RosTopic topic_;
  mutable std::mutex mutex_;
  ros::Publisher publisher_;
  std::optional<Message> latest_;  ///< Of a latched topic.
};

/// A subscribed topic. The callback runs on the link's own thread.
template <class Message>
class RosSubscriber final : public RosEndpoint {
 public:
  using Callback = std::function<void(const Message&)>;
  RosSubscriber(RosTopic topic, Callback callback, ros::CallbackQueue& queue)
      : topic_(std::move(topic)), callback_(std::move(callback)), queue_(queue) {}
  ~RosSubscriber() override { subscriber_.shutdown(); }

  void connect() override {
    subscriber_.shutdown();
    ros::NodeHandle node(topic_.name_space);
    node.setCallbackQueue(&queue_);
    const auto hear = [callback = callback_](const boost::shared_ptr<const Message>& message) {
      callback(*message);
    };
    subscriber_ = node.subscribe<Message>(topic_.name, topic_.queue, hear);
  }

 private:
  RosTopic topic_;
  Callback callback_;
  ros::CallbackQueue& queue_;
  ros::Subscriber subscriber_;
};

/// Watches the master on a separate thread: opens topics when one appears, and opens them again
/// when another replaces it. Except for the first check, only that thread waits for a master, and
/// nothing ends the process. Initializes ROS as node "gazebo" unless someone else (gazebo_ros) has
/// done so.
class RosLink {
 public:
  /// The process' link: ROS has one node per process, so there is one link, which lives as long as
  /// there are references to it. Waits up to a second for the first check of the master. Never
  /// throws: if ROS can't be initialized or a thread can't be started, `fault()` states why and
  /// publishing has no effect.
  static std::shared_ptr<RosLink> shared();
  ~RosLink();
  RosLink(const RosLink&) = delete;
  RosLink& operator=(const RosLink&) = delete;

  /// Why ROS is unavailable, or "".
  [[nodiscard]] const std::string& fault() const { return fault_; }
  /// Whether a master answered at the last check.
  [[nodiscard]] bool connected() const { return connected_; }

  template <class Message>
  std::shared_ptr<RosPublisher<Message>> advertise(RosTopic topic) {
    const auto endpoint = std::make_shared<RosPublisher<Message>>(std::move(topic));
    add(endpoint);
    return endpoint;
  }
  template <class Message>
  std::shared_ptr<RosSubscriber<Message>> subscribe(
      RosTopic topic, typename RosSubscriber<Message>::Callback callback) {
    const auto endpoint =
        std::make_shared<RosSubscriber<Message>>(std::move(topic), std::move(callback), callbacks_);
    add(endpoint);
    return endpoint;
  }

  /// Sets simulated time; to be called in each step, by any number of callers. Publishes /clock at
  /// 100 Hz of simulated time and sets /use_sim_time, unless other code in this process does.
  void advance_clock(Time now);

 private:
  class Clock;

  RosLink();
  void initialize();
  void add(const std::shared_ptr<RosEndpoint>& endpoint);
  void watch_master();
  void look_at_master();
  void connect_all();
  void hear();
  bool wait(std::chrono::milliseconds time);
  void end_threads();

  std::string fault_;
  std::atomic<bool> connected_{false};
  std::int64_t master_ = 0;  ///< Process ID of the master that knows our topics; 0 for none.

  std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;
  bool looked_ = false;  ///< The master was checked at least once.
  std::vector<std::weak_ptr<RosEndpoint>> endpoints_;
  std::vector<std::weak_ptr<RosEndpoint>> fresh_;  ///< Not connected yet.

  ros::CallbackQueue callbacks_;
  std::unique_ptr<Clock> clock_;
  // Not std::jthread, as this header is included by C++17 code.
  std::thread watcher_;
  std::thread hearer_;
};

}  // namespace tagfield
