// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/coherent_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>

#include "tagfield/base/units.h"
#include "tagfield/fit/levenberg_marquardt.h"
#include "tagfield/fit/symmetric.h"
#include "tagfield/fit/von_mises.h"
#include "tagfield/localization/fit_candidates.h"
#include "tagfield/localization/holograms/wave_slopes.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/pose_misfit.h"
#include "tagfield/localization/residuals.h"
#include "tagfield/localization/tag_fit.h"

namespace tagfield {
namespace {

constexpr double kSameMaximum = 0.03;  ///< Maxima closer than this are the same [m].
/// Minimum share of the best coherence before the climb; lower ones are side lobes.
constexpr double kWorthWhile = 0.4;
constexpr std::size_t kMirrored = 3;   ///< Number of best positions whose mirror images are tried.
constexpr std::size_t kMaxNamed = 16;  ///< Maximum number of maxima considered.
constexpr double kSameLobes = 0.3;     ///< Maxima closer than this are lobes of one position [m].
constexpr double kOtherPlace = 4.0;  ///< Maxima with a log-likelihood lower by this are ruled out.

/// Direction of S, by which the phasors are rotated back; 1 where the offset is known.
std::complex<double> direction_of(const Aperture& part, std::complex<double> sum) {
  const double length = std::abs(sum);
  return part.offset_known || !(length > 0.0) ? 1.0 : sum / length;
}

/// State of the climb: coherence, its gradient and expected information.
struct Summit {
  PositionVector place;
  double cost = 0.0;  ///< Negative coherence.
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double count = 0.0;
};

/// One pass: the offset is only known after summing all phasors, so both quadratures are kept.
void add_part(const TagPhases& phases, const Aperture& part, const HeightModel& height,
              Summit& summit) {
  const WaveSlopes waves = wave_slopes(phases, part, height, summit.place);
  const std::complex<double> back = direction_of(part, waves.sum);
  const auto count = static_cast<double>(part.count);
  summit.cost -= waves.sum.real() * back.real() + waves.sum.imag() * back.imag();
  summit.gradient += back.real() * waves.quadrature - back.imag() * waves.in_phase;
  summit.information += waves.squares;
  if (!part.offset_known) {
    summit.information -= waves.slopes * waves.slopes.transpose() / count;
  }
  summit.count += count;
}

Summit summit_at(const TagPhases& phases, const std::vector<Aperture>& parts,
                 const HeightModel& height, const PositionVector& place) {
  Summit summit;
  summit.place = place;
  for (const Aperture& part : parts) add_part(phases, part, height, summit);
  // The curvature of |S| is smaller than that of n by the reads' mean cosine.
  summit.information *= std::max(0.1, -summit.cost / std::max(summit.count, 1.0));
  if (height.kind == HeightModel::Kind::kKnown) summit.information(2, 2) = 1.0;
  return summit;
}

TagFit fit_at(const TagPhases& phases, const HeightModel& height, const PositionVector& place) {
  return {place, offsets_at(phases, height, place), 0.0};
}

/// Residuals unwrapped from read to read over each interval, minus its mean: at a wrong position
/// they drift away, which wrapped residuals hide.
Eigen::ArrayXd followed(const Spans& segments, Eigen::ArrayXd residuals) {
  for (const TagPhases::Span& span : segments) {
    auto segment = residuals.segment(span.begin, span.count);
    for (Eigen::Index i = 1; i < span.count; ++i) {
      segment[i] -= span.cycle_m * std::round((segment[i] - segment[i - 1]) / span.cycle_m);
    }
    segment -= segment.mean();
  }
  return residuals;
}

/// Intervals in which no step is too long for unwrapping the phase.
Spans intervals_of(const TagPhases& phases) {
  constexpr double kLongestStep = 0.4;  // of λ/2, which is one turn of phase
  Spans segments;
  for (const TagPhases::Span& span : phases.spans) {
    for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
      const bool follows =
          i > span.begin && std::hypot(phases.x[i] - phases.x[i - 1], phases.y[i] - phases.y[i - 1],
                                       phases.z[i] - phases.z[i - 1]) < kLongestStep * span.cycle_m;
      if (!follows) segments.push_back({i, 0, span.antenna, span.offset_known, span.cycle_m});
      ++segments.back().count;
    }
  }
  return segments;
}

/// Whether wrapped or unwrapped residuals show that `other` is a worse position than `best`.
bool is_worse(const TagPhases& phases, const Eigen::ArrayXd& best, const Eigen::ArrayXd& other) {
  if (tells_apart(phases.spans, best, other)) return true;
  const Spans segments = intervals_of(phases);
  return tells_apart(segments, followed(segments, best), followed(segments, other));
}

struct Maximum {
  PositionVector place;
  double coherence = 0.0;
};

/// Distinct positions, in descending order of coherence.
std::vector<Maximum> distinct(const TagPhases& phases, const HeightModel& height,
                              const std::vector<PositionVector>& places) {
  std::vector<Maximum> ranked;
  ranked.reserve(places.size());
  for (const PositionVector& place : places) {
    ranked.push_back({place, coherence(phases, apertures(phases, kWholeAperture), height, place)});
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.coherence > b.coherence; });
  std::vector<Maximum> kept;
  for (const Maximum& maximum : ranked) {
    const bool apart = std::all_of(kept.begin(), kept.end(), [&](const Maximum& other) {
      return (to_position(height, other.place) - to_position(height, maximum.place)).norm() >
             kSameMaximum;
    });
    if (apart && kept.size() < kMaxNamed) kept.push_back(maximum);
  }
  return kept;
}

