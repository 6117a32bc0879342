// SPDX-License-Identifier: Apache-2.0
/// @file
/// An antenna in one place, asked for many tags.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tagfield/planning/forecast.h"
#include "tagfield/planning/local_link.h"
#include "tagfield/report/coverage.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// By the paper's model or a physical one. May be used by several threads at once.
class AntennaPlace {
 public:
  /// Keeps references to `antenna` and `world`.
  AntennaPlace(const Scenario& scenario, const AntennaSpec& antenna, const RadioWorld& world,
               const RigidTransform& X_WA, std::uint64_t seed);

  /// Powers, margin and probability of a tag, with its place and key, in these orientations.
  [[nodiscard]] CoverageCell look(const TagEnd& tag, const Orientations& orientations,
                                  std::vector<RadioPath>& paths) const;
  /// The link's fading states; none of one of the paper's antennas.
  [[nodiscard]] LinkStates states(const TagEnd& tag, std::vector<RadioPath>& paths) const;
  /// A margin that no tag at `p_WT` has more of [dB].
  [[nodiscard]] double most_margin_db(const TagModel& tag, const Eigen::Vector3d& p_WT) const;

 private:
  [[nodiscard]] double distance(const Eigen::Vector3d& p_WT) const;
  [[nodiscard]] CoverageCell look_by_paper(double distance_m) const;

  const AntennaSpec& antenna_;
  Eigen::Vector3d p_WA_;
  std::vector<double> carriers_hz_;
  std::optional<RadioView> view_;  ///< Of a physical antenna.
};

/// Takes over what is more: the place with the greatest margin, the greatest probability.
void merge(const CoverageCell& seen, int antenna, CoverageCell& cell);

}  // namespace tagfield
