// SPDX-License-Identifier: Apache-2.0
/// @file
/// The figures of an inventory.
#pragma once

#include "tagfield/report/figures.h"

namespace tagfield {

/// Share of the tags that were read by each moment.
Figure inventory_curve_figure(const RunFiles& run);

/// Tags that each antenna read, and those that no other did, grouped by reader.
Figure inventory_antennas_figure(const RunFiles& run);

}  // namespace tagfield
