#include "tagfield/localization/fit_candidates.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tagfield/localization/residuals.h"

namespace tagfield {
namespace {

constexpr double kAnything = 1e12;  // [m²]
constexpr double kSame = 0.03;      ///< Fits nearer than this are one [m].
constexpr std::size_t kMost = 8;    ///< Candidates of one tag.

/// Only the spans matter to residuals.h besides the residuals.
FitData spans_of(const TagPhases& phases) {
  FitData data;
  for (const TagPhases::Span& span : phases.spans) {
    data.spans.push_back({span.begin, span.count, 0.0});
  }
  return data;
}

double mean_square_wavenumber(const TagPhases& phases) { return phases.wavenumber.square().mean(); }

std::vector<TagFit> distinct(std::vector<TagFit> fits) {
  std::stable_sort(fits.begin(), fits.end(),
                   [](const TagFit& a, const TagFit& b) { return a.cost < b.cost; });
  std::vector<TagFit> kept;
  for (TagFit& fit : fits) {
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const TagFit& other) {
      return (other.unknowns - fit.unknowns).head<2>().norm() < kSame;
    });
    if (is_new && kept.size() < kMost) kept.push_back(std::move(fit));
  }
  return kept;
}

/// Greatest deviation from the mean over all reads of ∂r/∂s along `direction`.
double range_rate_spread(const TagPhases& phases, const HeightModel& height, const TagFit& fit,
                         const PlaceVector& direction) {
  double low = 1e9;
  double high = -1e9;
  const bool any_known = std::any_of(phases.spans.begin(), phases.spans.end(),
                                     [](const auto& span) { return span.offset_known; });
  for (Eigen::Index i = 0; i < phases.size(); ++i) {
    const double rate = range_to(height, fit.unknowns, phases.x[i], phases.y[i], phases.z[i])
                            .gradient.dot(direction);
    low = std::min(low, rate);
    high = std::max(high, rate);
  }
  return any_known ? std::max(std::abs(low), std::abs(high)) : 0.5 * (high - low);
}

}  // namespace

Eigen::Matrix3d covariance_of(const TagPhases& phases, const HeightModel& height,
                              const TagFit& fit) {
  const FitData data = spans_of(phases);
  const Eigen::ArrayXd errors = residuals_of(phases, height, fit);
  const double noise = residual_variance(data, errors) * correlation_factor(data, errors);
  const Eigen::Matrix3d normal =
      normal_of(phases, height, fit.unknowns) / mean_square_wavenumber(phases);
  bool is_regular = false;
  Eigen::Matrix3d inverse;
  normal.computeInverseWithCheck(inverse, is_regular, 1e-30);
  if (!is_regular || !inverse.allFinite() || inverse.diagonal().minCoeff() < 0.0) {
    inverse = Eigen::Matrix3d::Identity() * kAnything;
  }
  Eigen::Matrix3d covariance = noise * inverse;
  if (height.unknowns() == 2) {
    covariance.row(2).setZero();
    covariance.col(2).setZero();
  }
  return covariance;
}

Candidate make_candidate(const TagPhases& phases, const HeightModel& height, const TagFit& fit,
                         const Eigen::Matrix3d& covariance) {
  Candidate candidate;
  candidate.p_WT = to_place(height, fit.unknowns);
  candidate.rms_m = std::sqrt(residuals_of(phases, height, fit).square().mean());
  candidate.covariance = to_place_covariance(height, fit.unknowns, covariance);
  candidate.expected_error_m = std::min(std::sqrt(covariance.topLeftCorner<2, 2>().trace()), 1e6);
  return candidate;
}

std::vector<Candidate> make_candidates(const TagPhases& phases, const HeightModel& height,
                                       std::vector<TagFit> fits) {
  const FitData data = spans_of(phases);
  const std::vector<TagFit> kept = distinct(std::move(fits));
  const Eigen::ArrayXd best = residuals_of(phases, height, kept.front());
  std::vector<Candidate> candidates;
  for (const TagFit& fit : kept) {
    const bool is_first = candidates.empty();
    if (!is_first && tells_apart(data, best, residuals_of(phases, height, fit))) continue;
    candidates.push_back(make_candidate(phases, height, fit, covariance_of(phases, height, fit)));
  }
  return candidates;
}

std::vector<PlaceVector> spread_starts(const TagPhases& phases, const HeightModel& height,
                                       const TagFit& fit, const Eigen::Matrix3d& covariance) {
  constexpr double kDeviations = 3.0;
  constexpr int kMostSteps = 40;
  constexpr double kFarthest = 2.0;  // [m]
  std::vector<PlaceVector> starts{fit.unknowns};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
  const PlaceVector direction = axes.eigenvectors().col(2);
  const double reach =
      std::min(kDeviations * std::sqrt(std::max(axes.eigenvalues()[2], 0.0)), kFarthest);
  const double eighth = phases.cycle.maxCoeff() / 4.0;  // A cycle is half a wavelength.
  const double step = eighth / std::max(range_rate_spread(phases, height, fit, direction), 1e-6);
  const int steps = std::min(kMostSteps, static_cast<int>(std::floor(reach / step)));
  for (int i = 1; i <= steps; ++i) {
    starts.push_back(fit.unknowns + i * step * direction);
    starts.push_back(fit.unknowns - i * step * direction);
  }
  return starts;
}

}  // namespace tagfield
