// SPDX-License-Identifier: Apache-2.0
/// @file
/// Files that the build puts into the program.
#pragma once

#include <string_view>

namespace tagfield::http {

/// The page, one HTML file; "" where it was built without Node.js' npm.
std::string_view page_file();
/// What the API is, as OpenAPI 3.
std::string_view openapi_file();

}  // namespace tagfield::http
