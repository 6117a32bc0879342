// SPDX-License-Identifier: Apache-2.0
/// @file
/// Detection of elements that SDF doesn't have, such as misspelt ones, which would otherwise go
/// unnoticed.
#pragma once

#include <tinyxml2.h>

#include "tagfield/base/error.h"

namespace tagfield::sdf_internal {

/// Warns of children of a <world>, <model>, <link> or <collision> that SDF (1.2 to 1.12) doesn't
/// have there. Names with a colon belong to other software.
void warn_of_unknown_children(const tinyxml2::XMLElement& element, Diagnostics& diagnostics);

}  // namespace tagfield::sdf_internal
