// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/resampling.h"

#include <algorithm>

#include "tagfield/base/lane_math.h"

namespace tagfield {
namespace {

/// Number of positions in the cumulative weights from which a draw starts its search.
constexpr std::size_t kStarts = 20;
/// Draws are kept below 1, and the search starts at a position slightly below the draw.
constexpr double kMost = 0.999999;
constexpr double kSafely = 0.05;

}  // namespace

std::mt19937 generator_of(RandomStream stream) {
  return std::mt19937(static_cast<std::mt19937::result_type>(stream()));
}

double uniform_draw(std::mt19937& generator, double low, double high) {
  constexpr double kStep = 1.0 / std::mt19937::max();
  return low + (high - low) * static_cast<double>(generator()) * kStep;
}

std::vector<double> shares_of(const std::vector<double>& log_weights) {
  const double most = *std::max_element(log_weights.begin(), log_weights.end());
  std::vector<double> shares;
  shares.reserve(log_weights.size());
  double sum = 0.0;
  for (const double log_weight : log_weights) {
    shares.push_back(lane_exp(log_weight - most));
    sum += shares.back();
  }
  const double norm = 1.0 / sum;
  for (double& share : shares) share *= norm;
  return shares;
}

std::vector<std::size_t> systematic_resampling(const std::vector<double>& log_weights,
                                               std::mt19937& generator) {
  const std::vector<double> shares = shares_of(log_weights);
  const double step = 1.0 / static_cast<double>(shares.size());
  double tooth = uniform_draw(generator, 0.0, step);
  double sum = shares.front();
  std::size_t chosen = 0;
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < shares.size(); ++i, tooth += step) {
    while (tooth >= sum && chosen + 1 < shares.size()) sum += shares[++chosen];
    all.push_back(chosen);
  }
  return all;
}

WeightedDraw::WeightedDraw(const std::vector<double>& log_weights)
    : shares_(shares_of(log_weights)) {
  double sum = 0.0;
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    sum += shares_[i];
    while (starts_.size() < kStarts && static_cast<double>(starts_.size()) / kStarts < sum) {
      starts_.push_back(i);
    }
  }
}

std::size_t WeightedDraw::operator()(std::mt19937& generator) const {
  const double draw = uniform_draw(generator, 0.0, kMost);
  const auto start = static_cast<std::size_t>(draw * (kStarts - kSafely));
  double sum = static_cast<double>(start) / kStarts;
  std::size_t chosen = starts_[start];
  while (draw > sum + shares_[chosen] && chosen + 1 < shares_.size()) sum += shares_[chosen++];
  return chosen;
}

}  // namespace tagfield
