/// @file
/// Phase histories without their jumps of 2π.
#pragma once

#include <vector>

#include "tagfield/localization/phase_sample.h"

namespace tagfield {

/// A stretch of one antenna's samples of one tag over which the phase could be followed.
struct PhaseSegment {
  std::vector<PhaseSample> samples;
  /// Unwrapped phase distance λ/(4π)·(φ_i − φ_0) [m] for each sample, 0 at the first: the change of
  /// the antenna-tag distance since then (eq. 9 of the paper).
  std::vector<double> distance_m;
};

/// Follows the phase from sample to sample. A new segment starts where the antenna travelled
/// further between two samples than the phase can be followed, or where the carrier changes. The
/// limit is `max_step` of a quarter wavelength of travel (λ/4 of radial motion turns the phase by
/// π), less what the phase noise seen in the samples needs.
std::vector<PhaseSegment> unwrap(const std::vector<PhaseSample>& samples, double max_step);

}  // namespace tagfield
