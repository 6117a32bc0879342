// SPDX-License-Identifier: Apache-2.0
/// @file
/// Phasor sums of many reads at one position, with their derivatives: the inner loop of the climb
/// to a hologram's maxima.
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
  PositionVector in_phase = PositionVector::Zero();
  PositionVector quadrature = PositionVector::Zero();
  PositionVector slopes = PositionVector::Zero();     ///< Σ s.
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();  ///< Σ s sᵀ.
};

/// Sums over the reads of one aperture, with the ranges and derivatives of range_to(), |ψ| ≤ 10⁵
/// rad. Bit-identical for every instruction set.
WaveSlopes wave_slopes(const TagPhases& phases, const Aperture& part, const HeightModel& height,
                       const PositionVector& place, InstructionSet set = instruction_sets().back());

/// S only.
std::complex<double> wave_sum(const TagPhases& phases, const Aperture& part,
                              const HeightModel& height, const PositionVector& place,
                              InstructionSet set = instruction_sets().back());

}  // namespace tagfield