std::vector<PositionVector> mirror_images(const TagPhases& phases,
                                          const std::vector<Maximum>& maxima) {
  std::vector<PositionVector> images;
  for (std::size_t i = 0; i < std::min(maxima.size(), kMirrored); ++i) {
    PositionVector image = maxima[i].place;
    image.head<2>() = mirror_image(phases, image.head<2>());
    images.push_back(image);
  }
  return images;
}

/// Summits reached from those positions where a climb is worthwhile.
std::vector<PositionVector> finished(const TagPhases& phases, const HeightModel& height,
                                     const std::vector<PositionVector>& places, double least,
                                     bool go_up) {
  std::vector<PositionVector> tops;
  for (const PositionVector& place : places) {
    if (coherence(phases, apertures(phases, kWholeAperture), height, place) < least) continue;
    tops.push_back(go_up ? climb(phases, apertures(phases, kWholeAperture), height, place) : place);
  }
  return tops;
}

/// Maxima near the positions and near the mirror images of the best.
std::vector<Maximum> maxima_near(const TagPhases& phases, const HeightModel& height,
                                 const std::vector<PositionVector>& places, bool go_up) {
  std::vector<Maximum> starts = distinct(phases, height, places);
  if (starts.empty()) return starts;
  const double least = kWorthWhile * starts.front().coherence;
  std::vector<PositionVector> tops = finished(phases, height, places, least, go_up);
  const std::vector<PositionVector> images =
      finished(phases, height, mirror_images(phases, distinct(phases, height, tops)), least, go_up);
  tops.insert(tops.end(), images.begin(), images.end());
  return distinct(phases, height, tops);
}

Eigen::ArrayXd residuals_at(const TagPhases& phases, const HeightModel& height,
                            const Maximum& maximum) {
  return residuals_of(phases, height, fit_at(phases, height, maximum.place));
}

/// Difference in log-likelihood between the best maximum and another.
using Unlikelihood = std::function<double(const Maximum&)>;

/// κ ΔS, divided by the correlation factor of the best's residuals, as reads with the same error
/// count only once.
Unlikelihood by_coherence(const TagPhases& phases, const Maximum& best,
                          const Eigen::ArrayXd& residuals) {
  const double share =
      best.coherence / static_cast<double>(std::max<Eigen::Index>(residuals.size(), 1));
  const double per_wave = von_mises_concentration(std::clamp(share, 0.0, 0.99)) /
                          correlation_factor(phases.spans, residuals);
  return [per_wave, coherence = best.coherence](const Maximum& maximum) {
    return per_wave * (coherence - maximum.coherence);
  };
}

/// From the given pose errors, which residuals of reads far apart do not show. The variance of the
/// best's residuals in excess of the pose errors is white noise, at least a quarter of it, as the
/// fit absorbs part of slow errors.
Unlikelihood by_stated_poses(const TagPhases& phases, const HeightModel& height,
                             const Eigen::ArrayXd& residuals) {
  constexpr double kMinWhite = 0.25;
  const double all = residual_variance(phases.spans, residuals);
  const double slow = phases.pose_error->sigma_m * phases.pose_error->sigma_m;
  const double white = std::max(kMinWhite * all, all - slow);
  const double least = pose_misfit(phases, residuals, white);
  return [&phases, &height, white, least](const Maximum& maximum) {
    return 0.5 * (pose_misfit(phases, residuals_at(phases, height, maximum), white) - least);
  };
}

