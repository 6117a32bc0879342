// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/discovery.h"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "tagfield/base/error.h"

namespace tagfield::ros2 {
namespace {

/// Maximum number of programs on one machine that can find one another without multicast. Each has
/// a port in each domain.
constexpr int kLastParticipant = 60;

std::string environment(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr ? "" : text;
}

DiscoveryRange range_of(const std::string& text) {
  if (text.empty() || text == "SUBNET") return DiscoveryRange::kSubnet;
  if (text == "LOCALHOST") return DiscoveryRange::kLocalhost;
  if (text == "SYSTEM_DEFAULT") return DiscoveryRange::kSystemDefault;
  if (text == "OFF") {
    throw Error(
        "ROS_AUTOMATIC_DISCOVERY_RANGE is OFF: no node would find this one; expected "
        "SUBNET, LOCALHOST or SYSTEM_DEFAULT");
  }
  throw Error(
      fmt::format("ROS_AUTOMATIC_DISCOVERY_RANGE is '{}', expected SUBNET, LOCALHOST or "
                  "SYSTEM_DEFAULT",
                  text));
}

/// Whether an address in numbers is one; other words may be names of machines.
bool is_possible(const std::string& peer) {
  const bool is_six = std::count(peer.begin(), peer.end(), ':') > 1;
  if (is_six || peer.front() == '[') {
    const std::size_t begin = peer.front() == '[' ? 1 : 0;
    const std::string six = peer.substr(begin, peer.find_first_of("]%", begin) - begin);
    in6_addr address{};
    return inet_pton(AF_INET6, six.c_str(), &address) == 1;
  }
  const std::string host = peer.substr(0, peer.find(':'));
  if (host.find_first_not_of("0123456789.") != std::string::npos) return true;
  in_addr address{};
  return inet_pton(AF_INET, host.c_str(), &address) == 1;
}

/// "a;b" → a, b
std::vector<std::string> peers_of(const std::string& text) {
  constexpr const char* kAllowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.:-_[]%";
  std::vector<std::string> peers;
  std::istringstream list(text);
  for (std::string peer; std::getline(list, peer, ';');) {
    if (peer.empty() || peer.find_first_not_of(kAllowed) != std::string::npos ||
        !is_possible(peer)) {
      throw Error(
          fmt::format("ROS_STATIC_PEERS has '{}', expected addresses of machines separated "
                      "by ';'",
                      peer));
    }
    peers.push_back(peer);
  }
  return peers;
}

}  // namespace

Discovery discovery_of_environment() {
  const std::string local_only = environment("ROS_LOCALHOST_ONLY");
  if (local_only == "1") return {DiscoveryRange::kLocalhost, {}};
  if (!local_only.empty() && local_only != "0") {
    throw Error(fmt::format("ROS_LOCALHOST_ONLY is '{}', expected 0 or 1", local_only));
  }
  Discovery discovery{range_of(environment("ROS_AUTOMATIC_DISCOVERY_RANGE")), {}};
  if (discovery.range != DiscoveryRange::kSystemDefault) {
    discovery.peers = peers_of(environment("ROS_STATIC_PEERS"));
  }
  return discovery;
}

std::string cyclone_settings(const Discovery& discovery) {
  if (discovery.range == DiscoveryRange::kSystemDefault) return "";
  const bool local = discovery.range == DiscoveryRange::kLocalhost;
  std::string peers = local ? "<Peer address=\"localhost\"/>" : "";
  for (const std::string& peer : discovery.peers) {
    peers += fmt::format("<Peer address=\"{}\"/>", peer);
  }
  // With an index a program has well-known ports, where programs without multicast look for it.
  return fmt::format(
      "<CycloneDDS><Domain>{}<Discovery><ParticipantIndex>auto</ParticipantIndex>"
      "<MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex><Peers>{}</Peers></Discovery></Domain>"
      "</CycloneDDS>",
      local ? "<General><AllowMulticast>false</AllowMulticast></General>" : "", kLastParticipant,
      peers);
}

}  // namespace tagfield::ros2
