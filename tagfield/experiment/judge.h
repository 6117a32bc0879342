// SPDX-License-Identifier: Apache-2.0
/// @file
/// The one judge of estimates: what became of each tag, whoever located it.
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

/// The estimates with one for each tag of `order` or of the truth that was never read: first those
/// of `order`, then the others; in natural order where `order` is empty and there is a truth.
std::vector<TagEstimate> with_all_tags(std::vector<TagEstimate> estimates, const Truth& truth,
                                       const std::vector<std::string>& order);

/// How many reads there are of each tag.
using ReadCounts = std::unordered_map<std::string, std::size_t>;

/// An outcome for each estimate: located, ambiguous or not located as the estimate says; moved
/// where the truth has the tag in places over 5 mm apart, so that it has no one true place; of
/// others the last counts, as physics lets them settle. `references` are those whose places were
/// told. `seed` is the run's.
std::vector<TagOutcome> judged(const std::vector<TagEstimate>& estimates,
                               const std::vector<TagRead>& reads, const Truth& truth,
                               const std::map<std::string, Eigen::Vector3d>& references,
                               std::uint64_t seed = 0);

/// The same of reads that are not in memory.
std::vector<TagOutcome> judged_by_counts(const std::vector<TagEstimate>& estimates,
                                         const ReadCounts& reads, const Truth& truth,
                                         const std::map<std::string, Eigen::Vector3d>& references,
                                         std::uint64_t seed = 0);

}  // namespace tagfield
