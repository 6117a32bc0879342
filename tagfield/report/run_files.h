// SPDX-License-Identifier: Apache-2.0
/// @file
/// A run's folder in memory, and what the figures ask of it.
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
  Trajectory truth;                   ///< Empty where unknown.
  std::vector<const TagRead*> reads;  ///< In rising order of time.
  bool moving = false;                ///< By over 5 cm, as believed.

  /// The true one where known.
  [[nodiscard]] const Trajectory& best() const { return truth.empty() ? believed : truth; }
};

/// The way of a robot that made a map.
struct MappingWay {
  Trajectory believed;  ///< Empty where the map was given.
  Trajectory truth;     ///< Empty where unknown.
};

/// Tags that moved, as they were tracked.
struct TrackedTags {
  TrackNumbers numbers;
  std::vector<PassingOrder> orders;
};

/// All that a page is made of. Not to be copied: tracks point into `reads`.
struct RunFiles {
  Summary summary;
  std::vector<TagRead> reads;      ///< Of the first seed, as all below; those that the page shows.
  std::size_t reads_in_table = 0;  ///< As many, or more where these don't fit in memory.
  std::map<std::string, std::vector<TagPosition>>
      true_places;                   ///< By tag, in rising order of time.
  std::vector<Silhouette> top_view;  ///< Empty where unknown.
  std::vector<AntennaTrack> tracks;  ///< By name.
  std::optional<OccupancyGrid> map;  ///< That robots found their way by.
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

/// Reads summary.json, reads.csv and antenna_poses.csv, and truth/ and top_view.json where they
/// are. Where a run with the true poses was compared with the believed ones, those come from
/// compared_poses.csv. The map and the way of mapping come from map.yaml and mapping_path.csv where
/// the summary has `navigation`, tracks from tracks.json and order.csv where those are. Throws
/// Error if one is malformed, or one of the first three is missing.
RunFiles read_run_files(const std::string& folder);

/// A recording as a run in which nothing was located: its reads, where its antennas were believed
/// to be, and what is known of the truth; its summary has the tags. Without belief the truth stands
/// for it.
RunFiles recorded_run(const std::string& name, std::vector<TagRead> reads,
                      const std::vector<AntennaPose>& believed, const Truth& truth);

/// The moving (or resting) antenna with the most reads, or nullptr.
const AntennaTrack* busiest_track(const RunFiles& run, bool moving);

/// The tag with the most reads in a track (the first in natural order among equals), or "".
std::string busiest_tag(const AntennaTrack& track);

/// Reads of one tag in a track, in rising order of time.
std::vector<const TagRead*> reads_of(const AntennaTrack& track, const std::string& tag);

/// Reads of a track joined with where its antenna was believed to be, by tag, as localization does
/// by default, whose warnings of them are in the summary.
SamplesByTag believed_samples(const AntennaTrack& track, const std::vector<const TagRead*>& reads);

/// Outcomes of the first seed, in natural order of their tags.
std::vector<const TagOutcome*> first_outcomes(const Summary& summary);

/// The place that is best known of a tag: true, else estimated; none where it moved or is unknown.
std::optional<Eigen::Vector3d> known_place(const TagOutcome& outcome);

/// Where a tag really was at `stamp`, if that is known.
std::optional<Eigen::Vector3d> true_place(const RunFiles& run, const std::string& tag, Time stamp);

}  // namespace tagfield
