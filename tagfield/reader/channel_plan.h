// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which carrier a reader uses at which time. See docs/reader.md for the plans and their sources.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/time.h"

namespace tagfield {

/// The carriers that a reader may use.
struct ChannelPlan {
  std::string name;
  std::vector<double> carriers_hz;  ///< In ascending order.
  double dwell_s = 0.2;             ///< Dwell time on each; greater than 0.
  double band_low_hz = 0.0;         ///< Edges of the band allowed by the regulation,
  double band_high_hz = 0.0;        ///< both 0 if unknown.
  double max_erp_dbm = 0.0;         ///< Maximum radiated power relative to a dipole; 0 if unknown.
  double channel_hz = 200e3;        ///< Width of a channel.
};

/// "etsi_low", "etsi_high", "fcc", "china".
const std::vector<ChannelPlan>& known_plans();

/// The known plan of this name. Throws Error with the nearest name if there is none.
const ChannelPlan& known_plan(const std::string& name);

/// A single carrier that never changes.
ChannelPlan fixed_plan(double frequency_hz);

/// Maximum power into the antenna, after the cable [dBm]; none if the plan's regulation limits only
/// what is radiated. For "fcc" 1 W with at least 50 carriers, 0.25 W with fewer: 47 CFR 15.247
/// (b)(2).
std::optional<double> max_conducted_dbm(const ChannelPlan& plan);

/// Throws Error naming the parameter that is out of range, such as a carrier outside the band.
void check(const ChannelPlan& plan);

/// The plan's channel that the reader with the stream_key() `reader_key` uses at `time`: a random
/// order, drawn once for each reader and seed, repeated forever. Readers that share a plan and a
/// key but have different `turn`s below the number of channels are never on the same channel
/// simultaneously.
std::size_t channel_at(const ChannelPlan& plan, Time time, std::uint64_t reader_key,
                       std::uint64_t seed, std::size_t turn = 0);

}  // namespace tagfield
