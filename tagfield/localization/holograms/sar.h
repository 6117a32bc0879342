// SPDX-License-Identifier: Apache-2.0
/// @file
/// Holograms, as of a synthetic aperture: the reads of one antenna and channel are added up as
/// waves at each place of a grid, the sums of several antennas and channels by magnitude, and the
/// brightest place is the tag's. docs/methods.md has the equations and the figures.
#pragma once

#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/holograms/hologram.h"
#include "tagfield/localization/method.h"

namespace tagfield {

struct SarOptions : SearchOptions {
  double min_share = 0.35;  ///< See CoherentJudgement; in (0, 1].
};

/// "sar": all tags, one by one. Throws Error on options out of their range.
Method sar_method(const SarOptions& options = {});

}  // namespace tagfield
