// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/tag_memories.h"

#include "tagfield/base/range_check.h"

namespace tagfield {

void check(const Persistence& persistence) {
  constexpr double kMost = 1e9;  // About thirty years, so that adding it to a stamp doesn't
                                 // overflow.
  require_in_range("s1", persistence.s1_s, 0.5, 5.0, "s");
  require_in_range("s2_s3", persistence.s2_s3_s, 2.0, kMost, "s");
}

TagMemories::TagMemories(const Persistence& persistence) {
  check(persistence);
  s1_ = duration_from_seconds(persistence.s1_s);
  s2_s3_ = duration_from_seconds(persistence.s2_s3_s);
}

TagMemories::Memory& TagMemories::memory(std::uint32_t tag) {
  if (tag >= memories_.size()) memories_.resize(tag + std::size_t{1});
  return memories_[tag];
}

void TagMemories::power_on(std::uint32_t tag, Time time) {
  Memory& memory = this->memory(tag);
  for (const Session session : {Session::kS1, Session::kS2, Session::kS3}) {
    memory.flags[static_cast<std::size_t>(session)] = flag(tag, session, time);
  }
  ++memory.powered_by;
  ++version_;
}

void TagMemories::power_off(std::uint32_t tag, Time time) {
  Memory& memory = this->memory(tag);
  if (memory.powered_by == 0) return;
  if (--memory.powered_by == 0) {
    memory.power_lost = time;
    memory.flags[static_cast<std::size_t>(Session::kS0)] = Flag::kA;
  }
  ++version_;
}

bool TagMemories::powered(std::uint32_t tag) const {
  return tag < memories_.size() && memories_[tag].powered_by > 0;
}

Flag TagMemories::flag(std::uint32_t tag, Session session, Time time) const {
  if (tag >= memories_.size()) return Flag::kA;
  const Memory& memory = memories_[tag];
  const Flag flag = memory.flags[static_cast<std::size_t>(session)];
  if (flag == Flag::kA || session == Session::kS0) return flag;
  if (session == Session::kS1) return time - memory.s1_set < s1_ ? Flag::kB : Flag::kA;
  const bool lasts = memory.powered_by > 0 || time - memory.power_lost < s2_s3_;
  return lasts ? Flag::kB : Flag::kA;
}

Time TagMemories::falls_back(std::uint32_t tag, Session session) const {
  if (session != Session::kS1 || tag >= memories_.size()) return Time::max();
  const Memory& memory = memories_[tag];
  const bool is_b = memory.flags[static_cast<std::size_t>(session)] == Flag::kB;
  return is_b ? memory.s1_set + s1_ : Time::max();
}

void TagMemories::set_flag(std::uint32_t tag, Session session, Flag flag, Time time) {
  Memory& memory = this->memory(tag);
  memory.flags[static_cast<std::size_t>(session)] = flag;
  if (session == Session::kS1) memory.s1_set = time;
  ++version_;
}

void TagMemories::forget(std::uint32_t tag) {
  memory(tag) = {};
  ++version_;
}

}  // namespace tagfield
