// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/outliers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "tagfield/base/parallel.h"
#include "tagfield/base/units.h"
#include "tagfield/fit/circular_mean.h"
#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/holograms/hologram.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/phase_curves/phase_following.h"
#include "tagfield/localization/phase_noise.h"
#include "tagfield/localization/residuals.h"
#include "tagfield/localization/tag_fit.h"

namespace tagfield {
namespace {

constexpr double kMinSigma = 1e-3;  ///< [rad]
constexpr double kMaxOutliers = 0.2;
constexpr double kLikely = 0.5;  ///< Probability from which a read counts as an outlier.

/// Density of wrapped normal noise with a standard deviation well under π.
Eigen::ArrayXd normal_density(const Eigen::ArrayXd& angles, double sigma) {
  return (-0.5 * (angles / sigma).square()).exp() / (sigma * std::sqrt(kTwoPi));
}

double root_mean_square(const Eigen::ArrayXd& angles) {
  return std::max(std::sqrt(angles.square().mean()), kMinSigma);
}

double median_deviation(const Eigen::ArrayXd& angles) {
  std::vector<double> sizes(angles.data(), angles.data() + angles.size());
  for (double& size : sizes) size = std::abs(size);
  const auto half = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), half, sizes.end());
  return std::max(*half / 0.6745, kMinSigma);
}

/// The brightest of the positions found, after climbing to the maximum; the search ranks them by
/// coarser sums.
PositionVector brightest_of(const TagPhases& phases, const HeightModel& height,
                            const std::vector<PositionVector>& places) {
  const std::vector<Aperture> whole = apertures(phases, kWholeAperture);
  PositionVector best = places.front();
  double most = -1.0;
  for (const PositionVector& place : places) {
    const PositionVector top = climb(phases, whole, height, place);
    const double light = coherence(phases, whole, height, top);
    if (light > most) best = top;
    most = std::max(most, light);
  }
  return best;
}

/// The arbitrary phases among one tag's samples; none if they are more than a few, as of two tags
/// under one ID.
SamplesOfTag strays_among(const SamplesOfTag& samples) {
  SamplesOfTag strays;
  for (const auto& [antenna, series] : samples) {
    if (extent_of(series) < kStillExtent) continue;
    const std::vector<PhaseSample> sorted = by_channel(series);
    std::set<Time> stamps;
    for (const std::size_t i : stray_samples(sorted, phase_noise(sorted))) {
      stamps.insert(sorted[i].stamp);
    }
    if (stamps.empty()) continue;
    std::copy_if(series.begin(), series.end(), std::back_inserter(strays[antenna]),
                 [&](const PhaseSample& sample) { return stamps.count(sample.stamp) > 0; });
  }
  const auto all = static_cast<double>(count_reads(samples));
  return static_cast<double>(count_reads(strays)) > kMaxOutliers * all ? SamplesOfTag{} : strays;
}

bool is_earlier(const PhaseSample& one, const PhaseSample& other) {
  return one.stamp < other.stamp;
}

/// Both in ascending order of stamps, which are unique.
void take_out(const std::vector<PhaseSample>& strays, std::vector<PhaseSample>& series) {
  auto stray = strays.begin();
  const auto is_stray = [&](const PhaseSample& sample) {
    if (stray == strays.end() || stray->stamp != sample.stamp) return false;
    ++stray;
    return true;
  };
  series.erase(std::remove_if(series.begin(), series.end(), is_stray), series.end());
}

/// Allocates nothing, as take_out() left the room.
void put_back(const std::vector<PhaseSample>& strays, std::vector<PhaseSample>& series) {
  const auto middle = static_cast<std::ptrdiff_t>(series.size());
  series.insert(series.end(), strays.begin(), strays.end());
  std::inplace_merge(series.begin(), series.begin() + middle, series.end(), is_earlier);
}

/// Warns if a noticeable share of the reads is left out.
void warn_of_strays(std::size_t strays, std::size_t reads, Diagnostics& diagnostics) {
  // Close to a tag its direction changes faster than expected, at which a few reads in a thousand
  // seem arbitrary.
  constexpr double kNoticed = 0.01;
  const double share = static_cast<double>(strays) / static_cast<double>(reads);
  if (share > kNoticed) warn_of_outliers(share, diagnostics);
}

}  // namespace

HologramPeak hologram_peak(const LocalizationProblem& problem, const std::string& tag,
                           const SamplesOfTag& samples) {
  HologramPeak result;
  if (!why_not_locatable(samples).empty()) return result;
  result.phases = coherent_reads(problem, samples);
  if (!too_few(result.phases).empty()) return result;
  const HeightModel height = height_model(problem, tag, result.phases);
  const auto places = search_positions(result.phases, height, SearchOptions{}, coherent_light());
  if (places.empty()) return result;
  const PositionVector place = brightest_of(result.phases, height, places);
  const Eigen::ArrayXd errors =
      residuals_of(result.phases, height, {place, offsets_at(result.phases, height, place), 0.0});
  result.residuals_rad = errors * result.phases.wavenumber;
  result.reads_worth_one = correlation_factor(result.phases.spans, errors);
  return result;
}

