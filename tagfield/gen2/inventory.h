// SPDX-License-Identifier: Apache-2.0
/// @file
/// An antenna's EPC Gen2 inventory, slot by slot in simulated time (Gen2 v2, 6.3.2.10). It knows no
/// radio channel: who has power and how strongly a tag is heard is handed in. See docs/gen2.md.
#pragma once

#include <cstdint>
#include <vector>

#include "tagfield/base/random.h"
#include "tagfield/base/time.h"
#include "tagfield/gen2/inventory_settings.h"
#include "tagfield/gen2/link_timing.h"
#include "tagfield/gen2/tag_field.h"
#include "tagfield/gen2/tag_memories.h"

namespace tagfield {

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
  /// it was to be read there; one that is new joins with the next Query. Call run_until(time)
  /// first. Throws Error if a tag is there twice, its strength is not finite or its probability is
  /// not from 0 to 1.
  void set_field(Time time, const std::vector<TagOnAir>& tags);
  /// Takes a tag that is no more out of the field and the round; TagMemories::forget() comes after.
  void forget(std::uint32_t tag);

  /// Goes on to `time` and adds the tags read to `out`, in order of time: of all slots that end by
  /// then. A slot that ends later is finished by a later call.
  void run_until(Time time, std::vector<Singulation>& out);

  [[nodiscard]] bool on() const { return on_; }
  /// No read to come is stamped earlier: one whose slot is open may be older than the last call.
  [[nodiscard]] Time next_read_after() const { return in_slot_ ? slot_.epc : Time::max(); }
  [[nodiscard]] const InventoryCounts& counts() const { return counts_; }
  /// Q of the last Query or QueryAdjust, or the next if it is due.
  [[nodiscard]] int q() const { return q_; }
  /// The flag that the last Query asked for, or the next will.
  [[nodiscard]] Flag target() const { return target_; }

 private:
  enum class Command { kQuery, kQueryAdjust, kQueryRep };
  enum class Outcome { kEmpty, kRead, kFailed, kCaptured, kCollided };
  struct Durations {
    Duration query, query_adjust, query_rep;
    Duration empty, collided, read, epc_begins;  ///< From the command's end.
    Duration power_up, round_overhead, slot_overhead, read_overhead;
  };
  struct Slot {
    Outcome outcome = Outcome::kEmpty;
    std::uint32_t tag = 0;  ///< The strongest that replies, if any does.
    Time epc;
    Time end;
  };
  static Durations durations_of(const LinkSettings& link, const InventorySettings& settings);

  void advance(Time time);
  void drop_absent();

  void begin_slot();
  void query();
  [[nodiscard]] bool participants_are_known() const;
  void gather_participants();
  void redraw();

  void drop_those_read_elsewhere();
  void judge_repliers();
  [[nodiscard]] bool is_captured(std::uint32_t strongest) const;
  [[nodiscard]] bool is_decoded(std::uint32_t tag);
  [[nodiscard]] bool is_read() const;

  void end_slot(std::vector<Singulation>& out);
  void count();
  void set_inventoried(std::uint32_t tag);
  void adapt_q();
  void choose_command();
  void end_frame();
  void interrupt_carrier();

  InventorySettings settings_;
  Durations durations_;
  TagMemories& memories_;
  std::uint64_t seed_;
  std::uint64_t key_;

  bool on_ = false;
  Time now_ = Time::min();  ///< The latest time told.
  TagField field_;
  InventoryCounts counts_;

  // The round.
  Flag target_;
  int q_;
  double qfp_;
  RandomStream stream_;
  std::vector<std::uint32_t> waiting_;   ///< Participants that have a slot before them.
  std::vector<std::uint32_t> spent_;     ///< Those that replied in vain and wait for a QueryAdjust.
  std::vector<std::uint32_t> repliers_;  ///< In the slot in progress.
  std::int64_t slots_left_ = 0;          ///< Of the frame.
  bool frame_quiet_ = true;              ///< Nobody replied in it.
  bool in_slot_ = false;
  Slot slot_;
  Time next_;  ///< When the next command begins, unless a slot is in progress.
  Command command_ = Command::kQuery;

  // Whether the last round's participants are still all there are.
  bool participants_known_ = false;
  std::uint64_t known_version_ = 0;
  Flag known_target_ = Flag::kA;
  Time known_until_;
};

}  // namespace tagfield
