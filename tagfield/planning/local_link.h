// SPDX-License-Identifier: Apache-2.0
/// @file
/// A link over a small neighbourhood instead of in one point: local mean power, and how often it is
/// heard. See docs/coverage.md.
#pragma once

#include <cstdint>
#include <vector>

#include "tagfield/field/radio_link.h"

namespace tagfield {

/// Powers are local means: of |h|² over carriers and places.
struct LocalLink {
  double tag_dbm = -400.0;
  double reply_dbm = -400.0;
  double margin_db = -400.0;  ///< The lesser of tag's and reader's, of the local means.
  double probability = 0.0;   ///< Share of carriers and places where it is heard.
};

/// Carriers of a plan to look at: all, or about eight spread over it; the first where it does not
/// hop.
std::vector<double> sampled_carriers(const RadioModel& model);
/// Channels that the reader hops over; 1 where it does not hop.
std::size_t hopped_channels(const RadioModel& model);
/// Which of sampled_carriers() stands for a channel of the plan.
std::size_t sampled_carrier_of(const RadioModel& model, std::size_t channel);

/// The link over the `carriers_hz` and nine places of the tag: its own and ± λ/4 along x and y. The
/// paths are traced once, to the middle, and turned in phase for the others as plane waves, which
/// is right to λ/50 from a metre on. `paths` is workspace; `draw` tells draws of diffuse waves
/// apart.
LocalLink local_link(const RadioView& view, const TagEnd& tag,
                     const std::vector<double>& carriers_hz, std::uint64_t draw,
                     std::vector<RadioPath>& paths);

/// The same over several orientations of the tag as one.
struct Orientations {
  std::vector<Eigen::Quaterniond> R_WT = {Eigen::Quaterniond::Identity()};
  bool worst = false;  ///< The one of least margin counts, instead of the mean over all.
};
LocalLink local_link(const RadioView& view, const TagEnd& tag, const Orientations& orientations,
                     const std::vector<double>& carriers_hz, std::uint64_t draw,
                     std::vector<RadioPath>& paths);

/// What a link has beyond what it takes in each of its fading states: by place (nine, its own the
/// fifth), then by carrier [dB]. Less power at the chip by so many dB, for instance by detuning,
/// leaves each margin so much less; a state is heard from 0 on. What limits the reader counts half,
/// as it goes both ways. kNothing_db where nothing arrives.
inline constexpr std::size_t kFadingPlaces = 9;
inline constexpr std::size_t kOwnPlace = 4;
std::vector<double> fading_margins_db(const RadioView& view, const TagEnd& tag,
                                      const std::vector<double>& carriers_hz, std::uint64_t draw,
                                      std::vector<RadioPath>& paths);

/// Greatest margin [dB] that any tag at `distance_m` can have: at the greatest gains, and with
/// fields of twice the direct one's where there are others.
double most_margin_db(const RadioModel& model, const TagModel& tag, double distance_m);

}  // namespace tagfield
