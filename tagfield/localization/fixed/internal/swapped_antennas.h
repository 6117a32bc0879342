// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether two antennas at rest must have been exchanged: ports mixed up, or poses.
#pragma once

#include <string>
#include <vector>

#include "tagfield/localization/fixed/internal/fixed_scene.h"

namespace tagfield {

/// Which two antennas' exchange makes the strengths of the tags with these numbers a hundred times
/// likelier, the number of pairs allowed for, and explains twice as much as their order as told
/// (evidence of LearnedLaw); "" where none does. By a few tags.
std::string swapped_antennas(const FixedScene& scene, const std::vector<std::size_t>& numbers,
                             const FixedOptions& options, int threads);

}  // namespace tagfield
