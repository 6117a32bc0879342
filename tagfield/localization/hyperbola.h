/// @file
/// The paper's method: unwrapped phase, a hyperbola for each stride, all their intersections, the
/// best by the quality E.
#pragma once

#include "tagfield/localization/phase_sample.h"
#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

struct HyperbolaOptions {
  double stride_m = 0.3;              ///< Travel of the antenna between two hyperbolae.
  double max_step = 0.8;              ///< See unwrap().
  bool refine = true;                 ///< Finish with Gauss-Newton from the best intersections.
  double max_expected_error_m = 0.3;  ///< A worse place than this is not given as located.
  double max_rms_m = 0.08;            ///< A worse misfit than this is no tag at rest.
};

/// Locates one tag at rest in the plane z = `tag_height` [m, world].
TagEstimate locate_by_hyperbolae(const std::string& tag, const SamplesOfTag& samples,
                                 double tag_height, const HyperbolaOptions& options);

}  // namespace tagfield
