// SPDX-License-Identifier: Apache-2.0
/// @file
/// A reader's port: its carrier at a given time, and how the reader reports a reply received there.
#pragma once

#include <cstdint>
#include <optional>

#include "tagfield/base/time.h"
#include "tagfield/field/radio_link.h"
#include "tagfield/field/reader_interference.h"
#include "tagfield/field/tag_population.h"
#include "tagfield/gen2/inventory.h"
#include "tagfield/reader/antenna.h"

namespace tagfield {

/// Identification of an antenna.
struct RadioPort {
  std::uint64_t antenna_key = 0;  ///< stream_key() of its name.
  std::uint64_t reader_key = 0;   ///< stream_key() of its reader's name.
  std::size_t turn = 0;           ///< Index of its reader among those that share the air.
  std::uint64_t seed = 0;
};

/// The carrier in use.
struct CarrierNow {
  std::size_t channel = 0;  ///< Index into the plan.
  double frequency_hz = 0.0;
  double phase_offset_rad = 0.0;  ///< φ0, plus the offsets of channel and port.
};

CarrierNow carrier_at(const RadioModel& model, const RadioPort& port, Time time);

/// The reader's report of the tag's reply at `stamp`; `v_AT_W` is the antenna's velocity relative
/// to the tag [m/s], `interference_mw` the other readers' power in the reply's band. The noise is a
/// function of seed, antenna, tag and stamp alone.
TagReply report(const RadioModel& model, const RadioPort& port, const CarrierNow& carrier,
                const RadioLink& link, const TagEnd& tag, const Eigen::Vector3d& v_AT_W, Time stamp,
                double interference_mw = 0.0);

/// Number of bits of a reply that must all be decoded: RN16, PC, EPC and CRC.
int reply_bits(const RadioModel& model);

/// Whether the tag is read without an inventory: its reply is strong enough, it decodes its
/// reader's commands, and at least half of such replies are decoded despite other readers' signals.
bool is_read(const RadioModel& model, const RadioLink& link, const TagEnd& tag,
             const Disturbance& disturbance);

/// The tag's parameters in the next slots. Nullopt if it has too little power, or can't decode the
/// commands.
std::optional<TagOnAir> on_air(const RadioModel& model, const RadioLink& link, const TagEnd& tag,
                               const Disturbance& disturbance = {});

}  // namespace tagfield
