// SPDX-License-Identifier: Apache-2.0
/// @file
/// A recording from a ROS 1 bag, read without a master, or from a ROS 2 recording: an MCAP file, a
/// rosbag2 database, or a folder of them.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/files/read_overview.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/stream/tag_read.h"
#include "tagfield/stream/truth.h"

namespace tagfield {

struct BagOptions {
  /// Candidates for the fixed frame of the antennas' believed poses: the first suitable one is
  /// used.
  std::vector<std::string> frames = {"map", "world", "odom"};
  /// Carrier of reads that don't state it (rfid_sensor/TagArray) [Hz].
  std::optional<double> frequency_hz;
  std::function<void(double share)> on_progress;  ///< Called with 0 … 1, or empty.
  /// If there are more reads or true distances than this, they are not held: see
  /// BagRecording::unreported.
  std::size_t max_reads = std::numeric_limits<std::size_t>::max();
  /// If there are more reads than this, they are not held, and the bag has a truth, then `believed`
  /// stays empty, which saves the memory of a pose per update.
  std::size_t max_reads_believed = std::numeric_limits<std::size_t>::max();
};

/// Reads of a bag that has too many to hold in memory.
struct BagReads {
  std::function<void(const TagRead&)> on_read;           ///< Called with each read, or empty.
  std::function<void(const TrueDistance&)> on_distance;  ///< Called with each distance, or empty.
  std::function<void(double share)> on_progress;         ///< Called with 0 … 1, or empty.
};
struct UnreportedReads {
  ReadOverview overview;
  bool has_distances = false;
  /// Reads the bag again, with reads and distances as they were recorded, so they may be out of
  /// order or repeated. Throws Error if the bag has changed.
  std::function<void(const BagReads&)> tell;
};

/// Poses of antennas as estimated by the robot, or as given.
struct PoseSet {
  std::string source;              ///< "odometry" or "tf", or "given" with the reads.
  std::string frame;               ///< The frame of `poses`.
  std::vector<AntennaPose> poses;  ///< By stamp; one row if it never moves. May be empty.
};

struct BagRecording {
  std::vector<TagRead> reads;  ///< By stamp, without duplicates.
  /// Set if there are more reads or distances than `max_reads`: then `reads` and the truth's
  /// distances are empty.
  std::optional<UnreportedReads> unreported;
  /// At the stamps of all updates of antennas for which a pose is known, and, if they are held, of
  /// reads.
  PoseSet believed;
  /// Empty if the bag has none. A tag at rest has one row, a moving one has a row per change.
  Truth truth;
  std::string truth_frame;  ///< The frame of the truth; "" if there is none.
  double duration_s = 0.0;  ///< From the first stamp of reads, poses and truth to the last.
};

/// Whether a path is meant to be a bag: judging by its name (….bag, ….bag.active, ….mcap, ….db3,
/// or one of these compressed), or its first bytes, or as a folder that rosbag2 recorded.
bool is_bag(const std::string& path);

/// Reads a bag, selecting topics by message type, whatever their names:
/// - tagfield_msgs/TagReads: reads. If there is no such topic, rfid_sensor/TagArray: then the
///   second to last part of the topic (…/SENSOR/data) is the antenna's name, and poses are
///   included;
/// - tagfield_msgs/AntennaTruth and TagPositions: the truth; nav_msgs/Odometry on topics that end
///   in ground_truth/odom: the truth of robots;
/// - tf2_msgs/TFMessage on topics that end in tf or tf_static: the believed poses, interpolated as
///   tf2 does it at the header stamps of reads and updates. An antenna that is unknown to tf but
///   never moved has its true pose, as if measured by hand, if that is in the same frame.
/// All stamps are header stamps, exact to the nanosecond. After a reset of time only the last part
/// is used, with a warning. Throws Error with one line if the file is incomplete, has neither kind
/// of reads, or contains messages of other versions, truncated ones, or absurd numbers.
BagRecording read_bag(const std::string& path, const BagOptions& options, Diagnostics& diagnostics);

}  // namespace tagfield
