// SPDX-License-Identifier: Apache-2.0
/// @file
/// Contents of a bag's messages, checked and converted to plain structs, but not yet combined.
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

/// An update of an antenna, in which it may have read tags.
struct RecordedUpdate {
  Time stamp;
  std::string antenna;
  std::string frame;  ///< The antenna's frame in tf; may be "".
};

/// The pose of frame C in its parent P.
struct StampedTransform {
  Time stamp;
  std::string parent;
  std::string child;
  RigidTransform X_PC;
  bool is_static = false;  ///< Valid at all times.
};

/// Receives what a bag contains by the million, in order of receipt.
struct BagReadSink {
  std::function<void(TagRead&&, const std::string& frame)> on_read;  ///< Phases as recorded.
  std::function<void(TrueDistance&&)> on_distance;
  std::function<void()> on_reset;  ///< Everything received before is invalid.
  bool alone = false;              ///< Nothing else from the bag is kept.
};

/// In order of receipt, except for what `sink` receives.
struct BagContent {
  explicit BagContent(const BagReadSink& takes_reads) : sink(&takes_reads) {}

  /// To be called after each message: if the sink is alone, keeps only the clock.
  void forget_unwanted() {
    if (!sink->alone) return;
    updates.clear();
    transforms.clear();
    given_poses.clear();
    truth = {};
  }

  const BagReadSink* sink;
  std::vector<RecordedUpdate> updates;  ///< One per message, whose reads may have other stamps.
  std::vector<StampedTransform> transforms;
  std::vector<AntennaPose> given_poses;  ///< From a TagArray's reads.
  Truth truth;                           ///< Without distances.
  std::string truth_frame;               ///< Of antennas, or "".
  std::map<std::string, Time> clock;     ///< Latest stamp of each stream, to detect a reset.
};

}  // namespace tagfield
