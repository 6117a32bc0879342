// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/signal_strength/path_loss_law.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/localization/signal_strength/rssi_search.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxTags = 12;     ///< From which a law is learned.
constexpr double kMinSlope = 10.0;       ///< [dB].
constexpr double kReferenceNoise = 2.0;  ///< Of a reference tag's RSSI about the line [dB].
/// Slow errors below this [dB] are those of rounding and averaging.
constexpr double kLeastPattern = 0.1;

/// Sums for a line fit of the reference tags' RSSI over log-distance: slope with its prior, one
/// level per antenna.
struct LineSums {
  double weight = 0.0, log = 0.0, rssi = 0.0, log_log = 0.0, log_rssi = 0.0;
};

std::map<std::string, LineSums> sums_of_references(const LocalizationProblem& problem,
                                                   const TrilaterationOptions& options) {
  std::map<std::string, LineSums> sums;
  for (const auto& [tag, p_WT] : problem.reference_tags) {
    const auto samples = problem.samples.find(tag);
    if (samples == problem.samples.end()) continue;
    const BinnedRssi bins = binned_rssi(problem, samples->second, options.bin_m, options);
    const Eigen::ArrayXd logs = distances(bins, p_WT).log10();
    const Eigen::ArrayXd rssi = bins.rssi - lobe_gains(bins, p_WT);
    for (const TagPhases::Span& span : bins.spans) {
      LineSums& sum = sums[span.antenna];
      const auto log = logs.segment(span.begin, span.count);
      const auto level = rssi.segment(span.begin, span.count);
      sum.weight += static_cast<double>(span.count);
      sum.log += log.sum();
      sum.rssi += level.sum();
      sum.log_log += log.square().sum();
      sum.log_rssi += (log * level).sum();
    }
  }
  return sums;
}

/// The law from the reference tags; levels only if there are any.
PathLossLaw law_of_references(const LocalizationProblem& problem,
                              const TrilaterationOptions& options) {
  const auto sums = sums_of_references(problem, options);
  PathLossLaw law;
  law.slope_db = options.slope_db;
  double squares = 0.0;
  double products = 0.0;
  for (const auto& [antenna, sum] : sums) {
    squares += sum.log_log - sum.log * sum.log / sum.weight;
    products += sum.log_rssi - sum.log * sum.rssi / sum.weight;
  }
  if (options.slope_sigma_db > 0.0 && !sums.empty()) {
    const double prior = std::pow(kReferenceNoise / options.slope_sigma_db, 2);
    law.slope_db = std::max(kMinSlope, (prior * options.slope_db - products) / (prior + squares));
    law.slope_sigma_db = kReferenceNoise / std::sqrt(prior + squares);
  }
  const double spread = std::max(options.tag_sigma_db, 0.1);
  for (const auto& [antenna, sum] : sums) {
    law.levels[antenna] = {(sum.rssi + law.slope_db * sum.log) / sum.weight,
                           std::pow(kReferenceNoise / spread, 2)};
  }
  return law;
}

/// A tag from which a law is learned.
struct Learned {
  BinnedRssi bins;
  double height = 0.0;
  std::vector<RssiFit> minima;  ///< By the slope of the prior.
  double independent = 0.0;     ///< Number of independent values, by the best of them.
};

std::vector<Learned> learned_of(const LocalizationProblem& problem,
                                const TrilaterationOptions& options) {
  std::vector<Learned> tags;
  for (const auto& [tag, samples] : problem.samples) {
    if (tags.size() == kMaxTags) break;
    if (problem.reference_tags.count(tag) > 0) continue;
    BinnedRssi bins = binned_rssi(problem, samples, options.bin_m, options);
    if (bins.rssi.size() < kFewestRssiBins) continue;
    tags.push_back({std::move(bins), plane_height(problem, tag), {}, 0.0});
  }
  return tags;
}

/// The best position by a law, starting from the minima by another one; none if there are none.
std::optional<RssiFit> best_fit(const BinnedRssi& bins, const PathLossLaw& law,
                                const std::vector<RssiFit>& minima, double max_range_m) {
  std::optional<RssiFit> best;
  for (const RssiFit& start : minima) {
    const RssiFit fit = rssi_refined(bins, law, start.p_WT);
    const bool in_range = distances(bins, fit.p_WT).maxCoeff() <= max_range_m;
    if (in_range && !(best && best->cost <= fit.cost)) best = fit;
  }
  return best || minima.empty() ? best : minima.front();
}

