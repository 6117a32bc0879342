// SPDX-License-Identifier: Apache-2.0
/// @file
/// Helpers for tests of texts.
#pragma once

#include <string>

namespace tagfield {

inline bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace tagfield
