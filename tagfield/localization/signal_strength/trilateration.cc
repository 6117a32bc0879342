// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/signal_strength/trilateration.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tagfield/localization/judgement.h"
#include "tagfield/localization/residuals.h"
#include "tagfield/localization/signal_strength/lobe.h"
#include "tagfield/localization/signal_strength/path_loss_law.h"
#include "tagfield/localization/signal_strength/rssi_search.h"

namespace tagfield {
namespace {

constexpr double kAnything = 1e6;  ///< Expected error if nothing is known [m].

/// Σ J Jᵀ for x and y [dB²/m²], with the slope within its prior eliminated.
Eigen::Matrix2d information_at(const BinnedRssi& bins, const PathLossLaw& law,
                               const Eigen::Vector3d& p_WT, const RssiMisfit& misfit,
                               double noise_db2) {
  const Eigen::Matrix3d all = normal_at(bins, law, p_WT, misfit).matrix;
  Eigen::Matrix2d information = all.topLeftCorner<2, 2>();
  if (!(law.slope_sigma_db > 0.0)) return information;
  const double of_slope = all(2, 2) + noise_db2 / (law.slope_sigma_db * law.slope_sigma_db);
  return information - all.topRightCorner<2, 1>() * all.bottomLeftCorner<1, 2>() / of_slope;
}

Candidate candidate_at(const BinnedRssi& bins, const PathLossLaw& law,
                       const Eigen::Vector3d& p_WT) {
  const RssiMisfit misfit = misfit_at(bins, law, p_WT);
  const double noise = rssi_noise(bins, misfit);
  const Eigen::Matrix2d inverse = noise * information_at(bins, law, p_WT, misfit, noise).inverse();
  Candidate candidate;
  candidate.p_WT = p_WT;
  candidate.expected_error_m = kAnything;
  candidate.covariance = Eigen::Matrix3d::Zero();
  candidate.covariance->diagonal().head<2>().setConstant(0.5 * kAnything * kAnything);
  if (inverse.allFinite() && inverse.trace() > 0.0 && inverse.trace() < kAnything * kAnything) {
    candidate.covariance->topLeftCorner<2, 2>() = inverse;
    candidate.expected_error_m = std::sqrt(inverse.trace());
  }
  // The misfit converted to distance, at the mean distance.
  candidate.rms_m = std::sqrt(misfit.residuals.square().mean()) * std::log(10.0) / law.slope_db *
                    distances(bins, p_WT).mean();
  return candidate;
}

/// Positions of a tag by a law.
struct Placed {
  PathLossLaw law;
  std::vector<RssiCell> cells;
  std::vector<RssiFit> fits;  ///< Best first.
  Eigen::ArrayXd best;        ///< Residuals of the first.
};

/// Positions within range of all reads; without fits if there are none.
Placed placed_by(const BinnedRssi& bins, const PathLossLaw& law, double height,
                 double max_range_m) {
  Placed placed{law, rssi_cells(bins, law, height, max_range_m), {}, {}};
  placed.fits = rssi_minima(bins, law, placed.cells, max_range_m);
  if (!placed.fits.empty()) placed.best = misfit_at(bins, law, placed.fits.front().p_WT).residuals;
  return placed;
}

bool is_excluded(const BinnedRssi& bins, const Placed& by, const Eigen::Vector3d& p_WT) {
  return tells_apart(bins.spans, by.best, misfit_at(bins, by.law, p_WT).residuals);
}

/// ln of the likelihood ratio of the RSSI, averaged over all positions in reach, against an
/// arbitrary RSSI that does not depend on position; each with its own residual noise.
double log_evidence(const BinnedRssi& bins, const Placed& by) {
  const auto& [law, cells, fits, best] = by;
  PathLossLaw flat;
  flat.slope_db = 0.0;
  BinnedRssi unaimed = bins;
  unaimed.lobe.beam_width_deg = 0.0;
  const double without = misfit_at(unaimed, flat, fits.front().p_WT).cost;
  const auto count = static_cast<double>(best.size());
  const double half = 0.5 * count / correlation_factor(bins.spans, best);
  const double least = count * kMinRssiNoise * kMinRssiNoise;
  Eigen::ArrayXd logs(static_cast<Eigen::Index>(cells.size()));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    logs[static_cast<Eigen::Index>(i)] =
        half *
        std::log(std::max(without, least) / std::max(cost_of(cells[i], law.slope_db), least));
  }
  const double most = logs.maxCoeff();
  return most + std::log((logs - most).exp().mean());
}

/// Adds the uncertainty of the reads' positions within a bin, which limits that of a tag.
void add_bin_length(double bin_m, Candidate& candidate) {
  candidate.covariance->diagonal().head<2>().array() += bin_m * bin_m / 12.0;
  candidate.expected_error_m = std::hypot(candidate.expected_error_m, bin_m / std::sqrt(6.0));
}

/// Widens candidates' covariances where misfits over the area suggest a larger spread than
/// derivatives do: the mean squares around each candidate over the cells nearest to it.
void widen(const BinnedRssi& bins, const PathLossLaw& law, const std::vector<RssiCell>& cells,
           std::vector<Candidate>& candidates) {
  const RssiMisfit best = misfit_at(bins, law, candidates.front().p_WT);
  const double noise = rssi_noise(bins, best);
  std::vector<double> sums(candidates.size());
  std::vector<Eigen::Matrix2d> squares(candidates.size(), Eigen::Matrix2d::Zero());
  for (const RssiCell& cell : cells) {
    const auto away = [&](const Candidate& c) { return (c.p_WT - cell.p_WT).head<2>().norm(); };
    const auto nearest =
        std::min_element(candidates.begin(), candidates.end(),
                         [&](const Candidate& a, const Candidate& b) { return away(a) < away(b); });
    const auto k = static_cast<std::size_t>(nearest - candidates.begin());
    const Eigen::Vector2d off = (cell.p_WT - nearest->p_WT).head<2>();
    const double weight = std::exp(-0.5 * (cost_of(cell, law.slope_db) - best.cost) / noise -
                                   0.5 * (cell.cost.log_determinant - best.log_determinant));
    sums[k] += weight;
    squares[k] += weight * off * off.transpose();
  }
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    Candidate& candidate = candidates[k];
    const Eigen::Matrix2d mean = squares[k] / std::max(sums[k], 1e-300);
    const double error = std::sqrt(mean.trace());
    if (!(error > candidate.expected_error_m)) continue;
    candidate.covariance->topLeftCorner<2, 2>() = mean;
    candidate.expected_error_m = error;
  }
}

