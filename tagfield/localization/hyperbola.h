/// @file
/// The paper's method: unwrapped phase, a hyperbola for each stride, all their intersections, the
/// best by the quality E. docs/localization.md has the equations and the figures.
#pragma once

#include "tagfield/localization/phase_sample.h"
#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

struct HyperbolaOptions {
  double stride_m = 0.3;               ///< Travel of the antenna between two hyperbolae.
  std::size_t max_hyperbolae = 50;     ///< Of one tag; more are thinned out (time grows as n³).
  double max_step = 0.8;               ///< See unwrap().
  bool refine = true;                  ///< Finish with Gauss-Newton from the best intersections.
  double max_expected_error_m = 0.15;  ///< A worse place than this is not given as located.
  double max_rms_m = 0.08;             ///< A worse misfit than this is no tag at rest.
};

/// Locates one tag at rest in the plane z = `tag_height` [m, world]. Antennas that stand still
/// tell nothing by phase differences and are left out. Throws Error on options or a height out of
/// their range.
TagEstimate locate_by_hyperbolae(const std::string& tag, const SamplesOfTag& samples,
                                 double tag_height, const HyperbolaOptions& options);

/// Largest extent of an antenna's places, the diagonal of the box around them [m].
double extent_of(const std::vector<PhaseSample>& samples);

/// An antenna that moved less than this [m] stood still.
inline constexpr double kStillExtent = 0.1;

}  // namespace tagfield
