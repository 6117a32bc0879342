// SPDX-License-Identifier: Apache-2.0
/// @file
/// The error of geometry in single precision.
#pragma once

namespace tagfield {

/// Upper bound on the rounding error of a sum of a few products in single precision, relative to
/// the greatest term: sixteen times half of 2⁻²³ (IEEE 754), as a safety margin.
inline constexpr double kSinglePrecision = 1e-6;

}  // namespace tagfield
