// SPDX-License-Identifier: Apache-2.0
/// @file
/// A recording out of a rosbag of ROS 1, read without a master, or out of one of ROS 2: an MCAP
/// file, a database of rosbag2, or a folder of them.
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
  /// Frames that antennas may be believed to stand in: the first that can express them.
  std::vector<std::string> frames = {"map", "world", "odom"};
  /// Carrier of reads that don't say theirs (rfid_sensor/TagArray) [Hz].
  std::optional<double> frequency_hz;
  std::function<void(double share)> on_progress;  ///< Called with 0 … 1, or empty.
  /// More reads than these, or true distances, are not held: see BagRecording::untold.
  std::size_t most_reads = std::numeric_limits<std::size_t>::max();
  /// Of a bag with untold reads, more than these, and a truth, nothing is believed: `believed` is
  /// empty, which saves the memory of a pose for each update.
  std::size_t most_reads_believed = std::numeric_limits<std::size_t>::max();
};

/// The reads of a bag that has more of them than are held.
struct BagReads {
  std::function<void(const TagRead&)> on_read;           ///< Gets each, or is empty.
  std::function<void(const TrueDistance&)> on_distance;  ///< Likewise.
  std::function<void(double share)> on_progress;         ///< Called with 0 … 1, or empty.
};
struct UntoldReads {
  ReadOverview overview;
  bool has_distances = false;
  /// Goes through the bag once more: reads and distances as they were recorded, so that some may be
  /// out of order or repeat others. Throws Error where the bag has others now.
  std::function<void(const BagReads&)> tell;
};

/// Where an antenna stood, by what the robot believed or was told.
struct PoseSet {
  std::string source;              ///< "odometry" or "tf", or "given" with the reads.
  std::string frame;               ///< That `poses` are in.
  std::vector<AntennaPose> poses;  ///< By stamp; of one that never moves one row. May be empty.
};

struct BagRecording {
  std::vector<TagRead> reads;  ///< By stamp, each once.
  /// Set where there are more of either than `most_reads`: then `reads` and the truth's distances
  /// are empty.
  std::optional<UntoldReads> untold;
  /// At the stamps of all updates of an antenna that have one, and, unless they are untold, of
  /// reads.
  PoseSet believed;
  /// Empty where the bag tells none. A tag at rest has one row, a moving one a row each change.
  Truth truth;
  std::string truth_frame;  ///< That the truth is in; "" where there is none.
  double duration_s = 0.0;  ///< From the first stamp of reads, poses and truth to the last.
};

/// Whether a file is meant to be a bag: by its name (….bag, ….bag.active, ….mcap, ….db3) or how it
/// begins, or a folder that rosbag2 records into.
bool is_bag(const std::string& path);

/// Reads a bag by the types of its messages, whatever the topics' names:
/// - tagfield_msgs/TagReads: reads. Where there is no such topic, rfid_sensor/TagArray: then the
///   second last name of the topic (…/SENSOR/data) names the antenna, and the pose comes along;
/// - tagfield_msgs/AntennaTruth and TagPositions: the truth, and nav_msgs/Odometry on topics that
///   end in ground_truth/odom that of robots;
/// - tf2_msgs/TFMessage on topics that end in tf or tf_static: what was believed, interpolated by
///   tf2 at the header stamps of reads and updates. An antenna that tf doesn't know but that never
///   moved has its true pose, as one that was measured by hand, if that is in the same frame.
/// All stamps are those of headers, to the nanosecond. After a reset of time only the last part
/// counts, with a warning. Throws Error with one line on a file that is no whole bag, has neither
/// kind of reads, or holds messages of other versions, cut short, or with absurd numbers.
BagRecording read_bag(const std::string& path, const BagOptions& options, Diagnostics& diagnostics);

}  // namespace tagfield
