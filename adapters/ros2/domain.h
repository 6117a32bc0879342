// SPDX-License-Identifier: Apache-2.0
/// @file
/// ROS 2 domains.
#pragma once

#include <cstdint>
#include <string>

namespace tagfield::ros2 {

inline constexpr double kLastDomain = 232.0;

/// The domain in `text`. Throws Error that names `place` unless it is a whole number from 0 to
/// kLastDomain.
std::uint32_t domain_in(const std::string& text, const std::string& place);

/// ROS_DOMAIN_ID of the environment, as used by ROS 2; 0 if not set.
std::uint32_t domain_of_environment();

}  // namespace tagfield::ros2
