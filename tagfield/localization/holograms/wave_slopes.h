// SPDX-License-Identifier: Apache-2.0
/// @file
/// Waves of many reads added up at one place, with how they change as it moves: the inner loop of
/// the climb to a hologram's maxima.
#pragma once

#include <Eigen/Core>
#include <complex>

#include "tagfield/base/lanes.h"
#include "tagfield/localization/height_model.h"
#include "tagfield/localization/holograms/coherent_reads.h"

namespace tagfield {

/// S = Σ e^{jψ} of the reads' residuals ψ = k (v − r), with the phase v and the range r in metres.
struct WaveSlopes {
  std::complex<double> sum;
  /// Σ cos ψ s and Σ sin ψ s with s = k ∂r/∂place [rad/m].
  PlaceVector in_phase = PlaceVector::Zero();
  PlaceVector quadrature = PlaceVector::Zero();
  PlaceVector slopes = PlaceVector::Zero();           ///< Σ s.
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();  ///< Σ s sᵀ.
};

/// Of the reads of one aperture, with ranges and derivatives of range_to(), |ψ| ≤ 10⁵ rad. The same
/// bits with each set of instructions.
WaveSlopes wave_slopes(const TagPhases& phases, const Aperture& part, const HeightModel& height,
                       const PlaceVector& place, InstructionSet set = instruction_sets().back());

/// S alone.
std::complex<double> wave_sum(const TagPhases& phases, const Aperture& part,
                              const HeightModel& height, const PlaceVector& place,
                              InstructionSet set = instruction_sets().back());

}  // namespace tagfield
