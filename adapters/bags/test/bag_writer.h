// SPDX-License-Identifier: Apache-2.0
/// @file
/// Bags for tests, written by rosbag itself.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tagfield/poses/trajectory.h"
#include "tagfield/stream/tag_read.h"

namespace rosbag {
class Bag;
}

namespace tagfield {

/// A tag in an rfid_sensor/TagArray.
struct ArrayTag {
  std::string name;
  double distance_m = 0.0;
  double phase_rad = 0.0;
  double rssi_dbm = 0.0;
};

/// Every message is received at its own stamp, or at `receipt` if set.
class BagWriter {
 public:
  explicit BagWriter(const std::string& path, const std::string& compression = "");
  ~BagWriter();
  BagWriter(const BagWriter&) = delete;
  BagWriter& operator=(const BagWriter&) = delete;

  void reads(Time stamp, const std::string& antenna, const std::vector<TagRead>& reads,
             const std::string& frame = "antenna");
  void antenna_truth(Time stamp, const std::string& antenna, const RigidTransform& X_WA,
                     const std::map<std::string, double>& distances = {});
  void tag_positions(Time stamp, const std::map<std::string, Eigen::Vector3d>& positions);
  void robot(const std::string& topic, Time stamp, const RigidTransform& X_WB);
  void transform(const std::string& topic, Time stamp, const std::string& parent,
                 const std::string& child, const RigidTransform& X_PC);
  void tag_array(const std::string& topic, Time stamp, const RigidTransform& X_WA,
                 const std::vector<ArrayTag>& tags);
  /// Writes any bytes as a message of any type.
  void raw(const std::string& topic, const std::string& type, const std::string& md5,
           const std::vector<std::uint8_t>& bytes);

  /// Receipt time of the following messages; Time::min() for their own stamps.
  Time receipt = Time::min();

 private:
  template <typename Message>
  void write(const std::string& topic, Time stamp, const Message& message);

  std::unique_ptr<rosbag::Bag> bag_;
};

/// MD5 sum of tagfield_msgs/TagReads.
std::string md5_of_tag_reads();

}  // namespace tagfield
