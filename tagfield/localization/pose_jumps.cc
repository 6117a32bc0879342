// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/pose_jumps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tagfield {
namespace {

constexpr double kLeast_m = 0.03;
constexpr double kOverDriven = 1.5;
/// Half of g: tyres and feet hardly hold more [m/s²].
constexpr double kAcceleration = 4.9;
constexpr double kOverUsual = 3.0;
constexpr double kUsual = 0.95;  ///< Share of the steps.
constexpr double kMoves = 1e-3;  ///< Shorter steps are none [m].
/// Fewer steps show no usual ones.
constexpr std::size_t kFewestSteps = 20;

struct Step {
  double seconds = 0.0;
  double longest_s = 0.0;   ///< Of this step and its neighbours.
  double change_m_s = 0.0;  ///< Of the velocity, from one neighbour to the other.
  Eigen::Vector2d way = Eigen::Vector2d::Zero();  ///< [m]
  double off_m = 0.0;                             ///< From where the neighbours' motion leads.
};

std::vector<Step> steps_of(const Trajectory& X_WA) {
  std::vector<Step> steps;
  for (std::size_t i = 1; i < X_WA.size(); ++i) {
    const StampedPose& from = X_WA[i - 1];
    const StampedPose& to = X_WA[i];
    steps.push_back({to_seconds(to.stamp - from.stamp), 0.0, 0.0,
                     (to.X_WB.translation - from.X_WB.translation).head<2>(), 0.0});
  }
  for (std::size_t i = 1; i + 1 < steps.size(); ++i) {
    const Eigen::Vector2d before = steps[i - 1].way / steps[i - 1].seconds;
    const Eigen::Vector2d after = steps[i + 1].way / steps[i + 1].seconds;
    steps[i].off_m = (steps[i].way - 0.5 * steps[i].seconds * (before + after)).norm();
    steps[i].change_m_s = (after - before).norm();
    steps[i].longest_s = std::max({steps[i - 1].seconds, steps[i].seconds, steps[i + 1].seconds});
  }
  return steps;
}

/// Value that kUsual of them do not exceed.
double usual(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(kUsual * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// Of steps that moved the antenna: while it stands, its poses don't show how it drives.
struct UsualStep {
  double speed_m_s = 0.0;
  double off_m = 0.0;
};

UsualStep usual_step(const std::vector<Step>& steps) {
  std::vector<double> speeds;
  std::vector<double> offs;
  for (const Step& step : steps) {
    if (step.way.norm() < kMoves) continue;
    speeds.push_back(step.way.norm() / step.seconds);
    offs.push_back(step.off_m);
  }
  if (speeds.size() < kFewestSteps) return {INFINITY, INFINITY};
  return {usual(std::move(speeds)), usual(std::move(offs))};
}

/// What driving may put a step off by [m]: half of a sudden change of the velocity, as at a corner
/// or a stop; at most 3/4 a Δt² if the speed falls and rises again by the acceleration a, with the
/// lowest in the middle of the step; and in any case less than what is driven.
double driven_off(const Step& step, const UsualStep& usual) {
  return std::min(kOverDriven * usual.speed_m_s * step.seconds,
                  step.seconds * (0.5 * step.change_m_s + 0.75 * kAcceleration * step.longest_s));
}

/// A jump lies in its neighbours' predictions, too, with half of its size.
bool is_largest_nearby(const std::vector<Step>& steps, std::size_t i) {
  return steps[i].off_m >= steps[i - 1].off_m && steps[i].off_m > steps[i + 1].off_m;
}

std::string in_words(const std::string& antenna, const std::vector<PoseJump>& jumps) {
  const PoseJump& most =
      *std::max_element(jumps.begin(), jumps.end(),
                        [](const PoseJump& a, const PoseJump& b) { return a.size_m < b.size_m; });
  const std::string times =
      jumps.size() == 1 ? "jump" : fmt::format("jump {} times, at most", jumps.size());
  return fmt::format(
      "the poses of antenna '{}' {} by {:.2f} m, from {:.3f} s to {:.3f} s at ({:.2f}, {:.2f}): {}",
      antenna, times, most.size_m, to_seconds(most.from), to_seconds(most.to), most.p_WA.x(),
      most.p_WA.y(),
      most.is_relocation ? "it had not driven as far, so tags are located by the reads after it"
                         : "a tag is located by its reads on one side of it, and its size is in "
                           "the expected errors");
}

}  // namespace

std::vector<PoseJump> pose_jumps(const Trajectory& X_WA) {
  std::vector<PoseJump> jumps;
  const std::vector<Step> steps = steps_of(X_WA);
  const UsualStep usual = usual_step(steps);
  double driven_m = steps.empty() ? 0.0 : steps.front().way.norm();
  for (std::size_t i = 1; i + 1 < steps.size(); ++i) {
    const Step& step = steps[i];
    const double least_m = std::max({kLeast_m, driven_off(step, usual), kOverUsual * usual.off_m});
    if (!(step.off_m > least_m) || !is_largest_nearby(steps, i)) {
      driven_m += step.way.norm();
      continue;
    }
    const StampedPose& from = X_WA[i];
    const bool is_relocation = step.off_m > driven_m;
    jumps.push_back({from.stamp, X_WA[i + 1].stamp, step.off_m, from.X_WB.translation.head<2>(),
                     is_relocation});
    if (is_relocation) driven_m = 0.0;
  }
  return jumps;
}

void warn_of_pose_jumps(const std::string& antenna, const std::vector<PoseJump>& jumps,
                        Diagnostics& diagnostics) {
  if (!jumps.empty()) diagnostics.warn(in_words(antenna, jumps));
}

void warn_of_pose_jumps(const std::map<std::string, BelievedTrack>& tracks,
                        Diagnostics& diagnostics) {
  std::string antenna;
  std::vector<PoseJump> most;
  for (const auto& [name, track] : tracks) {
    std::vector<PoseJump> jumps = pose_jumps(track.X_WA);
    if (jumps.size() <= most.size()) continue;
    antenna = name;
    most = std::move(jumps);
  }
  warn_of_pose_jumps(antenna, most, diagnostics);
}

}  // namespace tagfield
