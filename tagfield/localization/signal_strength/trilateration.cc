// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/signal_strength/trilateration.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tagfield/fit/levenberg_marquardt.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/residuals.h"
#include "tagfield/localization/signal_strength/lobe.h"
#include "tagfield/localization/signal_strength/rssi_samples.h"

namespace tagfield {
namespace {

constexpr double kCell = 0.5;             ///< Of the search grid [m].
constexpr double kSameMinimum = 0.2;      ///< Minima closer than this are the same [m].
constexpr std::size_t kRssiStarts = 8;    ///< Cells from which a fit starts.
constexpr double kNearestAntenna = 0.05;  ///< Smaller distances are clamped to this [m].
constexpr double kAnything = 1e6;         ///< Expected error if nothing is known [m].
constexpr Eigen::Index kFewestBins = 6;
/// Lower bound on the error of a mean of many reads [dB], due to reflections and the antenna
/// pattern.
constexpr double kMinRssiNoise = 0.5;

/// Prior of an antenna's level [dBm at 1 m].
struct RssiLevel {
  double mean_dbm = 0.0;
  double precision = 0.0;  ///< 1/variance [1/dB²], in units of the bins' noise; 0: unknown.
};

/// Path-loss law of one problem.
struct Law {
  double slope_db = 40.0;
  std::map<std::string, RssiLevel> levels;  ///< By antenna.
};

/// The bins of one tag, grouped by antenna.
struct Bins {
  Eigen::ArrayXd x, y, z, rssi, weight;
  Spans spans;
  std::vector<Eigen::Vector3d> boresights_W;  ///< Boresights of the antennas.
  Lobe lobe;
};

Eigen::Vector3d boresight_of(const LocalizationProblem& problem, const std::string& antenna,
                             Time stamp) {
  const auto track = problem.tracks.find(antenna);
  if (track == problem.tracks.end() || track->second.X_WA.empty()) return Eigen::Vector3d::UnitX();
  return held_pose_at(track->second.X_WA, stamp).rotation * Eigen::Vector3d::UnitX();
}

Bins bins_of(const LocalizationProblem& problem, const SamplesOfTag& samples,
             const TrilaterationOptions& options) {
  Bins bins;
  const Lobe& lobe = options;
  bins.lobe = lobe;
  std::vector<RssiBin> all;
  for (const auto& [antenna, series] : rssi_along_paths(samples, options.bin_m)) {
    for (const RssiBin& bin : series) {
      bins.boresights_W.push_back(boresight_of(problem, antenna, bin.stamp));
    }
    bins.spans.push_back(
        {static_cast<Eigen::Index>(all.size()), static_cast<Eigen::Index>(series.size()), antenna});
    all.insert(all.end(), series.begin(), series.end());
  }
  const auto count = static_cast<Eigen::Index>(all.size());
  for (Eigen::ArrayXd* column : {&bins.x, &bins.y, &bins.z, &bins.rssi, &bins.weight}) {
    column->resize(count);
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const RssiBin& bin = all[static_cast<std::size_t>(i)];
    bins.x[i] = bin.p_WA.x();
    bins.y[i] = bin.p_WA.y();
    bins.z[i] = bin.p_WA.z();
    bins.rssi[i] = bin.rssi_dbm;
    // With more than a few reads, the error of a bin is dominated by the surroundings.
    bins.weight[i] = std::min(bin.reads, 4.0) / 4.0;
  }
  return bins;
}

Eigen::ArrayXd distances(const Bins& bins, const Eigen::Vector3d& p_WT) {
  return ((bins.x - p_WT.x()).square() + (bins.y - p_WT.y()).square() +
          (bins.z - p_WT.z()).square())
      .sqrt()
      .max(kNearestAntenna);
}

/// Gains of the lobes towards a tag [dB].
Eigen::ArrayXd gains(const Bins& bins, const Eigen::Vector3d& p_WT) {
  Eigen::ArrayXd gain = Eigen::ArrayXd::Zero(bins.rssi.size());
  if (bins.lobe.beam_width_deg <= 0.0) return gain;
  for (Eigen::Index i = 0; i < gain.size(); ++i) {
    const Eigen::Vector3d p_WA(bins.x[i], bins.y[i], bins.z[i]);
    gain[i] = lobe_db(bins.lobe, bins.boresights_W[static_cast<std::size_t>(i)], p_WT - p_WA);
  }
  return gain;
}

/// Derivatives of the gains along an axis [dB/m].
Eigen::ArrayXd gain_slopes(const Bins& bins, const Eigen::Vector3d& p_WT,
                           const Eigen::Vector3d& axis) {
  constexpr double kStep = 1e-4;  // [m]
  return (gains(bins, p_WT + kStep * axis) - gains(bins, p_WT - kStep * axis)) / (2.0 * kStep);
}

RssiLevel level_of(const Law& law, const std::string& antenna) {
  const auto level = law.levels.find(antenna);
  return level == law.levels.end() ? RssiLevel{} : level->second;
}

/// Best-fitting level of a span, including its prior.
double best_level(const Bins& bins, const TagPhases::Span& span, const RssiLevel& known,
                  const Eigen::ArrayXd& above_line) {
  const auto weight = bins.weight.segment(span.begin, span.count);
  const double sum = (weight * above_line.segment(span.begin, span.count)).sum();
  return (sum + known.precision * known.mean_dbm) / (weight.sum() + known.precision);
}

/// RSSI minus that of the law with fitted levels, times the square root of the weight [dB].
struct Misfit {
  Eigen::ArrayXd residuals;
  double cost = 0.0;  ///< Including the cost of the levels' deviations.
};

Misfit misfit_at(const Bins& bins, const Law& law, const Eigen::Vector3d& p_WT) {
  Misfit misfit;
  misfit.residuals = bins.rssi - gains(bins, p_WT) + law.slope_db * distances(bins, p_WT).log10();
  for (const TagPhases::Span& span : bins.spans) {
    const RssiLevel known = level_of(law, span.antenna);
    const double level = best_level(bins, span, known, misfit.residuals);
    misfit.residuals.segment(span.begin, span.count) -= level;
    misfit.cost += known.precision * (level - known.mean_dbm) * (level - known.mean_dbm);
  }
  misfit.residuals *= bins.weight.sqrt();
  misfit.cost += misfit.residuals.square().sum();
  return misfit;
}

/// Σ J Jᵀ for x and y [dB²/m²] with levels eliminated, and the gradient.
struct RssiStep {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
};

RssiStep step_at(const Bins& bins, const Law& law, const Eigen::Vector3d& p_WT,
                 const Eigen::ArrayXd& residuals) {
  const Eigen::ArrayXd square = distances(bins, p_WT).square();
  const double factor = -law.slope_db / std::log(10.0);
  Eigen::ArrayXd ux =
      factor * (p_WT.x() - bins.x) / square + gain_slopes(bins, p_WT, Eigen::Vector3d::UnitX());
  Eigen::ArrayXd uy =
      factor * (p_WT.y() - bins.y) / square + gain_slopes(bins, p_WT, Eigen::Vector3d::UnitY());
  RssiStep step;
  for (const TagPhases::Span& span : bins.spans) {
    const auto weight = bins.weight.segment(span.begin, span.count);
    const double sum = weight.sum() + level_of(law, span.antenna).precision;
    for (Eigen::ArrayXd* column : {&ux, &uy}) {
      auto part = column->segment(span.begin, span.count);
      const double mean = (weight * part).sum() / sum;
      part -= mean;
    }
  }
  const Eigen::ArrayXd root = bins.weight.sqrt();
  ux *= root;
  uy *= root;
  step.normal << ux.square().sum(), (ux * uy).sum(), (ux * uy).sum(), uy.square().sum();
  step.gradient = {(ux * residuals).sum(), (uy * residuals).sum()};
  return step;
}

struct Fit {
  Eigen::Vector3d p_WT;
  double cost = 0.0;
};

/// State of a fit.
struct RssiPoint {
  Eigen::Vector3d p_WT;
  Eigen::ArrayXd residuals;
  double cost = 0.0;
};

RssiPoint point_at(const Bins& bins, const Law& law, const Eigen::Vector3d& p_WT) {
  Misfit misfit = misfit_at(bins, law, p_WT);
  return {p_WT, std::move(misfit.residuals), misfit.cost};
}

/// Fit refined in the plane of the tag.
Fit refined(const Bins& bins, const Law& law, const Eigen::Vector3d& start) {
  constexpr double kTolerance = 1e-5;  // [m]
  constexpr double kRidge = 1e-9;
  constexpr double kLongestStep = 1.0;  // [m]
  constexpr LevenbergMarquardt kHow{.max_steps = 30, .damping = 1e-3, .raise = 8.0};
  const auto step = [&](const RssiPoint& here, double damping) -> std::optional<RssiPoint> {
    const RssiStep at = step_at(bins, law, here.p_WT, here.residuals);
    Eigen::Vector2d move = evenly_damped(at.normal, damping, kRidge).inverse() * at.gradient;
    if (!is_worthwhile(move, kTolerance)) return std::nullopt;
    if (move.norm() > kLongestStep) move.normalize();
    return point_at(bins, law, here.p_WT + Eigen::Vector3d(move.x(), move.y(), 0.0));
  };
  const RssiPoint best = descend(point_at(bins, law, start), kHow, step);
  return {best.p_WT, best.cost};
}

std::vector<Fit> distinct(std::vector<Fit> fits, double apart, std::size_t count) {
  std::stable_sort(fits.begin(), fits.end(),
                   [](const Fit& a, const Fit& b) { return a.cost < b.cost; });
  std::vector<Fit> kept;
  for (const Fit& fit : fits) {
    const bool is_new = std::all_of(kept.begin(), kept.end(), [&](const Fit& other) {
      return (other.p_WT - fit.p_WT).norm() > apart;
    });
    if (is_new && kept.size() < count) kept.push_back(fit);
  }
  return kept;
}

bool in_reach(const Bins& bins, const Eigen::Vector3d& p_WT, double max_range) {
  return distances(bins, p_WT).maxCoeff() <= max_range;
}

/// Misfits over the area within range of all reads.
std::vector<Fit> cells_of(const Bins& bins, const Law& law, double height, double max_range) {
  const Eigen::Vector3d middle(0.5 * (bins.x.minCoeff() + bins.x.maxCoeff()),
                               0.5 * (bins.y.minCoeff() + bins.y.maxCoeff()), height);
  std::vector<Fit> cells;
  const int reach = static_cast<int>(std::min(max_range / kCell, 200.0)) + 1;
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      const Eigen::Vector3d p_WT = middle + kCell * Eigen::Vector3d(i, j, 0.0);
      if (!in_reach(bins, p_WT, max_range)) continue;
      cells.push_back({p_WT, misfit_at(bins, law, p_WT).cost});
    }
  }
  return cells;
}

