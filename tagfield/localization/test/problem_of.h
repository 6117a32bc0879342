// SPDX-License-Identifier: Apache-2.0
/// @file
/// Problems for the methods, from synthetic reads (made_reads.h).
#pragma once

#include <string>
#include <vector>

#include "tagfield/localization/problem.h"
#include "tagfield/localization/test/made_reads.h"
#include "tagfield/poses/trajectory.h"

namespace tagfield::made {

inline constexpr double kPathRate = 15.0;

/// Poses of an antenna that is at point i of the path at i/15 s, as in read_along().
inline BelievedTrack track_along(const Path& path) {
  BelievedTrack track;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double time = static_cast<double>(i) / kPathRate;
    track.X_WA.push_back({time_from_seconds(ReaderSetup{}.start_s) + duration_from_seconds(time),
                          from_translation(path[i])});
  }
  return track;
}

struct Hall {
  LocalizationProblem problem;
  std::map<std::string, Eigen::Vector3d> truth;
};

/// Tags t0, t1, … 1 to 4 m beside the path, read by antenna "a" with the believed path `beliefs`.
inline Hall hall(const Path& path, const Path& beliefs, int tags, const Noise& noise, Rng& rng,
                 double z = 0.4) {
  Hall made;
  made.problem.tracks["a"] = track_along(beliefs);
  for (int i = 0; i < tags; ++i) {
    const std::string id = "t" + std::to_string(i);
    made.truth[id] = beside(path, uniform(rng, 1.0, 4.0), z, rng);
    made.problem.samples[id]["a"] = read_along(path, beliefs, made.truth[id], noise, rng);
  }
  made.problem.heights.of_all = z;
  made.problem.pose_error = PoseErrorModel{noise.pose_m, 0.0, noise.pose_time};
  return made;
}

inline Hall hall(const Path& path, int tags, const Noise& noise, Rng& rng, double z = 0.4) {
  return hall(path, believed(path, noise, kPathRate, rng), tags, noise, rng, z);
}

/// Inserts a pause of `pause_s` after `after_s`, during which nothing moves or is read.
inline void pause(Hall& hall, double after_s, double pause_s) {
  const Time begin = time_from_seconds(ReaderSetup{}.start_s + after_s);
  const auto shift = [&](auto& rows) {
    for (auto& row : rows) row.stamp += duration_from_seconds(row.stamp > begin ? pause_s : 0.0);
  };
  for (auto& [antenna, track] : hall.problem.tracks) shift(track.X_WA);
  for (auto& [tag, of_tag] : hall.problem.samples) {
    for (auto& [antenna, series] : of_tag) shift(series);
  }
}

/// Delays the reads' stamps and joins them with the believed antenna positions at these.
inline void make_late(Hall& hall, double late_s) {
  for (auto& [tag, of_tag] : hall.problem.samples) {
    for (auto& [antenna, series] : of_tag) {
      const Trajectory& track = hall.problem.tracks.at(antenna).X_WA;
      for (PhaseSample& sample : series) {
        sample.stamp += duration_from_seconds(late_s);
        sample.p_WA = held_position_at(track, sample.stamp);
      }
    }
  }
}

}  // namespace tagfield::made