/// Whether a position is the same as a better one: within three of its standard deviations.
bool is_part_of_any(const std::vector<Candidate>& better, const Eigen::Vector3d& p_WT,
                    double bin_m) {
  return std::any_of(better.begin(), better.end(), [&](const Candidate& other) {
    const Eigen::Matrix2d covariance = other.covariance->topLeftCorner<2, 2>() +
                                       bin_m * bin_m / 12.0 * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d off = (p_WT - other.p_WT).head<2>();
    return off.dot(covariance.inverse() * off) < 9.0;
  });
}

/// The best position by the directional law, and all that neither law excludes: gains may make up
/// for poses that are wrong.
std::vector<Candidate> candidates_of(const BinnedRssi& bins, const Placed& directional,
                                     const Placed& isotropic, double bin_m) {
  std::vector<RssiFit> fits = directional.fits;
  fits.insert(fits.end(), isotropic.fits.begin(), isotropic.fits.end());
  std::vector<Candidate> candidates;
  for (const RssiFit& fit : fits) {
    if (is_part_of_any(candidates, fit.p_WT, bin_m)) continue;
    if (!candidates.empty() && is_excluded(bins, directional, fit.p_WT) &&
        is_excluded(bins, isotropic, fit.p_WT)) {
      continue;
    }
    candidates.push_back(candidate_at(bins, directional.law, fit.p_WT));
  }
  return candidates;
}

std::string why_not(const SamplesOfTag& samples, const BinnedRssi& bins) {
  if (count_reads(samples) == 0) return "no reads that have an antenna pose";
  if (bins.rssi.size() == 0) return "no read has an RSSI";
  if (bins.rssi.size() < kFewestRssiBins) {
    return fmt::format("RSSI from only {} positions, at least {} are needed", bins.rssi.size(),
                       kFewestRssiBins);
  }
  return "";
}