/// ln of the likelihood of all tags' RSSI by a law, each at its best position, and of its slope by
/// the prior.
double log_likelihood(const std::vector<Learned>& tags, const PathLossLaw& law,
                      const TrilaterationOptions& options) {
  constexpr double kTiny = 1e-12;  // [dB²]
  double log = -0.5 * std::pow((law.slope_db - options.slope_db) / options.slope_sigma_db, 2);
  for (const Learned& tag : tags) {
    const std::optional<RssiFit> best = best_fit(tag.bins, law, tag.minima, options.max_range_m);
    if (best) log -= 0.5 * tag.independent * std::log(best->cost + kTiny);
  }
  return log;
}

/// Standard deviation about `middle` of a distribution given by logarithms of its density, by
/// trapezoids.
double spread_about(double middle, const std::map<double, double>& logs, double most) {
  double mass = 0.0;
  double squares = 0.0;
  for (auto after = std::next(logs.begin()); after != logs.end(); ++after) {
    const auto before = std::prev(after);
    for (const auto& [x, log] : {*before, *after}) {
      const double part = 0.5 * (after->first - before->first) * std::exp(log - most);
      mass += part;
      squares += part * (x - middle) * (x - middle);
    }
  }
  return mass > 0.0 ? std::sqrt(squares / mass) : 0.0;
}

/// The law with the slope that suits all tags best: the best of a grid, then of ever closer
/// neighbours. A slope that is known or comes from reference tags stays.
PathLossLaw with_best_slope(const std::vector<Learned>& tags, PathLossLaw law,
                            const TrilaterationOptions& options) {
  if (!law.levels.empty() || !(options.slope_sigma_db > 0.0)) return law;
  const double least = std::min(kMinSlope, options.slope_db);
  std::map<double, double> logs;  // By slope.
  const auto try_slope = [&](double slope_db) {
    law.slope_db = std::max(least, slope_db);
    logs[law.slope_db] = log_likelihood(tags, law, options);
  };
  const auto best = [&] {
    return *std::max_element(logs.begin(), logs.end(),
                             [](const auto& a, const auto& b) { return a.second < b.second; });
  };
  double step = 0.5 * options.slope_sigma_db;
  for (int i = -4; i <= 4; ++i) try_slope(options.slope_db + step * i);
  for (int halvings = 0; halvings < 6; ++halvings) {
    step *= 0.5;
    const double middle = best().first;
    try_slope(middle - step);
    try_slope(middle + step);
  }
  const auto [slope_db, most] = best();
  law.slope_db = slope_db;
  law.slope_sigma_db = spread_about(slope_db, logs, most);
  return law;
}

/// The law with the slope that suits all tags best, and the tags' positions by the prior's.
PathLossLaw learned_law(std::vector<Learned>& tags, const PathLossLaw& law,
                        const TrilaterationOptions& options) {
  for (Learned& tag : tags) {
    const auto cells = rssi_cells(tag.bins, law, tag.height, options.max_range_m);
    tag.minima = rssi_minima(tag.bins, law, cells, options.max_range_m);
    if (tag.minima.empty()) continue;
    const Eigen::ArrayXd best = misfit_at(tag.bins, law, tag.minima.front().p_WT).residuals;
    tag.independent =
        static_cast<double>(tag.bins.rssi.size()) / correlation_factor(tag.bins.spans, best);
  }
  return with_best_slope(tags, law, options);
}

/// Standard deviation of slow errors that a law leaves [dB]: of all residuals, without the noise
/// from one to the next.
double slow_misfit(const std::vector<Learned>& tags, const PathLossLaw& law,
                   const TrilaterationOptions& options) {
  double squares = 0.0;
  double count = 0.0;
  for (const Learned& tag : tags) {
    const std::optional<RssiFit> best = best_fit(tag.bins, law, tag.minima, options.max_range_m);
    if (!best) continue;
    const Eigen::ArrayXd residuals = misfit_at(tag.bins, law, best->p_WT).residuals;
    const double noise = noise_of_one(tag.bins.spans, residuals);
    squares += residual_variance(tag.bins.spans, residuals) - noise * noise;
    count += 1.0;
  }
  return squares > 0.0 ? std::sqrt(squares / count) : 0.0;
}

}  // namespace

PathLossLaws path_loss_laws(const LocalizationProblem& problem,
                            const TrilaterationOptions& options) {
  const PathLossLaw references = law_of_references(problem, options);
  std::vector<Learned> tags = learned_of(problem, options);
  const PathLossLaw isotropic = learned_law(tags, references, options);
  PathLossLaw directional = references;
  directional.pattern_sigma_db = slow_misfit(tags, isotropic, options);
  if (directional.pattern_sigma_db < kLeastPattern) return {isotropic, isotropic};
  return {isotropic, learned_law(tags, directional, options)};
}

}  // namespace tagfield
