// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/residuals.h"

#include <algorithm>
#include <cmath>

namespace tagfield {
namespace {

/// Lower limit of the deviation of any phase [m]: even a fit without residuals is not certain.
constexpr double kMinDeviation = 1e-5;

/// Mean of e_i e_{i+lag} over the pairs within a span; 0 if there are too few.
double lagged_product(const Spans& spans, const Eigen::ArrayXd& residuals, Eigen::Index lag) {
  double sum = 0.0;
  Eigen::Index all = 0;
  for (const TagPhases::Span& span : spans) {
    const Eigen::Index pairs = span.count - lag;
    if (pairs <= 0) continue;
    all += pairs;
    sum +=
        (residuals.segment(span.begin, pairs) * residuals.segment(span.begin + lag, pairs)).sum();
  }
  return 4 * all > residuals.size() ? sum / static_cast<double>(all) : 0.0;
}

}  // namespace

double correlation_factor(const Spans& spans, const Eigen::ArrayXd& residuals) {
  constexpr Eigen::Index kLongestLag = 1000;
  const double power = residuals.size() > 0 ? residuals.square().mean() : 0.0;
  if (!(power > 0.0)) return 1.0;
  double factor = 1.0;
  const Eigen::Index last = std::min(kLongestLag, residuals.size() / 2);
  for (Eigen::Index lag = 1; lag < last; ++lag) {
    const double correlation = lagged_product(spans, residuals, lag) / power;
    if (correlation <= 0.0) break;
    factor += 2.0 * correlation;
  }
  return factor;
}

double fitted_away(double correlation_factor) {
  constexpr double kSlowErrors = 3.0;  // Reads per independent one, above which errors are slow.
  return 1.0 + std::min(1.0, (correlation_factor - 1.0) / (kSlowErrors - 1.0));
}

double fitted_away(const Spans& spans, const Eigen::ArrayXd& residuals) {
  return fitted_away(correlation_factor(spans, residuals));
}

double noise_of_one(const Spans& spans, const Eigen::ArrayXd& residuals) {
  double squares = 0.0;
  double count = 0.0;
  for (const TagPhases::Span& span : spans) {
    for (Eigen::Index i = span.begin + 1; i < span.begin + span.count; ++i) {
      squares += (residuals[i] - residuals[i - 1]) * (residuals[i] - residuals[i - 1]);
      count += 1.0;
    }
  }
  return std::sqrt(0.5 * squares / std::max(count, 1.0));
}

double residual_variance(const Spans& spans, const Eigen::ArrayXd& residuals) {
  const auto reads = static_cast<double>(residuals.size());
  const auto unknowns = static_cast<double>(spans.size()) + 2.0;
  // Of slow errors, each unknown absorbs as many reads as are worth one independent residual.
  const double slow = 3.0 * (correlation_factor(spans, residuals) - 1.0);
  const double freedom = std::max({1.0, 0.2 * reads, reads - unknowns - slow});
  return std::max(residuals.square().sum() / std::min(freedom, reads),
                  kMinDeviation * kMinDeviation);
}

bool tells_apart(const Spans& spans, const Eigen::ArrayXd& best, const Eigen::ArrayXd& other) {
  constexpr double kThreshold = 16.0;
  constexpr double kDeviations = 4.0;
  constexpr double kRatioDeviations = 4.0;
  const double factor = correlation_factor(spans, best);
  const double noise = residual_variance(spans, best) * factor;
  const double difference = (other.square() - best.square()).sum() / noise;
  const double chance = 2.0 * std::sqrt((other - best).square().sum() / noise);
  const double independent = static_cast<double>(best.size()) / factor;
  // Σ other² / Σ best² computed from the variance, which is never 0.
  const double ratio = 1.0 + difference / independent;
  return difference > kThreshold && difference > kDeviations * chance &&
         std::log(ratio) > kRatioDeviations * 2.0 / std::sqrt(independent);
}

}  // namespace tagfield
