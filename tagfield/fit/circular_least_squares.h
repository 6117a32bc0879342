// SPDX-License-Identifier: Apache-2.0
/// @file
/// Least squares on angles with the residual 2 sin(e/2): it is bounded, so that an outlier has
/// little influence, and half its square is 1 − cos e, which is the negative log-likelihood of the
/// von Mises distribution up to its concentration.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <vector>

#include "tagfield/base/units.h"
#include "tagfield/fit/circular_mean.h"
#include "tagfield/fit/levenberg_marquardt.h"
#include "tagfield/fit/symmetric.h"

namespace tagfield {

/// One angle, linearized in N unknowns.
template <int N>
struct CircularRow {
  double angle = 0.0;                 ///< Measured minus predicted [rad].
  Eigen::Matrix<double, N, 1> slope;  ///< Derivative of the prediction.
};

/// Normal equations and the cost: Σ w (1 − cos e).
template <int N>
struct CircularNormal {
  Eigen::Matrix<double, N, N> matrix = Eigen::Matrix<double, N, N>::Zero();
  Eigen::Matrix<double, N, 1> right = Eigen::Matrix<double, N, 1>::Zero();
  double cost = 0.0;
  std::vector<double> residuals;  ///< e in (−π, π], in order of addition [rad].
};

template <int N>
double circular_mean(const std::vector<CircularRow<N>>& rows) {
  CircularMean mean;
  for (const CircularRow<N>& row : rows) mean.add(row.angle);
  return mean.value();
}

/// Adds angles that share one offset. If `offset_free`, it is eliminated at their circular mean,
/// otherwise it is 0.
template <int N>
void add_angles(const std::vector<CircularRow<N>>& rows, bool offset_free, double weight,
                CircularNormal<N>& normal) {
  const double offset = offset_free ? circular_mean(rows) : 0.0;
  Eigen::Matrix<double, N, 1> sum = Eigen::Matrix<double, N, 1>::Zero();
  double weights = 0.0;
  double residuals = 0.0;
  for (const CircularRow<N>& row : rows) {
    const double error = wrap_to_pi(row.angle - offset);
    const double cosine = std::cos(error / 2.0);
    const double residual = 2.0 * std::sin(error / 2.0);
    const double w = cosine * cosine;
    const double r = cosine * residual;
    normal.matrix.noalias() += weight * w * row.slope * row.slope.transpose();
    normal.right += weight * r * row.slope;
    normal.cost += 0.5 * weight * residual * residual;
    normal.residuals.push_back(error);
    sum += w * row.slope;
    weights += w;
    residuals += r;
  }
  if (!offset_free || weights <= 1e-9) return;
  normal.matrix.noalias() -= weight / weights * sum * sum.transpose();
  normal.right -= weight * residuals / weights * sum;
}

/// Unknowns and the normal equations at them.
template <int N>
struct CircularFit {
  Eigen::Matrix<double, N, 1> unknowns;
  CircularNormal<N> normal;
  double cost = 0.0;  ///< That of `normal`.
};

/// Minimizes the cost from `start`; a step to where `allowed(unknowns)` is false ends the search.
/// `normal_at(unknowns)` returns the CircularNormal.
template <int N, typename NormalAt, typename Allowed>
CircularFit<N> fit_angles(const Eigen::Matrix<double, N, 1>& start, const LevenbergMarquardt& how,
                          const NormalAt& normal_at, const Allowed& allowed) {
  const auto at = [&](const Eigen::Matrix<double, N, 1>& unknowns) {
    CircularFit<N> fit{unknowns, normal_at(unknowns), 0.0};
    fit.cost = fit.normal.cost;
    return fit;
  };
  using Next = std::optional<CircularFit<N>>;
  return descend(at(start), how, [&](const CircularFit<N>& here, double damping) -> Next {
    const Eigen::Matrix<double, N, 1> next =
        here.unknowns + solve_symmetric(damped(here.normal.matrix, damping), here.normal.right);
    return allowed(next) ? Next(at(next)) : std::nullopt;
  });
}

}  // namespace tagfield
