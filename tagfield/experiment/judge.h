// SPDX-License-Identifier: Apache-2.0
/// @file
/// The common evaluation of estimates: the outcome of each tag, whichever method located it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "tagfield/localization/tag_estimate.h"
#include "tagfield/report/summary.h"
#include "tagfield/stream/truth.h"

namespace tagfield {

/// The estimates, completed by one for each tag of `order` or of the truth that was never read:
/// first those of `order`, then the others, in natural order if there is a truth.
std::vector<TagEstimate> with_all_tags(std::vector<TagEstimate> estimates, const Truth& truth,
                                       const std::vector<std::string>& order);

/// Number of reads of each tag.
using ReadCounts = std::unordered_map<std::string, std::size_t>;

/// An outcome for each estimate: located, ambiguous or not located as stated by the estimate. A tag
/// counts as moved if its true positions are more than 5 mm apart, as it then has no single true
/// position; for other tags the last position counts, since the physics engine lets them settle.
/// `references` are the tags with given positions. `seed` is the run's.
std::vector<TagOutcome> judged(const std::vector<TagEstimate>& estimates,
                               const std::vector<TagRead>& reads, const Truth& truth,
                               const std::map<std::string, Eigen::Vector3d>& references,
                               std::uint64_t seed = 0);

/// Same, but for reads that are not in memory.
std::vector<TagOutcome> judged_by_counts(const std::vector<TagEstimate>& estimates,
                                         const ReadCounts& reads, const Truth& truth,
                                         const std::map<std::string, Eigen::Vector3d>& references,
                                         std::uint64_t seed = 0);

}  // namespace tagfield
