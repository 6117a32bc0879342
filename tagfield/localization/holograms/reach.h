// SPDX-License-Identifier: Apache-2.0
/// @file
/// The area where a tag could have been read.
#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>
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

/// A Reach for many places (x, y, height): squares of the plane whose places are all alike are
/// looked at once.
class PlaneInReach {
 public:
  PlaneInReach(const TagPhases& phases, double height, double max_range);

  bool holds(const Eigen::Vector2d& p);

 private:
  enum class Square { kNone, kAll, kMixed };
  [[nodiscard]] Square square_around(const Eigen::Vector2d& middle) const;

  Reach reach_;
  double height_;
  std::map<std::pair<int, int>, Square> squares_;
  std::pair<int, int> last_{0, 0};  ///< Places come row by row.
  const Square* of_last_ = nullptr;
};

}  // namespace tagfield
