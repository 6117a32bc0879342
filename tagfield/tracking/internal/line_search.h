// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where a pass may have begun and how fast it went, found without any first guess.
#pragma once

#include <vector>

#include "tagfield/tracking/internal/line_fit.h"

namespace tagfield {

/// A straight motion that explains a pass, and over how long its phase was coherent.
struct LineHypothesis {
  LineFit fit;
  double aperture_s = 0.0;      ///< Length of the sub-apertures that it was fitted with.
  double log_likelihood = 0.0;  ///< Up to a constant, with all hypotheses' common noise.
};

/// The best straight motions, best first, at most `most` of them. An inverse synthetic aperture,
/// coarse to fine: over sub-apertures so short that a range rate explains each, the power
/// Σ |Σ_i e^(j(φ_i − k ṙ t_i))| is looked up for a grid of motions within what the options allow;
/// the best are fitted (fit_line()) with sub-apertures of twice the length each time, as long as
/// the phase stays coherent, and with their mirror images in the antennas' plane.
std::vector<LineHypothesis> search_lines(const Pass& pass, const TrackingOptions& options,
                                         std::size_t most);

/// The mirror image of a motion in the vertical plane that holds all antennas' places; none where
/// there is no such plane. Of antennas at one place: in the plane that holds the place and the
/// vertical across the motion's direction.
std::vector<StraightMotion> mirror_images(const Pass& pass, const StraightMotion& motion);

}  // namespace tagfield
