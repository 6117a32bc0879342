/// @file
/// What values from outside must be.
#pragma once

#include <string>

namespace tagfield {

/// Throws Error "NAME must be finite and over 0, but is VALUE".
void require_positive(double value, const std::string& name);

}  // namespace tagfield
