// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/at_rest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/base/median.h"
#include "tagfield/base/parallel.h"
#include "tagfield/base/units.h"
#include "tagfield/fit/levenberg_marquardt.h"
#include "tagfield/fit/symmetric.h"
#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/holograms/hologram.h"
#include "tagfield/localization/holograms/segments.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/residuals.h"
#include "tagfield/localization/tag_fit.h"
#include "tagfield/poses/trajectory.h"

namespace tagfield {
namespace {

using Index = Eigen::Index;
using Unknowns = Eigen::Matrix<double, 5, 1>;
using Normal = Eigen::Matrix<double, 5, 5>;

constexpr double kMaxTagLatency = 10.0;  ///< [s]
constexpr double kMaxSpeed = 3.0;        ///< Maximum speed of a tag [m/s].
constexpr Index kFewestToJudge = 30;
/// Keeps the normal matrix regular where unknowns are not observable.
constexpr double kRidge = 1e-9;
/// Aperture for climbing to the position without a departure [λ].
constexpr double kClimbedOver = 5.0;

/// Input of one tag's fit.
struct Followed {
  const LocalizationProblem* problem = nullptr;
  HeightModel height;
  TagPhases wrapped;  ///< As reported.
  TagPhases phases;   ///< Tracked from read to read.
  double wavelength = 0.0;
  double middle_s = 0.0;
  Departure departure = Departure::kMotion;
};

/// One linearized residual.
struct Row {
  double error = 0.0;  ///< Measured minus predicted, up to the offset [m].
  Unknowns slope = Unknowns::Zero();
};

struct RestPoint {
  Unknowns unknowns;
  Normal normal = Normal::Zero();
  Unknowns right = Unknowns::Zero();
  Eigen::ArrayXd errors;  ///< Residuals without the offsets [m].
  double cost = 0.0;
};

double travel(const TagPhases& phases, Index from, Index to) {
  return std::hypot(phases.x[to] - phases.x[from], phases.y[to] - phases.y[from],
                    phases.z[to] - phases.z[from]);
}

/// Removes jumps by whole cycles from the differences to the phases expected at `place`.
TagPhases follow(TagPhases phases, const HeightModel& height, const PositionVector& place) {
  const TagFit there{place, offsets_at(phases, height, place), 0.0};
  const Eigen::ArrayXd errors = residuals_of(phases, height, there);
  std::vector<TagPhases::Span> pieces;
  for (const TagPhases::Span& span : phases.spans) {
    double before = 0.0;
    for (Index i = span.begin; i < span.begin + span.count; ++i) {
      const bool begins = i == span.begin || travel(phases, i - 1, i) > 0.5 * span.cycle_m;
      double error = errors[i];
      if (begins) {
        pieces.push_back(span);
        pieces.back().begin = i;
        pieces.back().count = 0;
        pieces.back().offset_known = false;
      } else {
        error = before + std::remainder(error - before, span.cycle_m);
      }
      before = error;
      ++pieces.back().count;
      phases.value[i] = range_to(height, place, phases.x[i], phases.y[i], phases.z[i]).r + error;
    }
  }
  phases.spans = std::move(pieces);
  phases.unwrapped = true;
  return phases;
}

/// Times [s] without pauses in which nothing was read and the antenna stood still: it is unknown
/// what happened then.
Eigen::ArrayXd without_pauses(const TagPhases& phases) {
  constexpr double kPause = 2.0;   // [s]
  constexpr double kStood = 0.02;  // [m]
  std::vector<std::pair<Index, const std::string*>> reads;
  for (const TagPhases::Span& span : phases.spans) {
    for (Index i = span.begin; i < span.begin + span.count; ++i) {
      reads.emplace_back(i, &span.antenna);
    }
  }
  std::stable_sort(reads.begin(), reads.end(), [&](const auto& a, const auto& b) {
    return phases.time_s[a.first] < phases.time_s[b.first];
  });
  Eigen::ArrayXd times = phases.time_s;
  std::map<std::string, Index> last;  // Last read of each antenna.
  double paused = 0.0;
  for (std::size_t k = 0; k < reads.size(); ++k) {
    const auto& [i, antenna] = reads[k];
    const double gap = k > 0 ? phases.time_s[i] - phases.time_s[reads[k - 1].first] : 0.0;
    const auto before = last.find(*antenna);
    if (gap > kPause && before != last.end() && travel(phases, before->second, i) < kStood) {
      paused += gap;
    }
    times[i] -= paused;
    last[*antenna] = i;
  }
  return times;
}

/// Antenna position in the frame in which the tag is at rest, with corrected stamps.
Eigen::Vector3d antenna_at(const Followed& of, const TagPhases::Span& span, Index i,
                           const Eigen::Vector2d& departure) {
  const double time_s = of.phases.time_s[i];
  if (of.departure == Departure::kLatency) {
    const Trajectory& track = of.problem->tracks.at(span.antenna).X_WA;
    return held_position_at(track, time_from_seconds(time_s - departure[0]));
  }
  const Eigen::Vector2d moved = (time_s - of.middle_s) * departure;
  return {of.phases.x[i] - moved.x(), of.phases.y[i] - moved.y(), of.phases.z[i]};
}

Range range_at(const Followed& of, const TagPhases::Span& span, Index i, const Unknowns& unknowns) {
  const Eigen::Vector3d p_WA = antenna_at(of, span, i, unknowns.tail<2>());
  return range_to(of.height, unknowns.head<3>(), p_WA.x(), p_WA.y(), p_WA.z());
}

/// Derivatives with respect to the departure are finite differences, over about the spacing of
/// poses.
Row row_of(const Followed& of, const TagPhases::Span& span, Index i, const Unknowns& unknowns) {
  const double step = of.departure == Departure::kMotion ? 1e-3 : 0.05;  // [m/s], [s]
  const Range range = range_at(of, span, i, unknowns);
  Row row;
  row.error = of.phases.value[i] - range.r;
  row.slope.head<3>() = range.gradient;
  const Index last = of.departure == Departure::kMotion ? 4 : 3;
  for (Index k = 3; k <= last; ++k) {
    const Unknowns side = step * Unknowns::Unit(k);
    row.slope[k] =
        (range_at(of, span, i, unknowns + side).r - range_at(of, span, i, unknowns - side).r) /
        (2.0 * step);
  }
  return row;
}

/// Linearization at `unknowns`. Offsets are eliminated; unknowns that are known or not observable
/// stay unchanged.
RestPoint at(const Followed& of, const Unknowns& unknowns) {
  RestPoint point;
  point.unknowns = unknowns;
  point.errors.resize(of.phases.size());
  for (const TagPhases::Span& span : of.phases.spans) {
    Unknowns sum = Unknowns::Zero();
    double errors = 0.0;
    for (Index i = span.begin; i < span.begin + span.count; ++i) {
      const Row row = row_of(of, span, i, unknowns);
      point.errors[i] = row.error;
      point.normal += row.slope * row.slope.transpose();
      point.right += row.error * row.slope;
      sum += row.slope;
      errors += row.error;
    }
    const auto count = static_cast<double>(span.count);
    point.normal -= sum * sum.transpose() / count;
    point.right -= errors / count * sum;
    point.errors.segment(span.begin, span.count) -= errors / count;
  }
  if (of.height.unknowns() == 2) point.normal(2, 2) = 1.0;
  if (of.departure == Departure::kLatency) point.normal(4, 4) = 1.0;
  point.cost = point.errors.square().sum();
  return point;
}

bool is_possible(const Followed& of, const Unknowns& unknowns) {
  return unknowns.allFinite() &&
         (of.departure == Departure::kMotion ? unknowns.tail<2>().norm() < kMaxSpeed
                                             : std::abs(unknowns[3]) < kMaxTagLatency);
}

/// ln of the likelihood of a position (segments.h), with the antennas moved by the departure. The
/// path is divided into sections as believed, so that likelihoods can be compared: `layout` is that
/// of the wrapped phases, about any position.
double log_likelihood(const Followed& of, const Unknowns& unknowns, SegmentedReads& layout) {
  const Eigen::Vector3d p_WT = to_position(of.height, unknowns.head<3>());
  for (const TagPhases::Span& span : of.wrapped.spans) {
    for (Index i = span.begin; i < span.begin + span.count; ++i) {
      const Eigen::Vector3d p_TA = antenna_at(of, span, i, unknowns.tail<2>()) - p_WT;
      SearchRead& read = layout.reads.reads[static_cast<std::size_t>(i)];
      read.x = static_cast<float>(p_TA.x());
      read.y = static_cast<float>(p_TA.y());
      read.z = static_cast<float>(p_TA.z());
    }
  }
  const Tile here = Tile::Zero();
  return static_cast<double>(segment_likelihood(layout, kForPlaces, here, here, here)[0]);
}

/// xᵀ C⁻¹ x.
double distance_of(const Eigen::Vector2d& x, const Eigen::Matrix2d& covariance) {
  return x.dot(solve_symmetric(covariance, x));
}

/// χ² of two and of one degree of freedom that chance reaches in one case in a million, and ln 10⁶.
constexpr double kCertainOfTwo = 27.6;
constexpr double kCertainOfOne = 23.9;
constexpr double kCertainGain = 13.8;

enum class Moved { kNo, kPerhaps, kSurely };

/// Slow pose errors of `pose_error_m` look like a motion too. But they hardly reach six times that
/// at both ends, and a constant velocity seldom explains them completely: a random walk leaves
/// under 0.02 of its variance in one case in 10⁴. A tag that moved half a metre has no position,
/// however large the claimed error.
Moved has_moved(const DepartureFit& fit, const Candidate& claim, double pose_error_m) {
  constexpr double kNothing = 0.02;
  constexpr double kFar = 0.5;  // [m]
  const double moved_m = fit.departure.norm() * fit.duration_s;
  if (moved_m <= std::min(kFar, kElsewhere * claim.expected_error_m) ||
      distance_of(fit.departure, fit.covariance.bottomRightCorner<2, 2>()) <= kCertainOfTwo) {
    return Moved::kNo;
  }
  if (fit.misfit_at_rest_m > pose_error_m) return Moved::kSurely;
  const bool may_be = fit.left_over < kNothing && moved_m > 6.0 * std::sqrt(2.0) * pose_error_m;
  return may_be ? Moved::kPerhaps : Moved::kNo;
}

bool is_elsewhere(const DepartureFit& fit, const Candidate& claim) {
  const Eigen::Vector2d off = fit.place.head<2>() - claim.p_WT.head<2>();
  return off.norm() > kElsewhere * claim.expected_error_m &&
         fit.departure[0] * fit.departure[0] > kCertainOfOne * fit.covariance(3, 3) &&
         distance_of(off, fit.covariance.topLeftCorner<2, 2>()) > kCertainOfTwo;
}

RestPoint fitted(const Followed& of, const Unknowns& start) {
  LevenbergMarquardt how;
  how.max_damping = 1e8;
  how.min_relative_gain = 1e-9;
  using Next = std::optional<RestPoint>;
  return descend(at(of, start), how, [&](const RestPoint& here, double damping) -> Next {
    const Unknowns next =
        here.unknowns + solve_symmetric(damped(here.normal, damping, kRidge), here.right);
    return is_possible(of, next) ? Next(at(of, next)) : std::nullopt;
  });
}

/// Starts from the position and from some around it, as a position found without a departure can be
/// far off.
RestPoint best_fit(const Followed& of, const PositionVector& start) {
  constexpr double kFarther[] = {0.25, 0.75};  // As a share of the rms distance to the antenna.
  constexpr std::size_t kReads = 100;
  Followed few = of;
  few.phases = thinned(of.phases, kReads);
  few.phases.unwrapped = true;
  const Eigen::ArrayXd squares =
      (few.phases.x - start.x()).square() + (few.phases.y - start.y()).square();
  Unknowns begin = Unknowns::Zero();
  begin.head<3>() = start;
  RestPoint best = fitted(few, begin);
  for (const double farther : kFarther) {
    for (int turn = 0; turn < 6; ++turn) {
      Unknowns beside = begin;
      const double angle = kTwoPi * turn / 6.0;
      beside.head<2>() +=
          farther * std::sqrt(squares.mean()) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      RestPoint point = fitted(few, beside);
      if (point.cost < best.cost) best = std::move(point);
    }
  }
  return fitted(of, best.unknowns);
}

Followed followed(const LocalizationProblem& problem, const std::string& tag, TagPhases phases,
                  const Eigen::Vector3d& p_WT, Departure departure) {
  Followed of;
  of.problem = &problem;
  of.height = height_model(problem, tag, phases);
  of.phases = follow(phases, of.height, to_unknowns(of.height, p_WT));
  of.wavelength = 2.0 * problem.multiple() * longest_cycle(phases);
  if (departure == Departure::kMotion) of.phases.time_s = without_pauses(phases);
  of.middle_s = of.phases.time_s.mean();
  of.departure = departure;
  of.wrapped = std::move(phases);
  return of;
}

/// Variance of a residual times the correlation factor [m²].
double slow_variance(const TagPhases& phases, const Eigen::ArrayXd& errors) {
  return residual_variance(phases.spans, errors) * correlation_factor(phases.spans, errors);
}

/// ln of the likelihood ratio of a departure to the most likely position near `start` without one.
double log_gain_of(const Followed& of, const PositionVector& start, const Unknowns& departed) {
  SegmentedReads layout =
      segmented_reads(of.wrapped, of.wavelength, of.height.z, Eigen::Vector2d::Zero());
  const auto at_rest = [&](const PositionVector& place) {
    Unknowns unknowns = Unknowns::Zero();
    unknowns.head<3>() = place;
    return log_likelihood(of, unknowns, layout);
  };
  const std::vector<Aperture> parts = apertures(of.wrapped, kClimbedOver * of.wavelength);
  const PositionVector top = climb(of.wrapped, parts, of.height, start);
  return log_likelihood(of, departed, layout) - std::max(at_rest(start), at_rest(top));
}

/// No gain if much is left: other slow errors resemble a departure, but none explains them
/// completely.
double gain_of(const DepartureFit& fit) {
  constexpr double kLeftOver = 0.25;
  return fit.left_over < kLeftOver ? fit.log_gain : -kCertainGain;
}

/// Standard deviation of the pose error [m]. Position and offset absorb most of it, so that hardly
/// any pose error leaves this much at the best position.
double pose_error_of(const LocalizationProblem& problem) {
  return problem.pose_error.value_or(kUsualPoseError).sigma_m;
}

/// Evidence against a tag's position.
struct Objection {
  std::string why;
  std::optional<double> late_s;
  Moved moved = Moved::kNo;
  double misfit_m = 0.0;  ///< Assuming a tag at rest; 0 if only noise is left.
};

Objection of_latency(const DepartureFit& fit, const Candidate& claim) {
  const double late_s = fit.departure[0];
  return {fmt::format("the phase fits a position {:.2f} m away, with reads stamped {:.2f} s {} "
                      "relative to the poses",
                      (fit.place.head<2>() - claim.p_WT.head<2>()).norm(), std::abs(late_s),
                      late_s > 0.0 ? "late" : "early"),
          late_s};
}

Objection of_motion(const DepartureFit& fit, Moved moved) {
  return {fmt::format("the phase fits a tag that moves, by {:.2f} m while it is read",
                      fit.departure.norm() * fit.duration_s),
          std::nullopt, moved};
}

/// Wavelength of the first read [m]; 0 if there is none.
double wavelength_of(const SamplesOfTag& samples) {
  for (const auto& [antenna, series] : samples) {
    if (!series.empty()) return wavelength(series.front().frequency_hz);
  }
  return 0.0;
}

/// Whether the residuals at the position itself are meaningful: not if it is known to no better
/// than λ/8, as by RSSI.
bool is_sharp(const Candidate& claim, double lambda) {
  return claim.expected_error_m < lambda / 8.0;
}

/// Whether a vaguely known position has no counterpart: even the best one nearby leaves more than
/// half a cycle (rms) of phases that can be tracked (noise under an eighth of a cycle), whereas
/// reflections bias phases by a radian and poses are off by centimetres.
bool has_no_place(const DepartureFit& fit, double lambda) {
  return fit.misfit_at_rest_m > lambda / 4.0 && fit.noise_m < lambda / 16.0;
}

Objection of_no_place(double misfit_m) {
  return {fmt::format(
              "the phase fits no tag at rest near there: {:.0f} cm rms remain, over half a cycle",
              100.0 * misfit_m),
          std::nullopt};
}

Objection objection_to(const LocalizationProblem& problem, const SamplesOfTag& samples,
                       const TagEstimate& estimate) {
  const Candidate& claim = estimate.candidates.front();
  const double lambda = wavelength_of(samples);
  if (is_sharp(claim, lambda) && !leaves_slow_errors(problem, estimate.tag, samples, claim.p_WT)) {
    return {};
  }
  const auto motion = fit_departure(problem, estimate.tag, samples, claim.p_WT, Departure::kMotion);
  const auto late = fit_departure(problem, estimate.tag, samples, claim.p_WT, Departure::kLatency);
  const double of_late = late && is_elsewhere(*late, claim) ? gain_of(*late) : -kCertainGain;
  const Moved moved = motion ? has_moved(*motion, claim, pose_error_of(problem)) : Moved::kNo;
  const double of_moving = moved != Moved::kNo ? gain_of(*motion) : -kCertainGain;
  Objection objection;
  if (std::max(of_late, of_moving) >= kCertainGain) {
    objection = of_late > of_moving ? of_latency(*late, claim) : of_motion(*motion, moved);
  }
  if (!motion) return objection;
  if (objection.why.empty() && !is_sharp(claim, lambda) && has_no_place(*motion, lambda)) {
    objection = of_no_place(motion->misfit_at_rest_m);
  }
  objection.misfit_m = motion->misfit_at_rest_m;
  return objection;
}

/// Drops motions that may be pose errors, unless the other tags show that the poses were right: a
/// quarter of all surely move, half of all may move, or most fit far better at rest.
void drop_unconfirmed(std::vector<Objection>& objections) {
  constexpr std::size_t kFewest = 5;
  constexpr double kFarBetter = 3.0;
  std::size_t surely = 0;
  std::size_t perhaps = 0;
  std::vector<double> misfits;
  for (const Objection& objection : objections) {
    if (objection.moved == Moved::kSurely) ++surely;
    if (objection.moved == Moved::kPerhaps) ++perhaps;
    if (objection.moved != Moved::kSurely) misfits.push_back(objection.misfit_m);
  }
  if (4 * surely > objections.size() || 2 * (surely + perhaps) >= objections.size()) return;
  if (objections.size() < kFewest) misfits.clear();
  const double usual_m =
      misfits.empty() ? std::numeric_limits<double>::infinity() : median(misfits);
  for (Objection& objection : objections) {
    if (objection.moved != Moved::kPerhaps || objection.misfit_m > kFarBetter * usual_m) continue;
    objection = {{}, std::nullopt, Moved::kNo, objection.misfit_m};
  }
}

}  // namespace

std::vector<std::size_t> claimed_tags(const LocalizationProblem& problem,
                                      const LocalizationResult& result) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < result.estimates.size(); ++i) {
    const TagEstimate& estimate = result.estimates[i];
    if (estimate.verdict != Verdict::kLocated) continue;
    if (problem.reference_tags.count(estimate.tag) > 0) continue;
    if (problem.samples.count(estimate.tag) > 0) all.push_back(i);
  }
  return all;
}

