// SPDX-License-Identifier: Apache-2.0
/// @file
/// The share of work that is done, of jobs whose kinds take different times.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>

namespace tagfield {

/// A job that is left costs the mean time of those of its kind so far, or, before the first of them
/// is done, of all.
template <class Kind>
class WeighedShare {
 public:
  void expect(const Kind& kind) { ++costs_[kind].left; }

  /// `seconds`: what a job took, or none if it had been done before.
  void finish(const Kind& kind, std::optional<double> seconds) {
    Cost& cost = costs_[kind];
    --cost.left;
    if (!seconds) return;
    ++cost.done;
    cost.seconds += *seconds;
  }

  /// 1 after the last job.
  [[nodiscard]] double done() const {
    Cost all;
    for (const auto& [kind, cost] : costs_) {
      all.left += cost.left;
      all.done += cost.done;
      all.seconds += cost.seconds;
    }
    if (all.left == 0) return 1.0;
    double left_s = 0.0;
    for (const auto& [kind, cost] : costs_) {
      left_s += static_cast<double>(cost.left) * (cost.done > 0 ? cost.mean_s() : all.mean_s());
    }
    return all.seconds > 0.0 ? all.seconds / (all.seconds + left_s) : 0.0;
  }

 private:
  struct Cost {
    std::size_t left = 0;
    std::size_t done = 0;
    double seconds = 0.0;  ///< Of those that are done.

    [[nodiscard]] double mean_s() const {
      return seconds / static_cast<double>(std::max<std::size_t>(done, 1));
    }
  };

  std::map<Kind, Cost> costs_;
};

}  // namespace tagfield
