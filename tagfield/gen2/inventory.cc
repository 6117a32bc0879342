// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/inventory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/base/units.h"
#include "tagfield/gen2/internal/slot_draw.h"

namespace tagfield {

Inventory::Durations Inventory::durations_of(const LinkSettings& link,
                                             const InventorySettings& settings) {
  Durations durations;
  durations.query = duration_from_seconds(query_s(link, settings.session));
  durations.query_adjust = duration_from_seconds(query_adjust_s(link, settings.session));
  durations.query_rep = duration_from_seconds(query_rep_s(link, settings.session));
  durations.empty = duration_from_seconds(empty_slot_s(link));
  durations.collided = duration_from_seconds(collided_slot_s(link));
  durations.read = duration_from_seconds(read_slot_s(link));
  durations.epc_begins = duration_from_seconds(epc_begins_s(link));
  durations.power_up = duration_from_seconds(settings.power_up_s);
  durations.round_overhead = duration_from_seconds(settings.round_overhead_s);
  durations.slot_overhead = duration_from_seconds(settings.slot_overhead_s);
  durations.read_overhead = duration_from_seconds(settings.read_overhead_s);
  return durations;
}

Inventory::Inventory(const LinkSettings& link, const InventorySettings& settings,
                     TagMemories& memories, std::uint64_t seed, std::uint64_t key)
    : settings_((check(link), check(settings), settings)),
      durations_(durations_of(link, settings)),
      memories_(memories),
      seed_(seed),
      key_(key),
      target_(settings.target == Target::kB ? Flag::kB : Flag::kA),
      q_(settings.start_q),
      qfp_(settings.start_q),
      stream_(seed, Purpose::kGen2, key) {}

// --- Input ---------------------------------------------------------------------------------------

void Inventory::advance(Time time) {
  if (time < now_) {
    throw Error(fmt::format("an inventory at {} s cannot go back to {} s", to_seconds(now_),
                            to_seconds(time)));
  }
  now_ = time;
}

void Inventory::start(Time time) {
  advance(time);
  if (on_) return;
  on_ = true;
  for (const TagOnAir& tag : field_.tags()) memories_.power_on(tag.tag, time);
  command_ = Command::kQuery;
  next_ = time + durations_.power_up + durations_.round_overhead;
}

void Inventory::stop(Time time) {
  advance(time);
  if (!on_) return;
  on_ = false;
  in_slot_ = false;
  for (const TagOnAir& tag : field_.tags()) memories_.power_off(tag.tag, time);
}

void Inventory::set_field(Time time, const std::vector<TagOnAir>& tags) {
  advance(time);
  TagField field;
  field.assign(tags);
  std::swap(field, field_);
  if (!on_) return;
  for (const TagOnAir& old : field.tags()) {
    if (!field_.has(old.tag)) memories_.power_off(old.tag, time);
  }
  for (const TagOnAir& tag : tags) {
    if (!field.has(tag.tag)) memories_.power_on(tag.tag, time);
  }
  drop_absent();
}

void Inventory::forget(std::uint32_t tag) {
  field_.remove(tag);
  drop_absent();
}

/// Removes tags without power from the round.
void Inventory::drop_absent() {
  const auto absent = [&](std::uint32_t tag) { return !field_.has(tag); };
  for (std::vector<std::uint32_t>* list : {&waiting_, &spent_, &repliers_}) {
    list->erase(std::remove_if(list->begin(), list->end(), absent), list->end());
  }
  if (!in_slot_ || !absent(slot_.tag)) return;
  if (slot_.outcome == Outcome::kRead) slot_.outcome = Outcome::kFailed;
  if (slot_.outcome == Outcome::kCaptured) slot_.outcome = Outcome::kCollided;
}

void Inventory::run_until(Time time, std::vector<Singulation>& out) {
  advance(time);
  while (on_) {
    if (in_slot_ ? slot_.end > time : next_ >= time) return;
    if (in_slot_) {
      end_slot(out);
    } else {
      begin_slot();
    }
  }
}

// --- Commands ------------------------------------------------------------------------------------

void Inventory::begin_slot() {
  Duration command = durations_.query_rep;
  if (command_ == Command::kQuery) {
    query();
    command = durations_.query;
  } else if (command_ == Command::kQueryAdjust) {
    redraw();
    command = durations_.query_adjust;
  }
  draw_repliers(slots_left_, stream_, waiting_, repliers_);
  --slots_left_;
  drop_those_read_elsewhere();
  judge_repliers();
  const Time begin = next_ + command;
  slot_.epc = begin + durations_.epc_begins;
  slot_.end = begin + (slot_.outcome == Outcome::kEmpty ? durations_.empty
                       : is_read()                      ? durations_.read
                                                        : durations_.collided);
  in_slot_ = true;
}

void Inventory::query() {
  stream_ = RandomStream(seed_, Purpose::kGen2, key_, static_cast<std::uint64_t>(counts_.rounds));
  ++counts_.rounds;
  if (!participants_are_known()) gather_participants();
  redraw();
}

/// Whether the participants of the last round, except the tags it read, are exactly those of the
/// next. This avoids checking all tags' flags in each of the short rounds of a field whose tags
/// have all been read.
bool Inventory::participants_are_known() const {
  return participants_known_ && known_target_ == target_ && next_ < known_until_ &&
         known_version_ == memories_.version();
}

void Inventory::gather_participants() {
  waiting_.clear();
  spent_.clear();
  known_until_ = Time::max();
  for (const TagOnAir& tag : field_.tags()) {
    if (memories_.flag(tag.tag, settings_.session, next_) == target_) waiting_.push_back(tag.tag);
    const Time falls_back = memories_.falls_back(tag.tag, settings_.session);
    if (falls_back > next_) known_until_ = std::min(known_until_, falls_back);
  }
  participants_known_ = true;
  known_target_ = target_;
  known_version_ = memories_.version();
}

/// All participants draw a new slot. draw_repliers() selects them slot by slot.
void Inventory::redraw() {
  waiting_.insert(waiting_.end(), spent_.begin(), spent_.end());
  spent_.clear();
  slots_left_ = std::int64_t{1} << static_cast<unsigned>(q_);
  frame_quiet_ = true;
}

// --- One slot ------------------------------------------------------------------------------------

/// Tags that another reader has read since the Query don't reply.
void Inventory::drop_those_read_elsewhere() {
  const auto keeps_silent = [&](std::uint32_t tag) {
    return memories_.flag(tag, settings_.session, next_) != target_;
  };
  const auto silent = std::stable_partition(repliers_.begin(), repliers_.end(),
                                            [&](std::uint32_t tag) { return !keeps_silent(tag); });
  spent_.insert(spent_.end(), silent, repliers_.end());
  repliers_.erase(silent, repliers_.end());
}

void Inventory::judge_repliers() {
  slot_.outcome = Outcome::kEmpty;
  if (repliers_.empty()) return;
  frame_quiet_ = false;
  const auto weaker = [&](std::uint32_t a, std::uint32_t b) {
    return field_.at(a).reply_dbm < field_.at(b).reply_dbm;
  };
  slot_.tag = *std::max_element(repliers_.begin(), repliers_.end(), weaker);
  if (repliers_.size() == 1) {
    slot_.outcome = is_decoded(slot_.tag) ? Outcome::kRead : Outcome::kFailed;
  } else {
    const bool captured = is_captured(slot_.tag) && is_decoded(slot_.tag);
    slot_.outcome = captured ? Outcome::kCaptured : Outcome::kCollided;
  }
}

bool Inventory::is_captured(std::uint32_t strongest) const {
  if (!settings_.capture_db) return false;
  double others_mw = 0.0;
  for (const std::uint32_t tag : repliers_) {
    if (tag != strongest) others_mw += from_db(field_.at(tag).reply_dbm);
  }
  return from_db(field_.at(strongest).reply_dbm - *settings_.capture_db) >= others_mw;
}

bool Inventory::is_decoded(std::uint32_t tag) {
  return uniform_above_0(stream_) <= field_.at(tag).decode_probability;
}

bool Inventory::is_read() const {
  return slot_.outcome == Outcome::kRead || slot_.outcome == Outcome::kCaptured;
}

void Inventory::end_slot(std::vector<Singulation>& out) {
  in_slot_ = false;
  // A tag answers one reader at a time: another's acknowledgement during the slot takes it away
  // from this one.
  const bool was_taken =
      is_read() && memories_.flag(slot_.tag, settings_.session, slot_.end) != target_;
  if (was_taken) slot_.outcome = Outcome::kFailed;
  count();
  next_ = slot_.end + durations_.slot_overhead;
  if (is_read()) {
    out.push_back({slot_.tag, slot_.epc});
    set_inventoried(slot_.tag);
    next_ += durations_.read_overhead;
  }
  spent_.insert(spent_.end(), repliers_.begin(), repliers_.end());
  adapt_q();
  choose_command();
}

void Inventory::count() {
  switch (slot_.outcome) {
    case Outcome::kEmpty:
      ++counts_.empty;
      break;
    case Outcome::kRead:
      ++counts_.read;
      break;
    case Outcome::kFailed:
      ++counts_.failed;
      break;
    case Outcome::kCaptured:
      ++counts_.captured;
      break;
    case Outcome::kCollided:
      ++counts_.collided;
      break;
  }
}

void Inventory::set_inventoried(std::uint32_t tag) {
  repliers_.erase(std::find(repliers_.begin(), repliers_.end(), tag));
  const bool known = known_version_ == memories_.version();
  memories_.set_flag(tag, settings_.session, inverted(target_), slot_.end);
  if (known) known_version_ = memories_.version();
  known_until_ = std::min(known_until_, memories_.falls_back(tag, settings_.session));
}

/// Annex D: Q decreases after a slot without replies, and increases after one whose replies can't
/// be decoded.
void Inventory::adapt_q() {
  if (!settings_.adaptive_q || is_read()) return;
  qfp_ += slot_.outcome == Outcome::kEmpty ? -settings_.q_step : settings_.q_step;
  qfp_ =
      std::clamp(qfp_, static_cast<double>(settings_.min_q), static_cast<double>(settings_.max_q));
}

void Inventory::choose_command() {
  const bool frame_ends = slots_left_ == 0;
  if (frame_ends) end_frame();
  const int q = static_cast<int>(std::lround(qfp_));
  command_ = frame_ends ? Command::kQuery : q != q_ ? Command::kQueryAdjust : Command::kQueryRep;
  q_ = q;
}

void Inventory::end_frame() {
  next_ += durations_.round_overhead;
  if (settings_.carrier_off_between_rounds) interrupt_carrier();
  if (!frame_quiet_) return;
  // No tag of this target is left.
  qfp_ = settings_.start_q;
  if (settings_.target == Target::kAlternate) target_ = inverted(target_);
}

/// Too brief to affect the persistence of S1 to S3.
void Inventory::interrupt_carrier() {
  for (const TagOnAir& tag : field_.tags()) memories_.power_off(tag.tag, slot_.end);
  for (const TagOnAir& tag : field_.tags()) memories_.power_on(tag.tag, slot_.end);
  next_ += durations_.power_up;
}

}  // namespace tagfield
