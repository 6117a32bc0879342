// SPDX-License-Identifier: Apache-2.0
/// @file
/// A plan as a page: the hall from above with what is read, by number of antennas.
#pragma once

#include <string>
#include <vector>

#include "tagfield/map/top_view.h"
#include "tagfield/report/figures.h"
#include "tagfield/report/plan.h"

namespace tagfield {

/// The hall from above, one map a level of the places, four at most; then what each number of
/// antennas reads, and what it costs.
std::vector<Figure> plan_figures(const AntennaPlan& plan, const std::vector<Silhouette>& top_view);

/// Self-contained: all figures, the tables, a slider over the number of antennas.
std::string plan_page(const AntennaPlan& plan, const std::vector<Figure>& figures);

}  // namespace tagfield
