// SPDX-License-Identifier: Apache-2.0
/// @file
/// Search for the position and velocity of a pass without an initial guess.
#pragma once

#include <vector>

#include "tagfield/tracking/internal/line_fit.h"

namespace tagfield {

/// A straight motion that explains a pass, and the time over which its phase was coherent.
struct LineHypothesis {
  LineFit fit;
  double aperture_s = 0.0;      ///< Length of the sub-apertures that it was fitted with.
  double log_likelihood = 0.0;  ///< Up to a constant, with the noise common to all hypotheses.
};

/// At most `most` straight motions, best first. Coarse-to-fine inverse synthetic aperture: over
/// sub-apertures short enough to be explained by a range rate each, Σ |Σ_i e^(j(φ_i − k ṙ t_i))| is
/// looked up for a grid of motions that the options allow. The best are fitted (fit_line()) with
/// sub-apertures of doubled length each time, as long as the phase stays coherent, finally together
/// with their mirror images in the antennas' plane.
std::vector<LineHypothesis> search_lines(const Pass& pass, const TrackingOptions& options,
                                         std::size_t most);

/// Fits a hypothesis of another pass again to this one, from the height that is known of this one.
LineHypothesis fitted_again(const Pass& pass, const TrackingOptions& options,
                            const LineHypothesis& hypothesis);

/// The mirror image of a motion in the vertical plane that contains all antenna positions; none if
/// there is no such plane. If all antennas are at one point, the vertical plane through it parallel
/// to the motion.
std::vector<StraightMotion> mirror_images(const Pass& pass, const StraightMotion& motion);

}  // namespace tagfield
