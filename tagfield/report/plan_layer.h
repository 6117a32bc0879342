// SPDX-License-Identifier: Apache-2.0
/// @file
/// A plan that lies in a folder, for a page that draws the world.
#pragma once

#include <string>

namespace tagfield {

/// Whether that is a plan's folder: one with plan.json and plan_places.csv.
bool is_plan_folder(const std::string& folder);

/// The plan in `folder` as JSON text: what is counted, the layouts with their antennas [m, world],
/// the places of tags and, by layout and place, in how many of a hundred cases a tag there has what
/// is aimed at, with the bands of colour for that. Throws Error "FILE: …" where the files are not
/// whole or don't belong together.
std::string plan_layer_to_json(const std::string& folder);

}  // namespace tagfield
