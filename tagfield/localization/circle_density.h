// SPDX-License-Identifier: Apache-2.0
/// @file
/// Densities of a phase difference on a circle.
#pragma once

#include <Eigen/Core>

#include "tagfield/base/lanes.h"

namespace tagfield {

/// Values of δ on a circle: i·2π/kCircleBins.
inline constexpr Eigen::Index kCircleBins = 128;
using OnCircle = Eigen::Array<double, kCircleBins, 1>;

/// A difference from an expected phase, of standard deviation `sigma` > 0, that is arbitrary with a
/// probability of `arbitrary` > 0.
struct PhaseDifference {
  float rad = 0.0f;
  float sigma = 0.0f;
  float arbitrary = 0.0f;
};

/// ln f(d − δ) for all δ, with f(x) = (1 − a)·exp(−x²/2σ²)/(σ√2π) + a/2π and x in [−π, π]. In
/// single precision, within 1e-4, as there are two for each read; the same bits on each instruction
/// set.
OnCircle log_density(const PhaseDifference& of, InstructionSet set = instruction_sets().back());

}  // namespace tagfield
