// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "tagfield/localization/judgement.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {
namespace {

/// Timestamp between two points of a track, at a fraction of the interval.
Time stamp_between(const TrackPoint& a, const TrackPoint& b, double part) {
  return a.stamp + duration_from_seconds(part * to_seconds(b.stamp - a.stamp));
}

}  // namespace

std::optional<Passing> passing_of(const Track& track, const PassingLine& line) {
  const Eigen::Vector2d across(-std::sin(line.heading_rad), std::cos(line.heading_rad));
  for (std::size_t i = 1; i < track.points.size(); ++i) {
    const TrackPoint& before = track.points[i - 1];
    const TrackPoint& point = track.points[i];
    const double away_before = across.dot(before.p_WT.head<2>() - line.point);
    const double away = across.dot(point.p_WT.head<2>() - line.point);
    if ((away_before < 0.0) == (away < 0.0)) continue;
    const double speed = std::abs(across.dot(point.v_WT.head<2>()));
    if (speed <= 0.0) return std::nullopt;
    const double variance = across.dot(point.covariance.topLeftCorner<2, 2>() * across);
    return Passing{"", stamp_between(before, point, away_before / (away_before - away)),
                   std::sqrt(std::max(0.0, variance)) / speed};
  }
  return std::nullopt;
}

std::optional<Passing> nearest_of(const Track& track, const Eigen::Vector3d& place) {
  std::optional<Passing> nearest;
  double least = std::numeric_limits<double>::infinity();
  // A tag that stands still seems to come and go by its noise.
  for (std::size_t i = 1; i < track.points.size(); ++i) {
    const TrackPoint& before = track.points[i - 1];
    const TrackPoint& point = track.points[i];
    const double leaves = (point.p_WT - place).dot(point.v_WT);
    const double left_before = (before.p_WT - place).dot(before.v_WT);
    const double square = point.v_WT.squaredNorm();
    if (left_before >= 0.0 || leaves < 0.0 || square <= 0.0) continue;
    const double part = left_before / (left_before - leaves);
    const Eigen::Vector3d p_WT = before.p_WT + part * (point.p_WT - before.p_WT);
    if ((p_WT - place).norm() >= least) continue;
    least = (p_WT - place).norm();
    Vector6d slope;
    slope << point.v_WT, p_WT - place;
    slope /= square;
    nearest = Passing{"", stamp_between(before, point, part),
                      std::sqrt(std::max(0.0, slope.dot(point.covariance * slope)))};
  }
  return nearest;
}

std::vector<PassingOrder> passing_orders(const LocalizationProblem& problem,
                                         const std::vector<TagTrack>& tracks,
                                         const std::optional<PassingLine>& line) {
  std::vector<PassingOrder> orders;
  const auto add = [&](const std::string& name, const auto& passing) {
    PassingOrder order{name, {}};
    for (const TagTrack& tag : tracks) {
      if (tag.verdict != TrackVerdict::kTracked) continue;
      std::optional<Passing> one = passing(tag.tracks.front());
      if (!one) continue;
      one->tag = tag.tag;
      order.passings.push_back(*one);
    }
    std::stable_sort(order.passings.begin(), order.passings.end(),
                     [](const Passing& a, const Passing& b) { return a.stamp < b.stamp; });
    orders.push_back(std::move(order));
  };
  if (line) add("line", [&](const Track& track) { return passing_of(track, *line); });
  for (const auto& [antenna, believed] : problem.tracks) {
    if (believed.X_WA.empty()) continue;
    const Eigen::Vector3d place = believed.X_WA.front().X_WB.translation;
    const bool still =
        std::all_of(believed.X_WA.begin(), believed.X_WA.end(), [&](const StampedPose& pose) {
          return (pose.X_WB.translation - place).norm() < kStillExtent;
        });
    if (still) add(antenna, [&](const Track& track) { return nearest_of(track, place); });
  }
  return orders;
}

double probability_before(const Passing& first, const Passing& second) {
  const double sigma = std::hypot(first.sigma_s, second.sigma_s);
  const double gap = to_seconds(second.stamp - first.stamp);
  if (sigma <= 0.0) return gap > 0.0 ? 1.0 : 0.5;
  return 0.5 * std::erfc(-gap / sigma / std::sqrt(2.0));
}

}  // namespace tagfield
