// SPDX-License-Identifier: Apache-2.0
/// @file
/// Resampling of particles by their weights.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "tagfield/base/random.h"

namespace tagfield {

/// A generator seeded with the stream's next word.
std::mt19937 generator_of(RandomStream stream);

/// Uniform in [low, high], from one word of the generator.
double uniform_draw(std::mt19937& generator, double low, double high);

/// Weights normalized to a sum of 1, given their logarithms, at least one of which must be finite.
std::vector<double> shares_of(const std::vector<double>& log_weights);

/// As many indices as there are particles, each as often as its normalized weight says, rounded up
/// or down: those hit by a comb of equal steps with one random offset (Kitagawa, 1996). In
/// ascending order.
std::vector<std::size_t> systematic_resampling(const std::vector<double>& log_weights,
                                               std::mt19937& generator);

/// Draws one particle at a time by its weight, independently: multinomial resampling of any number.
/// The search starts from the last of twenty positions in the cumulative weights that is below the
/// draw. A particle that straddles such a position counts as beginning there, so that it, and the
/// one before the next position, may be drawn more or less often by up to its own weight.
class WeightedDraw {
 public:
  explicit WeightedDraw(const std::vector<double>& log_weights);
  std::size_t operator()(std::mt19937& generator) const;

 private:
  std::vector<double> shares_;
  std::vector<std::size_t> starts_;  ///< The particle at each of these positions.
};

}  // namespace tagfield
