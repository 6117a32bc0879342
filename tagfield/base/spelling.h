// SPDX-License-Identifier: Apache-2.0
/// @file
/// The known word closest to a misspelt one, for error messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tagfield {

/// Minimum number of insertions, deletions, substitutions and swaps of adjacent characters that
/// turn `a` into `b` (the optimal string alignment distance).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word of `known` closest to `word`: the first that begins with it, else the one with the
/// smallest edit distance; "" if none is close (over half of it differs).
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

/// " (did you mean 'frequency'?)", or " (known: a, b, c)" if no word is close.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace tagfield
