// SPDX-License-Identifier: Apache-2.0
/// @file
/// Names by pattern, as shells have it.
#pragma once

#include <string_view>

namespace tagfield {

/// Whether `pattern` has a '*' or '?'.
bool is_pattern(std::string_view pattern);

/// Whether the whole of `name` is as `pattern` says: '*' stands for any characters or none, '?' for
/// one, all others for themselves.
bool matches(std::string_view pattern, std::string_view name);

}  // namespace tagfield
