// SPDX-License-Identifier: Apache-2.0
/// @file
/// Coverage as maps.
#pragma once

#include <string>
#include <vector>

#include "tagfield/map/top_view.h"
#include "tagfield/report/coverage.h"
#include "tagfield/report/figures.h"

namespace tagfield {

enum class CoverageQuantity { kProbability, kMargin, kPower, kAntenna };

/// One quantity of a layer over the world from above, with the antennas.
Figure coverage_figure(const Coverage& coverage, const CoverageLayer& layer,
                       CoverageQuantity quantity, const std::vector<Silhouette>& top_view);

/// "read by gate, shelf; meant for gate alone".
std::string spoken(const Coverage& coverage, const TagCoverage& tag);

/// The scenario's own tags from above, by verdict.
Figure coverage_tags_figure(const Coverage& coverage, const std::vector<Silhouette>& top_view);

}  // namespace tagfield
