// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros1/ros_link.h"

#include <fmt/format.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

constexpr std::chrono::milliseconds kLookInterval{500};
constexpr std::chrono::milliseconds kFirstLook{1000};
constexpr double kRetrySeconds = 1.0;
constexpr std::int64_t kNanoseconds = 1'000'000'000;

/// Process ID of the master, 0 if none answers.
std::int64_t master_process() {
  XmlRpc::XmlRpcValue arguments;
  XmlRpc::XmlRpcValue result;
  XmlRpc::XmlRpcValue payload;
  arguments[0] = ros::this_node::getName();
  if (!ros::master::execute("getPid", arguments, result, payload, false)) return 0;
  return payload.getType() == XmlRpc::XmlRpcValue::TypeInt ? static_cast<int>(payload) : -1;
}

/// roscpp aborts the process on an address that it can't parse.
std::string fault_of_master_address() {
  const char* const given = std::getenv("ROS_MASTER_URI");
  if (given == nullptr) return "";
  std::string host;
  std::uint32_t port = 0;
  if (ros::network::splitURI(given, host, port)) return "";
  return fmt::format("ROS_MASTER_URI is '{}', expected http://HOST:PORT", given);
}

}  // namespace

ros::Time to_ros(Time time) {
  const std::int64_t count = time.time_since_epoch().count();
  if (count < 0 || count / kNanoseconds > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(fmt::format("time {} s can't be represented in ROS", format_stamp(time)));
  }
  return {static_cast<std::uint32_t>(count / kNanoseconds),
          static_cast<std::uint32_t>(count % kNanoseconds)};
}

Time from_ros(const ros::Time& time) {
  return Time(Duration(static_cast<std::int64_t>(time.sec) * kNanoseconds + time.nsec));
}

bool advertised_here(const std::string& name_space, const std::string& topic) {
  ros::V_string topics;
  ros::this_node::getAdvertisedTopics(topics);
  const std::string name = ros::NodeHandle(name_space).resolveName(topic);
  return std::find(topics.begin(), topics.end(), name) != topics.end();
}

void register_publisher_again(const ros::Publisher& publisher, const std::string& data_type) {
  XmlRpc::XmlRpcValue arguments;
  XmlRpc::XmlRpcValue result;
  XmlRpc::XmlRpcValue payload;
  arguments[0] = ros::this_node::getName();
  arguments[1] = publisher.getTopic();
  arguments[2] = data_type;
  arguments[3] = ros::XMLRPCManager::instance()->getServerURI();
  ros::master::execute("registerPublisher", arguments, result, payload, false);
}

/// /clock, if no other code in this process publishes it.
class RosLink::Clock {
 public:
  /// Called when a master is available.
  void connect() {
    if (!decided_) {
      alone_ = !advertised_here("", "/clock");
      decided_ = true;
      if (alone_) {
        topic_ = std::make_shared<RosPublisher<rosgraph_msgs::Clock>>(
            RosTopic{"", "/clock", 10, false, false});
      }
    }
    if (!alone_) return;
    ros::param::set("/use_sim_time", true);
    topic_->connect();
    const std::lock_guard lock(mutex_);
    open_ = topic_;
  }

  void advance(Time now) {
    const std::lock_guard lock(mutex_);
    if (!open_ || (now >= published_ && now < published_ + kInterval)) return;
    published_ = now;
    rosgraph_msgs::Clock message;
    message.clock = to_ros(now);
    open_->publish(message);
  }

 private:
  static constexpr Duration kInterval = std::chrono::milliseconds(10);

  bool decided_ = false;
  bool alone_ = false;
  std::shared_ptr<RosPublisher<rosgraph_msgs::Clock>> topic_;
  std::mutex mutex_;
  Time published_ = Time::min();
  std::shared_ptr<RosPublisher<rosgraph_msgs::Clock>> open_;
};