/// Minima of the misfit near its best cells, best first.
std::vector<Fit> minima_of(const Bins& bins, const Law& law, std::vector<Fit> cells) {
  std::vector<Fit> fits;
  for (const Fit& cell : distinct(std::move(cells), 2.0 * kCell, kRssiStarts)) {
    fits.push_back(refined(bins, law, cell.p_WT));
  }
  return distinct(std::move(fits), kSameMinimum, kRssiStarts);
}

/// Residual variance times the residuals' correlation factor [dB²].
double noise_of(const Bins& bins, const Eigen::ArrayXd& residuals) {
  return std::max(residual_variance(bins.spans, residuals), kMinRssiNoise * kMinRssiNoise) *
         correlation_factor(bins.spans, residuals);
}

Candidate candidate_at(const Bins& bins, const Law& law, const Eigen::Vector3d& p_WT) {
  const Misfit misfit = misfit_at(bins, law, p_WT);
  const double noise = noise_of(bins, misfit.residuals);
  const Eigen::Matrix2d inverse =
      noise * step_at(bins, law, p_WT, misfit.residuals).normal.inverse();
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

/// ln of the likelihood ratio of the RSSI, averaged over all positions in reach, against an
/// arbitrary RSSI that does not depend on position; each with its own residual noise.
double log_evidence(const Bins& bins, const std::vector<Fit>& cells, const Eigen::ArrayXd& best) {
  Law flat;
  flat.slope_db = 0.0;
  Bins unaimed = bins;
  unaimed.lobe.beam_width_deg = 0.0;
  const double without = misfit_at(unaimed, flat, cells.front().p_WT).cost;
  const auto count = static_cast<double>(best.size());
  const double half = 0.5 * count / correlation_factor(bins.spans, best);
  const double least = count * kMinRssiNoise * kMinRssiNoise;
  Eigen::ArrayXd logs(static_cast<Eigen::Index>(cells.size()));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    logs[static_cast<Eigen::Index>(i)] =
        half * std::log(std::max(without, least) / std::max(cells[i].cost, least));
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
void widen(const Bins& bins, const Law& law, const std::vector<Fit>& cells,
           std::vector<Candidate>& candidates) {
  const Misfit best = misfit_at(bins, law, candidates.front().p_WT);
  const double noise = noise_of(bins, best.residuals);
  std::vector<double> sums(candidates.size());
  std::vector<Eigen::Matrix2d> squares(candidates.size(), Eigen::Matrix2d::Zero());
  for (const Fit& cell : cells) {
    const auto away = [&](const Candidate& c) { return (c.p_WT - cell.p_WT).head<2>().norm(); };
    const auto nearest =
        std::min_element(candidates.begin(), candidates.end(),
                         [&](const Candidate& a, const Candidate& b) { return away(a) < away(b); });
    const auto k = static_cast<std::size_t>(nearest - candidates.begin());
    const Eigen::Vector2d off = (cell.p_WT - nearest->p_WT).head<2>();
    const double weight = std::exp(-0.5 * (cell.cost - best.cost) / noise);
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
    const Bins bins = bins_of(problem, samples->second, options);
    const Eigen::ArrayXd logs = distances(bins, p_WT).log10();
    const Eigen::ArrayXd rssi = bins.rssi - gains(bins, p_WT);
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

/// Weight of the slope's prior: its precision in units of about 2 dB of noise.
double prior_weight(const TrilaterationOptions& options) {
  constexpr double kNoise = 2.0;
  return kNoise * kNoise / (options.slope_sigma_db * options.slope_sigma_db);
}

/// The law from the reference tags; levels only if there are any.
Law law_of_references(const LocalizationProblem& problem, const TrilaterationOptions& options) {
  const auto sums = sums_of_references(problem, options);
  Law law;
  law.slope_db = options.slope_db;
  double squares = 0.0;
  double products = 0.0;
  for (const auto& [antenna, sum] : sums) {
    squares += sum.log_log - sum.log * sum.log / sum.weight;
    products += sum.log_rssi - sum.log * sum.rssi / sum.weight;
  }
  if (options.slope_sigma_db > 0.0 && !sums.empty()) {
    const double prior = prior_weight(options);
    law.slope_db = std::max(10.0, (prior * options.slope_db - products) / (prior + squares));
  }
  constexpr double kNoise = 2.0;
  const double spread = std::max(options.tag_sigma_db, 0.1);
  for (const auto& [antenna, sum] : sums) {
    law.levels[antenna] = {(sum.rssi + law.slope_db * sum.log) / sum.weight,
                           kNoise * kNoise / (spread * spread)};
  }
  return law;
}

/// Total cost of all tags for a given slope.
double cost_of(const std::vector<Bins>& tags, const std::vector<double>& heights, const Law& law,
               const TrilaterationOptions& options) {
  double cost = prior_weight(options) * std::pow(law.slope_db - options.slope_db, 2);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const std::vector<Fit> fits =
        minima_of(tags[i], law, cells_of(tags[i], law, heights[i], options.max_range_m));
    if (!fits.empty()) cost += fits.front().cost;
  }
  return cost;
}

/// Without reference tags: the slope that fits all tags best.
double fitted_slope(const LocalizationProblem& problem, const TrilaterationOptions& options) {
  constexpr std::size_t kMaxTags = 12;
  std::vector<Bins> tags;
  std::vector<double> heights;
  for (const auto& [tag, samples] : problem.samples) {
    Bins bins = bins_of(problem, samples, options);
    if (bins.rssi.size() < kFewestBins || tags.size() == kMaxTags) continue;
    tags.push_back(std::move(bins));
    heights.push_back(plane_height(problem, tag));
  }
  double best = options.slope_db;
  double least = -1.0;
  for (int i = -4; i <= 4; ++i) {
    Law law;
    law.slope_db = options.slope_db + 0.5 * options.slope_sigma_db * i;
    if (law.slope_db < 10.0) continue;
    const double cost = cost_of(tags, heights, law, options);
    if (least < 0.0 || cost < least) best = law.slope_db;
    least = least < 0.0 ? cost : std::min(least, cost);
  }
  return best;
}

Law law_of(const LocalizationProblem& problem, const TrilaterationOptions& options) {
  Law law = law_of_references(problem, options);
  if (law.levels.empty() && options.slope_sigma_db > 0.0) {
    law.slope_db = fitted_slope(problem, options);
  }
  return law;
}

std::string why_not(const SamplesOfTag& samples, const Bins& bins) {
  if (count_reads(samples) == 0) return "no reads that have an antenna pose";
  if (bins.rssi.size() == 0) return "no read has an RSSI";
  if (bins.rssi.size() < kFewestBins) {
    return fmt::format("RSSI from only {} positions, at least {} are needed", bins.rssi.size(),
                       kFewestBins);
  }
  return "";
}

TagEstimate locate_by_strength(const LocalizationProblem& problem, const Law& law,
                               const std::string& tag, const SamplesOfTag& samples,
                               const TrilaterationOptions& options) {
  TagEstimate estimate = begun(tag, samples);
  const Bins bins = bins_of(problem, samples, options);
  const std::string why = why_not(samples, bins);
  if (!why.empty()) return not_located(std::move(estimate), why);
  const std::vector<Fit> cells =
      cells_of(bins, law, plane_height(problem, tag), options.max_range_m);
  if (cells.empty())
    return not_located(std::move(estimate), "no position is within range of all reads");
  const std::vector<Fit> fits = minima_of(bins, law, cells);
  const Eigen::ArrayXd best = misfit_at(bins, law, fits.front().p_WT).residuals;
  const double misfit_db = std::sqrt(best.square().mean());
  if (misfit_db > options.max_misfit_db) {
    return not_located(std::move(estimate),
                       fmt::format("RSSI does not fit a law of distance: misfit {:.1f} dB, limit "
                                   "{:.1f} dB",
                                   misfit_db, options.max_misfit_db));
  }
  if (log_evidence(bins, cells, best) < kMinLogEvidence) {
    return not_located(std::move(estimate), "RSSI shows no significant dependence on distance");
  }
  for (const Fit& fit : fits) {
    const bool first = estimate.candidates.empty();
    if (first || !tells_apart(bins.spans, best, misfit_at(bins, law, fit.p_WT).residuals)) {
      estimate.candidates.push_back(candidate_at(bins, law, fit.p_WT));
    }
  }
  widen(bins, law, cells, estimate.candidates);
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
  const Law law = law_of(problem, options);
  return locate_each(problem, threads, [&](const std::string& tag, const SamplesOfTag& samples) {
    return locate_by_strength(problem, law, tag, samples, options);
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
