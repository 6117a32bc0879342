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

/// Whether a tag at `p` would be within `max_range` [m] of the antennas at half of the reads, of
/// which about sixty are looked at. Strong readers and reflections carry some reads further.
bool in_reach(const TagPhases& phases, const Eigen::Vector3d& p, double max_range);

/// in_reach() of many places (x, y, height): squares of the plane whose places are all alike are
/// looked at once.
class PlaneInReach {
 public:
  PlaneInReach(const TagPhases& phases, double height, double max_range);

  bool holds(const Eigen::Vector2d& p);

 private:
  enum class Square { kNone, kAll, kMixed };
  [[nodiscard]] Square square_around(const Eigen::Vector2d& middle) const;

  std::vector<Eigen::Vector3d> antennas_;  ///< At the reads that are looked at.
  double height_;
  double max_range_;
  std::map<std::pair<int, int>, Square> squares_;
  std::pair<int, int> last_{0, 0};  ///< Places come row by row.
  const Square* of_last_ = nullptr;
};

}  // namespace tagfield
