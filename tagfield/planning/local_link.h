// SPDX-License-Identifier: Apache-2.0
/// @file
/// A link over a small neighbourhood instead of at a single point: local mean power, and how often
/// it is heard. See docs/coverage.md.
#pragma once

#include <cstdint>
#include <vector>

#include "tagfield/field/radio_link.h"

namespace tagfield {

/// Powers are local means: means of |h|² over carriers and positions.
struct LocalLink {
  double tag_dbm = -400.0;
  double reply_dbm = -400.0;
  double margin_db = -400.0;  ///< The lesser of tag's and reader's, from local means.
  double probability = 0.0;   ///< Fraction of carriers and positions at which it is heard.
};

/// Carriers of a plan to evaluate: all, or about eight spread over it; only the first if the reader
/// does not hop.
std::vector<double> sampled_carriers(const RadioModel& model);
/// Number of channels that the reader hops over; 1 if it does not hop.
std::size_t hopped_channels(const RadioModel& model);
/// Index into sampled_carriers() of the one that represents a channel of the plan.
std::size_t sampled_carrier_of(const RadioModel& model, std::size_t channel);

/// The link over the `carriers_hz` and nine positions of the tag: its own and ± λ/4 along x and y.
/// The paths are traced once, to the centre, and their phases shifted for the other positions as
/// for plane waves, which is accurate to λ/50 from a metre on. `paths` is a workspace; `draw`
/// distinguishes draws of diffuse waves.
LocalLink local_link(const RadioView& view, const TagEnd& tag,
                     const std::vector<double>& carriers_hz, std::uint64_t draw,
                     std::vector<RadioPath>& paths);

/// Several orientations of the tag, evaluated as one link.
struct Orientations {
  std::vector<Eigen::Quaterniond> R_WT = {Eigen::Quaterniond::Identity()};
  bool worst = false;  ///< Use the orientation with the least margin instead of the mean over all.
};
LocalLink local_link(const RadioView& view, const TagEnd& tag, const Orientations& orientations,
                     const std::vector<double>& carriers_hz, std::uint64_t draw,
                     std::vector<RadioPath>& paths);

/// Margins of a link in each of its fading states: by position (nine, its own the fifth), then by
/// carrier [dB]. Any loss of power at the chip, for instance by detuning, reduces each margin by
/// the same number of dB; a state is heard from 0 dB on. The reader's margin counts half, as such a
/// loss applies both ways. kNothing_db if nothing arrives.
inline constexpr std::size_t kFadingPositions = 9;
inline constexpr std::size_t kOwnPlace = 4;
std::vector<double> fading_margins_db(const RadioView& view, const TagEnd& tag,
                                      const std::vector<double>& carriers_hz, std::uint64_t draw,
                                      std::vector<RadioPath>& paths);

/// Upper bound on the margin [dB] of any tag at `distance_m`: at peak gains, and with twice the
/// field of the direct path if there may be others.
double max_margin_db(const RadioModel& model, const TagModel& tag, double distance_m);

}  // namespace tagfield
