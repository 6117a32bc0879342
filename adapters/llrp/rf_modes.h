// SPDX-License-Identifier: Apache-2.0
/// @file
/// The reader's tables, which a client picks from by number: RF modes, powers.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tagfield/gen2/link_timing.h"

namespace tagfield::llrp {

/// A link profile by its number in C1G2RFControl.
struct RfMode {
  std::uint16_t id = 0;
  std::optional<LinkSettings> link;  ///< None: the reader chooses, as the scenario says.
};

/// Five fixed ones, as widely used readers have, and 1000, where the reader chooses.
const std::vector<RfMode>& rf_modes();
const RfMode* find_mode(std::uint16_t id);

/// Transmit powers [dBm], rising, in steps of 0.25 dB; index i + 1 in a client's words.
std::vector<double> power_table(double most_dbm);
/// The index of the power nearest to `dbm`.
std::uint16_t power_index_of(const std::vector<double>& table, double dbm);

}  // namespace tagfield::llrp
