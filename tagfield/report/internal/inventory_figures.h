// SPDX-License-Identifier: Apache-2.0
/// @file
/// The figures of an inventory.
#pragma once

#include "tagfield/report/figures.h"

namespace tagfield {

/// Share of the tags that had been read by each time.
Figure inventory_curve_figure(const RunFiles& run);

/// Number of tags that each antenna read, and that it alone read, grouped by reader.
Figure inventory_antennas_figure(const RunFiles& run);

}  // namespace tagfield
