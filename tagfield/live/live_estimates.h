// SPDX-License-Identifier: Apache-2.0
/// @file
/// Estimated positions of tags from the reads of the last minutes, updated as the reads come in.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tagfield/localization/locate.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

/// The last estimate for a tag.
struct LiveEstimate {
  TagEstimate estimate;
  Time last_read;            ///< Timestamp of the newest read used.
  std::string method;        ///< Method of the estimate.
  std::uint64_t number = 0;  ///< Increases with every estimate, across all tags.
};

struct LiveEstimateOptions {
  LocalizationOptions localization;
  Duration window = std::chrono::seconds(120);  ///< Of simulated time; older reads don't count.
  std::size_t max_reads = 2'000'000;  ///< In all, equally divided, but at least 100 per tag.
};

/// An outlet. Locates tags repeatedly, those with the largest fraction of new reads first, in its
/// own low-priority thread, so that the sender of reads never waits. With little CPU time it lags
/// behind and processes fewer tags at a time. Each estimate is what locate_tags() returns for the
/// window's reads of the tags processed together. A tag that is no longer read keeps its last
/// estimate.
class LiveEstimates final : public ReadListener, public PoseListener {
 public:
  /// Throws Error on options that locate_tags() rejects.
  explicit LiveEstimates(LiveEstimateOptions options);
  ~LiveEstimates() override;

  void on_read(const TagRead& read) override;
  void on_pose(const AntennaInfo& antenna, const AntennaPose& pose) override;
  void on_restart() override;

  // Callable from any thread.

  /// Estimates with a number above `number`, in ascending order.
  [[nodiscard]] std::vector<LiveEstimate> since(std::uint64_t number) const;
  /// Number of the newest estimate, 0 if there is none.
  [[nodiscard]] std::uint64_t newest() const;
  /// The latest warnings.
  [[nodiscard]] std::vector<std::string> warnings() const;
  /// Whether all reads received have been processed.
  [[nodiscard]] bool is_idle() const;
  /// Stops estimating; waits up to `patience` for the estimate in progress. Returns whether it
  /// ended in time.
  bool stop(std::chrono::milliseconds patience);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
