// SPDX-License-Identifier: Apache-2.0
/// @file
/// Choosing particles by their weights.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "tagfield/base/random.h"

namespace tagfield {

/// Seeded by the stream's next word.
std::mt19937 generator_of(RandomStream stream);

/// From `low` to `high`, both included, by one word of the generator.
double uniform_draw(std::mt19937& generator, double low, double high);

/// Shares in a sum of 1 of weights whose logarithms are given; at least one of them finite.
std::vector<double> shares_of(const std::vector<double>& log_weights);

/// As many as there are, each particle as often as its share says, rounded up or down: what lies
/// on a comb of equal steps with one random offset (Kitagawa, 1996). In ascending order.
std::vector<std::size_t> systematic_resampling(const std::vector<double>& log_weights,
                                               std::mt19937& generator);

/// Draws one particle at a time by its weight, independently: multinomial resampling of as many as
/// it takes. Looks for it from the last of twenty places in the running sum of shares that the draw
/// is beyond; a particle that lies across such a place counts as beginning there, so that it, and
/// the one before the next place, may be drawn more or less often by up to its own share.
class WeightedDraw {
 public:
  explicit WeightedDraw(const std::vector<double>& log_weights);
  std::size_t operator()(std::mt19937& generator) const;

 private:
  std::vector<double> shares_;
  std::vector<std::size_t> starts_;  ///< The particle at each of the places.
};

}  // namespace tagfield
