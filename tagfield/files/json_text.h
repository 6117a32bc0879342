// SPDX-License-Identifier: Apache-2.0
/// @file
/// Text as JSON strings.
#pragma once

#include <string>
#include <string_view>

namespace tagfield {

/// Appends `text` in quotes to `json`. Invalid UTF-8 becomes U+FFFD, so that the result is valid
/// JSON for any text.
void append_quoted(std::string_view text, std::string& json);

/// Same, as a new string.
std::string json_string(std::string_view text);

}  // namespace tagfield
