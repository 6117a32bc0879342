// SPDX-License-Identifier: Apache-2.0
/// @file
/// The warnings on a page.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tagfield {

/// More warnings than this are folded under their count.
inline constexpr std::size_t kMaxOpenWarnings = 2;

/// The warnings as HTML, headed by their number; "" for none. Equal ones, and ones that differ only
/// in where they begin, are merged. `file` beside the page has those that are left out; "" if none
/// has.
std::string warnings_note(const std::vector<std::string>& warnings, const std::string& file = "");

}  // namespace tagfield
