// SPDX-License-Identifier: Apache-2.0
/// @file
/// Text as JSON has it.
#pragma once

#include <string>
#include <string_view>

namespace tagfield {

/// `text` in quotes at the end of `json`. What is no UTF-8 becomes U+FFFD, so that the whole is
/// JSON whatever the text.
void append_quoted(std::string_view text, std::string& json);

/// The same by itself.
std::string json_string(std::string_view text);

}  // namespace tagfield
