// SPDX-License-Identifier: Apache-2.0
/// @file
/// Recordings to be localized or tracked, from any source.
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

/// Antenna poses and their kind: "true", "odometry", "tf", "given".
struct NamedPoses {
  std::string name;
  std::vector<AntennaPose> poses;
};

struct LoadedRecording {
  std::vector<TagRead> reads;  ///< All, or none if they are stored or not kept.
  /// If reads are not kept: they are read again each time they are needed.
  std::optional<ReadSource> source;
  std::optional<StoredReads> stored;          ///< If they don't fit in memory.
  std::string table;                          ///< Source of reads that are not kept, or "".
  std::optional<UnreportedReads> unreported;  ///< Same, for a bag.
  ReadOverview overview;
  NamedPoses poses;
  NamedPoses other;            ///< For comparison; empty if there are none.
  Truth truth;                 ///< Empty if unknown.
  std::string true_distances;  ///< Table of them that is not in `truth`, or "".
  double path_length_m = 0.0;
  double duration_s = 0.0;  ///< Of a table, from its first read to the last.
};

/// The reads that are in memory or in `source`. `recording` must outlive it.
EachRead reads_of(const LoadedRecording& recording);

/// Reads and poses from CSV. Reads of a table over kTableToReadAnew are not kept unless `keep` is
/// set. `references`: tags at known positions, which are included in all parts if reads are stored
/// on the path to `out`. Of a run's folder, the truth is taken, too. Throws Error if `--poses` is
/// missing, or --part-reads is combined with an archive or third-party tables.
LoadedRecording csv_recording(const LocalizeArguments& arguments, const std::string& out,
                              const std::set<std::string>& references, bool keep,
                              Diagnostics& diagnostics);

/// The truth beside a table of reads, or in a run's folder; empty if there is none. It is for
/// judging results only.
Truth truth_beside(const std::string& reads);
/// Same, but empty, with a warning, if it is too large for memory.
Truth truth_that_fits(const std::string& reads, Diagnostics& diagnostics);

/// A command's arguments for a ROS recording.
struct BagArguments {
  std::string command;  ///< For error messages.
  std::string bag;
  std::string poses;  ///< One of kPoseWords, or "".
  RosOptions ros;
  std::optional<std::size_t> part_reads;  ///< See part_of_table().
};

/// Reads a ROS recording, with a progress bar. Its reads are kept or not, as those of tables,
/// depending on kReadsToReadAnew and kManyReads. Throws Error if it does not contain the requested
/// poses.
LoadedRecording bag_recording(const BagArguments& arguments, const std::string& out,
                              const std::set<std::string>& references, bool keep,
                              Diagnostics& diagnostics);

}  // namespace tagfield
