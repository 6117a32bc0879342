// SPDX-License-Identifier: Apache-2.0
#include "adapters/bags/bag_sweep.h"

#include <fmt/format.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tagfield_msgs/AntennaTruth.h>
#include <tagfield_msgs/TagPositions.h>
#include <tagfield_msgs/TagReads.h>
#include <tf2_msgs/TFMessage.h>

#include <map>
#include <set>
#include <vector>

#include "adapters/bags/bag_messages.h"
#include "adapters/bags/bag_wire.h"
#include "adapters/bags/message_content.h"
#include "adapters/bags/silence.h"

namespace tagfield {
namespace {

using recorded::last_name;
using recorded::take_antenna_truth;
using recorded::take_array;
using recorded::take_odometry;
using recorded::take_reads;
using recorded::take_tag_positions;
using recorded::take_transforms;

constexpr double kAssumedFrequency = 865.7e6;  ///< [Hz] As in the paper.

/// Runs `work` and converts errors on opening and reading the bag.
template <typename Work>
BagContent with_bag_errors(const std::string& path, const Work& work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const rosbag::BagUnindexedException&) {
    fail({path, 0},
         fmt::format(
             "has no index, like a recording that was cut off: 'rosbag reindex {}' makes one",
             path));
  } catch (const rosbag::BagException& error) {
    fail({path, 0},
         fmt::format("is cut off or damaged ({}); 'rosbag reindex' may recover the intact part",
                     error.what()));
  } catch (const std::exception& error) {
    fail({path, 0}, fmt::format("can't be read as a rosbag: {}", error.what()));
  }
}

enum class Kind { kReads, kAntennaTruth, kTagPositions, kRobot, kTransforms, kArray };

/// The kind of a connection, by its type and, for types with other uses, its topic.
std::optional<Kind> kind_of(const rosbag::ConnectionInfo& connection) {
  const std::string& type = connection.datatype;
  const std::string& topic = connection.topic;
  if (type == "tagfield_msgs/TagReads") return Kind::kReads;
  if (type == "tagfield_msgs/AntennaTruth") return Kind::kAntennaTruth;
  if (type == "tagfield_msgs/TagPositions") return Kind::kTagPositions;
  if (type == "rfid_sensor/TagArray") return Kind::kArray;
  if (type == "nav_msgs/Odometry") {
    const std::string end = "ground_truth/odom";
    const bool fits = topic.size() >= end.size() &&
                      topic.compare(topic.size() - end.size(), end.size(), end) == 0;
    return fits ? std::optional(Kind::kRobot) : std::nullopt;
  }
  const std::string name = last_name(topic);
  const bool of_tf = type == "tf2_msgs/TFMessage" || type == "tf/tfMessage";
  if (of_tf && (name == "tf" || name == "tf_static")) return Kind::kTransforms;
  return std::nullopt;
}

const char* md5_of(Kind kind) {
  using ros::message_traits::md5sum;
  switch (kind) {
    case Kind::kReads:
      return md5sum<tagfield_msgs::TagReads>();
    case Kind::kAntennaTruth:
      return md5sum<tagfield_msgs::AntennaTruth>();
    case Kind::kTagPositions:
      return md5sum<tagfield_msgs::TagPositions>();
    case Kind::kRobot:
      return md5sum<nav_msgs::Odometry>();
    case Kind::kTransforms:
      return md5sum<tf2_msgs::TFMessage>();
    case Kind::kArray:
      break;
  }
  return md5sum<rfid_sensor::TagArray>();
}

/// The bytes of one message.
void read_bytes(const rosbag::MessageInstance& instance, std::vector<std::uint8_t>& bytes) {
  bytes.resize(instance.size());
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  instance.write(stream);
}

/// One pass over a bag.
class Sweep {
 public:
  Sweep(const std::string& path, std::optional<double> frequency_hz, const BagReadSink& sink,
        Diagnostics& diagnostics)
      : path_(path),
        frequency_hz_(frequency_hz),
        diagnostics_(diagnostics),
        bag_(path),
        content_(sink) {}

  BagContent content(const std::function<void(double)>& on_progress) {
    choose_kinds();
    rosbag::View view(bag_, [this](const rosbag::ConnectionInfo* connection) {
      return kinds_.count(connection->id) > 0;
    });
    const double size = view.size();
    double done = 0.0;
    for (const rosbag::MessageInstance& instance : view) {
      take_message(instance);
      content_.forget_unwanted();
      if (on_progress) on_progress(++done / size);
    }
    require_messages();
    return std::move(content_);
  }

