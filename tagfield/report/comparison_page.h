// SPDX-License-Identifier: Apache-2.0
/// @file
/// The page that compares two runs.
#pragma once

#include <string>
#include <vector>

#include "tagfield/map/top_view.h"
#include "tagfield/report/comparison.h"
#include "tagfield/report/figures.h"

namespace tagfield {

/// The result in a sentence or two, plain text.
std::string comparison_sentence(const RunComparison& comparison);

/// Each tag's error in both runs; and its estimates over `geometry` from above.
std::vector<Figure> comparison_figures(const RunComparison& comparison,
                                       const std::vector<Silhouette>& geometry);

std::string comparison_page(const RunComparison& comparison, const std::vector<Figure>& figures);

}  // namespace tagfield
