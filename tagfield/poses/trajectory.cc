// SPDX-License-Identifier: Apache-2.0
#include "tagfield/poses/trajectory.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

/// First pose later than `stamp`.
Trajectory::const_iterator first_after(const Trajectory& trajectory, Time stamp) {
  return std::upper_bound(trajectory.begin(), trajectory.end(), stamp,
                          [](Time time, const StampedPose& pose) { return time < pose.stamp; });
}

double fraction_at(const StampedPose& before, const StampedPose& after, Time stamp) {
  return to_seconds(stamp - before.stamp) / to_seconds(after.stamp - before.stamp);
}

RigidTransform between(const StampedPose& before, const StampedPose& after, Time stamp) {
  return interpolate(before.X_WB, after.X_WB, fraction_at(before, after, stamp));
}

}  // namespace

void require_rising_stamps(const Trajectory& trajectory) {
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    if (trajectory[i].stamp <= trajectory[i - 1].stamp) {
      throw Error(fmt::format("times must rise: {} s follows {} s",
                              format_stamp(trajectory[i].stamp),
                              format_stamp(trajectory[i - 1].stamp)));
    }
  }
}

std::optional<RigidTransform> pose_at(const Trajectory& trajectory, Time stamp, Duration max_gap,
                                      double still_distance) {
  if (trajectory.size() == 1) return trajectory.front().X_WB;
  const auto after = first_after(trajectory, stamp);
  if (after == trajectory.begin()) return std::nullopt;
  const auto before = after - 1;
  if (before->stamp == stamp) return before->X_WB;
  if (after == trajectory.end()) return std::nullopt;
  const bool too_far_apart = max_gap > Duration::zero() && after->stamp - before->stamp > max_gap;
  const double moved = (after->X_WB.translation - before->X_WB.translation).norm();
  if (too_far_apart && moved > still_distance) return std::nullopt;
  return between(*before, *after, stamp);
}

RigidTransform held_pose_at(const Trajectory& trajectory, Time stamp) {
  const auto after = first_after(trajectory, stamp);
  if (after == trajectory.begin()) return trajectory.front().X_WB;
  if (after == trajectory.end()) return trajectory.back().X_WB;
  return between(*(after - 1), *after, stamp);
}

Eigen::Vector3d held_position_at(const Trajectory& trajectory, Time stamp) {
  const auto after = first_after(trajectory, stamp);
  if (after == trajectory.begin()) return trajectory.front().X_WB.translation;
  if (after == trajectory.end()) return trajectory.back().X_WB.translation;
  const Eigen::Vector3d& from = (after - 1)->X_WB.translation;
  return from + fraction_at(*(after - 1), *after, stamp) * (after->X_WB.translation - from);
}

double path_length(const Trajectory& trajectory) {
  double length = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    length += (trajectory[i].X_WB.translation - trajectory[i - 1].X_WB.translation).norm();
  }
  return length;
}

}  // namespace tagfield
