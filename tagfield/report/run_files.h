// SPDX-License-Identifier: Apache-2.0
/// @file
/// A run's folder in memory, and the queries of figures.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/localization/problem.h"
#include "tagfield/map/occupancy_grid.h"
#include "tagfield/map/top_view.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/report/summary.h"
#include "tagfield/report/track_judgement.h"
#include "tagfield/stream/tag_read.h"
#include "tagfield/stream/truth.h"

namespace tagfield {

/// One antenna in one run.
struct AntennaTrack {
  std::string antenna;
  Trajectory believed;                ///< Never empty.
  Trajectory truth;                   ///< Empty if unknown.
  std::vector<const TagRead*> reads;  ///< In chronological order.
  bool moving = false;                ///< By over 5 cm, by the believed poses.

  /// The true trajectory if known, else the believed one.
  [[nodiscard]] const Trajectory& best() const { return truth.empty() ? believed : truth; }
};

/// The path of a robot while mapping.
struct MappingWay {
  Trajectory believed;  ///< Empty if the map was given.
  Trajectory truth;     ///< Empty if unknown.
};

/// Results of tracking moving tags.
struct TrackedTags {
  TrackNumbers numbers;
  std::vector<PassingOrder> orders;
};

/// The content of a page. Not copyable, since tracks point into `reads`.
struct RunFiles {
  Summary summary;
  std::vector<TagRead> reads;      ///< Those shown; of the first seed, like all below.
  std::size_t reads_in_table = 0;  ///< The same number, or more if not all fit in memory.
  std::map<std::string, std::vector<TagPosition>>
      true_positions;                ///< By tag, in chronological order.
  std::vector<Silhouette> top_view;  ///< Empty if unknown.
  std::vector<AntennaTrack> tracks;  ///< By name.
  std::optional<OccupancyGrid> map;  ///< The map used for navigation.
  MappingWay mapping_way;
  std::optional<TrackedTags> tracked;

  RunFiles() = default;
  RunFiles(const RunFiles&) = delete;
  RunFiles& operator=(const RunFiles&) = delete;
  RunFiles(RunFiles&&) = default;
  RunFiles& operator=(RunFiles&&) = default;
};

/// Reads a run's top_view.json. Throws Error naming the file.
std::vector<Silhouette> read_top_view(const std::string& path);

/// Reads summary.json, reads.csv and antenna_poses.csv, and truth/ and top_view.json if they exist.
/// If a run with the true poses was compared with the believed ones, the latter are read from
/// compared_poses.csv. The map and the mapping path are read from map.yaml and mapping_path.csv if
/// the summary has `navigation`, tracking results from tracks.json and order.csv if they exist.
/// Throws Error if a file is malformed, or one of the first three is missing.
RunFiles read_run_files(const std::string& folder);

/// A recording as a run without localization: its reads, the believed poses of its antennas, and
/// the known part of the truth; its summary has the tags. Without believed poses the true ones are
/// used.
RunFiles recorded_run(const std::string& name, std::vector<TagRead> reads,
                      const std::vector<AntennaPose>& believed, const Truth& truth);

/// The moving (or stationary) antenna with the most reads, or nullptr.
const AntennaTrack* busiest_track(const RunFiles& run, bool moving);

/// The tag with the most reads in a track (the first in natural order among equals), or "".
std::string busiest_tag(const AntennaTrack& track);

/// Reads of one tag in a track, in chronological order.
std::vector<const TagRead*> reads_of(const AntennaTrack& track, const std::string& tag);

/// Reads of a track joined with the believed poses of its antenna, by tag, as localization does by
/// default. Its warnings are already in the summary.
SamplesByTag believed_samples(const AntennaTrack& track, const std::vector<const TagRead*>& reads);

/// Outcomes of the first seed, in natural order of their tags.
std::vector<const TagOutcome*> first_outcomes(const Summary& summary);

/// The best known position of a tag: true, else estimated; none if it moved or is unknown.
std::optional<Eigen::Vector3d> known_place(const TagOutcome& outcome);

/// The true position of a tag at `stamp`, if known.
std::optional<Eigen::Vector3d> true_position(const RunFiles& run, const std::string& tag,
                                             Time stamp);

}  // namespace tagfield
