// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/scan/scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/base/parallel.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/problem.h"
#include "tagfield/localization/scan/pooled_distance.h"
#include "tagfield/localization/scan/two_paths.h"

namespace tagfield {
namespace {

/// Intermediate results of one tag.
struct ScannedTag {
  std::string tag;
  const SamplesOfTag* samples = nullptr;
  ScanField scan;
  ScanGrid grid;
  double one_path = 0.0;  ///< Share of the field's power that the best single path explains.
  TwoPathLikelihood likelihood;
  std::string why_not;
};

/// Probability that some position explains a field of pure noise as well by chance: (1 − share)^(n
/// − 1) for one position and n independent samples, times at most n² distinct positions, as many as
/// pairs of samples.
double chance(const ScanField& scan, double share) {
  const auto n = static_cast<double>(scan.along_m.size());
  return n * n * std::pow(1.0 - share, n - 1.0);
}

Eigen::Vector2d place_of(const ScannedTag& tag, double along, double away) {
  return tag.scan.line.middle + along * tag.scan.line.along + away * tag.scan.line.left();
}

void look_at(const LocalizationProblem& problem, const ScanOptions& options, ScannedTag& tag) {
  constexpr double kMaxChance = 1e-4;
  tag.scan = scan_field(problem, tag.tag, *tag.samples);
  tag.why_not = tag.scan.why_not;
  if (!tag.why_not.empty()) return;
  tag.grid = scan_grid(tag.scan, options.max_range_m);
  tag.one_path = one_path_share(tag.scan, tag.grid);
  if (chance(tag.scan, tag.one_path) > kMaxChance) {
    tag.why_not = "the phases carry no information: random ones fit as well";
    return;
  }
  tag.likelihood = two_path_likelihood(tag.scan, tag.grid);
  if (tag.likelihood.two_paths >= options.min_share) return;
  tag.why_not = fmt::format(
      "the phase does not fit a tag at rest: two paths explain {:.0f} % of its power, at least "
      "{:.0f} % should be",
      100.0 * tag.likelihood.two_paths, 100.0 * options.min_share);
}

/// Whether a tag may be at the grid's position (i, j) on this side (1 left, −1 right).
bool is_possible(const LocalizationProblem& problem, const ScannedTag& tag, Eigen::Index i,
                 Eigen::Index j, double side) {
  const Eigen::Vector2d place = place_of(tag, tag.grid.along_m[i], side * tag.grid.away_m[j]);
  return is_within(problem.area, tag.scan.line.middle, tag.scan.line.along, place);
}

/// Clears positions where no tag can be on either side.
void keep_possible(const LocalizationProblem& problem, ScannedTag& tag) {
  if (!problem.area.box) return;
  Eigen::ArrayXXd& p = tag.likelihood.relative;
  for (Eigen::Index j = 0; j < p.cols(); ++j) {
    for (Eigen::Index i = 0; i < p.rows(); ++i) {
      if (!is_possible(problem, tag, i, j, 1.0) && !is_possible(problem, tag, i, j, -1.0)) {
        p(i, j) = 0.0;
      }
    }
  }
}

/// Probabilities over the grid on one side (1 left, −1 right), within the area; not normalized.
Eigen::ArrayXXd on_side(const LocalizationProblem& problem, const ScannedTag& tag,
                        const Eigen::ArrayXd& expected, double side) {
  Eigen::ArrayXXd p = tag.likelihood.relative.rowwise() * expected.transpose();
  for (Eigen::Index j = 0; j < p.cols(); ++j) {
    for (Eigen::Index i = 0; i < p.rows(); ++i) {
      if (!is_possible(problem, tag, i, j, side)) p(i, j) = 0.0;
    }
  }
  return p;
}

/// Median of a distribution over `at`, interpolated.
double median_of(const Eigen::ArrayXd& at, const Eigen::ArrayXd& probability) {
  const double half = 0.5 * probability.sum();
  double sum = 0.0;
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    const double next = sum + probability[i];
    if (next >= half) {
      const double part = (half - sum) / std::max(probability[i], 1e-300) - 0.5;
      const Eigen::Index other =
          std::clamp<Eigen::Index>(part < 0.0 ? i - 1 : i + 1, 0, at.size() - 1);
      return at[i] + std::abs(part) * (at[other] - at[i]);
    }
    sum = next;
  }
  return at[at.size() - 1];
}

/// Candidate on one side: the medians along and away, and the scatter around them plus the variance
/// within a cell.
Candidate candidate_of(const ScannedTag& tag, const Eigen::ArrayXXd& p, double side) {
  const double along = median_of(tag.grid.along_m, p.rowwise().sum());
  const double away = median_of(tag.grid.away_m, p.colwise().sum().transpose());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (Eigen::Index j = 0; j < p.cols(); ++j) {
    for (Eigen::Index i = 0; i < p.rows(); ++i) {
      const Eigen::Vector2d apart(tag.grid.along_m[i] - along, tag.grid.away_m[j] - away);
      scatter += p(i, j) / p.sum() * apart * apart.transpose();
    }
  }
  const double cell = tag.grid.along_m[1] - tag.grid.along_m[0];
  scatter(0, 0) += cell * cell / 12.0;
  scatter(1, 1) += std::pow(away * (tag.grid.away_m[1] / tag.grid.away_m[0] - 1.0), 2) / 12.0;
  Eigen::Matrix2d turn;
  turn << tag.scan.line.along, side * tag.scan.line.left();
  Candidate candidate;
  const Eigen::Vector2d place = place_of(tag, along, side * away);
  candidate.p_WT = {place.x(), place.y(), 0.0};
  candidate.covariance = Eigen::Matrix3d::Zero();
  candidate.covariance->topLeftCorner<2, 2>() = turn * scatter * turn.transpose();
  candidate.expected_error_m = std::sqrt(scatter.trace());
  return candidate;
}

/// Phase residual of the single-path fit, assuming equal noise in both quadratures [m].
double misfit_of(const ScannedTag& tag) {
  const double noise = std::sqrt(std::max(1.0 - tag.one_path, 0.0));
  return noise / tag.scan.wavenumber;
}

void judge(const ScanOptions& options, TagEstimate& estimate) {
  const Candidate& best = estimate.candidates.front();
  if (best.expected_error_m > options.max_error_m) {
    estimate = not_located(std::move(estimate),
                           fmt::format("geometry too weak: expected error {:.2f} m, limit {:.2f} m",
                                       best.expected_error_m, options.max_error_m));
    return;
  }
  estimate.verdict = estimate.candidates.size() == 1 ? Verdict::kLocated : Verdict::kAmbiguous;
  if (estimate.verdict == Verdict::kAmbiguous) {
    estimate.reason =
        "the tag may be on either side of the straight path; a known side, or a turn in the path, "
        "would distinguish them";
  }
}

TagEstimate estimate_of(const LocalizationProblem& problem, const ScannedTag& tag,
                        const Eigen::ArrayXd& expected, const ScanOptions& options) {
  // The furthest positions represent all those further away.
  constexpr double kMaxAtEnd = 0.05;
  constexpr Eigen::Index kEnd = 3;
  TagEstimate estimate = begun(tag.tag, *tag.samples);
  const double height = tag.scan.up_m + tag.samples->begin()->second.front().p_WA.z();
  for (const double side : {1.0, -1.0}) {
    const Eigen::ArrayXXd p = on_side(problem, tag, expected, side);
    if (!(p.sum() > 1e-200)) continue;
    if (p.rightCols(kEnd).sum() > kMaxAtEnd * p.sum()) {
      return not_located(std::move(estimate), "geometry too weak: the tag may be anywhere");
    }
    estimate.candidates.push_back(candidate_of(tag, p, side));
    estimate.candidates.back().p_WT.z() = height;
    estimate.candidates.back().rms_m = misfit_of(tag);
  }
  if (estimate.candidates.empty()) {
    return not_located(std::move(estimate), "no position explains the phase where tags can be");
  }
  judge(options, estimate);
  return estimate;
}

std::vector<ScannedTag> look_at_all(const LocalizationProblem& problem, int threads,
                                    const ScanOptions& options) {
  std::vector<ScannedTag> tags;
  for (const auto& [tag, samples] : problem.samples) {
    tags.emplace_back();
    tags.back().tag = tag;
    tags.back().samples = &samples;
  }
  parallel_for(tags.size(), threads, [&](std::size_t i) {
    if (problem.reference_tags.count(tags[i].tag) > 0) return;
    look_at(problem, options, tags[i]);
    keep_possible(problem, tags[i]);
  });
  return tags;
}

/// Prior of each tag's distance from the other tags with a valid scan.
std::vector<Eigen::ArrayXd> pooled(const std::vector<ScannedTag>& tags) {
  std::vector<Eigen::ArrayXd> likelihoods;
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (!tags[i].why_not.empty() || tags[i].grid.away_m.size() == 0) continue;
    likelihoods.emplace_back(tags[i].likelihood.relative.colwise().sum().transpose());
    which.push_back(i);
  }
  std::vector<Eigen::ArrayXd> expected(tags.size());
  if (which.empty()) return expected;
  const std::vector<Eigen::ArrayXd> found =
      expected_distances(tags[which.front()].grid.away_m, likelihoods);
  for (std::size_t k = 0; k < which.size(); ++k) expected[which[k]] = found[k];
  return expected;
}

