// SPDX-License-Identifier: Apache-2.0
// In C++17, as all that includes messages of ROS 1: what is read here goes the same way as theirs.
#include "adapters/ros1/ros2_sweep.h"

#include <fmt/format.h>

#include <memory>
#include <string_view>
#include <vector>

#include "adapters/ros1/bag_messages.h"
#include "adapters/ros2/ros2_messages.h"
#include "adapters/rosbag2/recording_files.h"

namespace tagfield {
namespace {

ros::Time time_of(const ros2::builtin_interfaces::Time& stamp, const MessagePlace& place) {
  if (stamp.sec < 0) fail_at(place, fmt::format("stamp is {} s, expected 0 or more", stamp.sec));
  ros::Time time;
  time.sec = static_cast<std::uint32_t>(stamp.sec);
  time.nsec = stamp.nanosec;
  return time;
}

std_msgs::Header header_of(const ros2::std_msgs::Header& from, const MessagePlace& place) {
  std_msgs::Header header;
  header.stamp = time_of(from.stamp, place);
  header.frame_id = from.frame_id;
  return header;
}

template <class To, class From>
void copy_xyz(const From& from, To& to) {
  to.x = from.x;
  to.y = from.y;
  to.z = from.z;
}

void copy_rotation(const ros2::geometry_msgs::Quaternion& from, geometry_msgs::Quaternion& to) {
  copy_xyz(from, to);
  to.w = from.w;
}

void copy_pose(const ros2::geometry_msgs::Pose& from, geometry_msgs::Pose& to) {
  copy_xyz(from.position, to.position);
  copy_rotation(from.orientation, to.orientation);
}

// What of each message counts, as one of ROS 1.

tagfield_msgs::TagReads ros1_of(const ros2::tagfield_msgs::TagReads& from,
                                const MessagePlace& place) {
  tagfield_msgs::TagReads message;
  message.header = header_of(from.header, place);
  message.antenna = from.antenna;
  for (const ros2::tagfield_msgs::TagRead& one : from.reads) {
    tagfield_msgs::TagRead read;
    read.header = header_of(one.header, place);
    read.epc = one.epc;
    read.reader = one.reader;
    read.antenna = one.antenna;
    read.frequency = one.frequency;
    read.phase = one.phase;
    read.rssi = one.rssi;
    read.doppler = one.doppler;
    message.reads.push_back(std::move(read));
  }
  return message;
}

tagfield_msgs::AntennaTruth ros1_of(const ros2::tagfield_msgs::AntennaTruth& from,
                                    const MessagePlace& place) {
  tagfield_msgs::AntennaTruth message;
  message.header = header_of(from.header, place);
  message.antenna = from.antenna;
  copy_pose(from.pose, message.pose);
  message.epcs = from.epcs;
  message.distances = from.distances;
  return message;
}

tagfield_msgs::TagPositions ros1_of(const ros2::tagfield_msgs::TagPositions& from,
                                    const MessagePlace& place) {
  tagfield_msgs::TagPositions message;
  message.header = header_of(from.header, place);
  for (const ros2::tagfield_msgs::TagPosition& one : from.tags) {
    tagfield_msgs::TagPosition tag;
    tag.epc = one.epc;
    copy_xyz(one.position, tag.position);
    message.tags.push_back(std::move(tag));
  }
  return message;
}

tf2_msgs::TFMessage ros1_of(const ros2::tf2_msgs::TFMessage& from, const MessagePlace& place) {
  tf2_msgs::TFMessage message;
  for (const ros2::geometry_msgs::TransformStamped& one : from.transforms) {
    geometry_msgs::TransformStamped transform;
    transform.header = header_of(one.header, place);
    transform.child_frame_id = one.child_frame_id;
    copy_xyz(one.transform.translation, transform.transform.translation);
    copy_rotation(one.transform.rotation, transform.transform.rotation);
    message.transforms.push_back(std::move(transform));
  }
  return message;
}

nav_msgs::Odometry ros1_of(const ros2::nav_msgs::Odometry& from, const MessagePlace& place) {
  nav_msgs::Odometry message;
  message.header = header_of(from.header, place);
  copy_pose(from.pose.pose, message.pose.pose);
  return message;
}

using Take = void (*)(std::string_view bytes, const MessagePlace& place, BagContent& content,
                      Diagnostics& diagnostics);

template <class Message>
void take_as(std::string_view bytes, const MessagePlace& place, BagContent& content,
             Diagnostics& diagnostics) {
  Message message;
  if (!ros2::from_cdr(bytes, message)) {
    fail_at(place, fmt::format("is no {}: its {} bytes end too early", ros2::type_of(message).name,
                               bytes.size()));
  }
  take(ros1_of(message, place), place, content, diagnostics);
}

bool ends_in(const std::string& text, std::string_view end) {
  return text.size() >= end.size() &&
         std::string_view(text).substr(text.size() - end.size()) == end;
}

/// How the messages of a topic are taken; null for those that are not looked at.
Take take_of(const RecordedTopic& topic) {
  if (topic.encoding != "cdr") return nullptr;
  const std::string& type = topic.type;
  const std::string name = last_name(topic.name);
  if (type == "tagfield_msgs/msg/TagReads") return take_as<ros2::tagfield_msgs::TagReads>;
  if (type == "tagfield_msgs/msg/AntennaTruth") return take_as<ros2::tagfield_msgs::AntennaTruth>;
  if (type == "tagfield_msgs/msg/TagPositions") return take_as<ros2::tagfield_msgs::TagPositions>;
  if (type == "nav_msgs/msg/Odometry" && ends_in(topic.name, "ground_truth/odom")) {
    return take_as<ros2::nav_msgs::Odometry>;
  }
  const bool is_tf = type == "tf2_msgs/msg/TFMessage" && (name == "tf" || name == "tf_static");
  return is_tf ? take_as<ros2::tf2_msgs::TFMessage> : nullptr;
}

/// Goes through one file after another.
class Ros2Sweep {
 public:
  explicit Ros2Sweep(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void take_file(const std::string& path, const std::function<void(double)>& on_progress) {
    const std::unique_ptr<RecordedFile> file = open_recorded_file(path, diagnostics_);
    std::vector<Take> takes;
    for (const RecordedTopic& topic : file->topics()) {
      takes.push_back(take_of(topic));
      has_reads_ = has_reads_ || takes.back() == &take_as<ros2::tagfield_msgs::TagReads>;
    }
    std::vector<std::size_t> numbers(takes.size(), 0);
    file->read([&](std::size_t topic, std::string_view bytes, double share) {
      const MessagePlace place{path, file->topics()[topic].name, ++numbers[topic]};
      if (takes[topic] != nullptr) takes[topic](bytes, place, content_, diagnostics_);
      on_progress(share);
    });
  }
  [[nodiscard]] bool has_reads() const { return has_reads_; }
  [[nodiscard]] BagContent content() { return std::move(content_); }

 private:
  Diagnostics& diagnostics_;
  BagContent content_;
  bool has_reads_ = false;
};

}  // namespace

BagContent sweep_ros2(const std::string& path, const std::function<void(double share)>& on_progress,
                      Diagnostics& diagnostics) {
  const std::vector<std::string> files = files_of_recording(path, diagnostics);
  Ros2Sweep sweep(diagnostics);
  for (std::size_t i = 0; i < files.size(); ++i) {
    sweep.take_file(files[i], [&](double share) {
      const double done = static_cast<double>(i) + share;
      if (on_progress) on_progress(done / static_cast<double>(files.size()));
    });
  }
  if (!sweep.has_reads()) {
    fail({path, 0}, "has no reads: no topic of type tagfield_msgs/msg/TagReads");
  }
  return sweep.content();
}

}  // namespace tagfield
