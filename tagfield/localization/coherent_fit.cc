#include "tagfield/localization/coherent_fit.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

#include "tagfield/base/units.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/residuals.h"

namespace tagfield {
namespace {

constexpr double kAnything = 1e6;  ///< Expected error where nothing is known [m].
constexpr double kSame = 0.03;     ///< Maxima nearer than this are one [m].
/// Of the best place's coherence before the climb; less is a side lobe.
constexpr double kWorthWhile = 0.4;
constexpr std::size_t kMirrored = 3;    ///< Of so many best places the mirror images are tried.
constexpr std::size_t kMostNamed = 16;  ///< Maxima that are looked at.

/// One read seen from a place.
struct Ray {
  double range = 0.0;     ///< [m]; at least a millimetre.
  Eigen::Vector3d slope;  ///< Of the range by x, y and v.
};

Ray ray_to(const CoherentReads& reads, Eigen::Index i, const HeightModel& model,
           const FitPlace& p) {
  const double dx = p.x() - reads.x[i];
  const double dy = p.y() - reads.y[i];
  Ray ray;
  ray.range =
      std::sqrt(std::max(1e-6, dx * dx + dy * dy + height_squared(model, p.z(), reads.z[i])));
  const double inverse = 1.0 / ray.range;
  ray.slope = {dx * inverse, dy * inverse, 0.0};
  if (model.kind == HeightModel::Kind::kSquare) ray.slope.z() = 0.5 * inverse;
  if (model.kind == HeightModel::Kind::kFree) ray.slope.z() = (p.z() - reads.z[i]) * inverse;
  return ray;
}

/// S of one group.
std::complex<double> sum_of(const CoherentReads& reads, const CoherentGroup& group,
                            const HeightModel& model, const FitPlace& p) {
  double in_phase = 0.0;
  double quadrature = 0.0;
  for (Eigen::Index i = group.begin; i < group.begin + group.count; ++i) {
    const double phase = reads.phase[i] - group.wavenumber * ray_to(reads, i, model, p).range;
    in_phase += std::cos(phase);
    quadrature += std::sin(phase);
  }
  return {in_phase, quadrature};
}

/// The direction of S, by which the group's waves are turned back; 1 where the offset is known.
std::complex<double> direction_of(const CoherentGroup& group, std::complex<double> sum) {
  const double length = std::abs(sum);
  return group.offset_known || !(length > 0.0) ? 1.0 : sum / length;
}

/// Value, gradient and expected information of the coherence.
struct Step {
  double value = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double count = 0.0;
};

/// Σ (∂r/∂θ)(∂r/∂θ)ᵀ of a group, its offset eliminated if unknown.
Eigen::Matrix3d less_mean(const CoherentGroup& group, const Eigen::Matrix3d& squares,
                          const Eigen::Vector3d& sum) {
  if (group.offset_known) return squares;
  return squares - sum * sum.transpose() / static_cast<double>(group.count);
}

/// In one pass: the offset is only known when all waves are added up, so both parts are kept.
void add_group(const CoherentReads& reads, const CoherentGroup& group, const HeightModel& model,
               const FitPlace& p, Step& step) {
  double in_phase = 0.0;
  double quadrature = 0.0;
  Eigen::Vector3d in_phase_slopes = Eigen::Vector3d::Zero();
  Eigen::Vector3d quadrature_slopes = Eigen::Vector3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = group.begin; i < group.begin + group.count; ++i) {
    const Ray ray = ray_to(reads, i, model, p);
    const double phase = reads.phase[i] - group.wavenumber * ray.range;
    const double cosine = std::cos(phase);
    const double sine = std::sin(phase);
    in_phase += cosine;
    quadrature += sine;
    in_phase_slopes += cosine * ray.slope;
    quadrature_slopes += sine * ray.slope;
    sum += ray.slope;
    squares += ray.slope * ray.slope.transpose();
  }
  const std::complex<double> back = direction_of(group, {in_phase, quadrature});
  step.value += in_phase * back.real() + quadrature * back.imag();
  step.gradient +=
      group.wavenumber * (back.real() * quadrature_slopes - back.imag() * in_phase_slopes);
  step.information += group.wavenumber * group.wavenumber * less_mean(group, squares, sum);
  step.count += static_cast<double>(group.count);
}

Step step_at(const CoherentReads& reads, const std::vector<CoherentGroup>& groups,
             const HeightModel& model, const FitPlace& p) {
  Step step;
  for (const CoherentGroup& group : groups) add_group(reads, group, model, p, step);
  // The curvature of |S| is smaller than that of n by the reads' mean cosine.
  step.information *= std::max(0.1, step.value / std::max(step.count, 1.0));
  if (model.kind == HeightModel::Kind::kKnown) step.information(2, 2) = 1.0;
  return step;
}

/// Number of unknowns of the place.
Eigen::Index unknowns(const HeightModel& model) {
  return model.kind == HeightModel::Kind::kKnown ? 2 : 3;
}

/// Σ (∂r/∂θ)(∂r/∂θ)ᵀ over the whole groups, offsets eliminated.
Eigen::Matrix3d normal_matrix(const CoherentReads& reads, const HeightModel& model,
                              const FitPlace& p) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  for (const CoherentGroup& group : reads.groups) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    for (Eigen::Index i = group.begin; i < group.begin + group.count; ++i) {
      const Eigen::Vector3d slope = ray_to(reads, i, model, p).slope;
      sum += slope;
      squares += slope * slope.transpose();
    }
    normal += less_mean(group, squares, sum);
  }
  return normal;
}

