// SPDX-License-Identifier: Apache-2.0
/// @file
/// An antenna's EPC Gen2 inventory, simulated slot by slot (Gen2 v2, 6.3.2.10). It knows nothing
/// about the radio channel: which tags have power and how strong their replies are is its input.
/// See docs/gen2.md.
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

/// One read of a tag.
struct Singulation {
  std::uint32_t tag = 0;
  Time stamp;  ///< Start of the reply with the EPC.
};

/// Outcomes of slots; all counts except `rounds` count slots.
struct InventoryCounts {
  std::int64_t rounds = 0;    ///< Queries sent.
  std::int64_t empty = 0;     ///< No tag replied.
  std::int64_t read = 0;      ///< One tag replied and was read.
  std::int64_t failed = 0;    ///< One tag replied and was not decoded.
  std::int64_t captured = 0;  ///< Several tags replied and the strongest was read.
  std::int64_t collided = 0;  ///< Several tags replied and none was read.
};

/// The inventory at one antenna. It is off until start(). Times passed must not decrease; otherwise
/// Error is thrown. The result depends only on the input and its times, not on how run_until()'s
/// calls divide the time.
class Inventory {
 public:
  /// `key` distinguishes this antenna's draws from those of others with the same seed. `memories`
  /// must outlive this. Throws Error as the settings' check() does.
  Inventory(const LinkSettings& link, const InventorySettings& settings, TagMemories& memories,
            std::uint64_t seed, std::uint64_t key);

  /// Carrier on: the field's tags have power from `time` on, and the first Query follows. Q and
  /// target continue with their last values. No effect if already on.
  void start(Time time);
  /// Carrier off: the round ends and a slot in progress is lost. The field's tags lose the power of
  /// this antenna. No effect if already off.
  void stop(Time time);

  /// Sets the tags that this antenna powers from `time` on (while the carrier is on). A tag that is
  /// no longer in the list leaves the round, and the slot in progress fails if it was to be read
  /// there; a new one joins with the next Query. Call run_until(time) first. Throws Error if a tag
  /// is listed twice, its strength is not finite or its probability is not from 0 to 1.
  void set_field(Time time, const std::vector<TagOnAir>& tags);
  /// Removes a tag that no longer exists from the field and the round; TagMemories::forget() comes
  /// after.
  void forget(std::uint32_t tag);

  /// Continues to `time` and appends the reads of all slots that end by then to `out`, in
  /// chronological order. A slot that ends later is completed by a later call.
  void run_until(Time time, std::vector<Singulation>& out);

  [[nodiscard]] bool on() const { return on_; }
  /// The earliest stamp that a read in the slot in progress can have, possibly before the time of
  /// the last call; Time::max() if no slot is in progress.
  [[nodiscard]] Time next_read_after() const { return in_slot_ ? slot_.epc : Time::max(); }
  [[nodiscard]] const InventoryCounts& counts() const { return counts_; }
  /// Q of the last Query or QueryAdjust, or of the next if it is due.
  [[nodiscard]] int q() const { return q_; }
  /// The flag that the last Query selected, or the next will.
  [[nodiscard]] Flag target() const { return target_; }

 private:
  enum class Command { kQuery, kQueryAdjust, kQueryRep };
  enum class Outcome { kEmpty, kRead, kFailed, kCaptured, kCollided };
  struct Durations {
    Duration query, query_adjust, query_rep;
    Duration empty, collided, read, epc_begins;  ///< From the end of the command.
    Duration power_up, round_overhead, slot_overhead, read_overhead;
  };
  struct Slot {
    Outcome outcome = Outcome::kEmpty;
    std::uint32_t tag = 0;  ///< The strongest replying tag, if any.
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
  Time now_ = Time::min();  ///< The latest time passed.
  TagField field_;
  InventoryCounts counts_;

  // The round.
  Flag target_;
  int q_;
  double qfp_;
  RandomStream stream_;
  std::vector<std::uint32_t> waiting_;   ///< Participants whose slot is still to come.
  std::vector<std::uint32_t> spent_;     ///< Those that replied in vain and wait for a QueryAdjust.
  std::vector<std::uint32_t> repliers_;  ///< In the slot in progress.
  std::int64_t slots_left_ = 0;          ///< Remaining slots of the frame.
  bool frame_quiet_ = true;              ///< No tag has replied in it.
  bool in_slot_ = false;
  Slot slot_;
  Time next_;  ///< Start of the next command, unless a slot is in progress.
  Command command_ = Command::kQuery;

  // State for participants_are_known().
  bool participants_known_ = false;
  std::uint64_t known_version_ = 0;
  Flag known_target_ = Flag::kA;
  Time known_until_;
};

}  // namespace tagfield
