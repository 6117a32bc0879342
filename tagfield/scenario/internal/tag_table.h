/// @file
/// Many tags at rest as a CSV table.
#pragma once

#include <string>
#include <vector>

#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Reads `tag,x_m,y_m,z_m`, a row a tag. Throws Error "FILE:LINE: …".
std::vector<TagSpec> read_tag_table(const std::string& path);

}  // namespace tagfield
