// SPDX-License-Identifier: Apache-2.0
/// @file
/// Least squares by Gauss and Newton's steps with Levenberg's and Marquardt's damping, which grows
/// where a step leads uphill. What the steps are and what they cost is up to the user.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace tagfield {

/// How the damping goes, and when to end.
struct LevenbergMarquardt {
  int most_steps = 30;  ///< Refused ones included.
  double damping = 1e-3;
  double least_damping = 1e-9;  ///< A step taken divides the damping by ten, down to this.
  double raise = 10.0;          ///< A step refused multiplies it by this,
  double least_raised = 0.0;    ///< but up to this at least.
  double most_damping = std::numeric_limits<double>::infinity();  ///< There it ends.
  /// A step that gains less is taken as the last; 0 for none.
  double least_gain = 0.0;
  double least_relative_gain = 0.0;  ///< Likewise, of the cost or of 1, whichever is more.
};

/// From `here` downhill. A Point has its `cost`. `step(point, damping)` says where the damped step
/// from a point leads, as std::optional<Point>: none ends it, a cost that is not a number is
/// refused. A step is taken if it costs less (with a least gain, if it doesn't cost more).
template <typename Point, typename Step>
Point descend(Point here, const LevenbergMarquardt& how, Step&& step) {
  double damping = how.damping;
  for (int i = 0; i < how.most_steps && damping < how.most_damping; ++i) {
    std::optional<Point> there = step(std::as_const(here), damping);
    if (!there) break;
    const double gain = here.cost - there->cost;
    const double least =
        std::max(how.least_gain, how.least_relative_gain * std::max(1.0, there->cost));
    if (gain > 0.0 || (gain == 0.0 && least > 0.0)) {
      here = std::move(*there);
      damping = std::max(0.1 * damping, how.least_damping);
      if (gain < least) break;
    } else {
      damping = std::max(how.raise * damping, how.least_raised);
    }
  }
  return here;
}

/// The normal matrix with its diagonal multiplied by 1 + λ, as Marquardt does, and `ridge` added,
/// which keeps a singular matrix (nothing to learn) solvable.
template <int N>
Eigen::Matrix<double, N, N> damped(Eigen::Matrix<double, N, N> normal, double damping,
                                   double ridge = 0.0) {
  normal.diagonal() *= 1.0 + damping;
  normal.diagonal().array() += ridge;
  return normal;
}

/// Likewise with λ times the matrix' trace added, as Levenberg does with all unknowns alike: for
/// unknowns of one unit.
template <int N>
Eigen::Matrix<double, N, N> evenly_damped(Eigen::Matrix<double, N, N> normal, double damping,
                                          double ridge = 0.0) {
  normal.diagonal().array() += damping * normal.trace() + ridge;
  return normal;
}

/// Whether a step is worth taking: finite, and not shorter than `least`.
template <int N>
bool is_worthwhile(const Eigen::Matrix<double, N, 1>& step, double least) {
  return step.allFinite() && step.norm() >= least;
}

}  // namespace tagfield
