// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where antennas were believed to be, by the transforms (tf) of a bag.
#pragma once

#include <string>
#include <vector>

#include "adapters/ros1/bag_content.h"

namespace tagfield {

/// Antenna poses in one fixed frame.
struct TransformedPoses {
  std::string frame;   ///< The fixed frame, "" where none can express the antennas.
  std::string source;  ///< "odometry" where they rest on a frame "odom" alone, else "tf".
  std::vector<AntennaPose> poses;  ///< One for each update that has one, by stamp.
};

/// The poses of the antennas at their updates, as tf2 interpolates them at exactly those stamps, in
/// the first of `frames` that can express every antenna whose frame tf knows in half of its updates
/// or more; where none can, in the one that can express most. `updates` must be in order of time.
TransformedPoses poses_from_transforms(std::vector<StampedTransform> transforms,
                                       const std::vector<RecordedUpdate>& updates,
                                       const std::vector<std::string>& frames);

}  // namespace tagfield
