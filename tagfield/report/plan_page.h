// SPDX-License-Identifier: Apache-2.0
/// @file
/// The page of a plan: the hall from above with read probabilities, by number of antennas.
#pragma once

#include <string>
#include <vector>

#include "tagfield/map/top_view.h"
#include "tagfield/report/figures.h"
#include "tagfield/report/plan.h"

namespace tagfield {

/// The hall from above, one map per level of positions, at most four; then what is read over the
/// number of antennas.
std::vector<Figure> plan_figures(const AntennaPlan& plan, const std::vector<Silhouette>& top_view);

/// The page, self-contained: all figures, the tables, a slider for the number of antennas.
std::string plan_page(const AntennaPlan& plan, const std::vector<Figure>& figures);

}  // namespace tagfield
