// SPDX-License-Identifier: Apache-2.0
/// @file
/// Phase histories without their jumps of 2π.
#pragma once

#include <string>
#include <vector>

#include "tagfield/localization/problem.h"
#include "tagfield/localization/tag_phases.h"

namespace tagfield {

/// A stretch of one antenna's samples of one tag over which the phase could be followed.
struct PhaseSegment {
  std::vector<PhaseSample> samples;
  /// Unwrapped phase distance λ/(4π)·(φ_i − φ_0) [m] for each sample, 0 at the first: the change of
  /// the antenna-tag distance since then (eq. 9 of the paper).
  std::vector<double> distance_m;
};

/// Longest travel between two samples over which the phase is followed, as a part of a quarter
/// wavelength: `max_step`, or less where the noise needs it, but not under 0.5 for noise alone.
double step_limit(double noise_rad, double max_step);

/// Follows the phase from sample to sample. A new segment starts where the antenna travelled
/// further between two samples than the phase can be followed, or where the carrier changes. The
/// limit is step_limit() quarter wavelengths of travel: λ/4 of radial motion turns the phase by π.
std::vector<PhaseSegment> unwrap(const std::vector<PhaseSample>& samples, double max_step);

/// Segments laid out, each a span with an offset of its own; and of which antenna each is.
TagPhases unwrapped_phases(const std::vector<PhaseSegment>& segments,
                           const std::vector<std::string>& antennas);

}  // namespace tagfield
