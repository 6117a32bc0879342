// SPDX-License-Identifier: Apache-2.0
/// @file
/// Two runs beside each other, on a page.
#pragma once

#include <string>
#include <vector>

#include "tagfield/map/top_view.h"
#include "tagfield/report/comparison.h"
#include "tagfield/report/figures.h"

namespace tagfield {

/// What came of it in a sentence or two, plain text.
std::string comparison_sentence(const RunComparison& comparison);

/// Each tag's error in both runs; where its estimates lie, over `geometry` from above.
std::vector<Figure> comparison_figures(const RunComparison& comparison,
                                       const std::vector<Silhouette>& geometry);

std::string comparison_page(const RunComparison& comparison, const std::vector<Figure>& figures);

}  // namespace tagfield
