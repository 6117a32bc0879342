// SPDX-License-Identifier: Apache-2.0
/// @file
/// A parameter as it stood in a file.
#pragma once

#include <string>

#include "tagfield/base/error.h"

namespace tagfield {

/// A parameter of an antenna or a tag as it stood in the file; rooms further on give it meaning.
struct RawParameter {
  std::string key;
  std::string value;
  Location location;  ///< Unknown where the file is not.
};

}  // namespace tagfield
