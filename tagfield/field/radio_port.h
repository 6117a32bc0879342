// SPDX-License-Identifier: Apache-2.0
/// @file
/// A reader's port: on which carrier it is, and what the reader reports of a reply there.
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

/// What tells an antenna from others.
struct RadioPort {
  std::uint64_t antenna_key = 0;  ///< stream_key() of its name.
  std::uint64_t reader_key = 0;   ///< Of its reader's.
  std::size_t turn = 0;           ///< Its reader's number among those that share the air.
  std::uint64_t seed = 0;
};

/// The carrier in use.
struct CarrierNow {
  std::size_t channel = 0;  ///< Index into the plan.
  double frequency_hz = 0.0;
  double phase_offset_rad = 0.0;  ///< φ0, and what the channel and the port add.
};

CarrierNow carrier_at(const RadioModel& model, const RadioPort& port, Time time);

/// What the reader reports of the tag's reply at `stamp`; `v_AT_W` is the antenna's velocity
/// against the tag's [m/s], `interference_mw` other readers' power in the reply. The noise is a
/// function of seed, antenna, tag and stamp alone.
TagReply report(const RadioModel& model, const RadioPort& port, const CarrierNow& carrier,
                const RadioLink& link, const TagEnd& tag, const Eigen::Vector3d& v_AT_W, Time stamp,
                double interference_mw = 0.0);

/// Bits of a reply that must all come through: RN16, PC, EPC and CRC.
int reply_bits(const RadioModel& model);

/// Whether the tag is read without an inventory: it is heard, makes out its reader's commands, and
/// at least half of such replies come through what other readers send.
bool is_read(const RadioModel& model, const RadioLink& link, const TagEnd& tag,
             const Disturbance& disturbance);

/// How the tag takes part in the next slots. None where it has too little power, or can't make out
/// the commands.
std::optional<TagOnAir> on_air(const RadioModel& model, const RadioLink& link, const TagEnd& tag,
                               const Disturbance& disturbance = {});

}  // namespace tagfield
