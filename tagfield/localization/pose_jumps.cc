// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/pose_jumps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tagfield {
namespace {

constexpr double kLeast_m = 0.03;
constexpr double kOverDriven = 1.5;
constexpr double kOverUsual = 3.0;
constexpr double kUsual = 0.95;  ///< Share of the steps.
constexpr double kMoves = 1e-3;  ///< Shorter steps are none [m].
/// Fewer steps show no usual ones.
constexpr std::size_t kFewestSteps = 20;

struct Step {
  double seconds = 0.0;
  Eigen::Vector2d way = Eigen::Vector2d::Zero();  ///< [m]
  double off_m = 0.0;                             ///< From where the neighbours' motion leads.
};

std::vector<Step> steps_of(const Trajectory& X_WA) {
  std::vector<Step> steps;
  for (std::size_t i = 1; i < X_WA.size(); ++i) {
    const StampedPose& from = X_WA[i - 1];
    const StampedPose& to = X_WA[i];
    steps.push_back({to_seconds(to.stamp - from.stamp),
                     (to.X_WB.translation - from.X_WB.translation).head<2>(), 0.0});
  }
  for (std::size_t i = 1; i + 1 < steps.size(); ++i) {
    const Eigen::Vector2d velocity =
        0.5 * (steps[i - 1].way / steps[i - 1].seconds + steps[i + 1].way / steps[i + 1].seconds);
    steps[i].off_m = (steps[i].way - steps[i].seconds * velocity).norm();
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
      "the poses of antenna '{}' {} by {:.2f} m, from {:.3f} s to {:.3f} s at ({:.2f}, {:.2f}): "
      "positions of tags that were read before and after it may be off by as much, which is not in "
      "the expected errors",
      antenna, times, most.size_m, to_seconds(most.from), to_seconds(most.to), most.p_WA.x(),
      most.p_WA.y());
}

}  // namespace

std::vector<PoseJump> pose_jumps(const Trajectory& X_WA) {
  std::vector<PoseJump> jumps;
  const std::vector<Step> steps = steps_of(X_WA);
  const UsualStep usual = usual_step(steps);
  for (std::size_t i = 1; i + 1 < steps.size(); ++i) {
    const Step& step = steps[i];
    const double least_m = std::max(
        {kLeast_m, kOverDriven * usual.speed_m_s * step.seconds, kOverUsual * usual.off_m});
    if (!(step.off_m > least_m) || !is_largest_nearby(steps, i)) continue;
    const StampedPose& from = X_WA[i];
    jumps.push_back({from.stamp, X_WA[i + 1].stamp, step.off_m, from.X_WB.translation.head<2>()});
  }
  return jumps;
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
  if (!most.empty()) diagnostics.warn(in_words(antenna, most));
}

}  // namespace tagfield
