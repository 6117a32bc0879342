// SPDX-License-Identifier: Apache-2.0
/// @file
/// The area where a tag could have been read.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/localization/tag_phases.h"

namespace tagfield {

/// The places that are within a range of the antennas at half of the reads, of which about sixty
/// are looked at. Strong readers and reflections carry some reads further.
class Reach {
 public:
  /// `max_range` [m].
  Reach(const TagPhases& phases, double max_range);

  [[nodiscard]] bool holds(const Eigen::Vector3d& p) const;
  [[nodiscard]] const std::vector<Eigen::Vector3d>& antennas() const { return antennas_; }
  [[nodiscard]] double max_range() const { return max_range_; }

 private:
  std::vector<Eigen::Vector3d> antennas_;  ///< At the reads that are looked at.
  double max_range_;
};

/// A Reach for many places (x, y, height).
class PlaneInReach {
 public:
  PlaneInReach(const TagPhases& phases, double height, double max_range);

  [[nodiscard]] bool holds(const Eigen::Vector2d& p) const;

  /// How many of the places about another it holds. `kMixed` may be all or none, too.
  enum class Part { kNone, kAll, kMixed };
  /// Of those up to `radius` from `middle` [m].
  [[nodiscard]] Part part_around(const Eigen::Vector2d& middle, double radius) const;

 private:
  Reach reach_;
  double height_;
};

}  // namespace tagfield