std::vector<TagEstimate> locate_by_scan(const LocalizationProblem& problem, int threads,
                                        const ScanOptions& options) {
  const std::vector<ScannedTag> tags = look_at_all(problem, threads, options);
  const std::vector<Eigen::ArrayXd> expected = pooled(tags);
  std::vector<TagEstimate> estimates;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const ScannedTag& tag = tags[i];
    const auto known = problem.reference_tags.find(tag.tag);
    if (known != problem.reference_tags.end()) {
      estimates.push_back(reference_estimate(tag.tag, known->second));
    } else if (!tag.why_not.empty()) {
      estimates.push_back(not_located(begun(tag.tag, *tag.samples), tag.why_not));
    } else {
      estimates.push_back(estimate_of(problem, tag, expected[i], options));
    }
  }
  return estimates;
}

/// Keys of the options.
const OptionTable<ScanOptions>& scan_options() {
  using O = ScanOptions;
  static const OptionTable<O> of{
      {setting<O>("max_range_m", "m", "maximum distance of a tag from the scan", &O::max_range_m,
                  {0.5, true, 1e3}),
       setting<O>("max_error_m", "m", "with a larger expected error a tag is not given as located",
                  &O::max_error_m, kOverZero),
       setting<O>("min_share", "", "minimum share of the field's power that two paths explain",
                  &O::min_share, {0.0, true, 1.0})}};
  return of;
}

}  // namespace

Method scan_method(const ScanOptions& options) {
  return method_with("scan", "a short straight scan amid reflections: phase and RSSI by two paths",
                     scan_options(), options, locate_by_scan);
}

}  // namespace tagfield