/// Maxima that the data cannot distinguish from the best.
struct Rivals {
  std::vector<Maximum> lobes;   ///< Near the best, for distorted phases.
  std::vector<Maximum> others;  ///< At other positions.
};

/// Without `unlikely`, residuals alone decide.
Rivals rivals_of(const TagPhases& phases, const HeightModel& height,
                 const std::vector<Maximum>& maxima, const Unlikelihood& unlikely) {
  const Eigen::ArrayXd best = residuals_at(phases, height, maxima.front());
  const Eigen::Vector3d p_WT = to_position(height, maxima.front().place);
  Rivals rivals;
  for (std::size_t i = 1; i < maxima.size(); ++i) {
    const Maximum& maximum = maxima[i];
    if (unlikely && unlikely(maximum) > kOtherPlace) continue;
    if (is_worse(phases, best, residuals_at(phases, height, maximum))) continue;
    const bool near = (to_position(height, maximum.place) - p_WT).norm() < kSameLobes;
    (unlikely && near ? rivals.lobes : rivals.others).push_back(maximum);
  }
  return rivals;
}

/// Extends the covariance over the lobes near the position, weighted by their likelihood.
void span_lobes(const HeightModel& height, const Unlikelihood& unlikely,
                const std::vector<Maximum>& lobes, Candidate& candidate) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  double weights = 1.0;
  for (const Maximum& lobe : lobes) {
    const double weight = std::exp(-std::max(0.0, unlikely(lobe)));
    const Eigen::Vector3d apart = to_position(height, lobe.place) - candidate.p_WT;
    spread += weight * apart * apart.transpose();
    weights += weight;
  }
  spread /= weights;
  if (candidate.covariance) *candidate.covariance += spread;
  candidate.expected_error_m =
      std::hypot(candidate.expected_error_m, std::sqrt(spread.topLeftCorner<2, 2>().trace()));
}

Candidate scaled(Candidate candidate, double factor) {
  candidate.expected_error_m *= factor;
  if (candidate.covariance) *candidate.covariance *= factor * factor;
  return candidate;
}

/// Ratio of the standard error of a sum of phasors to the linearized one. Normal phase errors with
/// covariances c_ij scatter the sum's slope by e^(−c) sinh c_ij and reduce its curvature by
/// e^(−c/2), so each c_ij counts as sinh c_ij. That is at most sinh(c)/c times as much, c being the
/// variance of the phase that the stated pose error causes; this bound is used for all pairs.
double by_phasors(const TagPhases& phases) {
  if (!phases.pose_error) return 1.0;
  constexpr double kMost = 10.0;  // [rad²]; beyond, no sum remains.
  const double sigma_m = phases.pose_error->sigma_m;
  const double c = std::min(sigma_m * sigma_m * phases.wavenumber.square().mean(), kMost);
  return c > 0.0 ? std::sqrt(std::sinh(c) / c) : 1.0;
}

/// Where phases are distorted, residuals may indicate larger errors than the given pose error.
Candidate careful_candidate(const TagPhases& phases, const HeightModel& height,
                            const PositionVector& place, bool bent) {
  Candidate honest = candidate_at(phases, height, place);
  if (!bent) return honest;
  const TagFit fit = fit_at(phases, height, place);
  const double factor =
      phases.pose_error ? 1.0 : fitted_away(phases.spans, residuals_of(phases, height, fit));
  const Candidate by_residuals = scaled(
      make_candidate(height, place, covariance_of(phases, height, fit), honest.rms_m), factor);
  return by_residuals.expected_error_m > honest.expected_error_m ? by_residuals : honest;
}

}  // namespace

double coherent_share(const TagPhases& phases, const HeightModel& height,
                      const PositionVector& place) {
  const double waves = coherence(phases, apertures(phases, kWholeAperture), height, place);
  return waves / static_cast<double>(std::max<Eigen::Index>(phases.size(), 1));
}

double coherence(const TagPhases& phases, const std::vector<Aperture>& parts,
                 const HeightModel& height, const PositionVector& place) {
  double sum = 0.0;
  for (const Aperture& part : parts) {
    const std::complex<double> waves = wave_sum(phases, part, height, place);
    sum += part.offset_known ? waves.real() : std::abs(waves);
  }
  return sum;
}

