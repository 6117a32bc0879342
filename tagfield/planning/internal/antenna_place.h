// SPDX-License-Identifier: Apache-2.0
/// @file
/// An antenna at one pose, evaluated for many tags.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tagfield/planning/forecast.h"
#include "tagfield/planning/local_link.h"
#include "tagfield/report/coverage.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Uses the paper's model or a physical one. May be used by several threads simultaneously.
class AntennaAtPose {
 public:
  /// Keeps references to `antenna` and `world`. `bodies` block waves.
  AntennaAtPose(const Scenario& scenario, const AntennaSpec& antenna, const RadioWorld& world,
                const RigidTransform& X_WA, const std::vector<MovingBody>& bodies,
                std::uint64_t seed);

  /// Powers, margin and probability of a tag, at its position and with its key, in these
  /// orientations.
  [[nodiscard]] CoverageCell look(const TagEnd& tag, const Orientations& orientations,
                                  std::vector<RadioPath>& paths) const;
  /// The link's fading states; none for an antenna of the paper's model.
  [[nodiscard]] LinkStates states(const TagEnd& tag, std::vector<RadioPath>& paths) const;
  /// Upper bound on the margin of any tag at `p_WT` [dB].
  [[nodiscard]] double max_margin_db(const TagModel& tag, const Eigen::Vector3d& p_WT) const;

 private:
  [[nodiscard]] double distance(const Eigen::Vector3d& p_WT) const;
  [[nodiscard]] CoverageCell look_by_paper(double distance_m) const;

  const AntennaSpec& antenna_;
  Eigen::Vector3d p_WA_;
  std::vector<double> carriers_hz_;
  std::optional<RadioView> view_;  ///< Set for a physical antenna.
};

/// Updates `cell` with the better values: the pose with the greatest margin, and the greatest
/// probability.
void merge(const CoverageCell& seen, int antenna, CoverageCell& cell);

}  // namespace tagfield
