// SPDX-License-Identifier: Apache-2.0
#include "adapters/bags/ros2_sweep.h"

#include <fmt/format.h>

#include <memory>
#include <string_view>
#include <vector>

#include "adapters/bags/message_content.h"
#include "adapters/ros2/ros2_messages.h"
#include "adapters/rosbag2/recording_files.h"

namespace tagfield {
namespace {

using recorded::last_name;
using recorded::take_antenna_truth;
using recorded::take_odometry;
using recorded::take_reads;
using recorded::take_tag_positions;
using recorded::take_transforms;

constexpr std::size_t kMaxOpen = 16;

/// Processes the bytes of a topic's message.
using Take = std::function<void(std::string_view bytes, const MessageLocation& place,
                                BagContent& content, Diagnostics& diagnostics)>;

/// Decodes the bytes and passes on the message, which is reused for its memory.
template <class Message>
Take decoded_for(void (*take)(const Message&, const MessageLocation&, BagContent&, Diagnostics&)) {
  const auto message = std::make_shared<Message>();
  return [take, message](std::string_view bytes, const MessageLocation& place, BagContent& content,
                         Diagnostics& diagnostics) {
    if (!ros2::from_cdr(bytes, *message)) {
      fail_at(place, fmt::format("is not a {}: its {} bytes end too early",
                                 ros2::type_of(*message).name, bytes.size()));
    }
    take(*message, place, content, diagnostics);
  };
}

constexpr std::string_view kEncoding = "cdr";
constexpr std::string_view kReadsType = "tagfield_msgs/msg/TagReads";

bool ends_in(const std::string& text, std::string_view end) {
  return text.size() >= end.size() &&
         std::string_view(text).substr(text.size() - end.size()) == end;
}

/// How the messages of a topic are processed; null for ignored topics.
Take take_of(const RecordedTopic& topic) {
  if (topic.encoding != kEncoding) return nullptr;
  const std::string& type = topic.type;
  const std::string name = last_name(topic.name);
  if (type == kReadsType) return decoded_for(&take_reads<ros2::tagfield_msgs::TagReads>);
  if (type == "tagfield_msgs/msg/AntennaTruth") {
    return decoded_for(&take_antenna_truth<ros2::tagfield_msgs::AntennaTruth>);
  }
  if (type == "tagfield_msgs/msg/TagPositions") {
    return decoded_for(&take_tag_positions<ros2::tagfield_msgs::TagPositions>);
  }
  if (type == "nav_msgs/msg/Odometry" && ends_in(topic.name, "ground_truth/odom")) {
    return decoded_for(&take_odometry<ros2::nav_msgs::Odometry>);
  }
  const bool is_tf = type == "tf2_msgs/msg/TFMessage" && (name == "tf" || name == "tf_static");
  if (!is_tf) return nullptr;
  return decoded_for(&take_transforms<ros2::tf2_msgs::TFMessage>);
}

/// Reads one file after the other.
class Ros2Sweep {
 public:
  Ros2Sweep(const BagReadSink& sink, Diagnostics& diagnostics)
      : diagnostics_(diagnostics), content_(sink) {}

  void take_file(const std::string& path, RecordedFile& file,
                 const std::function<void(double)>& on_progress) {
    std::vector<Take> takes;
    std::vector<char> wanted;
    std::vector<MessageLocation> places;
    for (const RecordedTopic& topic : file.topics()) {
      takes.push_back(take_of(topic));
      wanted.push_back(takes.back() ? 1 : 0);
      places.push_back({path, topic.name, 0});
      if (topic.type == kReadsType) take_note(topic);
    }
    const auto take = [&](std::size_t topic, std::string_view bytes, double share) {
      ++places[topic].number;
      has_reads_ = has_reads_ || file.topics()[topic].type == kReadsType;
      takes[topic](bytes, places[topic], content_, diagnostics_);
      content_.forget_unwanted();
      on_progress(share);
    };
    file.read(wanted, take, diagnostics_);
  }
  [[nodiscard]] bool has_reads() const { return has_reads_; }
  [[nodiscard]] const std::string& why_without_reads() const { return why_without_reads_; }
  [[nodiscard]] BagContent content() { return std::move(content_); }

 private:
  /// Of a topic of reads that may turn out to have none.
  void take_note(const RecordedTopic& topic) {
    why_without_reads_ = topic.encoding == kEncoding
                             ? fmt::format("there are no messages on {}", topic.name)
                             : fmt::format("{} is encoded as '{}', expected '{}'", topic.name,
                                           topic.encoding, kEncoding);
  }

  Diagnostics& diagnostics_;
  BagContent content_;
  bool has_reads_ = false;  ///< Messages with them, even if no tag was read.
  std::string why_without_reads_ = fmt::format("no topic of type {}", kReadsType);
};

}  // namespace

Ros2Files::Ros2Files(const std::string& path, Diagnostics& diagnostics)
    : path_(path), files_(files_of_recording(path, diagnostics)), open_(files_.size()) {}

std::shared_ptr<RecordedFile> Ros2Files::open(std::size_t index, Diagnostics& diagnostics) {
  if (open_[index] != nullptr) return open_[index];
  std::shared_ptr<RecordedFile> file = open_recorded_file(files_[index], diagnostics);
  if (files_.size() <= kMaxOpen) open_[index] = file;
  return file;
}

BagContent sweep_ros2(Ros2Files& files, const BagReadSink& sink,
                      const std::function<void(double share)>& on_progress,
                      Diagnostics& diagnostics) {
  Ros2Sweep sweep(sink, diagnostics);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::shared_ptr<RecordedFile> file = files.open(i, diagnostics);
    sweep.take_file(files.path(i), *file, [&](double share) {
      const double done = static_cast<double>(i) + share;
      if (on_progress) on_progress(done / static_cast<double>(files.size()));
    });
  }
  if (!sweep.has_reads()) {
    fail({files.path(), 0}, "has no reads: " + sweep.why_without_reads());
  }
  return sweep.content();
}

}  // namespace tagfield
