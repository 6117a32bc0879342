// SPDX-License-Identifier: Apache-2.0
/// @file
/// Least squares by Gauss-Newton steps with Levenberg-Marquardt damping, which grows if a step
/// increases the cost. Steps and cost are supplied by the caller.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace tagfield {

/// Damping schedule and stopping criteria.
struct LevenbergMarquardt {
  int max_steps = 30;  ///< Including rejected ones.
  double damping = 1e-3;
  double min_damping = 1e-9;  ///< An accepted step divides the damping by ten, down to this.
  double raise = 10.0;        ///< A rejected step multiplies it by this,
  double min_raised = 0.0;    ///< to at least this value.
  double max_damping = std::numeric_limits<double>::infinity();  ///< Ends the search.
  /// A step that gains less is accepted as the last one; 0 disables this.
  double min_gain = 0.0;
  /// As above, relative to the cost or to 1, whichever is larger.
  double min_relative_gain = 0.0;
};

/// Descends from `here`. A Point has a `cost`. `step(point, damping)` returns the point after the
/// damped step as std::optional<Point>: nullopt ends the search, and a point whose cost is not a
/// number is rejected. A step is accepted if it decreases the cost (with a least gain, also if the
/// cost stays the same).
template <typename Point, typename Step>
Point descend(Point here, const LevenbergMarquardt& how, Step&& step) {
  double damping = how.damping;
  for (int i = 0; i < how.max_steps && damping < how.max_damping; ++i) {
    std::optional<Point> there = step(std::as_const(here), damping);
    if (!there) break;
    const double gain = here.cost - there->cost;
    const double least = std::max(how.min_gain, how.min_relative_gain * std::max(1.0, there->cost));
    if (gain > 0.0 || (gain == 0.0 && least > 0.0)) {
      here = std::move(*there);
      damping = std::max(0.1 * damping, how.min_damping);
      if (gain < least) break;
    } else {
      damping = std::max(how.raise * damping, how.min_raised);
    }
  }
  return here;
}

/// The normal matrix with its diagonal multiplied by 1 + λ (Marquardt) and `ridge` added to it,
/// which keeps a singular matrix (unknowns not observable) solvable.
template <int N>
Eigen::Matrix<double, N, N> damped(Eigen::Matrix<double, N, N> normal, double damping,
                                   double ridge = 0.0) {
  normal.diagonal() *= 1.0 + damping;
  normal.diagonal().array() += ridge;
  return normal;
}

/// The normal matrix with λ times its trace added to the diagonal (Levenberg): for unknowns of the
/// same unit.
template <int N>
Eigen::Matrix<double, N, N> evenly_damped(Eigen::Matrix<double, N, N> normal, double damping,
                                          double ridge = 0.0) {
  normal.diagonal().array() += damping * normal.trace() + ridge;
  return normal;
}

/// Whether a step is finite and not shorter than `least`.
template <int N>
bool is_worthwhile(const Eigen::Matrix<double, N, 1>& step, double least) {
  return step.allFinite() && step.norm() >= least;
}

}  // namespace tagfield