OutlierMixture outlier_mixture(const Eigen::ArrayXd& angles) {
  constexpr int kRounds = 30;
  OutlierMixture mixture;
  mixture.sigma_rad = median_deviation(angles);
  mixture.share = 0.05;
  Eigen::ArrayXd of_noise;
  for (int round = 0; round < kRounds; ++round) {
    of_noise = (1.0 - mixture.share) * normal_density(angles, mixture.sigma_rad);
    mixture.probability = 1.0 - of_noise / (of_noise + mixture.share / kTwoPi);
    const Eigen::ArrayXd weights = 1.0 - mixture.probability;
    const double sum = std::max(weights.sum(), 1e-9);
    mixture.sigma_rad = std::max(std::sqrt((weights * angles.square()).sum() / sum), kMinSigma);
    mixture.share = std::clamp(mixture.probability.mean(), 1e-6, 1.0);
  }
  const Eigen::ArrayXd alone = normal_density(angles, root_mean_square(angles));
  mixture.evidence = ((of_noise + mixture.share / kTwoPi).log() - alone.max(1e-300).log()).sum();
  return mixture;
}

Eigen::ArrayXd less_neighbours(const TagPhases& phases, const Eigen::ArrayXd& residuals_rad) {
  constexpr Eigen::Index kNeighbours = 4;
  Eigen::ArrayXd less = residuals_rad;
  for (const TagPhases::Span& span : phases.spans) {
    if (span.count <= kNeighbours) continue;
    const Eigen::Index end = span.begin + span.count;
    for (Eigen::Index i = span.begin; i < end; ++i) {
      CircularMean mean;
      const Eigen::Index from = std::max(span.begin, i - kNeighbours);
      for (Eigen::Index j = from; j < std::min(end, i + kNeighbours + 1); ++j) {
        if (j != i) mean.add(residuals_rad[j]);
      }
      less[i] = wrap_to_pi(residuals_rad[i] - mean.value());
    }
  }
  return less;
}

bool has_outliers(const OutlierMixture& mixture) {
  return mixture.share < kMaxOutliers &&
         mixture.evidence > std::log(static_cast<double>(mixture.probability.size()));
}

bool are_scattered(const TagPhases& phases, const Eigen::ArrayXd& probability) {
  const double share = (probability > kLikely).cast<double>().mean();
  double successors = 0.0;
  double pairs = 0.0;
  for (const TagPhases::Span& span : phases.spans) {
    for (Eigen::Index i = span.begin + 1; i < span.begin + span.count; ++i) {
      successors += 1.0;
      if (probability[i - 1] > kLikely && probability[i] > kLikely) pairs += 1.0;
    }
  }
  const double expected = successors * share * share;
  return pairs <= expected + 3.0 * std::sqrt(expected) + 1.0;
}

std::optional<OutlierMixture> outliers_at(const HologramPeak& there) {
  if (there.residuals_rad.size() == 0) return std::nullopt;
  OutlierMixture mixture = outlier_mixture(less_neighbours(there.phases, there.residuals_rad));
  if (!has_outliers(mixture) || !are_scattered(there.phases, mixture.probability)) {
    return std::nullopt;
  }
  return mixture;
}

std::size_t remove_outliers(const LocalizationProblem& problem, const std::string& tag,
                            SamplesOfTag& samples) {
  const HologramPeak there = hologram_peak(problem, tag, samples);
  const std::optional<OutlierMixture> mixture = outliers_at(there);
  if (!mixture) return 0;
  std::map<std::string, std::set<double>> stamps;
  for (const TagPhases::Span& span : there.phases.spans) {
    for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
      if (mixture->probability[i] > kLikely) stamps[span.antenna].insert(there.phases.time_s[i]);
    }
  }
  std::size_t removed = 0;
  for (auto& [antenna, series] : samples) {
    const std::set<double>& of_antenna = stamps[antenna];
    const auto kept = std::remove_if(series.begin(), series.end(), [&](const PhaseSample& sample) {
      return of_antenna.count(to_seconds(sample.stamp)) > 0;
    });
    removed += static_cast<std::size_t>(series.end() - kept);
    series.erase(kept, series.end());
  }
  return removed;
}

WithoutStrayPhases::WithoutStrayPhases(LocalizationProblem& problem, int threads,
                                       Diagnostics& diagnostics)
    : problem_(problem) {
  std::vector<const SamplesByTag::value_type*> tags;
  for (const auto& entry : problem.samples) tags.push_back(&entry);
  std::vector<SamplesOfTag> found(tags.size());
  parallel_for(tags.size(), threads,
               [&](std::size_t i) { found[i] = strays_among(tags[i]->second); });
  std::size_t reads = 0;
  std::size_t strays = 0;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    reads += count_reads(tags[i]->second);
    strays += count_reads(found[i]);
    if (!found[i].empty()) strays_[tags[i]->first] = std::move(found[i]);
  }
  for (const auto& [tag, of_tag] : strays_) {
    for (const auto& [antenna, series] : of_tag) {
      take_out(series, problem_.samples.at(tag).at(antenna));
    }
  }
  if (strays > 0) warn_of_strays(strays, reads, diagnostics);
}

WithoutStrayPhases::~WithoutStrayPhases() {
  for (const auto& [tag, of_tag] : strays_) {
    for (const auto& [antenna, series] : of_tag) {
      put_back(series, problem_.samples.at(tag).at(antenna));
    }
  }
}

void warn_of_outliers(double share, Diagnostics& diagnostics) {
  diagnostics.warn(
      fmt::format("{:.1f} % of the phases are outliers and are left out", 100.0 * share));
}

}  // namespace tagfield