PositionVector climb(const TagPhases& phases, const std::vector<Aperture>& parts,
                     const HeightModel& height, const PositionVector& start) {
  constexpr double kTolerance = 1e-5;   // [m]
  constexpr double kNoGain = 1e-5;      // of a coherence of many reads
  constexpr double kLongestStep = 0.3;  // [m]; longer ones reach another lobe
  constexpr double kRidge = 1e-9;
  constexpr LevenbergMarquardt kHow{
      .max_steps = 40, .damping = 1e-4, .min_damping = 1e-12, .raise = 8.0, .min_raised = 1e-3};
  const auto step = [&](const Summit& here, double damping) -> std::optional<Summit> {
    PositionVector move = solve_symmetric(damped(here.information, damping, kRidge), here.gradient);
    if (!is_worthwhile(move, kTolerance) || here.gradient.dot(move) < kNoGain) return std::nullopt;
    if (move.head<2>().norm() > kLongestStep) move *= kLongestStep / move.head<2>().norm();
    return summit_at(phases, parts, height, here.place + move);
  };
  return descend(summit_at(phases, parts, height, start), kHow, step).place;
}

Candidate candidate_at(const TagPhases& phases, const HeightModel& height,
                       const PositionVector& place) {
  const TagFit fit = fit_at(phases, height, place);
  return scaled(make_candidate(phases, height, fit), by_phasors(phases));
}

TagEstimate judge_places(const TagPhases& phases, const HeightModel& height,
                         const std::vector<PositionVector>& places,
                         const CoherentJudgement& judgement, const EstimateLimits& limits,
                         TagEstimate estimate) {
  const std::vector<Maximum> maxima = maxima_near(phases, height, places, judgement.climb);
  if (maxima.empty()) {
    return not_located(std::move(estimate), "no position is within range of most reads");
  }
  const Eigen::ArrayXd best = residuals_at(phases, height, maxima.front());
  const double share = coherent_share(phases, height, maxima.front().place);
  if (share < judgement.min_share) {
    return not_located(std::move(estimate),
                       fmt::format("the phase does not fit a tag at rest: coherence {:.0f} %, at "
                                   "least {:.0f} % is expected",
                                   100.0 * share, 100.0 * judgement.min_share));
  }
  const bool bent = judgement.at_maxima && share < kBentShare;
  Unlikelihood unlikely;
  if (hides_pose_errors(phases, best)) {
    unlikely = by_stated_poses(phases, height, best);
  } else if (bent) {
    unlikely = by_coherence(phases, maxima.front(), best);
  }
  const Rivals rivals = rivals_of(phases, height, maxima, unlikely);
  const double factor =
      judgement.error_factor ? judgement.error_factor(phases, height, maxima.front().place) : 1.0;
  const auto candidate_of = [&](const Maximum& maximum) {
    if (!judgement.error_factor) {
      return careful_candidate(phases, height, maximum.place, bent);
    }
    const PositionVector top =
        climb(phases, apertures(phases, kWholeAperture), height, maximum.place);
    Candidate candidate = scaled(candidate_at(phases, height, top), factor);
    candidate.p_WT = to_position(height, maximum.place);
    return candidate;
  };
  estimate.candidates.push_back(candidate_of(maxima.front()));
  span_lobes(height, unlikely, rivals.lobes, estimate.candidates.front());
  for (const Maximum& other : rivals.others) estimate.candidates.push_back(candidate_of(other));
  judge(limits, estimate);
  return estimate;
}

TagEstimate locate_by_waves(const LocalizationProblem& problem, const std::string& tag,
                            const SamplesOfTag& samples, const CoherentJudgement& judgement,
                            const FindPlaces& find) {
  TagEstimate estimate = begun(tag, samples);
  const std::string hopeless = why_not_locatable(samples);
  if (!hopeless.empty()) return not_located(std::move(estimate), hopeless);
  TagPhases phases = coherent_reads(problem, samples);
  for (TagPhases::Span& span : phases.spans) {
    span.offset_known = span.offset_known && judgement.known_offsets;
  }
  estimate.reads = static_cast<std::size_t>(phases.size());
  const std::string why_too_few = too_few(phases);
  if (!why_too_few.empty()) return not_located(std::move(estimate), why_too_few);
  const HeightModel height = height_model(problem, tag, phases);
  return judge_places(phases, height, find(phases, height), judgement, problem.limits,
                      std::move(estimate));
}

}  // namespace tagfield
