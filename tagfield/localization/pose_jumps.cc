// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/pose_jumps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "tagfield/localization/joint/pose_knots.h"
#include "tagfield/localization/map_error.h"

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

/// Jumps in order of time, those that overlap as one.
std::vector<PoseJump> apart(std::vector<PoseJump> jumps) {
  std::sort(jumps.begin(), jumps.end(),
            [](const PoseJump& a, const PoseJump& b) { return a.from < b.from; });
  std::vector<PoseJump> merged;
  merged.reserve(jumps.size());
  for (const PoseJump& jump : jumps) {
    if (merged.empty() || jump.from >= merged.back().to) {
      merged.push_back(jump);
      continue;
    }
    merged.back().to = std::max(merged.back().to, jump.to);
    merged.back().size_m = std::max(merged.back().size_m, jump.size_m);
    merged.back().is_relocation = merged.back().is_relocation || jump.is_relocation;
  }
  return merged;
}

/// Number of jumps before a stamp; none amid a jump.
std::optional<std::size_t> side_of(const std::vector<PoseJump>& jumps, Time stamp) {
  const auto next = std::partition_point(jumps.begin(), jumps.end(),
                                         [&](const PoseJump& jump) { return jump.to <= stamp; });
  if (next != jumps.end() && next->from < stamp) return std::nullopt;
  return static_cast<std::size_t>(next - jumps.begin());
}

/// Number of reads on each side of a body's jumps.
using ReadsBySide = std::vector<std::size_t>;

ReadsBySide reads_by_side(const JumpingBody& body, const SamplesOfTag& samples) {
  ReadsBySide reads(body.jumps.size() + 1, 0);
  for (const std::string& antenna : body.antennas) {
    const auto series = samples.find(antenna);
    if (series == samples.end()) continue;
    for (const PhaseSample& sample : series->second) {
      const auto side = side_of(body.jumps, sample.stamp);
      if (side) ++reads[*side];
    }
  }
  return reads;
}

ReadsBySide reads_by_side(const JumpingBody& body, const SamplesByTag& samples) {
  ReadsBySide all(body.jumps.size() + 1, 0);
  for (const auto& [tag, of_tag] : samples) {
    const ReadsBySide reads = reads_by_side(body, of_tag);
    std::transform(all.begin(), all.end(), reads.begin(), all.begin(), std::plus<>());
  }
  return all;
}

/// Number of the jumps until the last relocation.
std::size_t until_relocation(const std::vector<PoseJump>& jumps) {
  const auto last = std::find_if(jumps.rbegin(), jumps.rend(),
                                 [](const PoseJump& jump) { return jump.is_relocation; });
  return static_cast<std::size_t>(jumps.rend() - last);
}

/// The jumps from number `begin` on with reads before and after them.
std::vector<PoseJump> jumps_amid(const ReadsBySide& reads, const std::vector<PoseJump>& jumps,
                                 std::size_t begin) {
  std::vector<PoseJump> amid;
  for (std::size_t i = begin; i < jumps.size(); ++i) {
    const auto middle = reads.begin() + static_cast<std::ptrdiff_t>(i + 1);
    const auto has_any = [](std::size_t count) { return count > 0; };
    if (std::any_of(reads.begin() + static_cast<std::ptrdiff_t>(begin), middle, has_any) &&
        std::any_of(middle, reads.end(), has_any)) {
      amid.push_back(jumps[i]);
    }
  }
  return amid;
}

/// Nothing shows which side is right. Where half of the reads are elsewhere, a tag may be off by a
/// whole jump; the fewer are, the less likely the frame is theirs.
double chance_of_other_frame(double share_here) { return std::min(1.0, 2.0 * (1.0 - share_here)); }

double mean_square(const std::vector<PoseJump>& jumps) {
  const double sum = std::accumulate(
      jumps.begin(), jumps.end(), 0.0,
      [](double so_far, const PoseJump& jump) { return so_far + jump.size_m * jump.size_m; });
  return sum / static_cast<double>(jumps.size());
}

void keep_side(const JumpingBody& body, std::size_t side, SamplesOfTag& samples) {
  for (const std::string& antenna : body.antennas) {
    const auto found = samples.find(antenna);
    if (found == samples.end()) continue;
    std::vector<PhaseSample>& series = found->second;
    series.erase(std::remove_if(series.begin(), series.end(),
                                [&](const PhaseSample& sample) {
                                  return side_of(body.jumps, sample.stamp) != side;
                                }),
                 series.end());
    if (series.empty()) samples.erase(found);
  }
}

