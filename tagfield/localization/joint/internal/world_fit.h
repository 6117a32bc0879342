// SPDX-License-Identifier: Apache-2.0
/// @file
/// The rounds of a fit through a known world: what its paths do to the phases is taken out, tags
/// and pose error are fitted together, and tags go on to places that are clearly likelier.
#pragma once

#include <vector>

#include "tagfield/localization/joint/internal/joint_state.h"
#include "tagfield/localization/joint/internal/traced_search.h"
#include "tagfield/localization/joint/multipath.h"

namespace tagfield {

/// A fit under way.
struct WorldFit {
  JointState state;
  std::vector<TagEstimate> starts;         ///< By tag of the state, as are
  std::vector<const SamplesOfTag*> given;  ///< the samples as they were measured,
  std::vector<Straightened> straight;      ///< and without their bends;
  /// and whether there was a look about where it is (by several threads, so no vector<bool>).
  std::vector<char> looked_about;
};

/// Traces and fits, again and again. Afterwards the tags' samples, slopes and offsets are of where
/// they are.
void fit_through_world(WorldFit& fit, const MultipathOptions& options, int threads);

/// By tag: for how much its reads count in the fit, of 1 where only their noise is left; 0 where
/// its waves don't add up.
std::vector<double> fit_weights(const JointState& state, int threads);

/// Whether a tag of that weight fits at all.
bool fits_somewhat(double weight);

/// A wrong world fits a tag here and there, a right one most.
bool is_right_world(const std::vector<double>& weights);

/// By tag, how well its place explains its reads.
std::vector<Fit> fits_of(const WorldFit& fit, const MultipathOptions& options, int threads);

}  // namespace tagfield
