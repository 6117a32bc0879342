// SPDX-License-Identifier: Apache-2.0
/// @file
/// Decoding of a bag's messages from untrusted bytes: a count is accepted only if that many
/// elements fit in the remaining bytes.
#pragma once

#include <cstdint>
#include <vector>

#include "adapters/bags/message_location.h"

namespace tagfield {

/// Decodes all of `bytes` as a message of type M: tagfield_msgs' TagReads, AntennaTruth and
/// TagPositions, rfid_sensor's TagArray, nav_msgs' Odometry, tf2_msgs' TFMessage. Throws Error if
/// there are too few or too many bytes.
template <typename M>
M decode(std::vector<std::uint8_t>& bytes, const MessageLocation& place);

}  // namespace tagfield
