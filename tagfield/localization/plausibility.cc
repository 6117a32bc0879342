// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tagfield/base/units.h"
#include "tagfield/localization/each_position.h"
#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/outliers.h"
#include "tagfield/localization/residuals.h"
#include "tagfield/localization/tag_fit.h"

namespace tagfield {
namespace {

constexpr double kMaxChance = 1e-4;
constexpr double kReach = 12.0;  ///< Positions are searched within this range [m].

/// ln E e^(λ·2|cos(θ/2)|) over all θ, by the midpoint rule.
double log_mean_of_two(double lambda) {
  constexpr int kSteps = 64;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = 0.5 * kPi * (i + 0.5) / kSteps;
    sum += std::exp(2.0 * lambda * (std::cos(angle) - 1.0));
  }
  return 2.0 * lambda + std::log(sum / kSteps);
}

/// ln E e^(λ|S|) of n random phasors; for Rayleigh's distribution with σ² = n/2 that is ln(1 + a
/// √(π/2) e^(a²/2) (1 + erf(a/√2))), a = λσ.
double log_mean(double n, double lambda) {
  if (n < 1.5) return lambda * n;
  if (n < 2.5) return log_mean_of_two(lambda);
  const double a = lambda * std::sqrt(0.5 * n);
  const double tail = a * std::sqrt(kPi / 2.0) * (1.0 + std::erf(a / std::sqrt(2.0)));
  return 0.5 * a * a + std::log(std::exp(-0.5 * a * a) + tail);
}

/// Number of different positions within reach: over λ/4, phases change by up to π.
double places_within_reach(const TagPhases& phases) {
  const double width = 2.0 * kReach + std::max(phases.x.maxCoeff() - phases.x.minCoeff(),
                                               phases.y.maxCoeff() - phases.y.minCoeff());
  return std::pow(width / (0.5 * longest_cycle(phases)), 2);
}

double log_chance_at(const TagPhases& phases, const HeightModel& height,
                     const PositionVector& place, double length) {
  std::vector<double> reads;
  const std::vector<Aperture> pieces = apertures(phases, length);
  reads.reserve(pieces.size());
  for (const Aperture& piece : pieces) reads.push_back(static_cast<double>(piece.count));
  return log_chance(reads, coherence(phases, pieces, height, place), places_within_reach(phases));
}

/// The least over several aperture lengths: pose errors and reflections spoil long ones.
double min_log_chance(const LocalizationProblem& problem, const std::string& tag,
                      const SamplesOfTag& samples, const Eigen::Vector3d& p_WT) {
  const TagPhases phases = coherent_reads(problem, samples);
  if (phases.size() == 0) return 0.0;
  const HeightModel height = height_model(problem, tag, phases);
  const PositionVector place = to_unknowns(height, p_WT);
  const double lambda = 2.0 * longest_cycle(phases);
  double least = 0.0;
  for (const double length : {1.5 * lambda, 4.5 * lambda, 13.5 * lambda, kWholeAperture}) {
    least = std::min(least, log_chance_at(phases, height, place, length));
  }
  return least;
}

/// Share of phasors that add up at the position where most of them do.
double best_share(const LocalizationProblem& problem, const std::string& tag,
                  const SamplesOfTag& samples) {
  const HologramPeak there = hologram_peak(problem, tag, samples);
  return there.residuals_rad.size() == 0 ? 0.0 : there.residuals_rad.cos().mean();
}

SamplesOfTag with_other_sign(SamplesOfTag samples) {
  for (auto& [antenna, series] : samples) {
    for (PhaseSample& sample : series) sample.phase_rad = wrap_to_two_pi(-sample.phase_rad);
  }
  return samples;
}

/// Whether the phases fit a position much better with the opposite sign.
bool fits_other_sign(const LocalizationProblem& problem, const std::string& tag,
                     const SamplesOfTag& samples) {
  // Phases that fit with one sign have residuals of about a radian with the other.
  constexpr double kBetter = 0.1;
  const double as_given = best_share(problem, tag, samples);
  if (as_given + kBetter >= 1.0) return false;  // No share is over 1.
  const double other = best_share(problem, tag, with_other_sign(samples));
  return other > as_given + kBetter && other > 0.5;
}

/// Tags used to determine the sign: the first few that might be located.
std::vector<const SamplesByTag::value_type*> informative_tags(const LocalizationProblem& problem) {
  constexpr std::size_t kEnough = 3;
  std::vector<const SamplesByTag::value_type*> informative;
  for (const auto& entry : problem.samples) {
    if (problem.reference_tags.count(entry.first) > 0) continue;
    if (why_not_locatable(entry.second).empty()) informative.push_back(&entry);
    if (informative.size() == kEnough) break;
  }
  return informative;
}

void refuse(TagEstimate& estimate, const std::string& why) {
  estimate = not_located(std::move(estimate), why);
}

std::vector<Eigen::Vector2d> places_of(const SamplesOfTag& samples) {
  std::vector<Eigen::Vector2d> places;
  for (const auto& [antenna, series] : samples) {
    for (const PhaseSample& sample : series) places.emplace_back(sample.p_WA.head<2>());
  }
  return places;
}

/// Refuses the estimate if the phase residuals at a position [rad] are such a mixture.
void refuse_mixture(const Eigen::ArrayXd& angles, TagEstimate& estimate) {
  constexpr double kMaxElsewhere = 0.25;
  constexpr double kFits = 0.5;  // [rad]
  const OutlierMixture mixture = outlier_mixture(angles);
  const double certain = std::log(static_cast<double>(angles.size()));
  if (mixture.share > kMaxElsewhere && mixture.sigma_rad < kFits && mixture.evidence > certain) {
    refuse(estimate,
           fmt::format("the phase does not fit one tag at rest: {:.0f} % of the reads are outliers",
                       100.0 * mixture.share));
  }
}

constexpr double kNearLine = 0.5;  ///< Distance from the line of a straight path [m].

Eigen::Vector2d across(const PathLine& way) { return {-way.along.y(), way.along.x()}; }

bool is_straight(const std::vector<Eigen::Vector2d>& places, const PathLine& way) {
  constexpr double kStraight = 0.05;  // [m]
  return std::all_of(places.begin(), places.end(), [&](const auto& place) {
    return std::abs(across(way).dot(place - way.middle)) < kStraight;
  });
}

/// Mean square deviation [m²] from the best position over a grid around it, weighted by likelihood.
/// Ranges hardly change across the line there, so a covariance from derivatives does not capture
/// it.
Eigen::Matrix2d squares_about(const LocalizationProblem& problem, const SamplesOfTag& samples,
                              const PathLine& way, const TagEstimate& estimate) {
  constexpr int kAlong = 60;
  constexpr int kAcross = 30;
  constexpr double kStepAlong = 0.05;   // [m]
  constexpr double kStepAcross = 0.02;  // [m]
  const TagPhases phases = coherent_reads(problem, samples);
  const HeightModel height = height_model(problem, estimate.tag, phases);
  const PositionVector best = to_unknowns(height, estimate.candidates.front().p_WT);
  const auto errors_at = [&](const PositionVector& place) {
    return residuals_of(phases, height, {place, offsets_at(phases, height, place), 0.0});
  };
  const Eigen::ArrayXd least = errors_at(best);
  const double noise =
      residual_variance(phases.spans, least) * correlation_factor(phases.spans, least);
  const Eigen::Vector2d on_line =
      best.head<2>() - across(way).dot(best.head<2>() - way.middle) * across(way);
  double sum = 0.0;
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  const auto add = [&](const Eigen::Vector2d& p) {
    PositionVector place = best;
    place.head<2>() = p;
    const double more = (errors_at(place).square() - least.square()).sum() / noise;
    const double weight = std::exp(-0.5 * std::max(more, 0.0));
    const Eigen::Vector2d off = p - best.head<2>();
    sum += weight;
    squares += weight * off * off.transpose();
  };
  // Both peaks, which may be too narrow for the grid to hit them.
  add(best.head<2>());
  add(2.0 * on_line - best.head<2>());
  for (int i = -kAlong; i <= kAlong; ++i) {
    for (int j = -kAcross; j <= kAcross; ++j) {
      add(on_line + i * kStepAlong * way.along + j * kStepAcross * across(way));
    }
  }
  return squares / sum;
}

}  // namespace

