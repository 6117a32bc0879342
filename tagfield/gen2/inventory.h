/// @file
/// An antenna's EPC Gen2 inventory, slot by slot in simulated time (Gen2 v2, 6.3.2.10). It knows no
/// radio channel: who has power and how strongly a tag is heard is handed in.
#pragma once

#include <cstdint>
#include <vector>

#include "tagfield/base/random.h"
#include "tagfield/base/time.h"
#include "tagfield/gen2/inventory_settings.h"
#include "tagfield/gen2/link_timing.h"
#include "tagfield/gen2/tag_memories.h"

namespace tagfield {

/// A tag that has power.
struct TagOnAir {
  std::uint32_t tag = 0;            ///< Its slot in the population.
  double reply_dbm = 0.0;           ///< Strength of its reply at the reader [dBm].
  double decode_probability = 1.0;  ///< That its RN16 and EPC are made out when it replies alone.
};

/// A tag was read.
struct Singulation {
  std::uint32_t tag = 0;
  Time stamp;  ///< When the reply with the EPC began on the air.
};

/// What slots came to; all but `rounds` count slots.
struct InventoryCounts {
  std::int64_t rounds = 0;    ///< Queries sent.
  std::int64_t empty = 0;     ///< Nobody replied.
  std::int64_t read = 0;      ///< One tag replied and was read.
  std::int64_t failed = 0;    ///< One tag replied and was not made out.
  std::int64_t captured = 0;  ///< Several replied and the strongest was read.
  std::int64_t collided = 0;  ///< Several replied and none was read.
};

/// The inventory at one antenna. It is off until start(). Times told must not go back; Error is
/// thrown otherwise. The result is a function of what is handed in and when, and not of how
/// run_until()'s calls divide the time.
class Inventory {
 public:
  /// `key` tells this antenna's draws from those of others with the same seed. `memories` must
  /// outlive this. Throws Error as the settings' check() does.
  Inventory(const LinkSettings& link, const InventorySettings& settings, TagMemories& memories,
            std::uint64_t seed, std::uint64_t key);

  /// Carrier on: the field's tags have power from `time` on, and the first Query follows. Q and
  /// target go on from where they were. Nothing if it is on already.
  void start(Time time);
  /// Carrier off: the round is over and a slot in progress comes to nothing. The field's tags lose
  /// the power that they have from here. Nothing if it is off already.
  void stop(Time time);

  /// The tags that this antenna powers from `time` on (while the carrier is on) are these and no
  /// others. One that is no longer among them leaves the round, and the slot in progress fails if
  /// it is its; one that is new joins with the next Query. Call run_until(time) first. Throws Error
  /// if a tag is there twice, its strength is not finite or its probability not from 0 to 1.
  void set_field(Time time, const std::vector<TagOnAir>& tags);
  /// Takes a tag that is no more out of the field and the round; TagMemories::forget() comes after.
  void forget(std::uint32_t tag);

  /// Goes on to `time` and adds the tags read to `out`, in order of time: of all slots that end by
  /// then. A slot that ends later is finished by a later call.
  void run_until(Time time, std::vector<Singulation>& out);

  [[nodiscard]] bool on() const { return on_; }
  [[nodiscard]] const InventoryCounts& counts() const { return counts_; }
  /// Q of the last Query or QueryAdjust.
  [[nodiscard]] int q() const { return q_; }
  /// The flag that the last Query asked for.
  [[nodiscard]] Flag target() const { return target_; }

 private:
};

}  // namespace tagfield
