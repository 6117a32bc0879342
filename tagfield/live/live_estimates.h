// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where tags are, as far as the reads of the last minutes say, worked out while they come in.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tagfield/localization/locate.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

/// What was last made of a tag.
struct LiveEstimate {
  TagEstimate estimate;
  Time last_read;            ///< Stamp of the newest read that it is from.
  std::string method;        ///< That made it.
  std::uint64_t number = 0;  ///< Grows with each estimate, of whatever tag.
};

struct LiveEstimateOptions {
  LocalizationOptions localization;
  Duration window = std::chrono::seconds(120);  ///< Of simulated time; older reads don't count.
  std::size_t most_reads = 2'000'000;           ///< In all, each tag an equal share.
};

/// An outlet. Locates tags again and again, those of which most is new first, in a thread of its
/// own of low priority: who tells it reads never waits for it. With little time it is late, and
/// takes fewer tags at once; each estimate is what locate_tags() makes of the window's reads of the
/// tags that it was made with. Of a tag that is no longer read the last estimate stays.
class LiveEstimates final : public ReadListener, public PoseListener {
 public:
  /// Throws Error on options that locate_tags() doesn't take.
  explicit LiveEstimates(LiveEstimateOptions options);
  ~LiveEstimates() override;

  void on_read(const TagRead& read) override;
  void on_pose(const AntennaInfo& antenna, const AntennaPose& pose) override;
  void on_restart() override;

  // From any thread.

  /// Those with a number above `number`, in its order.
  [[nodiscard]] std::vector<LiveEstimate> since(std::uint64_t number) const;
  /// Number of the newest, 0 where there is none.
  [[nodiscard]] std::uint64_t newest() const;
  /// What was last warned of.
  [[nodiscard]] std::vector<std::string> warnings() const;
  /// Whether nothing is left to be made of what has come.
  [[nodiscard]] bool is_idle() const;
  /// No more estimates; what is being worked out is waited for so long. Whether that was enough.
  bool stop(std::chrono::milliseconds patience);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