double log_chance(const std::vector<double>& reads, double sum, double places) {
  std::map<double, double> groups;  // Number of apertures by number of reads.
  for (const double n : reads) groups[n] += 1.0;
  double least = 0.0;
  for (double lambda = 0.02; lambda < 40.0; lambda *= 1.25) {
    double bound = -lambda * sum;
    for (const auto& [n, count] : groups) bound += count * log_mean(n, lambda);
    least = std::min(least, bound);
  }
  return std::log(places) + least;
}

void refuse_without_phases(const LocalizationProblem& problem, LocalizationResult& result) {
  for_each_position(problem, result, [](const SamplesOfTag&, TagEstimate& estimate) {
    refuse(estimate, "the reads have no usable phases: use a method by RSSI");
  });
}

void refuse_chance(const LocalizationProblem& problem, LocalizationResult& result) {
  for_each_position(problem, result, [&](const SamplesOfTag& samples, TagEstimate& estimate) {
    const double chance =
        min_log_chance(problem, estimate.tag, samples, estimate.candidates.front().p_WT);
    if (chance > std::log(kMaxChance)) {
      refuse(estimate, "the phases carry no information: random ones fit as well");
    }
  });
}

void refuse_mixtures(const LocalizationProblem& problem, LocalizationResult& result) {
  if (!result.corrected_poses.empty() && !has_exact_poses(problem)) return;
  for_each_position(problem, result, [&](const SamplesOfTag& samples, TagEstimate& estimate) {
    const TagPhases phases = coherent_reads(problem, samples);
    if (phases.size() == 0) return;
    const HeightModel height = height_model(problem, estimate.tag, phases);
    const PositionVector place = to_unknowns(height, estimate.candidates.front().p_WT);
    const Eigen::ArrayXd errors =
        residuals_of(phases, height, {place, offsets_at(phases, height, place), 0.0});
    refuse_mixture(errors * phases.wavenumber, estimate);
  });
}

