// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fit_candidates.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "tagfield/base/median.h"
#include "tagfield/fit/symmetric.h"
#include "tagfield/localization/residuals.h"

namespace tagfield {
namespace {

constexpr double kUnboundedVariance = 1e12;  // [m²]
constexpr double kSameFit = 0.03;            ///< Fits nearer than this are the same [m].
constexpr std::size_t kMaxCandidates = 8;    ///< Maximum per tag.

double mean_square_wavenumber(const TagPhases& phases) { return phases.wavenumber.square().mean(); }

std::vector<TagFit> distinct(std::vector<TagFit> fits) {
  std::stable_sort(fits.begin(), fits.end(),
                   [](const TagFit& a, const TagFit& b) { return a.cost < b.cost; });
  std::vector<TagFit> kept;
  for (TagFit& fit : fits) {
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const TagFit& other) {
      return (other.unknowns - fit.unknowns).head<2>().norm() < kSameFit;
    });
    if (is_new && kept.size() < kMaxCandidates) kept.push_back(std::move(fit));
  }
  return kept;
}

/// Half the spread over all reads of ∂r/∂s along `direction`; its largest magnitude if any offset
/// is known.
double range_rate_spread(const TagPhases& phases, const HeightModel& height, const TagFit& fit,
                         const PositionVector& direction) {
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

constexpr double kNeighbour = 0.35;  ///< Reads nearer in time than this are neighbours [s].

/// Sets the rows and columns of a known height to 0.
Eigen::Matrix3d of_unknowns(const HeightModel& height, Eigen::Matrix3d covariance) {
  if (height.unknowns() == 3) return covariance;
  covariance.row(2).setZero();
  covariance.col(2).setZero();
  return covariance;
}

/// nullopt if the matrix is singular or its inverse is not positive.
std::optional<Eigen::Matrix3d> inverse_of(const Eigen::Matrix3d& normal) {
  bool is_regular = false;
  Eigen::Matrix3d inverse;
  normal.computeInverseWithCheck(inverse, is_regular, 1e-30);
  if (!is_regular || !inverse.allFinite() || inverse.diagonal().minCoeff() < 0.0)
    return std::nullopt;
  return inverse;
}

/// Contribution of each read to the right-hand side of the normal equations per metre of antenna
/// error in x and in y: columns k² g̃ u_x and k² g̃ u_y.
struct Pull {
  double time_s = 0.0;
  Eigen::Matrix<double, 3, 2> by_axis;
};

std::vector<Pull> pulls_of(const TagPhases& phases, const HeightModel& height, const TagFit& fit) {
  std::vector<Pull> pulls;
  pulls.reserve(static_cast<std::size_t>(phases.size()));
  for (const TagPhases::Span& span : phases.spans) {
    std::vector<Eigen::Vector3d> gradients;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
      gradients.push_back(
          range_to(height, fit.unknowns, phases.x[i], phases.y[i], phases.z[i]).gradient);
      mean += gradients.back() / static_cast<double>(span.count);
    }
    if (span.offset_known) mean.setZero();
    for (Eigen::Index i = 0; i < span.count; ++i) {
      const Eigen::Vector3d& g = gradients[static_cast<std::size_t>(i)];
      const double k = phases.wavenumber[span.begin + i];
      pulls.push_back(
          {phases.time_s[span.begin + i], k * k * (g - mean) * g.head<2>().transpose()});
    }
  }
  std::stable_sort(pulls.begin(), pulls.end(),
                   [](const Pull& a, const Pull& b) { return a.time_s < b.time_s; });
  return pulls;
}

/// Σ over all pairs of reads of the products of their pulls, weighted by the correlation of their
/// errors; in one pass, as the correlation is exponential.
Eigen::Matrix3d scatter_of(const std::vector<Pull>& pulls, const PoseErrorModel& model) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> before = Eigen::Matrix<double, 3, 2>::Zero();
  double time_s = pulls.empty() ? 0.0 : pulls.front().time_s;
  for (const Pull& pull : pulls) {
    before *= std::exp(-(pull.time_s - time_s) / model.time_constant_s);
    time_s = pull.time_s;
    const Eigen::Matrix3d cross = pull.by_axis * before.transpose();
    scatter += pull.by_axis * pull.by_axis.transpose() + cross + cross.transpose();
    before += pull.by_axis;
  }
  return model.sigma_m * model.sigma_m * scatter;
}

}  // namespace

std::vector<double> neighbour_differences(const TagPhases& phases, const Eigen::ArrayXd& errors) {
  std::vector<double> differences;
  for (const TagPhases::Span& span : phases.spans) {
    for (Eigen::Index i = span.begin + 1; i < span.begin + span.count; ++i) {
      if (phases.time_s[i] - phases.time_s[i - 1] > kNeighbour) continue;
      differences.push_back(std::abs(errors[i] - errors[i - 1]) * phases.wavenumber[i]);
    }
  }
  return differences;
}

