// SPDX-License-Identifier: Apache-2.0
/// @file
/// Discovery of ROS 2 nodes, as configured by the environment.
#pragma once

#include <string>
#include <vector>

namespace tagfield::ros2 {

/// Where to look for other nodes, as in ROS 2 from Iron on.
enum class DiscoveryRange {
  kSubnet,        ///< On all machines reachable by multicast.
  kLocalhost,     ///< On this machine only.
  kSystemDefault  ///< As in the middleware's own settings.
};

struct Discovery {
  DiscoveryRange range = DiscoveryRange::kSubnet;
  std::vector<std::string> peers;  ///< Addresses of machines that are also contacted by unicast.
};

/// Settings from ROS_AUTOMATIC_DISCOVERY_RANGE and ROS_STATIC_PEERS; ROS_LOCALHOST_ONLY, used up to
/// Humble, overrides both. Throws Error for values unknown to ROS 2, and for the range OFF, with
/// which nobody would receive anything.
Discovery discovery_of_environment();

/// Corresponding settings of Cyclone DDS (XML), "" for its defaults.
std::string cyclone_settings(const Discovery& discovery);

}  // namespace tagfield::ros2
