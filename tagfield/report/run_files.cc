// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/run_files.h"

#include <algorithm>
#include <iterator>

#include "tagfield/base/error.h"
#include "tagfield/base/file_kind.h"
#include "tagfield/files/files.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/truth_csv.h"
#include "tagfield/map/map_file.h"
#include "tagfield/report/internal/drawn_reads.h"
#include "tagfield/report/text.h"
#include "tagfield/report/tracks_csv.h"

namespace tagfield {
namespace {

constexpr double kMovingExtent = 0.05;  ///< [m]

using Trajectories = std::map<std::string, Trajectory>;

/// Trajectories by antenna, in chronological order, without duplicate timestamps.
Trajectories by_antenna(const std::vector<AntennaPose>& poses) {
  Trajectories trajectories;
  for (const AntennaPose& pose : poses) {
    trajectories[pose.antenna].push_back({pose.stamp, pose.X_WA});
  }
  const auto earlier = [](const auto& a, const auto& b) { return a.stamp < b.stamp; };
  const auto same = [](const auto& a, const auto& b) { return a.stamp == b.stamp; };
  for (auto& [antenna, trajectory] : trajectories) {
    std::stable_sort(trajectory.begin(), trajectory.end(), earlier);
    trajectory.erase(std::unique(trajectory.begin(), trajectory.end(), same), trajectory.end());
  }
  return trajectories;
}

bool is_moving(const Trajectory& trajectory) {
  Eigen::AlignedBox3d box;
  for (const StampedPose& pose : trajectory) box.extend(pose.X_WB.translation);
  return box.sizes().norm() > kMovingExtent;
}

/// A recording has one row per update even for stationary antennas, of which the first is enough.
void leave_out_rest(Trajectories& trajectories) {
  for (auto& [antenna, trajectory] : trajectories) {
    const RigidTransform first = trajectory.front().X_WB;
    const bool rests =
        std::all_of(trajectory.begin(), trajectory.end(), [&](const StampedPose& pose) {
          return pose.X_WB.translation == first.translation &&
                 pose.X_WB.rotation.coeffs() == first.rotation.coeffs();
        });
    if (rests) trajectory.resize(1);
  }
}

/// Reads of an antenna without a pose have no track, as no figure can show them.
std::vector<AntennaTrack> tracks_of(const std::vector<TagRead>& reads, const Trajectories& believed,
                                    Trajectories truth) {
  std::map<std::string, AntennaTrack> tracks;
  for (const auto& [antenna, trajectory] : believed) {
    tracks[antenna] = {antenna, trajectory, truth[antenna], {}, is_moving(trajectory)};
  }
  for (const TagRead& read : reads) {
    const auto track = tracks.find(read.antenna);
    if (track != tracks.end()) track->second.reads.push_back(&read);
  }
  std::vector<AntennaTrack> list;
  for (auto& [antenna, track] : tracks) {
    std::stable_sort(track.reads.begin(), track.reads.end(),
                     [](const TagRead* a, const TagRead* b) { return a->stamp < b->stamp; });
    list.push_back(std::move(track));
  }
  return list;
}

/// Stores the tags' positions in `run` and returns the antennas' trajectories.
Trajectories take_truth(const Truth& truth, RunFiles& run) {
  for (const TagPosition& position : truth.tag_positions) {
    run.true_positions[position.tag].push_back(position);
  }
  for (auto& [tag, places] : run.true_positions) {
    std::stable_sort(places.begin(), places.end(),
                     [](const TagPosition& a, const TagPosition& b) { return a.stamp < b.stamp; });
  }
  return by_antenna(truth.antenna_poses);
}

/// Reads the robot's believed poses of a run that was localized with the true ones.
void take_compared_poses(const std::string& file, Trajectories& believed) {
  for (auto& [antenna, trajectory] : by_antenna(read_poses_csv(file))) {
    believed[antenna] = std::move(trajectory);
  }
}

/// The path of the only robot in such a file; empty without the file.
Trajectory read_way(const std::string& file) {
  if (!is_there(file)) return {};
  Trajectories ways = by_antenna(read_poses_csv(file));
  return ways.empty() ? Trajectory{} : std::move(ways.begin()->second);
}

void take_map(const std::string& folder, RunFiles& run) {
  const std::string map_file = folder + "/map.yaml";
  Diagnostics ignored;
  if (is_there(map_file)) run.map = read_map(map_file, ignored);
  run.mapping_way = {read_way(folder + "/mapping_path.csv"),
                     read_way(folder + "/truth/mapping_path.csv")};
}

}  // namespace

std::vector<Silhouette> read_top_view(const std::string& path) {
  try {
    return top_view_from_json(read_text_file(path));
  } catch (const Error& error) {
    const std::string what = error.what();
    if (what.rfind(path, 0) == 0) throw;
    fail({path, 0}, what);
  }
}

RunFiles read_run_files(const std::string& folder) {
  RunFiles run;
  const std::string summary_file = folder + "/summary.json";
  run.summary = summary_from_json(read_text_file(summary_file), summary_file);
  DrawnReads drawn = read_drawn(folder + "/reads.csv");
  run.reads = std::move(drawn.reads);
  run.reads_in_table = drawn.of;
  Trajectories believed = by_antenna(read_poses_csv(folder + "/antenna_poses.csv"));
  const std::string compared = folder + "/compared_poses.csv";
  if (run.summary.pose == "true" && run.summary.compared_pose && is_there(compared)) {
    take_compared_poses(compared, believed);
  }
  Trajectories truth;
  if (is_there(folder + "/truth")) truth = take_truth(read_truth(folder), run);
  if (is_there(folder + "/top_view.json")) {
    run.top_view = read_top_view(folder + "/top_view.json");
  }
  if (run.summary.navigation) take_map(folder, run);
  const std::string tracks = folder + "/tracks.json";
  if (is_there(tracks) && is_there(folder + "/order.csv")) {
    run.tracked = {track_numbers_from_json(read_text_file(tracks), tracks),
                   read_orders_csv(folder + "/order.csv")};
  }
  run.tracks = tracks_of(run.reads, believed, std::move(truth));
  return run;
}

RunFiles recorded_run(const std::string& name, std::vector<TagRead> reads,
                      const std::vector<AntennaPose>& believed, const Truth& truth) {
  RunFiles run;
  run.summary.scenario = name;
  run.reads = std::move(reads);
  run.reads_in_table = run.reads.size();
  Trajectories true_poses = take_truth(truth, run);
  std::map<std::string, std::size_t> counts = count_by_tag(run.reads);
  for (const auto& [tag, places] : run.true_positions) counts.emplace(tag, 0);
  for (const auto& [tag, count] : counts) {
    TagOutcome outcome;
    outcome.estimate.tag = tag;
    outcome.reads = count;
    run.summary.tags.push_back(std::move(outcome));
  }
  Trajectories poses = by_antenna(believed);
  for (const auto& [antenna, trajectory] : true_poses) poses.emplace(antenna, trajectory);
  leave_out_rest(poses);
  leave_out_rest(true_poses);
  run.tracks = tracks_of(run.reads, poses, std::move(true_poses));
  return run;
}

const AntennaTrack* busiest_track(const RunFiles& run, bool moving) {
  const AntennaTrack* busiest = nullptr;
  for (const AntennaTrack& track : run.tracks) {
    if (track.moving != moving) continue;
    if (busiest == nullptr || track.reads.size() > busiest->reads.size()) busiest = &track;
  }
  return busiest;
}

std::string busiest_tag(const AntennaTrack& track) {
  std::map<std::string, std::size_t> counts;
  for (const TagRead* read : track.reads) ++counts[read->tag];
  const auto fewer = [](const auto& a, const auto& b) {
    return a.second != b.second ? a.second < b.second : natural_less(b.first, a.first);
  };
  const auto most = std::max_element(counts.begin(), counts.end(), fewer);
  return most == counts.end() ? "" : most->first;
}

std::vector<const TagRead*> reads_of(const AntennaTrack& track, const std::string& tag) {
  std::vector<const TagRead*> reads;
  std::copy_if(track.reads.begin(), track.reads.end(), std::back_inserter(reads),
               [&](const TagRead* read) { return read->tag == tag; });
  return reads;
}

SamplesByTag believed_samples(const AntennaTrack& track, const std::vector<const TagRead*>& reads) {
  constexpr double kMaxPoseGap_s = 0.5;  // The default of localization.
  std::vector<TagRead> copies;
  copies.reserve(reads.size());
  for (const TagRead* read : reads) copies.push_back(*read);
  std::vector<AntennaPose> poses;
  poses.reserve(track.believed.size());
  for (const StampedPose& pose : track.believed) {
    poses.push_back({pose.stamp, track.antenna, pose.X_WB});
  }
  Diagnostics reported_before;
  return join_reads_with_tracks(copies, tracks_of(poses, reported_before), kMaxPoseGap_s,
                                reported_before);
}

std::vector<const TagOutcome*> first_outcomes(const Summary& summary) {
  std::vector<const TagOutcome*> outcomes;
  for (const TagOutcome& outcome : summary.tags) {
    if (outcome.seed == summary.tags.front().seed) outcomes.push_back(&outcome);
  }
  std::stable_sort(outcomes.begin(), outcomes.end(), [](const TagOutcome* a, const TagOutcome* b) {
    return natural_less(a->estimate.tag, b->estimate.tag);
  });
  return outcomes;
}

std::optional<Eigen::Vector3d> known_place(const TagOutcome& outcome) {
  if (outcome.truth_m) return outcome.truth_m;
  const bool located = outcome.estimate.verdict == Verdict::kLocated;
  if (!located || outcome.estimate.candidates.empty()) return std::nullopt;
  return outcome.estimate.candidates.front().p_WT;
}

std::optional<Eigen::Vector3d> true_position(const RunFiles& run, const std::string& tag,
                                             Time stamp) {
  const auto places = run.true_positions.find(tag);
  if (places == run.true_positions.end()) return std::nullopt;
  const auto after = std::upper_bound(
      places->second.begin(), places->second.end(), stamp,
      [](Time time, const TagPosition& position) { return time < position.stamp; });
  if (after == places->second.begin()) return std::nullopt;
  return (after - 1)->p_WT;
}

}  // namespace tagfield
