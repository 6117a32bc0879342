// SPDX-License-Identifier: Apache-2.0
/// @file
/// Statistics for tests with fixed seeds. Every bound below has a false-alarm probability of at
/// most 1e-6 per use.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace tagfield::statistics {

/// Two-sided bound for a standard normal deviate: P(|Z| > 4.892) = 1e-6.
inline constexpr double kNormalBound = 4.892;
/// Kolmogorov's bound for √n·D: 2·exp(-2·2.694²) = 1e-6.
inline constexpr double kKolmogorovBound = 2.694;

inline double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

/// √n times the maximum distance between the empirical distribution of the draws and `cdf`.
template <class Cdf>
double kolmogorov(std::vector<double> draws, const Cdf& cdf) {
  std::sort(draws.begin(), draws.end());
  const auto n = static_cast<double>(draws.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < draws.size(); ++i) {
    const double expected = cdf(draws[i]);
    const auto below = static_cast<double>(i) / n;
    worst = std::max({worst, expected - below, below + 1.0 / n - expected});
  }
  return std::sqrt(n) * worst;
}

inline double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

inline double covariance(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = mean(a);
  const double mean_b = mean(b);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b);
  return sum / static_cast<double>(a.size() - 1);
}

inline double variance(const std::vector<double>& values) { return covariance(values, values); }

/// √n times the correlation: nearly N(0, 1) if the two are independent.
inline double correlation_deviate(const std::vector<double>& a, const std::vector<double>& b) {
  return std::sqrt(static_cast<double>(a.size())) * covariance(a, b) /
         std::sqrt(variance(a) * variance(b));
}

}  // namespace tagfield::statistics