double noise_of_differences(std::vector<double> differences) {
  constexpr double kLeast = 1e-3;
  return std::max(sigma_by_median(std::move(differences)) / std::sqrt(2.0), kLeast);
}

Eigen::Matrix3d honest_covariance(const TagPhases& phases, const HeightModel& height,
                                  const TagFit& fit) {
  if (!phases.pose_error) {
    const double factor = fitted_away(phases.spans, residuals_of(phases, height, fit));
    return factor * factor * covariance_of(phases, height, fit);
  }
  const Eigen::Matrix3d normal = normal_of(phases, height, fit.unknowns);
  const auto inverse = inverse_of(normal);
  if (!inverse) return covariance_of(phases, height, fit);
  const Eigen::ArrayXd errors = residuals_of(phases, height, fit);
  const std::vector<double> differences = neighbour_differences(phases, errors);
  // For reads far apart residuals don't separate noise from pose errors: all may be noise.
  const double noise =
      differences.empty()
          ? std::sqrt(residual_variance(phases.spans, errors) * mean_square_wavenumber(phases))
          : noise_of_differences(differences);
  const Eigen::Matrix3d right =
      noise * noise * normal + scatter_of(pulls_of(phases, height, fit), *phases.pose_error);
  return of_unknowns(height, *inverse * right * inverse->transpose());
}

Eigen::Matrix3d covariance_of(const TagPhases& phases, const HeightModel& height,
                              const TagFit& fit) {
  const Eigen::ArrayXd errors = residuals_of(phases, height, fit);
  const double noise =
      residual_variance(phases.spans, errors) * correlation_factor(phases.spans, errors);
  const Eigen::Matrix3d normal =
      normal_of(phases, height, fit.unknowns) / mean_square_wavenumber(phases);
  const Eigen::Matrix3d anything = kUnboundedVariance * Eigen::Matrix3d::Identity();
  return of_unknowns(height, noise * inverse_of(normal).value_or(anything));
}

Candidate make_candidate(const HeightModel& height, const PositionVector& unknowns,
                         const Eigen::Matrix3d& covariance, double rms_m) {
  constexpr double kMaxError = 1e6;  // [m]
  Candidate candidate;
  candidate.p_WT = to_position(height, unknowns);
  candidate.rms_m = rms_m;
  candidate.covariance = to_position_covariance(height, unknowns, covariance);
  candidate.expected_error_m =
      std::min(std::sqrt(covariance.topLeftCorner<2, 2>().trace()), kMaxError);
  return candidate;
}

Candidate make_candidate(const TagPhases& phases, const HeightModel& height, const TagFit& fit) {
  const double rms_m = std::sqrt(residuals_of(phases, height, fit).square().mean());
  return make_candidate(height, fit.unknowns, honest_covariance(phases, height, fit), rms_m);
}

std::vector<Candidate> make_candidates(const TagPhases& phases, const HeightModel& height,
                                       std::vector<TagFit> fits) {
  const std::vector<TagFit> kept = distinct(std::move(fits));
  const Eigen::ArrayXd best = residuals_of(phases, height, kept.front());
  std::vector<Candidate> candidates;
  for (const TagFit& fit : kept) {
    const bool is_first = candidates.empty();
    if (!is_first && tells_apart(phases.spans, best, residuals_of(phases, height, fit))) {
      continue;
    }
    candidates.push_back(make_candidate(phases, height, fit));
  }
  return candidates;
}

std::vector<PositionVector> spread_starts(const TagPhases& phases, const HeightModel& height,
                                          const TagFit& fit, const Eigen::Matrix3d& covariance) {
  constexpr double kDeviations = 3.0;
  constexpr int kMaxSteps = 40;
  constexpr double kFarthest = 2.0;  // [m]
  std::vector<PositionVector> starts{fit.unknowns};
  const SymmetricEigen<3> axes = symmetric_eigen(covariance);
  const PositionVector direction = axes.vectors.col(2);
  const double reach = std::min(kDeviations * std::sqrt(std::max(axes.values[2], 0.0)), kFarthest);
  const double eighth = longest_cycle(phases) / 4.0;  // A cycle is half a wavelength.
  const double step = eighth / std::max(range_rate_spread(phases, height, fit, direction), 1e-6);
  const int steps = std::min(kMaxSteps, static_cast<int>(std::floor(reach / step)));
  for (int i = 1; i <= steps; ++i) {
    starts.push_back(fit.unknowns + i * step * direction);
    starts.push_back(fit.unknowns - i * step * direction);
  }
  return starts;
}

}  // namespace tagfield
