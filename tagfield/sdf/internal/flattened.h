/// @file
/// Worlds as Gazebo saves them, with models in models made flat: links called "inner::link".
#pragma once

#include <string>

namespace tagfield::sdf_internal {

/// The XML text with what sdformat 12 gives up on in such worlds taken out or renamed: joints,
/// which are not used here; attributes of poses that name no frame; and "::" in names, which
/// becomes "__". Everything keeps its line.
std::string without_flattened_names(const std::string& text);

}  // namespace tagfield::sdf_internal
