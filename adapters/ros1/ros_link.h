// SPDX-License-Identifier: Apache-2.0
/// @file
/// This process' link to the ROS 1 master, from inside a program that must go on without one.
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

/// Simulated time as ROS says it. Throws Error if it is negative or beyond 2106, which ros::Time
/// can't express.
ros::Time to_ros(Time time);
Time from_ros(const ros::Time& time);

/// Whether this process' node publishes `topic` (any resolvable name) already, by whomever.
bool advertised_here(const std::string& name_space, const std::string& topic);

/// One topic of a RosLink.
class RosEndpoint {
 public:
  RosEndpoint() = default;
  virtual ~RosEndpoint() = default;
  RosEndpoint(const RosEndpoint&) = delete;
  RosEndpoint& operator=(const RosEndpoint&) = delete;
  /// Called by RosLink with a master there: for the first time, or again for a new master.
  virtual void connect() = 0;
};

struct RosTopic {
  std::string name_space;  ///< "" for the process' own.
  std::string name;        ///< Relative or absolute; private ones ("~x") by the name space.
  std::uint32_t queue = 1000;
  bool latched = false;
  /// To stay silent if this process' node publishes the topic already.
  bool alone = false;
};

/// Tells a new master that this process publishes `topic`, without disturbing whom it is connected
/// to already.
void register_publisher_again(const ros::Publisher& publisher, const std::string& data_type);

/// A topic to publish on. Messages are dropped while there never was a master.
template <class Message>
class RosPublisher final : public RosEndpoint {
 public:
  explicit RosPublisher(RosTopic topic) : topic_(std::move(topic)) {}

  void publish(const Message& message) {
    const std::lock_guard lock(mutex_);
    if (topic_.latched) latest_ = message;
    if (publisher_) publisher_.publish(message);
  }
  /// Whether anybody listens, so that a large message is worth making.
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

/// A topic to hear. The callback runs on the link's own thread.
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

/// Looks after the master on a thread of its own: topics open when one appears, and open anew when
/// another takes its place. Nothing but that thread waits for a master, the first look excepted,
/// and nothing ends the process. Initializes ROS as node "gazebo" unless somebody else (gazebo_ros)
/// did.
class RosLink {
 public:
  /// The process' link: ROS has one node in a process, so there is one link, which lives as long as
  /// anybody holds it. Waits up to a second for the first look at the master. Never throws: where
  /// ROS can't be initialized or a thread can't be started, `fault()` says why and all publishing
  /// is void.
  static std::shared_ptr<RosLink> shared();
  ~RosLink();
  RosLink(const RosLink&) = delete;
  RosLink& operator=(const RosLink&) = delete;

  /// Why there will be no ROS at all, or "".
  [[nodiscard]] const std::string& fault() const { return fault_; }
  /// Whether a master answered at the last look.
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

  /// Tells simulated time; to be called in each step, by any number of callers. Publishes /clock at
  /// 100 Hz of simulated time and sets /use_sim_time, unless somebody else in this process does.
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
  bool looked_ = false;  ///< At the master, at least once.
  std::vector<std::weak_ptr<RosEndpoint>> endpoints_;
  std::vector<std::weak_ptr<RosEndpoint>> fresh_;  ///< Not connected yet.

  ros::CallbackQueue callbacks_;
  std::unique_ptr<Clock> clock_;
  // Not std::jthread, which those who include this as C++17 don't know.
  std::thread watcher_;
  std::thread hearer_;
};

}  // namespace tagfield
