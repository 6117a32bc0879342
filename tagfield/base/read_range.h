// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which numbers can be an RSSI or a carrier at all.
#pragma once

#include <cmath>

namespace tagfield {

/// Beyond ±this [dBm] a number is no received power: readers report −120 to 30 dBm, and those in
/// hundredths of a dBm are off by thousands.
inline constexpr double kMaxRssiDbm = 300.0;

/// False also for NaN.
inline bool is_rssi(double rssi_dbm) { return std::abs(rssi_dbm) <= kMaxRssiDbm; }

/// Carriers from 1 MHz to 100 GHz [Hz]: one given in MHz or kHz is below.
inline constexpr double kMinCarrierHz = 1e6;
inline constexpr double kMaxCarrierHz = 1e11;

/// False also for NaN.
inline bool is_carrier(double frequency_hz) {
  return frequency_hz >= kMinCarrierHz && frequency_hz <= kMaxCarrierHz;
}

}  // namespace tagfield
