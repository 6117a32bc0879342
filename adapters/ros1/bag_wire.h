// SPDX-License-Identifier: Apache-2.0
/// @file
/// Decoding of a bag's messages from untrusted bytes: a count is accepted only if that many
/// elements fit in the remaining bytes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

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

/// Decodes all of `bytes` as a message of type M: tagfield_msgs' TagReads, AntennaTruth and
/// TagPositions, rfid_sensor's TagArray, nav_msgs' Odometry, tf2_msgs' TFMessage. Throws Error if
/// there are too few or too many bytes.
template <typename M>
M decode(std::vector<std::uint8_t>& bytes, const MessageLocation& place);

}  // namespace tagfield
