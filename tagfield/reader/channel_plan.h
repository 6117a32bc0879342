// SPDX-License-Identifier: Apache-2.0
/// @file
/// On which carrier a reader sends when. See docs/reader.md for the plans and their sources.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tagfield/base/time.h"

namespace tagfield {

/// The carriers that a reader may use.
struct ChannelPlan {
  std::string name;
  std::vector<double> carriers_hz;  ///< Rising.
  double dwell_s = 0.2;             ///< On each; greater than 0.
  double band_low_hz = 0.0;         ///< Edges of the band that the regulation allows,
  double band_high_hz = 0.0;        ///< both 0 where none is known.
  double most_erp_dbm = 0.0;        ///< Most radiated power over a dipole; 0 where none is known.
  double channel_hz = 200e3;        ///< Width of a channel.
};

/// "etsi_low", "etsi_high", "fcc", "china".
const std::vector<ChannelPlan>& known_plans();

/// The known plan of this name. Throws Error with the nearest name if there is none.
const ChannelPlan& known_plan(const std::string& name);

/// One carrier for good.
ChannelPlan fixed_plan(double frequency_hz);

/// Throws Error naming the parameter that is out of its range, as a carrier outside the band.
void check(const ChannelPlan& plan);

/// Which channel of the plan the reader with the stream_key() `reader_key` is on at `time`: a
/// random order, drawn once for each reader and seed, over and over. Readers with a `turn` of their
/// own each that share a plan and a key are never on the same channel at once, up to as many as
/// there are channels.
std::size_t channel_at(const ChannelPlan& plan, Time time, std::uint64_t reader_key,
                       std::uint64_t seed, std::size_t turn = 0);

}  // namespace tagfield
