// SPDX-License-Identifier: Apache-2.0
/// @file
/// Rounds of a fit in a known world: the effect of its paths on the phases is removed, tags and
/// pose error are fitted jointly, and tags move to clearly likelier positions.
#pragma once

#include <vector>

#include "tagfield/localization/joint/internal/joint_state.h"
#include "tagfield/localization/joint/internal/traced_search.h"
#include "tagfield/localization/joint/multipath.h"

namespace tagfield {

/// State of the fit.
struct WorldFit {
  JointState state;
  std::vector<TagEstimate> starts;         ///< Per tag of the state, as are
  std::vector<const SamplesOfTag*> given;  ///< the measured samples,
  std::vector<Straightened> straight;      ///< the samples without bends,
  /// and whether its neighbourhood was searched (written by several threads, so no vector<bool>).
  std::vector<char> looked_about;
};

/// Traces and fits repeatedly. Afterwards, the tags' samples, slopes and offsets belong to their
/// final positions.
void fit_through_world(WorldFit& fit, const MultipathOptions& options, int threads);

/// Weight of each tag's reads in the fit: 1 if only noise remains, 0 if its phasors do not add up.
std::vector<double> fit_weights(const JointState& state, int threads);

/// Whether a tag of this weight fits at all.
bool fits_somewhat(double weight);

/// Whether most tags fit: a wrong world only fits a few of them.
bool is_right_world(const std::vector<double>& weights);

/// Goodness of fit of each tag's position.
std::vector<Fit> fits_of(const WorldFit& fit, const MultipathOptions& options, int threads);

}  // namespace tagfield
