// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/seeds.h"

#include <algorithm>
#include <cmath>

namespace tagfield {
namespace {

/// Maximum distance of a guess from the antenna's path [m]; passive tags are read within about 15
/// m.
constexpr double kFarthest = 40.0;
/// Enough curves for some well-conditioned intersections.
constexpr std::size_t kFewConics = 8;
constexpr double kShortestStride = 0.04;  // [m]

ConicGroup conics_of(const PhaseSegment& segment, double stride) {
  ConicGroup group;
  const Eigen::Vector3d& focus = segment.samples.front().p_WA;
  Eigen::Vector3d last = focus;
  for (std::size_t i = 1; i < segment.samples.size(); ++i) {
    const Eigen::Vector3d& here = segment.samples[i].p_WA;
    if ((here - last).norm() < stride) continue;
    last = here;
    const Conic conic{focus, here - focus, segment.distance_m[i]};
    if (is_usable(conic) && conic.baseline.norm() >= 0.5 * stride) group.push_back(conic);
  }
  return group;
}

std::vector<ConicGroup> conics_at(const std::vector<PhaseSegment>& segments, double stride) {
  std::vector<ConicGroup> groups;
  for (const PhaseSegment& segment : segments) {
    ConicGroup group = conics_of(segment, stride);
    if (!group.empty()) groups.push_back(std::move(group));
  }
  return groups;
}

std::size_t count_of(const std::vector<ConicGroup>& groups) {
  std::size_t count = 0;
  for (const ConicGroup& group : groups) count += group.size();
  return count;
}

/// Keeps `max_conics` of all, evenly spread: long segments get a wider stride, and short ones are
/// not lost.
void thin_out(std::vector<ConicGroup>& groups, std::size_t max_conics) {
  const std::size_t all = count_of(groups);
  if (all <= max_conics) return;
  std::size_t index = 0;
  for (ConicGroup& group : groups) {
    ConicGroup kept;
    for (const Conic& conic : group) {
      const std::size_t i = index++;
      if (i * max_conics / all != (i + 1) * max_conics / all) kept.push_back(conic);
    }
    group = std::move(kept);
  }
}

void intersect_group(const ConicGroup& group, double height, std::vector<Eigen::Vector2d>& points) {
  for (std::size_t i = 1; i < group.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) intersect_common_focus(group[i], group[j], height, points);
  }
}

void intersect_groups(const std::vector<TracedConic>& traced, const ConicGroup& others,
                      double height, std::vector<Eigen::Vector2d>& points) {
  for (const TracedConic& a : traced) {
    for (const Conic& b : others) intersect_traced(a, b, height, points);
  }
}

}  // namespace

std::vector<ConicGroup> make_conics(const std::vector<PhaseSegment>& segments, double stride,
                                    std::size_t max_conics) {
  std::vector<ConicGroup> groups = conics_at(segments, stride);
  while (count_of(groups) < kFewConics && stride > kShortestStride) {
    stride *= 0.6;
    groups = conics_at(segments, stride);
  }
  thin_out(groups, max_conics);
  return groups;
}

std::vector<Eigen::Vector2d> intersect_all(const std::vector<ConicGroup>& groups, double height) {
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    intersect_group(groups[i], height, points);
    if (i + 1 == groups.size()) break;
    std::vector<TracedConic> traced;
    for (const Conic& conic : groups[i]) traced.push_back(trace(conic, height));
    for (std::size_t j = i + 1; j < groups.size(); ++j) {
      intersect_groups(traced, groups[j], height, points);
    }
  }
  return points;
}

std::vector<Guess> rank(const TagPhases& phases, double height,
                        const std::vector<Eigen::Vector2d>& points) {
  const Eigen::Vector2d middle(phases.x.mean(), phases.y.mean());
  const double spread =
      ((phases.x - middle.x()).square() + (phases.y - middle.y()).square()).sqrt().maxCoeff();
  std::vector<Guess> ranked;
  ranked.reserve(points.size());
  for (const Eigen::Vector2d& p : points) {
    // Written so that a NaN fails the test.
    if (!((p - middle).norm() < kFarthest + spread)) continue;
    ranked.push_back({p, sum_of_squares(phases, height, p)});
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Guess& a, const Guess& b) {
    return a.sum_of_squares < b.sum_of_squares;
  });
  return ranked;
}

std::vector<Eigen::Vector2d> best_distinct(const std::vector<Guess>& ranked, std::size_t count,
                                           double apart) {
  std::vector<Eigen::Vector2d> best;
  for (const Guess& guess : ranked) {
    if (best.size() >= count) break;
    const bool is_new = std::none_of(best.begin(), best.end(), [&](const Eigen::Vector2d& p) {
      return (p - guess.p).norm() < apart;
    });
    if (is_new) best.push_back(guess.p);
  }
  return best;
}

}  // namespace tagfield
