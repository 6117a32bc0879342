// SPDX-License-Identifier: Apache-2.0
/// @file
/// Poses as tf2 itself finds them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/bags/bag_content.h"

namespace tagfield {

/// X_FB of frame B in frame F at `stamp` > 0, by tf2's buffer filled with all transforms; none
/// where tf2 refuses.
std::optional<RigidTransform> tf2_lookup(const std::vector<StampedTransform>& transforms,
                                         const std::string& F, const std::string& B, Time stamp);

}  // namespace tagfield
