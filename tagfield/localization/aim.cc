// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/aim.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/base/units.h"
#include "tagfield/localization/at_rest.h"
#include "tagfield/localization/holograms/segments.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

/// RSSI of a read, with the position and boresight of its antenna.
struct AimedRead {
  Eigen::Vector3d p_WA;
  Eigen::Vector3d ahead_W;
  double rssi_dbm = 0.0;
};

/// Reads of one antenna.
struct AimedSeries {
  std::vector<AimedRead> reads;
  double independent = 0.0;  ///< Effective number of reads with independent fading.
};

double independent_along(const LocalizationProblem& problem, const std::vector<AimedRead>& reads,
                         double frequency_hz) {
  constexpr std::size_t kEnough = 400;
  std::vector<double> along;
  double gone = 0.0;
  const std::size_t stride = reads.size() / kEnough + 1;
  for (std::size_t i = 0; i < reads.size(); i += stride) {
    if (i > 0) gone += (reads[i].p_WA - reads[i - stride].p_WA).norm();
    along.push_back(gone);
  }
  return independent_samples(along, wavelength(frequency_hz / problem.multiple()));
}

/// Two antennas whose orientations are exchanged; none if both names are empty.
using SwappedPair = std::pair<std::string, std::string>;

const std::string& aim_of(const std::string& antenna, const SwappedPair& swapped) {
  if (antenna == swapped.first) return swapped.second;
  return antenna == swapped.second ? swapped.first : antenna;
}

std::vector<AimedSeries> aimed_series(const LocalizationProblem& problem,
                                      const SamplesOfTag& samples,
                                      const SwappedPair& swapped = {}) {
  std::vector<AimedSeries> all;
  for (const auto& [antenna, series] : samples) {
    const auto track = problem.tracks.find(aim_of(antenna, swapped));
    if (track == problem.tracks.end() || !is_orientation_known(track->second)) continue;
    AimedSeries aimed;
    double frequency_hz = 0.0;
    for (const PhaseSample& sample : series) {
      if (sample.rssi_dbm <= kNoRssi) continue;
      const RigidTransform X_WA = held_pose_at(track->second.X_WA, sample.stamp);
      aimed.reads.push_back(
          {sample.p_WA, X_WA.rotation * Eigen::Vector3d::UnitX(), sample.rssi_dbm});
      frequency_hz = sample.frequency_hz;
    }
    if (aimed.reads.size() < kFewestReads) continue;
    aimed.independent = independent_along(problem, aimed.reads, frequency_hz);
    all.push_back(std::move(aimed));
  }
  return all;
}

/// The nearest third of the reads to a position, where the direct path dominates, as variables of
/// the regression: x = cos θ, y = RSSI + 40 log₁₀ r.
struct Nearest {
  Eigen::ArrayXd x, y;
  double independent = 0.0;
  [[nodiscard]] double scatter() const { return (y - y.mean()).square().mean(); }
};

double farthest_of_nearest(const std::vector<AimedSeries>& all, const Eigen::Vector3d& p_WT) {
  std::vector<double> ranges;
  for (const AimedSeries& series : all) {
    for (const AimedRead& read : series.reads) ranges.push_back((p_WT - read.p_WA).norm());
  }
  const auto third = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 3);
  std::nth_element(ranges.begin(), third, ranges.end());
  return *third;
}

Nearest nearest_of(const AimedSeries& series, const Eigen::Vector3d& p_WT, double farthest) {
  std::vector<double> x;
  std::vector<double> y;
  for (const AimedRead& read : series.reads) {
    const Eigen::Vector3d way = p_WT - read.p_WA;
    const double r = std::max(way.norm(), 0.01);
    if (r > farthest) continue;
    x.push_back(read.ahead_W.dot(way) / r);
    y.push_back(read.rssi_dbm + 40.0 * std::log10(r));
  }
  const auto count = static_cast<Eigen::Index>(x.size());
  const double share = static_cast<double>(count) / static_cast<double>(series.reads.size());
  return {Eigen::Map<Eigen::ArrayXd>(x.data(), count), Eigen::Map<Eigen::ArrayXd>(y.data(), count),
          share * series.independent};
}

/// Weighted sums of a linear regression.
struct Regression {
  double weight = 0.0, x = 0.0, y = 0.0;  ///< Of the antennas' means.
  double xx = 0.0, xy = 0.0;              ///< Within antennas and between their means.
};

void add_within(const Nearest& of, double variance, Regression& sums) {
  const double weight = of.independent / static_cast<double>(of.x.size()) / variance;
  sums.xx += weight * (of.x - of.x.mean()).square().sum();
  sums.xy += weight * ((of.x - of.x.mean()) * (of.y - of.y.mean())).sum();
}

/// Variance of the antennas' levels, due to cables and settings [dB²].
constexpr double kLevelVariance = 9.0;

double weight_of_mean(const Nearest& of, double variance) {
  return 1.0 / (variance / of.independent + kLevelVariance);
}