std::vector<std::size_t> some_of(const std::vector<std::size_t>& all, std::size_t most) {
  const std::size_t stride = std::max<std::size_t>((all.size() + most - 1) / most, 1);
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < all.size(); i += stride) some.push_back(all[i]);
  return some;
}

bool leaves_slow_errors(const LocalizationProblem& problem, const std::string& tag,
                        const SamplesOfTag& samples, const Eigen::Vector3d& p_WT) {
  constexpr double kSlow = 3.0;  // Correlation factor; noise alone leaves 1 to 1.5.
  const TagPhases phases = coherent_reads(problem, samples);
  if (phases.size() < kFewestToJudge) return false;
  const HeightModel height = height_model(problem, tag, phases);
  const PositionVector place = to_unknowns(height, p_WT);
  const Eigen::ArrayXd errors =
      residuals_of(phases, height, {place, offsets_at(phases, height, place), 0.0});
  return correlation_factor(phases.spans, errors) > kSlow;
}

void warn_of_latency(double late_s, Diagnostics& diagnostics) {
  diagnostics.warn(
      fmt::format("most tags' phases fit better with reads stamped {:.2f} s {} relative to the "
                  "poses: are their clocks the same?",
                  std::abs(late_s), late_s > 0.0 ? "late" : "early"));
}

