// SPDX-License-Identifier: Apache-2.0
/// @file
/// The message of an Error, for tests.
#pragma once

#include <string>
#include <string_view>

#include "tagfield/base/error.h"

namespace tagfield {

/// The message of the Error that `body` throws; "(no error)" if it throws none.
template <class Body>
std::string error_of(const Body& body) {
  try {
    body();
  } catch (const Error& error) {
    return error.what();
  }
  return "(no error)";
}

inline bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

}  // namespace tagfield
