// SPDX-License-Identifier: Apache-2.0
/// @file
/// How nodes of ROS 2 find one another, as the environment says.
#pragma once

#include <string>
#include <vector>

namespace tagfield::ros2 {

/// Where other nodes are looked for, as ROS 2 has it from Iron on.
enum class DiscoveryRange {
  kSubnet,        ///< On all machines that multicast reaches.
  kLocalhost,     ///< On this machine alone.
  kSystemDefault  ///< As the middleware's own settings say.
};

struct Discovery {
  DiscoveryRange range = DiscoveryRange::kSubnet;
  std::vector<std::string> peers;  ///< Addresses of machines that are asked one by one, too.
};

/// ROS_AUTOMATIC_DISCOVERY_RANGE and ROS_STATIC_PEERS; before both goes ROS_LOCALHOST_ONLY, as up
/// to Humble. Throws Error for values that ROS 2 does not know, and for the range OFF, with which
/// nobody would hear anything.
Discovery discovery_of_environment();

/// Cyclone DDS's settings for it (XML), "" where it is left to its own.
std::string cyclone_settings(const Discovery& discovery);

}  // namespace tagfield::ros2
