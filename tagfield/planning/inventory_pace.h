/// @file
/// How many of so many tags an inventory gets to know in so much time.
#pragma once

#include <cstdint>
#include <vector>

#include "tagfield/reader/radio_model.h"

namespace tagfield {

/// Tabulated by running the inventory itself, slot by slot, on tags that all have power and are all
/// made out. May be used by several threads at once.
class InventoryPace {
 public:
  /// For turns of up to `most_s` > 0 and up to `most_tags` tags. `gen2` must be one that the
  /// inventory takes.
  InventoryPace(const Gen2Reader& gen2, double most_s, std::size_t most_tags, std::uint64_t seed);

  /// Mean number of different tags read of `tags` that begin unread, `time_s` after the carrier has
  /// come on. Linear between tabulated counts of tags (powers of √2).
  [[nodiscard]] double read(double tags, double time_s) const;

 private:
  struct Row {
    double tags = 0.0;
    std::vector<double> read;  ///< After each step of time.
  };
  [[nodiscard]] double read_of(const Row& row, double time_s) const;

  double step_s_;
  std::vector<Row> rows_;
};

}  // namespace tagfield
