// SPDX-License-Identifier: Apache-2.0
/// @file
/// The paper's method: unwrapped phase, a hyperbola for each stride, all their intersections, the
/// best by the quality E. docs/localization.md has the equations and the figures.
#pragma once

#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"
#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

struct HyperbolaOptions {
  double stride_m = 0.3;            ///< Travel of the antenna between two hyperbolae.
  std::size_t max_hyperbolae = 50;  ///< Of one tag; more are thinned out (time grows as n³).
  double max_step = 0.8;            ///< See unwrap().
  bool refine = true;               ///< Finish with Gauss-Newton from the best intersections.
};

/// Locates one tag at rest in the plane z = `tag_height` [m, world]. Antennas that stand still
/// tell nothing by phase differences and are left out. With the pose error's model, where it is
/// told, covariances are honest about it; with a side, where the tag's height is not known, about
/// the plane, too. Throws Error on options or a height out of their range.
TagEstimate locate_by_hyperbolae(const std::string& tag, const SamplesOfTag& samples,
                                 double tag_height, const HyperbolaOptions& options,
                                 const EstimateLimits& limits,
                                 const std::optional<PoseErrorModel>& pose_error = {},
                                 const std::optional<HeightSide>& side = {});

/// "hyperbola": all tags, one by one, each in its plane.
Method hyperbola_method(const HyperbolaOptions& options = {});

}  // namespace tagfield
