// SPDX-License-Identifier: Apache-2.0
/// @file
/// Messages of a bag from their bytes, which may be anything: no count is believed before that many
/// elements can stand in what is left.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tagfield {

/// Where a message stands, for complaints.
struct MessagePlace {
  std::string file;
  std::string topic;
  std::size_t number = 0;  ///< Within its topic, from 1 on.
};

/// "FILE: topic /x, message 3"
std::string to_string(const MessagePlace& place);

/// Throws Error "FILE: topic /x, message 3: MESSAGE".
[[noreturn]] void fail_at(const MessagePlace& place, const std::string& message);

/// The message of type M that all of `bytes` is: tagfield_msgs' TagReads, AntennaTruth and
/// TagPositions, rfid_sensor's TagArray, nav_msgs' Odometry, tf2_msgs' TFMessage. Throws Error
/// where they are too few or too many.
template <typename M>
M decode(std::vector<std::uint8_t>& bytes, const MessagePlace& place);

}  // namespace tagfield
