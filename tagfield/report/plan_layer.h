// SPDX-License-Identifier: Apache-2.0
/// @file
/// A plan from a folder, for a page that draws the world.
#pragma once

#include <string>

namespace tagfield {

/// Whether `folder` is that of a plan: one with plan.json and plan_positions.csv.
bool is_plan_folder(const std::string& folder);

/// The plan in `folder` as JSON text: what is counted, the layouts with their antennas [m, world],
/// the positions of tags and, by layout and position, the percentage of cases in which a tag there
/// attains the aim, with the colour bands for that. Throws Error "FILE: …" if the files are
/// incomplete or inconsistent.
std::string plan_layer_to_json(const std::string& folder);

}  // namespace tagfield
