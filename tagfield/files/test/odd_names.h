// SPDX-License-Identifier: Apache-2.0
/// @file
/// Names that test a table's quoting, for RapidCheck.
#pragma once

#include <rapidcheck.h>

#include <string>

namespace tagfield {

/// Not empty, without NUL; many commas, quotes, spaces, line ends and non-ASCII bytes.
inline std::string odd_name() {
  const auto odd = rc::gen::elementOf(std::string(",\"\r\n \t;'ab1\xc3\xa9\xef\xbb\xbf\xff"));
  return *rc::gen::nonEmpty(rc::gen::container<std::string>(odd));
}

}  // namespace tagfield
