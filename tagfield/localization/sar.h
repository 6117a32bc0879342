/// @file
/// Holograms, as of a synthetic aperture: the reads of one antenna and channel are added up as
/// waves at each place of a grid, the sums of several antennas and channels by magnitude, and the
/// brightest place is the tag's. docs/methods.md has the equations and the figures.
#pragma once

#include "tagfield/localization/coherent_fit.h"
#include "tagfield/localization/hologram.h"
#include "tagfield/localization/method.h"
#include "tagfield/localization/method_settings.h"

namespace tagfield {

/// "sar": all tags, one by one. Throws Error on options out of their range.
Method sar_method(const SarOptions& options);

}  // namespace tagfield
