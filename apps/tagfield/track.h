// SPDX-License-Identifier: Apache-2.0
/// @file
/// Arguments and results of `track`.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/ros_options.h"
#include "apps/tagfield/scenario_arguments.h"
#include "tagfield/experiment/tracking_run.h"
#include "tagfield/files/staged_folder.h"

namespace tagfield {

struct TrackArguments {
  std::string input;     ///< Reads as CSV, or a scenario.
  std::string poses;     ///< CSV; "" with a scenario.
  std::string format;    ///< Format of third-party tables, or "".
  std::string scenario;  ///< In addition to reads, or "".
  std::vector<std::string> settings;
  std::optional<std::string> method;
  std::vector<double> lane;        ///< X Y HEADING_DEG [SIGMA_M].
  std::vector<double> line;        ///< X Y HEADING_DEG.
  std::vector<double> speeds;      ///< MIN MAX.
  std::vector<double> old_speeds;  ///< Same, by the option's old name.
  bool bidirectional = false;
  std::optional<double> acceleration_noise;
  std::optional<double> tag_height_m;
  std::string heights_file;
  std::string calibration;
  std::optional<std::uint64_t> seed;
  std::size_t seeds = 1;
  std::string out;
  RosOptions ros{};
  std::optional<std::size_t> part_reads;  ///< See part_of_table().
  int threads = default_threads();
  bool no_page = false;
  bool as_json = false;
  WorldOptions world{};
};

/// Error message of --part-reads.
inline constexpr const char* kUselessParts =
    "track: --part-reads can only be used with CSV in Tagfield's own form, not packed, and with "
    "recordings of ROS";

struct TrackResult {
  TrackSummary summary;
  TrackingRun first;
  bool complete = true;
  /// If reads were tracked in parts: the folder with their tracks and verdicts.
  std::shared_ptr<StagedFolder> parts{};
  std::size_t reads_of_parts = 0;
};

/// Overrides the scenario's settings with the command line's. Throws Error on conflicting settings.
void apply(const TrackArguments& arguments, TrackingSpec& spec);

/// The scenario at `path` with the overrides of --set.
ScenarioWithWorld load(const TrackArguments& arguments, const std::string& path,
                       Diagnostics& diagnostics);

/// Adds the results of the runs.
void gather(const std::vector<TrackingRun>& runs, TrackSummary& summary);

/// Tracks the tags of a ROS recording or of tables, in parts stored on the path to `out` if the
/// reads don't fit in memory. Throws Error on arguments that can't be combined with these.
TrackResult track_reads(const TrackArguments& arguments, const std::string& out,
                        Diagnostics& diagnostics);

}  // namespace tagfield