/// B over its standard deviation: how significantly RSSI increases towards the boresight.
double forward_score(const std::vector<AimedSeries>& all, const Eigen::Vector3d& p_WT) {
  constexpr double kMinVariance = 1.0;  // [dB²]
  const double farthest = farthest_of_nearest(all, p_WT);
  std::vector<Nearest> nearest;
  nearest.reserve(all.size());
  for (const AimedSeries& series : all) {
    nearest.push_back(nearest_of(series, p_WT, farthest));
    if (nearest.back().x.size() < 2) nearest.pop_back();
  }
  double variance = kMinVariance;
  for (const Nearest& of : nearest) variance = std::max(variance, of.scatter());
  Regression sums;
  for (const Nearest& of : nearest) {
    add_within(of, variance, sums);
    const double weight = weight_of_mean(of, variance);
    sums.weight += weight;
    sums.x += weight * of.x.mean();
    sums.y += weight * of.y.mean();
  }
  for (const Nearest& of : nearest) {
    const double weight = weight_of_mean(of, variance);
    const double apart = of.x.mean() - sums.x / sums.weight;
    sums.xx += weight * apart * apart;
    sums.xy += weight * apart * (of.y.mean() - sums.y / sums.weight);
  }
  return sums.xx > 0.0 ? sums.xy / std::sqrt(sums.xx) : 0.0;
}

void drop_behind(const std::vector<AimedSeries>& all, TagEstimate& estimate) {
  constexpr double kBehind = -2.33;  // One in a hundred.
  std::vector<double> scores;
  scores.reserve(estimate.candidates.size());
  for (const Candidate& candidate : estimate.candidates) {
    scores.push_back(forward_score(all, candidate.p_WT));
  }
  if (*std::max_element(scores.begin(), scores.end()) <= 0.0) return;
  std::vector<Candidate> kept;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (scores[i] > kBehind) kept.push_back(estimate.candidates[i]);
  }
  estimate.candidates = std::move(kept);
}

/// Located tags that are tested for being in front of the antennas, evenly spaced.
std::vector<const TagEstimate*> asked(const LocalizationProblem& problem,
                                      const LocalizationResult& result) {
  constexpr std::size_t kMaxTags = 40;
  std::vector<const TagEstimate*> some;
  for (const std::size_t i : some_of(claimed_tags(problem, result), kMaxTags)) {
    some.push_back(&result.estimates[i]);
  }
  return some;
}

/// Combined score of these tags: a standard normal variable for patterns without a front.
double forward_score(const LocalizationProblem& problem,
                     const std::vector<const TagEstimate*>& tags, const SwappedPair& swapped) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const TagEstimate* tag : tags) {
    const std::vector<AimedSeries> all =
        aimed_series(problem, problem.samples.at(tag->tag), swapped);
    if (all.empty()) continue;
    sum += forward_score(all, tag->candidates.front().p_WT);
    ++count;
  }
  return count == 0 ? 0.0 : sum / std::sqrt(static_cast<double>(count));
}

std::vector<SwappedPair> pairs_of_antennas(const std::vector<const TagEstimate*>& tags,
                                           const LocalizationProblem& problem) {
  std::set<std::string> antennas;
  for (const TagEstimate* tag : tags) {
    for (const auto& [antenna, series] : problem.samples.at(tag->tag)) {
      if (problem.tracks.count(antenna) > 0) antennas.insert(antenna);
    }
  }
  std::vector<SwappedPair> pairs;
  for (auto one = antennas.begin(); one != antennas.end(); ++one) {
    for (auto other = std::next(one); other != antennas.end(); ++other) {
      pairs.emplace_back(*one, *other);
    }
  }
  return pairs;
}

bool is_read_by(const SamplesOfTag& samples, const SwappedPair& antennas) {
  return samples.count(antennas.first) + samples.count(antennas.second) > 0;
}

void refuse_read_by(const LocalizationProblem& problem, const SwappedPair& antennas,
                    LocalizationResult& result) {
  for (const std::size_t i : claimed_tags(problem, result)) {
    TagEstimate& estimate = result.estimates[i];
    if (!is_read_by(problem.samples.at(estimate.tag), antennas)) continue;
    estimate = not_located(std::move(estimate),
                           fmt::format("antennas '{}' and '{}' read best what is behind them, as "
                                       "if they were swapped",
                                       antennas.first, antennas.second));
  }
}

}  // namespace

void drop_candidates_behind(const LocalizationProblem& problem, LocalizationResult& result) {
  for (TagEstimate& estimate : result.estimates) {
    const auto samples = problem.samples.find(estimate.tag);
    if (estimate.verdict != Verdict::kAmbiguous || samples == problem.samples.end()) continue;
    const std::vector<AimedSeries> all = aimed_series(problem, samples->second);
    if (all.empty()) continue;
    drop_behind(all, estimate);
    judge(problem.limits, estimate);
  }
}

void refuse_swapped_antennas(const LocalizationProblem& problem, LocalizationResult& result,
                             Diagnostics& diagnostics) {
  constexpr double kCertain = 3.72;  // Standard deviations: one case in ten thousand.
  const std::vector<const TagEstimate*> tags = asked(problem, result);
  if (forward_score(problem, tags, {}) > -kCertain) return;
  SwappedPair best;
  double highest = kCertain;
  for (const SwappedPair& pair : pairs_of_antennas(tags, problem)) {
    const double score = forward_score(problem, tags, pair);
    if (score < highest) continue;
    highest = score;
    best = pair;
  }
  if (best.first.empty()) return;
  diagnostics.warn(fmt::format(
      "antennas '{}' and '{}' read best what is behind them, in front of each other: are their "
      "ports, names or poses swapped? (Antennas look along their x axis.)",
      best.first, best.second));
  refuse_read_by(problem, best, result);
}

}  // namespace tagfield
