// SPDX-License-Identifier: Apache-2.0
/// @file
/// What is to be localized or tracked, wherever it comes from.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/tagfield/localize.h"
#include "apps/tagfield/ros_options.h"
#include "apps/tagfield/stored_reads.h"
#include "tagfield/base/error.h"
#include "tagfield/localization/problem.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/stream/tag_read.h"
#include "tagfield/stream/truth.h"

namespace tagfield {

/// Antenna poses and what they are: "true", "odometry", "tf", "given".
struct NamedPoses {
  std::string name;
  std::vector<AntennaPose> poses;
};

struct LoadedRecording {
  std::vector<TagRead> reads;  ///< All, or none where they are stored or not kept.
  /// Where reads are not kept: they are read anew each time they are asked for.
  std::optional<ReadSource> source;
  std::optional<StoredReads> stored;  ///< More than fit in memory.
  std::string table;                  ///< That the reads come from where they are not kept, or "".
  std::optional<UntoldReads> untold;  ///< The same of a bag.
  ReadOverview overview;
  NamedPoses poses;
  NamedPoses other;  ///< To be compared with; empty where there are none.
  Truth truth;       ///< Empty where unknown.
  double path_length_m = 0.0;
  double duration_s = 0.0;  ///< 0 where unknown.
};

/// The reads that are in memory or in `source`. `recording` must outlive it.
EachRead reads_of(const LoadedRecording& recording);

/// Reads and poses as CSV. Reads of a table over kTableToReadAnew are not kept unless `keep` is
/// set. `references`: tags at known places, which all parts have of reads that are stored on the
/// way to `out`. Throws Error where `--poses` is missing, or --part-reads goes with an archive or
/// other people's tables.
LoadedRecording csv_recording(const LocalizeArguments& arguments, const std::string& out,
                              const std::set<std::string>& references, bool keep,
                              Diagnostics& diagnostics);

/// What a command was told of a recording of ROS.
struct BagArguments {
  std::string command;  ///< For complaints.
  std::string bag;
  std::string poses;  ///< One of kPoseWords, or "".
  RosOptions ros;
  std::optional<std::size_t> part_reads;  ///< See part_of_table().
};

/// A recording of ROS, with a progress bar. Its reads are kept, or not, as those of tables, by
/// kReadsToReadAnew and kManyReads. Throws Error where it has not the poses that were asked for.
LoadedRecording bag_recording(const BagArguments& arguments, const std::string& out,
                              const std::set<std::string>& references, bool keep,
                              Diagnostics& diagnostics);

}  // namespace tagfield
