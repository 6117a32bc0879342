// SPDX-License-Identifier: Apache-2.0
/// @file
/// A sweep as small multiples: the same axes over and over, a panel for each value of what else
/// varies. Each method has a colour of its own throughout.
#pragma once

#include <string>
#include <vector>

#include "tagfield/experiment/sweep/sweep_results.h"
#include "tagfield/report/figures.h"

namespace tagfield {

/// Mean error, then the share of tags located.
///
/// Of a grid of up to three keys: the numeric key with most values to the right, a panel for each
/// combination of the others (and for each condition), lines between neighbours, bars of 95 % by
/// the standard error. Of other designs a panel for each key, a dot for each point.
std::vector<Figure> sweep_figures(const SweepResults& results);

}  // namespace tagfield