std::shared_ptr<RosLink> RosLink::shared() {
  // ROS has one node per process for all its users, hence one link. It is not kept longer than its
  // users.
  static std::mutex mutex;
  static std::weak_ptr<RosLink> known;
  const std::lock_guard lock(mutex);
  std::shared_ptr<RosLink> link = known.lock();
  if (!link) {
    link = std::shared_ptr<RosLink>(new RosLink);
    known = link;
  }
  return link;
}

RosLink::RosLink() : clock_(std::make_unique<Clock>()) {
  try {
    initialize();
    if (!fault_.empty()) return;
    watcher_ = std::thread([this] { watch_master(); });
    hearer_ = std::thread([this] { hear(); });
  } catch (const std::exception& error) {
    end_threads();
    fault_ = error.what();
    return;
  }
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kFirstLook, [this] { return looked_; });
}

// ROS itself keeps running: it can't be started twice in a process, and another plugin may need it.
RosLink::~RosLink() { end_threads(); }

void RosLink::end_threads() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  if (watcher_.joinable()) watcher_.join();
  if (hearer_.joinable()) hearer_.join();
}

void RosLink::initialize() {
  if (ros::isInitialized()) return;
  fault_ = fault_of_master_address();
  if (!fault_.empty()) return;
  setenv("ROS_MASTER_URI", "http://localhost:11311", 0);
  // SIGINT is handled by Gazebo.
  ros::init(ros::M_string{}, "gazebo", ros::init_options::NoSigintHandler);
  ros::master::setRetryTimeout(ros::WallDuration(kRetrySeconds));
}

void RosLink::add(const std::shared_ptr<RosEndpoint>& endpoint) {
  if (!fault_.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    fresh_.push_back(endpoint);
  }
  changed_.notify_all();
}

bool RosLink::wait(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, time, [this] { return stop_ || (connected_ && !fresh_.empty()); });
  return !stop_;
}

void RosLink::watch_master() {
  do {
    try {
      look_at_master();
    } catch (const std::exception& error) {
      ROS_ERROR("Tagfield: %s", error.what());
    }
    {
      const std::lock_guard lock(mutex_);
      looked_ = true;
    }
    changed_.notify_all();
  } while (wait(kLookInterval));
}

void RosLink::look_at_master() {
  const std::int64_t master = master_process();
  connected_ = master != 0;
  if (!connected_) {
    // The next master to answer has no registrations of ours, even if it has the same process ID.
    master_ = 0;
    return;
  }
  if (!ros::isStarted()) ros::start();
  if (master != master_) {
    const std::lock_guard lock(mutex_);
    fresh_.insert(fresh_.end(), endpoints_.begin(), endpoints_.end());
    endpoints_.clear();
  }
  if (master != master_) clock_->connect();
  master_ = master;
  connect_all();
}

void RosLink::connect_all() {
  std::vector<std::weak_ptr<RosEndpoint>> fresh;
  {
    const std::lock_guard lock(mutex_);
    fresh.swap(fresh_);
    endpoints_.erase(std::remove_if(endpoints_.begin(), endpoints_.end(),
                                    [](const auto& endpoint) { return endpoint.expired(); }),
                     endpoints_.end());
    endpoints_.insert(endpoints_.end(), fresh.begin(), fresh.end());
  }
  for (const std::weak_ptr<RosEndpoint>& endpoint : fresh) {
    const auto held = endpoint.lock();
    if (!held) continue;
    try {
      held->connect();
    } catch (const std::exception& error) {
      // A topic that can't be opened must not affect the others.
      ROS_ERROR("Tagfield: %s", error.what());
    }
  }
}

void RosLink::hear() {
  while (true) {
    {
      const std::lock_guard lock(mutex_);
      if (stop_) return;
    }
    callbacks_.callAvailable(ros::WallDuration(0.1));
  }
}

void RosLink::advance_clock(Time now) {
  if (fault_.empty()) clock_->advance(now);
}

}  // namespace tagfield
