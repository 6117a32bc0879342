// SPDX-License-Identifier: Apache-2.0
/// @file
/// What the messages of a bag say, checked and as plain structs, not yet joined.
#pragma once

#include <functional>
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

/// Gets what a bag has by the million, in the order of receipt.
struct BagReadSink {
  std::function<void(TagRead&&, const std::string& frame)> on_read;  ///< Phases as recorded.
  std::function<void(TrueDistance&&)> on_distance;
  std::function<void()> on_reset;  ///< Nothing that came before counts.
  bool alone = false;              ///< Nothing else of the bag is kept.
};

/// In the order of receipt, but for what `sink` gets.
struct BagContent {
  explicit BagContent(const BagReadSink& takes_reads) : sink(&takes_reads) {}

  /// To be called after each message: where the sink is alone, keeps the clock alone.
  void forget_unwanted() {
    if (!sink->alone) return;
    updates.clear();
    transforms.clear();
    given_poses.clear();
    truth = {};
  }

  const BagReadSink* sink;
  std::vector<RecordedUpdate> updates;  ///< Of messages; the reads in one may have other stamps.
  std::vector<StampedTransform> transforms;
  std::vector<AntennaPose> given_poses;  ///< Those that came with a TagArray's reads.
  Truth truth;                           ///< Without distances.
  std::string truth_frame;               ///< Of antennas, or "".
  std::map<std::string, Time> clock;     ///< Latest stamp of each stream, to notice a reset.
};

}  // namespace tagfield
