// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where all tags were at the last two updates, and between them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tagfield/field/tag_population.h"

namespace tagfield {

/// Relative position of `time` between `before` (0) and `now` (1); slightly below 0 for times just
/// before `before`, and 1 if the two are the same.
double share_at(Time time, Time before, Time now);

/// Positions of tags by slot at the times of the last two updates.
class TagMotion {
 public:
  /// Records where tags are at `now`, which must be later than in the last call.
  void see(const TagPopulation& tags, Time now);
  /// To be called before the slot is reused for another tag.
  void forget(std::uint32_t slot);

  /// Time of the last update; nullopt before the first.
  [[nodiscard]] std::optional<Time> seen() const { return now_; }
  /// The tag's pose at `stamp`, its position interpolated between the last two updates; its present
  /// pose if it did not exist at the earlier one.
  [[nodiscard]] RigidTransform pose(std::uint32_t slot, Time stamp,
                                    const TagPopulation& tags) const;
  /// Mean velocity between the last two updates [m/s]; 0 if unknown.
  [[nodiscard]] Eigen::Vector3d velocity(std::uint32_t slot) const;

 private:
  std::optional<Time> now_;
  Time before_{};
  std::vector<Eigen::Vector3d> places_;         ///< At now_, by slot; NaN if there is no tag.
  std::vector<Eigen::Vector3d> places_before_;  ///< At before_.
};

}  // namespace tagfield
