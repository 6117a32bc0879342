// SPDX-License-Identifier: Apache-2.0
/// @file
/// The nearest known word to a misspelt one, for error messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tagfield {

/// Fewest insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`
/// (the optimal string alignment distance).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word of `known` nearest to `word`: the first that begins with it, or else the one of least
/// edit distance; "" where none is near (over half of it differs).
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

/// " (did you mean 'frequency'?)", or " (known: a, b, c)" where no word is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace tagfield
