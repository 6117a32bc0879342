// SPDX-License-Identifier: Apache-2.0
/// @file
/// Believed poses of antennas from the transforms (tf) of a bag.
#pragma once

#include <string>
#include <vector>

#include "adapters/bags/bag_content.h"

namespace tagfield {

/// Antenna poses in one fixed frame.
struct TransformedPoses {
  std::string frame;   ///< The fixed frame, "" if none can express the antennas.
  std::string source;  ///< "odometry" if based on a frame "odom" and no "map", else "tf".
  /// One per update for which a pose is known, by stamp; none in gaps of over 0.5 s between
  /// transforms that moved the antenna.
  std::vector<AntennaPose> poses;
};

/// The poses of the antennas at their updates, interpolated at exactly those stamps as tf2 does it,
/// in the first of `frames` that can express every antenna with a frame known to tf in at least
/// half of its updates; if there is none, in the frame that can express most. `updates` must be in
/// chronological order.
TransformedPoses poses_from_transforms(std::vector<StampedTransform> transforms,
                                       const std::vector<RecordedUpdate>& updates,
                                       const std::vector<std::string>& frames);

}  // namespace tagfield
