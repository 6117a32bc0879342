// SPDX-License-Identifier: Apache-2.0
/// @file
/// What the messages of a bag say, checked and as plain structs, not yet joined.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/stream/tag_read.h"
#include "tagfield/stream/truth.h"

namespace tagfield {

/// An antenna looked for tags then, and may have read some.
struct RecordedUpdate {
  Time stamp;
  std::string antenna;
  std::string frame;  ///< The antenna's, in tf; may be "".
};

/// The pose of frame C in its parent P.
struct StampedTransform {
  Time stamp;
  std::string parent;
  std::string child;
  RigidTransform X_PC;
  bool is_static = false;  ///< Holds at all times.
};

/// In the order of receipt.
struct BagContent {
  std::vector<TagRead> reads;  ///< Phases as recorded.
  std::vector<RecordedUpdate> updates;
  std::vector<StampedTransform> transforms;
  std::vector<AntennaPose> given_poses;  ///< Those that came with a TagArray's reads.
  Truth truth;
  std::string truth_frame;            ///< Of antennas, or "".
  std::map<std::string, Time> clock;  ///< Latest stamp of each stream, to notice a reset.
};

}  // namespace tagfield
