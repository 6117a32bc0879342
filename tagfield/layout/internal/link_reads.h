// SPDX-License-Identifier: Apache-2.0
/// @file
/// What one antenna by itself reads of a tag, and tells of its place, in the time that it is there.
/// See docs/plan.md.
#pragma once

#include <cstddef>
#include <map>
#include <utility>

#include "tagfield/layout/selection.h"
#include "tagfield/planning/forecast.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {

/// How long a port has its turn [s]; of one without an inventory as if it had one.
double port_dwell_s(const RadioModel& model);

/// How often a tag that is heard is read in one of the antenna's turns, where `tags` tags are heard
/// and all of the reader's `ports` ports take turns: in the mean, by the inventory itself, slot by
/// slot; without one at each update, `rate_hz`.
double reads_a_turn(const RadioModel& model, double rate_hz, std::size_t ports, std::size_t tags);

/// The same, each case once. `model` must outlive this.
class ReadsATurn {
 public:
  explicit ReadsATurn(std::size_t ports) : ports_(ports) {}
  double of(const RadioModel& model, double rate_hz, double tags);

 private:
  std::size_t ports_;
  std::map<std::pair<const RadioModel*, std::size_t>, double> known_;
};

/// Fisher information of a distance [1/m²] by phases of carriers f and noise σφ, one unknown offset
/// for all: (4π/c)² Σ (f − f̄)²/σφ², given that sum [Hz²], f̄ weighted.
double information_of_phases(double spread_over_noise);
/// By strength: as it falls with the fourth power of the distance and scatters by 4 dB, as `fixed`
/// takes it (docs/methods.md).
double information_of_strength(double distance_m);
/// Of x and y, by that of a distance: along the horizontal part of the line from antenna to tag.
Told told_along(double information, const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT);

/// What an antenna's reads of a tag tell of the distance.
struct RangeTold {
  double precision = 0.0;    ///< Mean of 1/σφ² [1/rad²].
  double by_strength = 0.0;  ///< All reads together, as fading at rest stays the same [1/m²].
};

/// Of a link `distance_m` long in these states, of which only those with a margin of `less_db` and
/// more count. Phase noise is that of a reply as strong as the margin says.
RangeTold range_told(const RadioModel& model, const LinkStates& states, double less_db,
                     double distance_m);

/// Σ (f − f̄)² [Hz²] to be expected of `reads` on channels that an antenna visits so many of, chance
/// saying which.
double expected_spread(const RadioModel& model, double reads, double visited);

/// What `reads` of it, over carriers with this Σ (f − f̄)² [Hz²], tell of x and y.
Told told_by(const RangeTold& range, double reads, double spread, const Eigen::Vector3d& p_WA,
             const Eigen::Vector3d& p_WT);

}  // namespace tagfield