/// Variances of anything where the matrix has no inverse.
Eigen::Matrix3d scaled_inverse(const Eigen::Matrix3d& normal, Eigen::Index size, double noise) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  const Eigen::MatrixXd block = normal.topLeftCorner(size, size);
  const Eigen::LDLT<Eigen::MatrixXd> factors(block);
  const Eigen::MatrixXd inverse = factors.solve(Eigen::MatrixXd::Identity(size, size));
  const bool good = factors.info() == Eigen::Success && inverse.allFinite() &&
                    (inverse.diagonal().array() > 0.0).all() &&
                    noise * inverse.diagonal().maxCoeff() < kAnything * kAnything;
  if (good) {
    covariance.topLeftCorner(size, size) = noise * inverse;
  } else {
    covariance.diagonal().head(size).setConstant(0.5 * kAnything * kAnything);
  }
  return covariance;
}

/// Covariance of (x, y, z) from that of (x, y, q): the slope of √q over one standard deviation,
/// which stays finite at q = 0 where the tangent does not.
void to_height(double q, Eigen::Matrix3d& covariance, HeightSide side) {
  const double deviation = std::sqrt(covariance(2, 2));
  if (!(deviation > 0.0)) return;
  const double base = std::max(q, 0.0);
  double slope = (std::sqrt(base + deviation) - std::sqrt(base)) / deviation;
  if (side == HeightSide::kBelow) slope = -slope;
  covariance.row(2) *= slope;
  covariance.col(2) *= slope;
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
std::vector<FitData::Span> stretches_of(const CoherentReads& reads) {
  constexpr double kLongestStep = 0.8;
  std::vector<FitData::Span> stretches;
  for (const CoherentGroup& group : reads.groups) {
    const double cycle = kTwoPi / group.wavenumber;
    for (Eigen::Index i = group.begin; i < group.begin + group.count; ++i) {
      const bool follows =
          i > group.begin && std::hypot(reads.x[i] - reads.x[i - 1], reads.y[i] - reads.y[i - 1],
                                        reads.z[i] - reads.z[i - 1]) < kLongestStep * 0.5 * cycle;
      if (!follows) stretches.push_back({i, 0, cycle});
      ++stretches.back().count;
    }
  }
  return stretches;
}

/// Whether wrapped residuals or followed ones tell that `other` is a worse place than `best`.
bool is_worse(const CoherentReads& reads, const FitData& layout, const Eigen::ArrayXd& best,
              const Eigen::ArrayXd& other) {
  if (tells_apart(layout, best, other)) return true;
  FitData followable = layout;
  followable.spans = stretches_of(reads);
  return tells_apart(followable, followed(followable.spans, best),
                     followed(followable.spans, other));
}

struct Maximum {
  FitPlace place;
  double coherence = 0.0;
};

/// Places that differ, by falling coherence.
std::vector<Maximum> distinct(const CoherentReads& reads, const HeightModel& model,
                              const std::vector<FitPlace>& places) {
  std::vector<Maximum> ranked;
  ranked.reserve(places.size());
  for (const FitPlace& place : places) {
    ranked.push_back({place, coherence(reads, reads.groups, model, place)});
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.coherence > b.coherence; });
  std::vector<Maximum> kept;
  for (const Maximum& maximum : ranked) {
    const bool apart = std::all_of(kept.begin(), kept.end(), [&](const Maximum& other) {
      return (world_place(model, other.place) - world_place(model, maximum.place)).norm() > kSame;
    });
    if (apart && kept.size() < kMostNamed) kept.push_back(maximum);
  }
  return kept;
}

std::vector<FitPlace> mirror_images(const FitData& layout, const std::vector<Maximum>& maxima) {
  std::vector<FitPlace> images;
  for (std::size_t i = 0; i < std::min(maxima.size(), kMirrored); ++i) {
    FitPlace image = maxima[i].place;
    image.head<2>() = mirror_image(layout, image.head<2>());
    images.push_back(image);
  }
  return images;
}

/// Those of the places from which the climb is worth while, finished.
std::vector<FitPlace> finished(const CoherentReads& reads, const HeightModel& model,
                               const std::vector<FitPlace>& places, double least, bool go_up) {
  std::vector<FitPlace> tops;
  for (const FitPlace& place : places) {
    if (coherence(reads, reads.groups, model, place) < least) continue;
    tops.push_back(go_up ? climb(reads, reads.groups, model, place) : place);
  }
  return tops;
}