std::optional<DepartureFit> fit_departure(const LocalizationProblem& problem,
                                          const std::string& tag, const SamplesOfTag& samples,
                                          const Eigen::Vector3d& p_WT, Departure departure) {
  TagPhases phases = coherent_reads(problem, samples);
  if (phases.size() < kFewestToJudge) return std::nullopt;
  const bool has_tracks =
      std::all_of(phases.spans.begin(), phases.spans.end(), [&](const TagPhases::Span& span) {
        const auto track = problem.tracks.find(span.antenna);
        return track != problem.tracks.end() && !track->second.X_WA.empty();
      });
  if (departure == Departure::kLatency && !has_tracks) return std::nullopt;
  const Followed of = followed(problem, tag, std::move(phases), p_WT, departure);
  const PositionVector start = to_unknowns(of.height, p_WT);
  const RestPoint end = best_fit(of, start);
  DepartureFit fit;
  fit.place = end.unknowns.head<3>();
  fit.departure = end.unknowns.tail<2>();
  const double left = slow_variance(of.phases, end.errors);
  fit.covariance = left * invert_symmetric(damped(end.normal, 0.0, kRidge));
  if (!fit.covariance.allFinite()) return std::nullopt;
  fit.duration_s = of.phases.time_s.maxCoeff() - of.phases.time_s.minCoeff();
  const TagFit at_rest = fit_tag(of.phases, of.height, start);
  const Eigen::ArrayXd errors = residuals_of(of.phases, of.height, at_rest);
  fit.misfit_at_rest_m = std::sqrt(errors.square().mean());
  fit.noise_m = noise_of_one(of.phases.spans, end.errors);
  fit.left_over = left / slow_variance(of.phases, errors);
  fit.log_gain = log_gain_of(of, start, end.unknowns);
  return fit;
}

void refuse_departures(const LocalizationProblem& problem, int threads, LocalizationResult& result,
                       Diagnostics& diagnostics) {
  if (!result.corrected_poses.empty() && !has_exact_poses(problem)) return;
  const std::vector<std::size_t> claimed = claimed_tags(problem, result);
  std::vector<Objection> objections(claimed.size());
  parallel_for(claimed.size(), threads, [&](std::size_t i) {
    const TagEstimate& estimate = result.estimates[claimed[i]];
    objections[i] = objection_to(problem, problem.samples.at(estimate.tag), estimate);
  });
  drop_unconfirmed(objections);
  std::vector<double> late_s;
  for (std::size_t i = 0; i < objections.size(); ++i) {
    TagEstimate& estimate = result.estimates[claimed[i]];
    if (objections[i].late_s) late_s.push_back(*objections[i].late_s);
    if (objections[i].why.empty()) continue;
    estimate = not_located(std::move(estimate), objections[i].why);
  }
  if (late_s.empty() || 2 * late_s.size() <= claimed.size()) return;
  warn_of_latency(median(late_s), diagnostics);
}

}  // namespace tagfield
