// SPDX-License-Identifier: Apache-2.0
/// @file
/// Ground truth as known to the simulator, separate from the reads: for evaluating estimates, never
/// for computing them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/poses/trajectory.h"

namespace tagfield {

/// The position of a tag from `stamp` on.
struct TagPosition {
  Time stamp;
  std::string tag;
  Eigen::Vector3d p_WT;  ///< [m]
};

/// The true distance of one read.
struct TrueDistance {
  Time stamp;
  std::string antenna;
  std::string tag;
  double distance_m = 0.0;
};

struct Truth {
  std::vector<AntennaPose> antenna_poses;  ///< A fixed antenna has one row.
  std::vector<AntennaPose> robot_poses;    ///< `antenna` holds the robot's name.
  std::vector<TagPosition> tag_positions;  ///< A tag at rest has one row, at its appearance.
  std::vector<TrueDistance> distances;     ///< One row per read, in the order of the reads.
};

}  // namespace tagfield
