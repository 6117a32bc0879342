// SPDX-License-Identifier: Apache-2.0
/// @file
/// The area where a tag could have been read.
#pragma once

#include <Eigen/Core>
#include <cstddef>
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

  /// How many places of a surrounding are in reach. `kMixed` may be all or none, too.
  enum class Part { kNone, kAll, kMixed };
  /// The places up to some radius from one.
  struct Surrounding {
    Part part = Part::kMixed;
    std::size_t beyond = 0;  ///< Antennas whose range ends before all of the places.
    std::vector<Eigen::Vector3d> undecided;  ///< Those whose range may end between them.
  };
  /// Of `middle`, up to `radius` [m].
  [[nodiscard]] Surrounding around(const Eigen::Vector2d& middle, double radius) const;

  /// Whether `p`, which is in the surrounding, is in reach.
  [[nodiscard]] bool holds(const Surrounding& of, const Eigen::Vector2d& p) const;

 private:
  Reach reach_;
  double height_;
};

}  // namespace tagfield
