// SPDX-License-Identifier: Apache-2.0
/// @file
/// Coverage as one HTML page.
#pragma once

#include <string>
#include <vector>

#include "tagfield/map/top_view.h"
#include "tagfield/report/coverage.h"
#include "tagfield/report/figures.h"

namespace tagfield {

/// All maps: for each height read probability, margin, power and, with several antennas, the best
/// one; the scenario's tags last. No maps of the grid if it is empty.
std::vector<Figure> coverage_figures(const Coverage& coverage,
                                     const std::vector<Silhouette>& top_view);

/// The page, self-contained like report.html.
std::string coverage_page(const Coverage& coverage, const std::vector<Figure>& figures);

}  // namespace tagfield
