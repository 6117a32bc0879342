// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/judge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "tagfield/files/read_overview.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

constexpr double kSettling = 0.005;  ///< [m]

/// The positions of a tag over time.
struct Places {
  Eigen::AlignedBox3d box;
  Eigen::Vector3d last;
};

std::map<std::string, Places> places_of(const Truth& truth) {
  std::map<std::string, Places> places;
  for (const TagPosition& position : truth.tag_positions) {
    Places& of_tag = places[position.tag];
    of_tag.box.extend(position.p_WT);
    of_tag.last = position.p_WT;
  }
  return places;
}

/// `order`, then all others that were read or are in the truth.
std::vector<std::string> all_tags(const std::vector<TagEstimate>& estimates, const Truth& truth,
                                  const std::vector<std::string>& order) {
  std::vector<std::string> others;
  others.reserve(estimates.size() + truth.tag_positions.size() + order.size());
  for (const TagEstimate& estimate : estimates) others.push_back(estimate.tag);
  for (const TagPosition& position : truth.tag_positions) others.push_back(position.tag);
  if (!truth.tag_positions.empty()) std::stable_sort(others.begin(), others.end(), natural_less);
  others.insert(others.begin(), order.begin(), order.end());
  std::vector<std::string> tags;
  std::set<std::string> seen;
  for (const std::string& tag : others) {
    if (seen.insert(tag).second) tags.push_back(tag);
  }
  return tags;
}

}  // namespace

std::vector<TagEstimate> with_all_tags(std::vector<TagEstimate> estimates, const Truth& truth,
                                       const std::vector<std::string>& order) {
  const std::vector<std::string> tags = all_tags(estimates, truth, order);
  std::map<std::string, TagEstimate*> by_tag;
  for (TagEstimate& estimate : estimates) by_tag[estimate.tag] = &estimate;
  std::vector<TagEstimate> all;
  for (const std::string& tag : tags) {
    const auto found = by_tag.find(tag);
    if (found != by_tag.end()) {
      all.push_back(std::move(*found->second));
    } else {
      all.push_back({tag, Verdict::kNotLocated, "cannot localize: never read", {}, 0});
    }
  }
  return all;
}

std::vector<TagOutcome> judged(const std::vector<TagEstimate>& estimates,
                               const std::vector<TagRead>& reads, const Truth& truth,
                               const std::map<std::string, Eigen::Vector3d>& references,
                               std::uint64_t seed) {
  return judged_by_counts(estimates, overview_of(reads).count_by_tag, truth, references, seed);
}

std::vector<TagOutcome> judged_by_counts(const std::vector<TagEstimate>& estimates,
                                         const ReadCounts& reads, const Truth& truth,
                                         const std::map<std::string, Eigen::Vector3d>& references,
                                         std::uint64_t seed) {
  const std::map<std::string, Places> places = places_of(truth);
  std::vector<TagOutcome> outcomes;
  for (const TagEstimate& estimate : estimates) {
    TagOutcome outcome;
    outcome.seed = seed;
    outcome.estimate = estimate;
    const auto count = reads.find(estimate.tag);
    if (count != reads.end()) outcome.reads = count->second;
    outcome.reference = references.count(estimate.tag) > 0;
    const auto known = places.find(estimate.tag);
    if (known != places.end()) {
      outcome.moved = known->second.box.sizes().norm() > kSettling;
      if (!outcome.moved) outcome.truth_m = known->second.last;
    }
    outcomes.push_back(std::move(outcome));
  }
  return outcomes;
}

}  // namespace tagfield
