// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a reader of a live world tells a client that it is and can do.
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
  std::vector<bool> is_empty;  ///< Of each port: its antenna was taken away, and counts as faulty.

  /// 1 or more; 0 where it is none of the reader's.
  [[nodiscard]] std::uint16_t id_of(const std::string& antenna) const;
};
/// As the world is now, `before` being what its ports were.
Ports ports_of(const LiveWorld& world, const std::string& reader, const Ports& before);

/// What its antennas can send: of the paper's model 30 dBm alone.
std::vector<double> powers_of(const Ports& ports);
/// Its channels in rising order [Hz], index 1 first; and whether it hops over them.
std::vector<double> channels_of(const Ports& ports);
bool hops(const Ports& ports);

/// GET_READER_CAPABILITIES' `requested` (§14.1.1): 0 all, 1 device, 2 LLRP, 3 regulation, 4 Gen2.
void write_capabilities(const Ports& ports, std::uint8_t requested, ByteWriter& writer);

}  // namespace tagfield::llrp