TagEstimate locate_by_strength(const LocalizationProblem& problem, const PathLossLaws& laws,
                               const std::string& tag, const SamplesOfTag& samples,
                               const TrilaterationOptions& options) {
  TagEstimate estimate = begun(tag, samples);
  const BinnedRssi bins = binned_rssi(problem, samples, options.bin_m, options);
  const std::string why = why_not(samples, bins);
  if (!why.empty()) return not_located(std::move(estimate), why);
  const double height = plane_height(problem, tag);
  const Placed isotropic = placed_by(bins, laws.isotropic, height, options.max_range_m);
  if (isotropic.fits.empty())
    return not_located(std::move(estimate), "no position is within range of all reads");
  const double misfit_db = std::sqrt(isotropic.best.square().mean());
  if (misfit_db > options.max_misfit_db) {
    return not_located(std::move(estimate),
                       fmt::format("RSSI does not fit a law of distance: misfit {:.1f} dB, limit "
                                   "{:.1f} dB",
                                   misfit_db, options.max_misfit_db));
  }
  // With gains that vary with direction, anything slow would fit.
  if (log_evidence(bins, isotropic) < kMinLogEvidence) {
    return not_located(std::move(estimate), "RSSI shows no significant dependence on distance");
  }
  const bool has_gains = laws.directional.pattern_sigma_db > 0.0;
  const Placed directional =
      has_gains ? placed_by(bins, laws.directional, height, options.max_range_m) : isotropic;
  estimate.candidates = candidates_of(bins, directional, isotropic, options.bin_m);
  widen(bins, directional.law, directional.cells, estimate.candidates);
  for (Candidate& candidate : estimate.candidates) add_bin_length(options.bin_m, candidate);
  EstimateLimits limits;
  limits.max_expected_error_m = options.max_expected_error_m;
  limits.max_rms_m = std::numeric_limits<double>::infinity();  // The misfit was judged above.
  judge(limits, estimate);
  if (estimate.verdict == Verdict::kAmbiguous) {
    estimate.reason =
        fmt::format("{} positions explain the RSSI equally well", estimate.candidates.size());
  }
  return estimate;
}

std::vector<TagEstimate> locate_by_rssi(const LocalizationProblem& problem, int threads,
                                        const TrilaterationOptions& options) {
  const PathLossLaws laws = path_loss_laws(problem, options);
  return locate_each(problem, threads, [&](const std::string& tag, const SamplesOfTag& samples) {
    return locate_by_strength(problem, laws, tag, samples, options);
  });
}

/// Keys of the options.
const OptionTable<TrilaterationOptions>& trilateration_options() {
  using O = TrilaterationOptions;
  static const OptionTable<O> of{with_lobe<O>(
      {setting<O>("slope_db", "dB", "by which RSSI falls for ten times the distance", &O::slope_db,
                  kOverZero),
       setting<O>("slope_sigma_db", "dB", "prior standard deviation of that", &O::slope_sigma_db,
                  kAtLeastZero),
       setting<O>("tag_sigma_db", "dB", "standard deviation between tags of one kind",
                  &O::tag_sigma_db, kAtLeastZero),
       setting<O>("bin_m", "m", "reads over this distance of travel are averaged", &O::bin_m,
                  kOverZero),
       setting<O>("max_range_m", "m", "maximum distance from which a tag is read", &O::max_range_m,
                  kOverZero),
       setting<O>("rssi_max_error_m", "m",
                  "with a larger expected error a tag is not given as located",
                  &O::max_expected_error_m, kOverZero),
       setting<O>("max_misfit_db", "dB", "with a larger rms, RSSI follows no law of distance",
                  &O::max_misfit_db, kOverZero)})};
  return of;
}

}  // namespace

Method trilateration_method(const TrilaterationOptions& options) {
  return ignoring(
      {"offset", "pi_ambiguity", "pose_error", "max_expected_error_m", "max_rms_m"},
      method_with("trilateration", "distances by RSSI over a logarithmic law, its slope fitted too",
                  trilateration_options(), options, locate_by_rssi));
}

}  // namespace tagfield