void refuse_mixtures_by_phase(const LocalizationProblem& problem, LocalizationResult& result) {
  for_each_position(problem, result, [&](const SamplesOfTag& samples, TagEstimate& estimate) {
    const HologramPeak there = hologram_peak(problem, estimate.tag, samples);
    if (there.residuals_rad.size() > 0) refuse_mixture(there.residuals_rad, estimate);
  });
}

void span_line(const LocalizationProblem& problem, LocalizationResult& result) {
  for_each_position(problem, result, [&](const SamplesOfTag& samples, TagEstimate& estimate) {
    if (estimate.verdict != Verdict::kLocated) return;
    const std::vector<Eigen::Vector2d> places = places_of(samples);
    const PathLine way = path_line(places);
    if (!is_straight(places, way)) return;
    Candidate& best = estimate.candidates.front();
    if (std::abs(across(way).dot(best.p_WT.head<2>() - way.middle)) > kNearLine) return;
    const Eigen::Matrix2d squares = squares_about(problem, samples, way, estimate);
    if (squares.trace() <= best.expected_error_m * best.expected_error_m) return;
    // Some methods have wider limits of their own.
    const bool was_within = best.expected_error_m <= problem.limits.max_expected_error_m;
    add_error(squares, best);
    if (was_within) judge(problem.limits, estimate);
  });
}

void refuse_wrong_sign(const LocalizationProblem& problem, LocalizationResult& result,
                       Diagnostics& diagnostics) {
  const auto informative = informative_tags(problem);
  std::size_t right = 0;
  for (const auto* entry : informative) {
    if (!fits_other_sign(problem, entry->first, entry->second)) ++right;
    if (2 * right >= informative.size()) return;
  }
  if (informative.empty()) return;
  diagnostics.warn(
      "the phases fit positions only with the opposite sign: they fall with distance (a dataset's "
      "profile says so by falls_with_distance: true), or antennas are mixed up");
  for (TagEstimate& estimate : result.estimates) {
    if (problem.reference_tags.count(estimate.tag) > 0) continue;
    refuse(estimate, "the phase falls with distance, where it should grow");
  }
}

}  // namespace tagfield
