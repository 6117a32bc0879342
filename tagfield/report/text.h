// SPDX-License-Identifier: Apache-2.0
/// @file
/// Text for page and figures: sanitized, shortened, sorted and formatted for human readers.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tagfield {

/// `text` as well-formed UTF-8 without control characters: invalid parts become U+FFFD, tabs and
/// line breaks become spaces.
std::string clean_text(std::string_view text);

/// `text`, cleaned, with & < > " ' written as entities: safe as content and as a quoted attribute
/// of both HTML and XML.
std::string escaped(std::string_view text);

/// Same, but for a name in a heading: lines may break after "_", "-", "/" and ".".
std::string breakable(std::string_view text);

/// `text`, cleaned, of at most `most` ≥ 3 characters: the middle of a longer one becomes "…".
std::string shortened(std::string_view text, std::size_t most);

/// Number of characters (code points) in well-formed UTF-8.
std::size_t length_of(std::string_view text);

/// Natural order of names: tag2 before tag10.
bool natural_less(std::string_view a, std::string_view b);

/// "3.2 mm", "15 mm", "1.23 m" for a length ≥ 0 [m].
std::string spoken_length(double length_m);

/// "7,012".
std::string grouped(std::size_t number);

/// A count, or a mean of counts ≥ 0: "7,012", "60.6".
std::string tally(double number);

/// `part` of `all`, both ≥ 0: "89.1 %"; never 100 % if any is missing, nor 0 % if there is any; "–"
/// of none.
std::string percent_of(double part, double all);

/// "1 tag", "2 tags".
std::string counted(std::size_t number, const std::string& noun);

}  // namespace tagfield
