// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which method does best in a condition, and which can't be told from it.
#pragma once

#include <optional>
#include <vector>

#include "tagfield/experiment/bench/bench.h"

namespace tagfield {

/// Methods compete that got at least this share of what the best got right.
inline constexpr double kCompetes = 0.95;

/// Tags located no further off than kWrong_m.
std::size_t count_right(const BenchEntry& entry);

struct Winner {
  const BenchEntry* entry = nullptr;
  /// Competitors whose errors don't differ from the winner's beyond chance: the mean of the paired
  /// differences, over tags and seeds that both located, lies within 1.96 standard errors of 0.
  std::vector<const BenchEntry*> alike;
};

/// Of the methods that compete, the one with the least mean error; none where no tag was right.
std::optional<Winner> winner_of(const std::vector<const BenchEntry*>& entries);

}  // namespace tagfield
