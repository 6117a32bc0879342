// SPDX-License-Identifier: Apache-2.0
/// @file
/// Distances of several tags from one scan, each known but poorly: tags on one shelf or wall are
/// about as far away, and how nearly so is told by the tags themselves.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tagfield {

/// For each tag what the others let expect of its distance, as a factor for its own likelihood at
/// each of the distances `away_m`, which rise by a constant factor. `likelihoods`: each tag's own
/// there. Distances are taken for log-normal about a middle, with a spread from 2 % to a factor of
/// e, both unknown but for their scale (priors flat in their logarithms) and integrated out; so a
/// tag by itself has a distance that is unknown but for its scale, and tags that differ learn
/// nothing from each other.
std::vector<Eigen::ArrayXd> expected_distances(const Eigen::ArrayXd& away_m,
                                               const std::vector<Eigen::ArrayXd>& likelihoods);

}  // namespace tagfield
