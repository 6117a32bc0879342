// SPDX-License-Identifier: Apache-2.0
/// @file
/// Names that are too long for a figure.
#pragma once

#include <string>
#include <vector>

#include "tagfield/report/svg.h"

namespace tagfield {

/// Each name, cleaned, of at most `most` ≥ 12 characters, as by shortened(). Different names stay
/// different: of those that would look alike, what they have in common at their beginning is left
/// out; the rest get their number, from 1.
std::vector<std::string> distinct_names(const std::vector<std::string>& names, std::size_t most);

/// Draws a shortened name; the whole one is its tooltip.
void add_short_name(Svg& svg, const Place& place, const std::string& shown,
                    const std::string& whole, Anchor anchor);

}  // namespace tagfield
