// SPDX-License-Identifier: Apache-2.0
/// @file
/// A way on the floor, by the length along it.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tagfield {

/// Straight pieces between points [m].
class Polyline {
 public:
  /// The place on a polyline nearest to a point.
  struct Foot {
    double along_m = 0.0;     ///< From the start.
    double distance_m = 0.0;  ///< From the point.
  };

  Polyline() = default;
  /// Points that repeat the one before are left out.
  explicit Polyline(const std::vector<Eigen::Vector2d>& points);

  [[nodiscard]] bool empty() const { return points_.empty(); }
  [[nodiscard]] double length_m() const { return empty() ? 0.0 : along_.back(); }
  [[nodiscard]] const std::vector<Eigen::Vector2d>& points() const { return points_; }
  /// The point `along_m` from the start; the ends beyond them. Not for an empty one.
  [[nodiscard]] Eigen::Vector2d at(double along_m) const;
  /// The foot of `p` among the places between `from_m` and `to_m`. Not for an empty one.
  [[nodiscard]] Foot nearest(const Eigen::Vector2d& p, double from_m, double to_m) const;
  /// The points between two places, with both.
  [[nodiscard]] std::vector<Eigen::Vector2d> between(double from_m, double to_m) const;

 private:
  std::vector<Eigen::Vector2d> points_;
  std::vector<double> along_;  ///< Of the points.
};

}  // namespace tagfield
