// SPDX-License-Identifier: Apache-2.0
/// @file
/// Pooling of the distances of several tags from one scan, each poorly known: tags on one shelf or
/// wall are at about the same distance, with a spread estimated from the tags themselves.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tagfield {

/// Prior of each tag's distance from the other tags, as a factor on its own likelihood at each of
/// the distances `away_m`, which form a geometric sequence. `likelihoods`: each tag's own at these
/// distances. Distances are modelled as log-normal around a centre, with a spread from 2 % to a
/// factor of e; both have priors flat in the logarithm and are integrated out. So the prior of a
/// single tag is flat in the logarithm of the distance, and tags at different distances do not
/// influence each other.
std::vector<Eigen::ArrayXd> expected_distances(const Eigen::ArrayXd& away_m,
                                               const std::vector<Eigen::ArrayXd>& likelihoods);

}  // namespace tagfield
