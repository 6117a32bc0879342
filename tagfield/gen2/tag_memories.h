// SPDX-License-Identifier: Apache-2.0
/// @file
/// The state that tags keep between inventories of any antenna or reader: their inventoried flags,
/// and when they lost power (Gen2 v2, 6.3.2.2 and Table 6.20).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/gen2/session.h"

namespace tagfield {

/// How long a flag stays B before it reverts to A. S0 lasts exactly as long as the tag has power;
/// S2 and S3 last indefinitely with power.
struct Persistence {
  double s1_s = 2.0;      ///< S1, with or without power [s]; from 0.5 to 5.
  double s2_s3_s = 10.0;  ///< S2 and S3 without power [s]; 2 or more.
};

/// Throws Error naming the parameter and its range.
void check(const Persistence& persistence);

/// The memories of all tags, by their index in the population; shared by all inventories within
/// range of these tags. A tag that was never mentioned has no power and A in all sessions. Not
/// thread-safe.
class TagMemories {
 public:
  /// Throws Error as check() does.
  explicit TagMemories(const Persistence& persistence = {});

  /// One more antenna powers the tag, from `time` on.
  void power_on(std::uint32_t tag, Time time);
  /// One antenna fewer powers the tag. No effect if none did.
  void power_off(std::uint32_t tag, Time time);
  [[nodiscard]] bool powered(std::uint32_t tag) const;

  /// The tag's flag at `time`, which must not be before the last change.
  [[nodiscard]] Flag flag(std::uint32_t tag, Session session, Time time) const;
  /// When the flag of a powered tag will revert to A by itself; Time::max() for never.
  [[nodiscard]] Time falls_back(std::uint32_t tag, Session session) const;
  /// Sets the flag of a tag with power at `time`. In S1, the persistence time of B starts then.
  void set_flag(std::uint32_t tag, Session session, Flag flag, Time time);

  /// Frees the index for another tag, without power and with A in all sessions. Inventories that
  /// have the old tag in their field must forget() it first.
  void forget(std::uint32_t tag);

  /// Increases with each change of a flag or of power, except changes due to the passing of time
  /// alone.
  [[nodiscard]] std::uint64_t version() const { return version_; }

 private:
  struct Memory {
    Time s1_set{};                 ///< When S1 became B.
    Time power_lost{};             ///< If no antenna powers it.
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
