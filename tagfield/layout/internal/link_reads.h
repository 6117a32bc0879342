// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a single antenna reads of a tag while it is present, and the information this gives about
/// its position. See docs/plan.md.
#pragma once

#include <cstddef>
#include <map>
#include <utility>

#include "tagfield/layout/selection.h"
#include "tagfield/planning/forecast.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {

/// Dwell time of a port [s]; without an inventory, the default.
double port_dwell_s(const RadioModel& model);

/// Mean number of reads of a tag in one of the antenna's turns, if `tags` tags are heard and all
/// `ports` ports of the reader take turns: by running the inventory, slot by slot; without one, a
/// read per update, at `rate_hz`.
double reads_a_turn(const RadioModel& model, double rate_hz, std::size_t ports, std::size_t tags);

/// Cache of reads_a_turn(). Models passed to of() must outlive this.
class ReadsATurn {
 public:
  explicit ReadsATurn(std::size_t ports) : ports_(ports) {}
  double of(const RadioModel& model, double rate_hz, double tags);

 private:
  std::size_t ports_;
  std::map<std::pair<const RadioModel*, std::size_t>, double> known_;
};

/// Fisher information about a distance [1/m²] from phases at carriers f with noise σφ and one
/// common unknown offset: (4π/c)² Σ (f − f̄)²/σφ² with the weighted mean f̄; the argument is the
/// sum [Hz²].
double information_of_phases(double spread_over_noise);
/// The same from signal strength, which falls with the fourth power of the distance and scatters by
/// 4 dB, as assumed by `fixed` (docs/methods.md).
double information_of_strength(double distance_m);
/// Information about x and y from that about a distance: along the horizontal component of the line
/// from antenna to tag.
PositionInformation information_along(double information, const Eigen::Vector3d& p_WA,
                                      const Eigen::Vector3d& p_WT);

/// Information about the distance from an antenna's reads of a tag.
struct RangeInformation {
  double precision = 0.0;    ///< Mean of 1/σφ² [1/rad²].
  double by_strength = 0.0;  ///< Of all reads together, as fading at rest is constant [1/m²].
};

/// For a link of length `distance_m` with these fading states, of which only those with a margin of
/// at least `less_db` count. The phase noise is that of a reply whose strength follows from the
/// margin.
RangeInformation range_information(const RadioModel& model, const LinkStates& states,
                                   double less_db, double distance_m);

/// Expected Σ (f − f̄)² [Hz²] of `reads` on `visited` channels chosen at random.
double expected_spread(const RadioModel& model, double reads, double visited);

/// Information about x and y from `reads` over carriers with this Σ (f − f̄)² [Hz²].
PositionInformation position_information(const RangeInformation& range, double reads, double spread,
                                         const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT);

}  // namespace tagfield
