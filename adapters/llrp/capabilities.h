// SPDX-License-Identifier: Apache-2.0
/// @file
/// Capabilities that a reader of a live world reports to a client.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "adapters/llrp/specs.h"
#include "tagfield/live/live_world.h"

namespace tagfield::llrp {

/// A reader's ports: antenna ID i is `antennas[i - 1]`.
struct Ports {
  std::vector<LiveAntenna> antennas;
  std::vector<bool> is_empty;  ///< Per port: its antenna was removed, which counts as a fault.

  /// 1 or more; 0 if it is not one of the reader's.
  [[nodiscard]] std::uint16_t id_of(const std::string& antenna) const;
};
/// The ports in the current world, given the previous ones in `before`.
Ports ports_of(const LiveWorld& world, const std::string& reader, const Ports& before);

/// Transmit powers that its antennas can be set to; with the paper's model 30 dBm only.
std::vector<double> powers_of(const Ports& ports);
/// Its channels in ascending order [Hz], index 1 first; and whether it hops between them.
std::vector<double> channels_of(const Ports& ports);
bool hops(const Ports& ports);

/// Writes the response to GET_READER_CAPABILITIES; `requested` (§14.1.1): 0 all, 1 device, 2 LLRP,
/// 3 regulation, 4 Gen2.
void write_capabilities(const Ports& ports, std::uint8_t requested, ByteWriter& writer);

}  // namespace tagfield::llrp
