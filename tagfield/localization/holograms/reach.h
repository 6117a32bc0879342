// SPDX-License-Identifier: Apache-2.0
/// @file
/// Area in which a tag could have been read.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tagfield/localization/tag_phases.h"

namespace tagfield {

/// Region within range of the antennas of at least half of the reads, of which about sixty are
/// sampled. Some reads come from further away, due to strong readers and reflections.
class Reach {
 public:
  /// `max_range` [m].
  Reach(const TagPhases& phases, double max_range);

  [[nodiscard]] bool holds(const Eigen::Vector3d& p) const;
  [[nodiscard]] const std::vector<Eigen::Vector3d>& antennas() const { return antennas_; }
  [[nodiscard]] double max_range() const { return max_range_; }

 private:
  std::vector<Eigen::Vector3d> antennas_;  ///< At the sampled reads.
  double max_range_;
};

/// A Reach for many points (x, y, height).
class PlaneInReach {
 public:
  PlaneInReach(const TagPhases& phases, double height, double max_range);

  /// Which points of a surrounding are in reach. `kMixed` may also be all or none.
  enum class Part { kNone, kAll, kMixed };
  /// The points within some radius of a point.
  struct Surrounding {
    Part part = Part::kMixed;
    std::size_t beyond = 0;  ///< Number of antennas that have none of the points in range.
    std::vector<Eigen::Vector3d> undecided;  ///< Antennas that may have some in range.
  };
  /// Surrounding of `middle` with `radius` [m].
  [[nodiscard]] Surrounding around(const Eigen::Vector2d& middle, double radius) const;

  /// Whether `p`, a point of the surrounding, is in reach.
  [[nodiscard]] bool holds(const Surrounding& of, const Eigen::Vector2d& p) const;

 private:
  Reach reach_;
  double height_;
};

}  // namespace tagfield
