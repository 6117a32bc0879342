// SPDX-License-Identifier: Apache-2.0
/// @file
/// The paper's method: unwrapped phase, a hyperbola for each stride, all their intersections, and
/// the best of these by the quality E. docs/localization.md has the equations and the figures.
#pragma once

#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"
#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

struct HyperbolaOptions {
  double stride_m = 0.3;            ///< Travel of the antenna between two hyperbolae.
  std::size_t max_hyperbolae = 50;  ///< Per tag; more are thinned out (time grows as n³).
  double max_step = 0.8;            ///< See unwrap().
  bool refine = true;               ///< Final Gauss-Newton fit from the best intersections.
};

/// Locates one tag at rest in the plane z = `tag_height` [m, world]. Stationary antennas are left
/// out, as their phase differences carry no information. If `pose_error` is given, covariances
/// account for it; if `side` is given (the tag's height is unknown), they also account for the
/// choice of the plane. Throws Error on options or a height out of range.
TagEstimate locate_by_hyperbolae(const std::string& tag, const SamplesOfTag& samples,
                                 double tag_height, const HyperbolaOptions& options,
                                 const EstimateLimits& limits,
                                 const std::optional<PoseErrorModel>& pose_error = {},
                                 const std::optional<HeightSide>& side = {});

/// Method "hyperbola": each tag independently, in its plane.
Method hyperbola_method(const HyperbolaOptions& options = {});

}  // namespace tagfield
