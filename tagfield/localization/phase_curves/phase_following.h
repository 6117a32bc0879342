// SPDX-License-Identifier: Apache-2.0
/// @file
/// Phase unwrapping aided by the phase change expected from the antenna's motion.
#pragma once

#include <cstddef>
#include <vector>

#include "tagfield/localization/phase_curves/unwrap.h"

namespace tagfield {

/// Samples sorted by channel, each channel in time order: the phase continues when the reader
/// returns to a channel, however many others it used in between.
std::vector<PhaseSample> by_channel(std::vector<PhaseSample> series);

/// Unwraps the phase from sample to sample, like unwrap(), but relative to the expected change: the
/// distance of a tag in the direction u from the antenna changes by −u·Δa over the antenna's step
/// Δa, and u changes slowly. u is the state of a Kalman filter, whose uncertainty decides whether
/// whole turns are reliable: a new segment starts if the standard deviation of the expected change
/// exceeds about 0.15 turns, or if the carrier changes. This unwraps noisier phases, and over steps
/// longer than λ/4 once the direction is known. `noise_rad`: standard deviation of the phase noise.
std::vector<PhaseSegment> follow(const std::vector<PhaseSample>& samples, double noise_rad);

/// Indices, in ascending order, of samples whose phase is arbitrary: over 4.5 standard deviations
/// from what at least four samples before lead to expect, while one of the next three samples is
/// as expected, as are the two before it if these follow another stray. Determined forward and
/// backward in time, so that those at the beginning count, too, and again without those found.
std::vector<std::size_t> stray_samples(const std::vector<PhaseSample>& samples, double noise_rad);

/// A change of phase from one sample to the next, and those before and after it.
struct FollowedStep {
  std::size_t from = 0;     ///< Index of the first of the two samples.
  double change_rad = 0.0;  ///< Measured, unwrapped to the turn nearest to the expected one.
  double off_rad = 0.0;     ///< Measured minus expected, wrapped.
  double sigma_rad = 0.0;   ///< Standard deviation of the expectation.
  double before_rad = 0.0;  ///< Change over the step before,
  double after_rad = 0.0;   ///< and over the next one, unwrapped likewise.
};

/// Steps that can be followed as by follow(), as can those before and after them, which are as
/// expected (within three standard deviations): no single arbitrary phase makes such a step
/// unexpected. Nothing is learnt from a step before the next one is expected, as it may not be due
/// to the antenna's motion.
std::vector<FollowedStep> followed_steps(const std::vector<PhaseSample>& samples, double noise_rad);

}  // namespace tagfield
