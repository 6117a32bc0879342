// SPDX-License-Identifier: Apache-2.0
/// @file
/// What tags remember between inventories, whichever antenna or reader asks: their inventoried
/// flags, and since when they are without power (Gen2 v2, 6.3.2.2 and Table 6.20).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/gen2/session.h"

namespace tagfield {

/// How long a flag stays B before it falls back to A. S0 lasts as long as the tag has power and not
/// longer; S2 and S3 last forever with power.
struct Persistence {
  double s1_s = 2.0;      ///< S1, with power or without [s]; from 0.5 to 5.
  double s2_s3_s = 10.0;  ///< S2 and S3 without power [s]; 2 or more.
};

/// Throws Error naming the parameter and its range.
void check(const Persistence& persistence);

/// The memories of all tags, by their slot in the population; shared by all inventories that these
/// tags hear. A tag that was never told of has no power and A in all sessions. Not thread-safe.
class TagMemories {
 public:
  /// Throws Error as check() does.
  explicit TagMemories(const Persistence& persistence = {});

  /// One more antenna powers the tag from `time` on.
  void power_on(std::uint32_t tag, Time time);
  /// One antenna less powers the tag. Nothing if none did.
  void power_off(std::uint32_t tag, Time time);
  [[nodiscard]] bool powered(std::uint32_t tag) const;

  /// The tag's flag at `time`, which must not be before the last change told of.
  [[nodiscard]] Flag flag(std::uint32_t tag, Session session, Time time) const;
  /// When the flag of a tag with power will fall back to A by itself; Time::max() for never.
  [[nodiscard]] Time falls_back(std::uint32_t tag, Session session) const;
  /// The tag, which has power, changes its flag at `time`. B in S1 lasts from then on.
  void set_flag(std::uint32_t tag, Session session, Flag flag, Time time);

  /// The slot is another tag's from now on, without power and with A in all sessions. Inventories
  /// that have the old one in their field must forget() it first.
  void forget(std::uint32_t tag);

  /// Grows with each change of any flag or power, but for what time alone changes.
  [[nodiscard]] std::uint64_t version() const { return version_; }

 private:
  struct Memory {
    Time s1_set{};                 ///< When S1 became B.
    Time power_lost{};             ///< While nobody powers it.
    std::uint32_t powered_by = 0;  ///< Number of antennas.
    std::array<Flag, 4> flags{};
  };
  Memory& memory(std::uint32_t tag);

  Duration s1_;
  Duration s2_s3_;
  std::vector<Memory> memories_;
  std::uint64_t version_ = 0;
};

}  // namespace tagfield
