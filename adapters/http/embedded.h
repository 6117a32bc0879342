// SPDX-License-Identifier: Apache-2.0
/// @file
/// Files embedded in the program.
#pragma once

#include <string_view>

namespace tagfield::http {

/// The page, one HTML file; "" if built without Node.js' npm.
std::string_view page_file();
/// The API's description as OpenAPI 3.
std::string_view openapi_file();

}  // namespace tagfield::http
