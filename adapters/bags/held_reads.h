// SPDX-License-Identifier: Apache-2.0
/// @file
/// The reads of a ROS recording: in memory if there are not too many, otherwise read again on
/// demand.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adapters/bags/bag_content.h"
#include "adapters/bags/bag_recording.h"
#include "tagfield/files/units_seen.h"

namespace tagfield {

/// Reads through a ROS 1 bag or a ROS 2 recording each time it is called.
using GoThrough = std::function<BagContent(
    const BagReadSink& sink, const std::function<void(double)>& on_progress, Diagnostics&)>;

/// Holds reads and distances as long as each are no more than `most`; beyond that, only an overview
/// of the reads.
class HeldReads {
 public:
  explicit HeldReads(std::size_t most) : most_(most) {}

  /// The sink to pass to a GoThrough; this must outlive it.
  [[nodiscard]] BagReadSink sink();

  /// Moves reads and distances into the results.
  void give(BagContent& content, BagRecording& recording);
  [[nodiscard]] const std::optional<ReadOverview>& overview() const { return overview_; }
  [[nodiscard]] bool has_distances() const { return has_distances_; }
  [[nodiscard]] const UnitsSeen& units() const { return units_; }
  [[nodiscard]] std::size_t resets() const { return resets_; }

 private:
  void add(TagRead&& read, const std::string& frame);
  void add(TrueDistance&& distance);
  void hold_no_more();
  HeldReads(std::size_t most, std::size_t resets) : most_(most), resets_(resets) {}

  std::size_t most_;
  std::size_t resets_ = 0;
  bool has_distances_ = false;
  UnitsSeen units_;
  std::vector<TagRead> reads_;
  std::vector<TrueDistance> distances_;
  std::vector<RecordedUpdate> updates_;  ///< At the stamps of reads.
  std::optional<ReadOverview> overview_;
};

/// Access to reads that are not held. `held` has an overview of them.
UnreportedReads unreported_reads(const std::string& path, const GoThrough& go_through,
                                 const HeldReads& held);

}  // namespace tagfield
