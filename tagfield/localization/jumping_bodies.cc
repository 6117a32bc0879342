// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/jumping_bodies.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "tagfield/localization/joint/pose_knots.h"
#include "tagfield/localization/map_error.h"

namespace tagfield {
namespace {

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

void warn_of_pose_jumps(const std::vector<JumpingBody>& bodies, Diagnostics& diagnostics) {
  const auto most = std::max_element(
      bodies.begin(), bodies.end(),
      [](const JumpingBody& a, const JumpingBody& b) { return a.jumps.size() < b.jumps.size(); });
  if (most != bodies.end()) {
    warn_of_pose_jumps(most->antennas.front(), most->jumps, diagnostics);
  }
}

}  // namespace tagfield
