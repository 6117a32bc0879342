// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reader tables from which clients select by index: RF modes, powers.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tagfield/gen2/link_timing.h"

namespace tagfield::llrp {

/// A link profile with its number in C1G2RFControl.
struct RfMode {
  std::uint16_t id = 0;
  std::optional<LinkSettings> link;  ///< None: as chosen by the reader, that is by the scenario.
};

/// Five fixed modes, as in widely used readers, and 1000, in which the reader chooses.
const std::vector<RfMode>& rf_modes();
const RfMode* find_mode(std::uint16_t id);

/// Transmit powers [dBm], ascending in steps of 0.25 dB; entry i has index i + 1 in LLRP.
std::vector<double> power_table(double max_dbm);
/// The index of the power nearest to `dbm`.
std::uint16_t power_index_of(const std::vector<double>& table, double dbm);

}  // namespace tagfield::llrp
