// SPDX-License-Identifier: Apache-2.0
/// @file
/// A path on the floor, parametrized by arc length.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tagfield {

/// Straight segments between points [m].
class Polyline {
 public:
  /// The point of a polyline nearest to a given point.
  struct Foot {
    double along_m = 0.0;     ///< From the start.
    double distance_m = 0.0;  ///< From the given point.
  };

  Polyline() = default;
  /// Points equal to their predecessor are skipped.
  explicit Polyline(const std::vector<Eigen::Vector2d>& points);

  [[nodiscard]] bool empty() const { return points_.empty(); }
  [[nodiscard]] double length_m() const { return empty() ? 0.0 : along_.back(); }
  [[nodiscard]] const std::vector<Eigen::Vector2d>& points() const { return points_; }
  /// The point at `along_m` from the start, clamped to the ends. The polyline must not be empty.
  [[nodiscard]] Eigen::Vector2d at(double along_m) const;
  /// The foot of `p` on the section between `from_m` and `to_m`. The polyline must not be empty.
  [[nodiscard]] Foot nearest(const Eigen::Vector2d& p, double from_m, double to_m) const;
  /// The section between two positions, both included.
  [[nodiscard]] std::vector<Eigen::Vector2d> between(double from_m, double to_m) const;

 private:
  std::vector<Eigen::Vector2d> points_;
  std::vector<double> along_;  ///< Arc length at each point.
};

}  // namespace tagfield