 private:
  /// Whether there are any of reads, even of updates in which no tag was read.
  void require_messages() const {
    for (const auto& [topic, number] : numbers_) {
      const Kind kind = of_topic_.at(topic);
      if (kind == Kind::kReads || kind == Kind::kArray) return;
    }
    fail({path_, 0}, "has no reads: there are no messages on the topics for them");
  }

  void choose_kinds() {
    rosbag::View all(bag_);
    const std::vector<const rosbag::ConnectionInfo*> connections = all.getConnections();
    std::set<Kind> present;
    for (const rosbag::ConnectionInfo* connection : connections) {
      if (const auto kind = kind_of(*connection)) present.insert(*kind);
    }
    const bool has_reads = present.count(Kind::kReads) > 0;
    if (!has_reads && present.count(Kind::kArray) == 0) {
      fail({path_, 0},
           "has no reads: no topic of type tagfield_msgs/TagReads or "
           "rfid_sensor/TagArray");
    }
    for (const rosbag::ConnectionInfo* connection : connections) {
      const auto kind = kind_of(*connection);
      if (!kind || (has_reads && *kind == Kind::kArray)) continue;
      require_version(*connection, *kind);
      kinds_[connection->id] = *kind;
      of_topic_[connection->topic] = *kind;
    }
    if (has_reads && frequency_hz_) {
      diagnostics_.warn({path_, 0}, "--frequency has no effect: its reads state their carriers");
    }
    if (!has_reads && !frequency_hz_) {
      diagnostics_.warn({path_, 0}, fmt::format("rfid_sensor/TagArray has no frequency: {:g} MHz "
                                                "is assumed (--frequency)",
                                                kAssumedFrequency * 1e-6));
    }
  }

  void require_version(const rosbag::ConnectionInfo& connection, Kind kind) const {
    if (connection.md5sum == md5_of(kind)) return;
    fail({path_, 0},
         fmt::format("topic {} is of another version of {}: its MD5 sum is '{}', "
                     "expected {}",
                     connection.topic, connection.datatype, connection.md5sum, md5_of(kind)));
  }

  void take_message(const rosbag::MessageInstance& instance) {
    const std::string& topic = instance.getTopic();
    const MessageLocation place = {path_, topic, ++numbers_[topic]};
    read_bytes(instance, bytes_);
    switch (of_topic_.at(topic)) {
      case Kind::kReads:
        return take_reads(decode<tagfield_msgs::TagReads>(bytes_, place), place, content_,
                          diagnostics_);
      case Kind::kAntennaTruth:
        return take_antenna_truth(decode<tagfield_msgs::AntennaTruth>(bytes_, place), place,
                                  content_, diagnostics_);
      case Kind::kTagPositions:
        return take_tag_positions(decode<tagfield_msgs::TagPositions>(bytes_, place), place,
                                  content_, diagnostics_);
      case Kind::kRobot:
        return take_odometry(decode<nav_msgs::Odometry>(bytes_, place), place, content_,
                             diagnostics_);
      case Kind::kTransforms:
        return take_transforms(decode<tf2_msgs::TFMessage>(bytes_, place), place, content_,
                               diagnostics_);
      case Kind::kArray:
        take_array(decode<rfid_sensor::TagArray>(bytes_, place), place,
                   frequency_hz_.value_or(kAssumedFrequency), content_, diagnostics_);
    }
  }

  const std::string& path_;
  std::optional<double> frequency_hz_;
  Diagnostics& diagnostics_;
  rosbag::Bag bag_;
  std::map<std::uint32_t, Kind> kinds_;  ///< By connection.
  std::map<std::string, Kind> of_topic_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<std::uint8_t> bytes_;
  BagContent content_;
};

}  // namespace

BagContent sweep_bag(const std::string& path, std::optional<double> frequency_hz,
                     const BagReadSink& sink, const std::function<void(double share)>& on_progress,
                     Diagnostics& diagnostics) {
  const Silence silence;
  return with_bag_errors(
      path, [&] { return Sweep(path, frequency_hz, sink, diagnostics).content(on_progress); });
}

}  // namespace tagfield
