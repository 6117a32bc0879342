#include "tagfield/localization/coherent_fit.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>

#include "tagfield/base/units.h"
#include "tagfield/localization/fit_candidates.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/residuals.h"
#include "tagfield/localization/tag_fit.h"

namespace tagfield {
namespace {

constexpr double kSame = 0.03;  ///< Maxima nearer than this are one [m].
/// Of the best place's coherence before the climb; less is a side lobe.
constexpr double kWorthWhile = 0.4;
constexpr std::size_t kMirrored = 3;    ///< Of so many best places the mirror images are tried.
constexpr std::size_t kMostNamed = 16;  ///< Maxima that are looked at.

/// S of one aperture.
std::complex<double> sum_of(const TagPhases& phases, const Aperture& part,
                            const HeightModel& height, const PlaceVector& p) {
  double in_phase = 0.0;
  double quadrature = 0.0;
  for (Eigen::Index i = part.begin; i < part.begin + part.count; ++i) {
    const double r = range_to(height, p, phases.x[i], phases.y[i], phases.z[i]).r;
    const double phase = phases.wavenumber[i] * (phases.value[i] - r);
    in_phase += std::cos(phase);
    quadrature += std::sin(phase);
  }
  return {in_phase, quadrature};
}

/// The direction of S, by which the waves are turned back; 1 where the offset is known.
std::complex<double> direction_of(const Aperture& part, std::complex<double> sum) {
  const double length = std::abs(sum);
  return part.offset_known || !(length > 0.0) ? 1.0 : sum / length;
}

/// Value, gradient and expected information of the coherence.
struct Step {
  double value = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double count = 0.0;
};

/// In one pass: the offset is only known when all waves are added up, so both parts are kept.
void add_part(const TagPhases& phases, const Aperture& part, const HeightModel& height,
              const PlaceVector& p, Step& step) {
  double in_phase = 0.0;
  double quadrature = 0.0;
  Eigen::Vector3d in_phase_slopes = Eigen::Vector3d::Zero();
  Eigen::Vector3d quadrature_slopes = Eigen::Vector3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = part.begin; i < part.begin + part.count; ++i) {
    const Range range = range_to(height, p, phases.x[i], phases.y[i], phases.z[i]);
    const double phase = phases.wavenumber[i] * (phases.value[i] - range.r);
    const Eigen::Vector3d slope = phases.wavenumber[i] * range.gradient;
    const double cosine = std::cos(phase);
    const double sine = std::sin(phase);
    in_phase += cosine;
    quadrature += sine;
    in_phase_slopes += cosine * slope;
    quadrature_slopes += sine * slope;
    sum += slope;
    squares += slope * slope.transpose();
  }
  const std::complex<double> back = direction_of(part, {in_phase, quadrature});
  const auto count = static_cast<double>(part.count);
  step.value += in_phase * back.real() + quadrature * back.imag();
  step.gradient += back.real() * quadrature_slopes - back.imag() * in_phase_slopes;
  step.information += squares;
  if (!part.offset_known) step.information -= sum * sum.transpose() / count;
  step.count += count;
}

Step step_at(const TagPhases& phases, const std::vector<Aperture>& parts, const HeightModel& height,
             const PlaceVector& p) {
  Step step;
  for (const Aperture& part : parts) add_part(phases, part, height, p, step);
  // The curvature of |S| is smaller than that of n by the reads' mean cosine.
  step.information *= std::max(0.1, step.value / std::max(step.count, 1.0));
  if (height.kind == HeightModel::Kind::kKnown) step.information(2, 2) = 1.0;
  return step;
}

TagFit fit_at(const TagPhases& phases, const HeightModel& height, const PlaceVector& place) {
  return {place, offsets_at(phases, height, place), 0.0};
}

/// Residuals as they run on from read to read over each stretch, less its mean: at a wrong place
/// they run away, which wrapped ones hide.
Eigen::ArrayXd followed(const std::vector<FitData::Span>& stretches, Eigen::ArrayXd residuals) {
  for (const FitData::Span& span : stretches) {
    auto stretch = residuals.segment(span.begin, span.count);
    for (Eigen::Index i = 1; i < span.count; ++i) {
      stretch[i] -= span.cycle_m * std::round((stretch[i] - stretch[i - 1]) / span.cycle_m);
    }
    stretch -= stretch.mean();
  }
  return residuals;
}

/// Where no step is too long for the phase to be followed.
std::vector<FitData::Span> stretches_of(const TagPhases& phases) {
  constexpr double kLongestStep = 0.4;  // of λ/2, which turns the phase by a whole turn
  std::vector<FitData::Span> stretches;
  for (const TagPhases::Span& span : phases.spans) {
    const double cycle = phases.cycle[span.begin];
    for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
      const bool follows =
          i > span.begin && std::hypot(phases.x[i] - phases.x[i - 1], phases.y[i] - phases.y[i - 1],
                                       phases.z[i] - phases.z[i - 1]) < kLongestStep * cycle;
      if (!follows) stretches.push_back({i, 0, cycle});
      ++stretches.back().count;
    }
  }
  return stretches;
}

/// Whether wrapped residuals or followed ones tell that `other` is a worse place than `best`.
bool is_worse(const TagPhases& phases, const FitData& layout, const Eigen::ArrayXd& best,
              const Eigen::ArrayXd& other) {
  if (tells_apart(layout, best, other)) return true;
  FitData followable = layout;
  followable.spans = stretches_of(phases);
  return tells_apart(followable, followed(followable.spans, best),
                     followed(followable.spans, other));
}

struct Maximum {
  PlaceVector place;
  double coherence = 0.0;
};

