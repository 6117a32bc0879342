// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/polyline.h"

#include <algorithm>

namespace tagfield {

Polyline::Polyline(const std::vector<Eigen::Vector2d>& points) {
  for (const Eigen::Vector2d& point : points) {
    const double length = empty() ? 0.0 : (point - points_.back()).norm();
    if (!empty() && length < 1e-9) continue;
    along_.push_back(length_m() + length);
    points_.push_back(point);
  }
}

Eigen::Vector2d Polyline::at(double along_m) const {
  const auto after = std::upper_bound(along_.begin(), along_.end(), along_m);
  if (after == along_.end()) return points_.back();
  if (after == along_.begin()) return points_.front();
  const auto end = static_cast<std::size_t>(after - along_.begin());
  const double share = (along_m - along_[end - 1]) / (along_[end] - along_[end - 1]);
  return points_[end - 1] + share * (points_[end] - points_[end - 1]);
}

Polyline::Foot Polyline::nearest(const Eigen::Vector2d& p, double from_m, double to_m) const {
  const double first = std::clamp(from_m, 0.0, length_m());
  const double last = std::clamp(to_m, first, length_m());
  Foot best{first, (at(first) - p).norm()};
  for (std::size_t i = 1; i < points_.size(); ++i) {
    if (along_[i] < first || along_[i - 1] > last) continue;
    const Eigen::Vector2d direction = (points_[i] - points_[i - 1]) / (along_[i] - along_[i - 1]);
    const double along = along_[i - 1] + (p - points_[i - 1]).dot(direction);
    const double nearest =
        std::clamp(along, std::max(first, along_[i - 1]), std::min(last, along_[i]));
    const double distance = (points_[i - 1] + (nearest - along_[i - 1]) * direction - p).norm();
    if (distance < best.distance_m) best = {nearest, distance};
  }
  return best;
}

std::vector<Eigen::Vector2d> Polyline::between(double from_m, double to_m) const {
  if (empty()) return {};
  std::vector<Eigen::Vector2d> part = {at(from_m)};
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (along_[i] > from_m && along_[i] < to_m) part.push_back(points_[i]);
  }
  if (to_m > from_m) part.push_back(at(to_m));
  return part;
}

}  // namespace tagfield
