// SPDX-License-Identifier: Apache-2.0
/// @file
/// The error of poses by dead reckoning as a process from knot to knot.
#pragma once

#include <vector>

#include "tagfield/localization/joint/pose_knots.h"

namespace tagfield {

/// Makes the error at the knots that of dead reckoning from an exact start (problem.drift), with x,
/// y and yaw at each knot. From one to the next it stays, and its yaw ψ turns what the reference
/// antenna drives, Δ; w is added:
///
///     (x, y)_k = (x, y)_{k−1} + Δ − R(−ψ_{k−1}) Δ + w,  ψ_k = ψ_{k−1} + w_ψ
///
/// with the covariance that the poses in between gain, in axes turned by −ψ_{k−1}. A pose's share
/// in a step is that of the time since the previous pose. Every body must drift.
void take_drift(const LocalizationProblem& problem, PoseKnots& knots);

}  // namespace tagfield