/// Places that differ, by falling coherence.
std::vector<Maximum> distinct(const TagPhases& phases, const HeightModel& height,
                              const std::vector<PlaceVector>& places) {
  std::vector<Maximum> ranked;
  ranked.reserve(places.size());
  for (const PlaceVector& place : places) {
    ranked.push_back({place, coherence(phases, apertures(phases, kWholeAperture), height, place)});
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.coherence > b.coherence; });
  std::vector<Maximum> kept;
  for (const Maximum& maximum : ranked) {
    const bool apart = std::all_of(kept.begin(), kept.end(), [&](const Maximum& other) {
      return (to_place(height, other.place) - to_place(height, maximum.place)).norm() > kSame;
    });
    if (apart && kept.size() < kMostNamed) kept.push_back(maximum);
  }
  return kept;
}

std::vector<PlaceVector> mirror_images(const FitData& layout, const std::vector<Maximum>& maxima) {
  std::vector<PlaceVector> images;
  for (std::size_t i = 0; i < std::min(maxima.size(), kMirrored); ++i) {
    PlaceVector image = maxima[i].place;
    image.head<2>() = mirror_image(layout, image.head<2>());
    images.push_back(image);
  }
  return images;
}

/// Those of the places from which the climb is worth while, finished.
std::vector<PlaceVector> finished(const TagPhases& phases, const HeightModel& height,
                                  const std::vector<PlaceVector>& places, double least,
                                  bool go_up) {
  std::vector<PlaceVector> tops;
  for (const PlaceVector& place : places) {
    if (coherence(phases, apertures(phases, kWholeAperture), height, place) < least) continue;
    tops.push_back(go_up ? climb(phases, apertures(phases, kWholeAperture), height, place) : place);
  }
  return tops;
}

/// The maxima near the places and near the mirror images of the best.
std::vector<Maximum> maxima_near(const TagPhases& phases, const HeightModel& height,
                                 const FitData& layout, const std::vector<PlaceVector>& places,
                                 bool go_up) {
  std::vector<Maximum> starts = distinct(phases, height, places);
  if (starts.empty()) return starts;
  const double least = kWorthWhile * starts.front().coherence;
  std::vector<PlaceVector> tops = finished(phases, height, places, least, go_up);
  const std::vector<PlaceVector> images =
      finished(phases, height, mirror_images(layout, distinct(phases, height, tops)), least, go_up);
  tops.insert(tops.end(), images.begin(), images.end());
  return distinct(phases, height, tops);
}

Candidate scaled(Candidate candidate, double factor) {
  candidate.expected_error_m *= factor;
  if (candidate.covariance) *candidate.covariance *= factor * factor;
  return candidate;
}

}  // namespace

double coherence(const TagPhases& phases, const std::vector<Aperture>& parts,
                 const HeightModel& height, const PlaceVector& place) {
  double sum = 0.0;
  for (const Aperture& part : parts) {
    const std::complex<double> waves = sum_of(phases, part, height, place);
    sum += part.offset_known ? waves.real() : std::abs(waves);
  }
  return sum;
}

PlaceVector climb(const TagPhases& phases, const std::vector<Aperture>& parts,
                  const HeightModel& height, const PlaceVector& start) {
  constexpr int kRounds = 40;
  constexpr double kTolerance = 1e-5;   // [m]
  constexpr double kNoGain = 1e-5;      // of a coherence of many reads
  constexpr double kLongestStep = 0.3;  // [m]; beyond is another lobe
  PlaceVector p = start;
  double damping = 1e-4;
  Step here = step_at(phases, parts, height, p);
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d damped = here.information;
    damped.diagonal() *= 1.0 + damping;
    damped.diagonal().array() += 1e-9;
    PlaceVector move = damped.ldlt().solve(here.gradient);
    if (!move.allFinite() || move.norm() < kTolerance) break;
    if (here.gradient.dot(move) < kNoGain) break;
    if (move.head<2>().norm() > kLongestStep) move *= kLongestStep / move.head<2>().norm();
    const Step there = step_at(phases, parts, height, p + move);
    if (there.value > here.value) {
      p += move;
      here = there;
      damping = std::max(damping * 0.1, 1e-12);
    } else {
      damping = std::max(damping * 8.0, 1e-3);
    }
  }
  return p;
}

Candidate candidate_at(const TagPhases& phases, const HeightModel& height,
                       const PlaceVector& place) {
  const TagFit fit = fit_at(phases, height, place);
  return make_candidate(phases, height, fit);
}

TagEstimate judge_places(const TagPhases& phases, const HeightModel& height,
                         const std::vector<PlaceVector>& places, const CoherentJudgement& judgement,
                         const EstimateLimits& limits, TagEstimate estimate) {
  const FitData layout = layout_of(phases);
  const std::vector<Maximum> maxima = maxima_near(phases, height, layout, places, judgement.climb);
  if (maxima.empty()) {
    return not_located(std::move(estimate), "no place is in reach of all reads");
  }
  const auto residuals_at = [&](const Maximum& maximum) {
    return residuals_of(phases, height, fit_at(phases, height, maximum.place));
  };
  const Eigen::ArrayXd best = residuals_at(maxima.front());
  const double rms_rad = std::sqrt((best * phases.wavenumber).square().mean());
  if (rms_rad > judgement.max_rms_rad) {
    return not_located(
        std::move(estimate),
        fmt::format("the phase does not fit a tag at rest: misfit {:.2f} rad, limit {:.2f} rad",
                    rms_rad, judgement.max_rms_rad));
  }
  for (const Maximum& maximum : maxima) {
    const bool first = estimate.candidates.empty();
    if (first || !is_worse(phases, layout, best, residuals_at(maximum))) {
      estimate.candidates.push_back(
          scaled(candidate_at(phases, height, maximum.place), judgement.error_factor));
    }
  }
  judge(limits, estimate);
  return estimate;
}

}  // namespace tagfield
