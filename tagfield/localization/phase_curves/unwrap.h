// SPDX-License-Identifier: Apache-2.0
/// @file
/// Phase unwrapping.
#pragma once

#include <string>
#include <vector>

#include "tagfield/localization/problem.h"
#include "tagfield/localization/tag_phases.h"

namespace tagfield {

/// Samples of one tag by one antenna over which the phase could be unwrapped.
struct PhaseSegment {
  std::vector<PhaseSample> samples;
  /// Unwrapped phase distance λ/(4π)·(φ_i − φ_0) [m] for each sample, 0 at the first: the change of
  /// the antenna-tag distance since then (eq. 9 of the paper).
  std::vector<double> distance_m;
};

/// Maximum travel between two samples for unwrapping, as a fraction of a quarter wavelength:
/// `max_step`, or less if the noise requires it, but noise does not reduce it below 0.5.
double step_limit(double noise_rad, double max_step);

/// Unwraps the phase from sample to sample. A new segment starts where the antenna travelled too
/// far between two samples, or where the carrier changes. The limit is step_limit() quarter
/// wavelengths of travel: λ/4 of radial motion turns the phase by π.
std::vector<PhaseSegment> unwrap(const std::vector<PhaseSample>& samples, double max_step);

/// Lays out segments, each as a span with its own offset; `antennas`: the antenna of each.
TagPhases unwrapped_phases(const std::vector<PhaseSegment>& segments,
                           const std::vector<std::string>& antennas);

}  // namespace tagfield
