// SPDX-License-Identifier: Apache-2.0
/// @file
/// Text for page and figures: made harmless, shortened, sorted and set as a person reads it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tagfield {

/// Well-formed UTF-8 without control characters: what is not becomes U+FFFD, tabs and line ends
/// become spaces.
std::string clean_text(std::string_view text);

/// `text`, cleaned, with & < > " ' written as entities: safe as content and as a quoted attribute
/// of both HTML and XML.
std::string escaped(std::string_view text);

/// The same for a name in a heading: lines may break after "_", "-", "/" and ".".
std::string breakable(std::string_view text);

/// `text`, cleaned, of at most `most` ≥ 3 characters: the middle of a longer one becomes "…".
std::string shortened(std::string_view text, std::size_t most);

/// Number of characters (code points) in well-formed UTF-8.
std::size_t length_of(std::string_view text);

/// Order of names as a person counts them: tag2 before tag10.
bool natural_less(std::string_view a, std::string_view b);

/// "3.2 mm", "15 mm", "1.23 m" of a length ≥ 0 [m].
std::string spoken_length(double length_m);

/// "7,012".
std::string grouped(std::size_t number);

/// "1 tag", "2 tags".
std::string counted(std::size_t number, const std::string& noun);

}  // namespace tagfield
