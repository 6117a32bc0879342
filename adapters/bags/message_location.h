// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which message of a recording an error is about.
#pragma once

#include <cstddef>
#include <string>

namespace tagfield {

/// Location of a message, for error messages.
struct MessageLocation {
  std::string file;
  std::string topic;
  std::size_t number = 0;  ///< Within its topic, from 1 on.
};

/// "FILE: topic /x, message 3"
std::string to_string(const MessageLocation& place);

/// Throws Error "FILE: topic /x, message 3: MESSAGE".
[[noreturn]] void fail_at(const MessageLocation& place, const std::string& message);

}  // namespace tagfield
