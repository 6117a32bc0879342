// SPDX-License-Identifier: Apache-2.0
/// @file
/// Synthetic-aperture holograms: at each point of a grid, the phasors of one antenna and channel
/// are summed coherently and the sums of several antennas and channels by magnitude; the tag is at
/// the brightest point. docs/methods.md has the equations and the figures.
#pragma once

#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/holograms/hologram.h"
#include "tagfield/localization/method.h"

namespace tagfield {

struct SarOptions : SearchOptions {
  double min_share = 0.35;  ///< See CoherentJudgement; in (0, 1].
};

/// Method "sar": each tag independently. Throws Error on options out of range.
Method sar_method(const SarOptions& options = {});

}  // namespace tagfield