/// What the sides of a body's jumps are worth.
class Sides {
 public:
  Sides(const JumpingBody& body, const SamplesByTag& samples)
      : jumps_(body.jumps),
        reads_(reads_by_side(body, samples)),
        first_(until_relocation(jumps_)),
        amid_(jumps_amid(reads_, jumps_, first_)) {}

  /// The side with most of a tag's reads, after the relocation if there are any.
  [[nodiscard]] std::size_t of_most(const ReadsBySide& reads) const {
    const auto valid = reads.begin() + static_cast<std::ptrdiff_t>(first_);
    const auto after = std::max_element(valid, reads.end());
    const auto most = *after > 0 ? after : std::max_element(reads.begin(), reads.end());
    return static_cast<std::size_t>(most - reads.begin());
  }
  [[nodiscard]] double deviation_m(std::size_t side) const {
    if (side < first_) return jumps_[first_ - 1].size_m;
    if (amid_.empty()) return 0.0;
    const auto valid = reads_.begin() + static_cast<std::ptrdiff_t>(first_);
    const auto count = std::accumulate(valid, reads_.end(), std::size_t{0});
    const double here = static_cast<double>(reads_[side]) / static_cast<double>(count);
    return std::sqrt(chance_of_other_frame(here) * mean_square(amid_));
  }
  /// Those with reads before and after them.
  [[nodiscard]] std::vector<PoseJump> jumps_to_tell() const {
    return jumps_amid(reads_, jumps_, 0);
  }

 private:
  const std::vector<PoseJump>& jumps_;
  ReadsBySide reads_;
  std::size_t first_;  ///< Side from which on there is no relocation.
  std::vector<PoseJump> amid_;
};

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

void warn_of_pose_jumps(const std::vector<JumpingBody>& bodies, Diagnostics& diagnostics) {
  const auto most = std::max_element(
      bodies.begin(), bodies.end(),
      [](const JumpingBody& a, const JumpingBody& b) { return a.jumps.size() < b.jumps.size(); });
  if (most != bodies.end()) diagnostics.warn(in_words(most->antennas.front(), most->jumps));
}

std::vector<JumpingBody> jumping_bodies(const LocalizationProblem& problem) {
  std::vector<JumpingBody> jumping;
  for (Body& body : bodies_of(problem)) {
    std::vector<PoseJump> all;
    for (const std::string& antenna : body.antennas) {
      const std::vector<PoseJump> jumps = pose_jumps(problem.tracks.at(antenna).X_WA);
      all.insert(all.end(), jumps.begin(), jumps.end());
    }
    if (!all.empty()) jumping.push_back({std::move(body.antennas), apart(std::move(all))});
  }
  return jumping;
}

std::map<std::string, double> keep_one_side(std::vector<JumpingBody>& bodies,
                                            SamplesByTag& samples) {
  std::map<std::string, double> deviations;
  for (JumpingBody& body : bodies) {
    const Sides sides(body, samples);
    for (auto& [tag, of_tag] : samples) {
      const ReadsBySide reads = reads_by_side(body, of_tag);
      const std::size_t side = sides.of_most(reads);
      keep_side(body, side, of_tag);
      const double deviation_m = reads[side] > 0 ? sides.deviation_m(side) : 0.0;
      if (deviation_m <= 0.0) continue;
      double& largest_m = deviations[tag];
      largest_m = std::max(largest_m, deviation_m);
    }
    body.jumps = sides.jumps_to_tell();
  }
  bodies.erase(std::remove_if(bodies.begin(), bodies.end(),
                              [](const JumpingBody& body) { return body.jumps.empty(); }),
               bodies.end());
  return deviations;
}

void add_pose_jumps(const LocalizationProblem& problem, LocalizationResult& result) {
  if (problem.pose_jump_m.empty()) return;
  const auto of_jumps = [&](const std::string& tag, const Eigen::Vector2d&) {
    const auto found = problem.pose_jump_m.find(tag);
    const double deviation = found == problem.pose_jump_m.end() ? 0.0 : found->second;
    return Eigen::Matrix2d(0.5 * deviation * deviation * Eigen::Matrix2d::Identity());
  };
  add_shifts(problem, "a jump of the poses", of_jumps, result);
}

}  // namespace tagfield
