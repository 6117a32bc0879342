// SPDX-License-Identifier: Apache-2.0
/// @file
/// The reads of a recording of ROS, in memory as long as there are not too many, and else told
/// anew.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adapters/ros1/bag_content.h"
#include "adapters/ros1/bag_recording.h"

namespace tagfield {

/// Goes through a bag of ROS 1 or a recording of ROS 2, as often as it is called.
using GoThrough = std::function<BagContent(
    const BagReadSink& sink, const std::function<void(double)>& on_progress, Diagnostics&)>;

/// Holds reads and distances as long as each are no more than `most`; of more reads it has an
/// overview.
class HeldReads {
 public:
  explicit HeldReads(std::size_t most) : most_(most) {}

  /// What goes through a recording gives reads to; this must outlive it.
  [[nodiscard]] BagReadSink sink();

  /// Moves them to where they belong.
  void give(BagContent& content, BagRecording& recording);
  [[nodiscard]] const std::optional<ReadOverview>& overview() const { return overview_; }
  [[nodiscard]] bool has_distances() const { return has_distances_; }
  [[nodiscard]] std::size_t resets() const { return resets_; }

 private:
  void add(TagRead&& read, const std::string& frame);
  void add(TrueDistance&& distance);
  void hold_no_more();
  HeldReads(std::size_t most, std::size_t resets) : most_(most), resets_(resets) {}

  std::size_t most_;
  std::size_t resets_ = 0;
  bool has_distances_ = false;
  std::vector<TagRead> reads_;
  std::vector<TrueDistance> distances_;
  std::vector<RecordedUpdate> updates_;  ///< At the stamps of reads.
  std::optional<ReadOverview> overview_;
};

/// Of reads that are not held. `held` has an overview of them.
UntoldReads untold(const std::string& path, const GoThrough& go_through, const HeldReads& held);

}  // namespace tagfield
