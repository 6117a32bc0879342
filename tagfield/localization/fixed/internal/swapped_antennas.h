// SPDX-License-Identifier: Apache-2.0
/// @file
/// Detection of two stationary antennas that have been swapped: mixed-up ports or poses.
#pragma once

#include <string>
#include <vector>

#include "tagfield/localization/fixed/internal/fixed_scene.h"

namespace tagfield {

/// The two antennas whose swap makes the RSSI of the tags with these indices a hundred times
/// likelier (allowing for the number of pairs) and explains twice as much as the given order
/// (evidence of LearnedLaw); "" if there are none. Uses a few tags.
std::string swapped_antennas(const FixedScene& scene, const std::vector<std::size_t>& numbers,
                             const FixedOptions& options, int threads);

}  // namespace tagfield
