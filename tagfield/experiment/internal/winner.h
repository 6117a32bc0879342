// SPDX-License-Identifier: Apache-2.0
/// @file
/// The best method in a condition, and those not significantly different from it.
#pragma once

#include <optional>
#include <vector>

#include "tagfield/experiment/bench/bench.h"

namespace tagfield {

/// Methods compete if they locate correctly at least this share of the number of tags that the best
/// one does.
inline constexpr double kCompetes = 0.95;

/// Number of tags located with an error of at most kWrong_m.
std::size_t count_right(const BenchEntry& entry);

struct Winner {
  const BenchEntry* entry = nullptr;
  /// Competitors whose errors don't differ significantly from the winner's: the mean of the paired
  /// differences, over tags and seeds that both located, is within 1.96 standard errors of 0.
  std::vector<const BenchEntry*> alike;
};

/// Of the methods that compete, the one with the smallest mean error; none if no tag was located
/// correctly.
std::optional<Winner> winner_of(const std::vector<const BenchEntry*>& entries);

}  // namespace tagfield
