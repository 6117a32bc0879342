#include "tagfield/localization/phase_sample.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// An antenna that moved less than this [m] between two poses stood still between them, however
/// long that took.
constexpr double kStillDistance = 0.01;

bool is_finite(const RigidTransform& pose) {
  return pose.translation.allFinite() && pose.rotation.coeffs().allFinite();
}

bool is_usable(const TagRead& read) {
  return std::isfinite(read.phase_rad) && std::isfinite(read.frequency_hz) &&
         read.frequency_hz > 0.0;
}

/// Sorts by time and keeps the first of those with equal stamps; how many were dropped.
std::size_t sort_and_drop_repeats(Trajectory& trajectory) {
  const std::size_t before = trajectory.size();
  std::stable_sort(trajectory.begin(), trajectory.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  const auto same = [](const auto& a, const auto& b) { return a.stamp == b.stamp; };
  trajectory.erase(std::unique(trajectory.begin(), trajectory.end(), same), trajectory.end());
  return before - trajectory.size();
}

std::map<std::string, Trajectory> trajectories_of(const std::vector<AntennaPose>& poses,
                                                  Diagnostics& diagnostics) {
  std::map<std::string, Trajectory> trajectories;
  std::map<std::string, std::size_t> broken;
  for (const AntennaPose& pose : poses) {
    if (is_finite(pose.X_WA)) {
      trajectories[pose.antenna].push_back({pose.stamp, pose.X_WA});
    } else {
      ++broken[pose.antenna];
    }
  }
  for (const auto& [antenna, count] : broken) {
    diagnostics.warn(
        fmt::format("antenna '{}': {} poses are not finite and are left out", antenna, count));
  }
  for (auto& [antenna, trajectory] : trajectories) {
    const std::size_t repeats = sort_and_drop_repeats(trajectory);
    if (repeats == 0) continue;
    diagnostics.warn(
        fmt::format("antenna '{}': {} poses repeat the stamp of another, of which the first counts",
                    antenna, repeats));
  }
  return trajectories;
}

struct ReadCount {
  std::size_t all = 0;
  std::size_t broken = 0;
  std::size_t without_pose = 0;
};

void warn_of_reads_left_out(const std::map<std::string, ReadCount>& counts,
                            Diagnostics& diagnostics) {
  for (const auto& [antenna, count] : counts) {
    if (count.broken > 0) {
      diagnostics.warn(fmt::format(
          "antenna '{}': {} of {} reads have no usable phase or carrier and are left out", antenna,
          count.broken, count.all));
    }
    if (count.without_pose > 0) {
      diagnostics.warn(
          fmt::format("antenna '{}': {} of {} reads have no pose at their stamp and are left out",
                      antenna, count.without_pose, count.all));
    }
  }
}

/// Brings one series into rising order of time, the first of equal stamps kept.
void put_in_order(std::vector<PhaseSample>& samples) {
  std::stable_sort(samples.begin(), samples.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  const auto same = [](const auto& a, const auto& b) { return a.stamp == b.stamp; };
  samples.erase(std::unique(samples.begin(), samples.end(), same), samples.end());
}

}  // namespace

SamplesByTag join_reads_with_poses(const std::vector<TagRead>& reads,
                                   const std::vector<AntennaPose>& poses, double max_pose_gap_s,
                                   Diagnostics& diagnostics) {
  const auto trajectories = trajectories_of(poses, diagnostics);
  const Duration max_gap = duration_from_seconds(max_pose_gap_s);
  SamplesByTag joined;
  std::map<std::string, ReadCount> counts;
  for (const TagRead& read : reads) {
    SamplesOfTag& of_tag = joined[read.tag];
    ReadCount& count = counts[read.antenna];
    ++count.all;
    if (!is_usable(read)) {
      ++count.broken;
      continue;
    }
    const auto trajectory = trajectories.find(read.antenna);
    std::optional<RigidTransform> X_WA;
    if (trajectory != trajectories.end()) {
      X_WA = pose_at(trajectory->second, read.stamp, max_gap, kStillDistance);
    }
    if (!X_WA) {
      ++count.without_pose;
      continue;
    }
    of_tag[read.antenna].push_back(
        {read.stamp, wrap_to_two_pi(read.phase_rad), read.frequency_hz, X_WA->translation});
  }
  for (auto& [tag, of_tag] : joined) {
    for (auto& [antenna, samples] : of_tag) put_in_order(samples);
  }
  warn_of_reads_left_out(counts, diagnostics);
  return joined;
}

}  // namespace tagfield
