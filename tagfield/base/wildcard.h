// SPDX-License-Identifier: Apache-2.0
/// @file
/// Matching of names against patterns, as in shells.
#pragma once

#include <string_view>

namespace tagfield {

/// Whether `pattern` has a '*' or '?'.
bool is_pattern(std::string_view pattern);

/// Whether all of `name` matches `pattern`: '*' stands for any number of characters, '?' for one,
/// any other character for itself.
bool matches(std::string_view pattern, std::string_view name);

}  // namespace tagfield