/// The maxima near the places and near the mirror images of the best.
std::vector<Maximum> maxima_near(const CoherentReads& reads, const HeightModel& model,
                                 const FitData& layout, const std::vector<FitPlace>& places,
                                 bool go_up) {
  const std::vector<Maximum> starts = distinct(reads, model, places);
  if (starts.empty()) return starts;
  const double least = kWorthWhile * starts.front().coherence;
  std::vector<FitPlace> tops = finished(reads, model, places, least, go_up);
  const std::vector<FitPlace> images =
      finished(reads, model, mirror_images(layout, distinct(reads, model, tops)), least, go_up);
  tops.insert(tops.end(), images.begin(), images.end());
  return distinct(reads, model, tops);
}

}  // namespace

double coherence(const CoherentReads& reads, const std::vector<CoherentGroup>& groups,
                 const HeightModel& model, const FitPlace& place) {
  double sum = 0.0;
  for (const CoherentGroup& group : groups) {
    const std::complex<double> waves = sum_of(reads, group, model, place);
    sum += group.offset_known ? waves.real() : std::abs(waves);
  }
  return sum;
}

FitPlace climb(const CoherentReads& reads, const std::vector<CoherentGroup>& groups,
               const HeightModel& model, const FitPlace& start) {
  constexpr int kRounds = 40;
  constexpr double kTolerance = 1e-5;   // [m]
  constexpr double kNoGain = 1e-5;      // of a coherence of many reads
  constexpr double kLongestStep = 0.3;  // [m]; beyond is another lobe
  FitPlace p = start;
  double damping = 1e-4;
  Step here = step_at(reads, groups, model, p);
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d damped = here.information;
    damped.diagonal() *= 1.0 + damping;
    damped.diagonal().array() += 1e-9;
    FitPlace move = damped.ldlt().solve(here.gradient);
    if (!move.allFinite() || move.norm() < kTolerance) break;
    if (here.gradient.dot(move) < kNoGain) break;
    if (move.head<2>().norm() > kLongestStep) move *= kLongestStep / move.head<2>().norm();
    const Step there = step_at(reads, groups, model, p + move);
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

Eigen::ArrayXd wrapped_residuals(const CoherentReads& reads, const HeightModel& model,
                                 const FitPlace& place) {
  Eigen::ArrayXd all(reads.phase.size());
  for (const CoherentGroup& group : reads.groups) {
    const double offset = std::arg(direction_of(group, sum_of(reads, group, model, place)));
    for (Eigen::Index i = group.begin; i < group.begin + group.count; ++i) {
      const double range = ray_to(reads, i, model, place).range;
      all[i] = wrap_to_pi(reads.phase[i] - group.wavenumber * range - offset) / group.wavenumber;
    }
  }
  return all;
}

Candidate candidate_at(const CoherentReads& reads, const HeightModel& model,
                       const FitPlace& place) {
  const FitData layout = layout_of(reads);
  const Eigen::ArrayXd errors = wrapped_residuals(reads, model, place);
  const double noise = residual_variance(layout, errors) * correlation_factor(layout, errors);
  Eigen::Matrix3d covariance =
      scaled_inverse(normal_matrix(reads, model, place), unknowns(model), noise);
  if (model.kind == HeightModel::Kind::kSquare) to_height(place.z(), covariance, model.side);
  Candidate candidate;
  candidate.p_WT = world_place(model, place);
  candidate.rms_m = std::sqrt(errors.square().mean());
  candidate.expected_error_m = std::min(kAnything, std::sqrt(covariance(0, 0) + covariance(1, 1)));
  candidate.covariance = covariance;
  return candidate;
}

TagEstimate judge_places(const CoherentReads& reads, const HeightModel& model,
                         const std::vector<FitPlace>& places, const CoherentJudgement& judgement,
                         const EstimateLimits& limits, TagEstimate estimate) {
  const FitData layout = layout_of(reads);
  const std::vector<Maximum> maxima = maxima_near(reads, model, layout, places, judgement.climb);
  if (maxima.empty()) {
    return not_located(std::move(estimate), "no place is in reach of all reads");
  }
  const Eigen::ArrayXd best = wrapped_residuals(reads, model, maxima.front().place);
  const double rms_rad = std::sqrt(best.square().mean()) * 4.0 * kPi / longest_wavelength(reads);
  if (rms_rad > judgement.max_rms_rad) {
    return not_located(
        std::move(estimate),
        fmt::format("the phase does not fit a tag at rest: misfit {:.2f} rad, limit {:.2f} rad",
                    rms_rad, judgement.max_rms_rad));
  }
  for (const Maximum& maximum : maxima) {
    const bool first = estimate.candidates.empty();
    if (first || !is_worse(reads, layout, best, wrapped_residuals(reads, model, maximum.place))) {
      estimate.candidates.push_back(candidate_at(reads, model, maximum.place));
    }
  }
  judge(limits, estimate);
  return estimate;
}

}  // namespace tagfield
