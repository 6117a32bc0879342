// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/record.h"

#include <algorithm>
#include <limits>
#include <map>

#include "tagfield/experiment/internal/consistency.h"
#include "tagfield/experiment/internal/faults.h"
#include "tagfield/report/alignment.h"
#include "tagfield/report/summary.h"

namespace tagfield {
namespace {

constexpr std::size_t kFewestToAlign = 3;  // Two could be aligned except for their distance.

double horizontal(const Eigen::Vector3d& difference) { return difference.head<2>().norm(); }

void add_errors(const Candidate& best, TagRecord& record) {
  record.estimate = best.p_WT;
  if (!record.truth) return;
  const Eigen::Vector3d error = best.p_WT - *record.truth;
  record.error = horizontal(error);
  if (record.height_estimated) record.error_3d = error.norm();
  if (!best.covariance || record.claims_no_error) return;
  const bool with_height = record.height_estimated && (*best.covariance)(2, 2) > 0.0;
  record.nees = nees_of(error, *best.covariance, with_height);
  record.flat_covariance = !record.nees;
}

double nearest_error(const std::vector<Candidate>& candidates, const Eigen::Vector3d& truth) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : candidates) {
    nearest = std::min(nearest, horizontal(candidate.p_WT - truth));
  }
  return nearest;
}

/// None if the position can't be determined at all, or is known exactly.
std::optional<TagBound> bound_of(const Eigen::Matrix3d& covariance) {
  const double variance_m2 = covariance.topLeftCorner<2, 2>().trace();
  if (!(covariance.allFinite() && variance_m2 > 0.0)) return std::nullopt;
  return TagBound{mean_horizontal_error(covariance), variance_m2};
}

/// Whether the method states an error of 0: one that states no error gives no covariance of 0.
bool claims_no_error(const Candidate& best) {
  return best.expected_error_m == 0.0 && best.covariance &&
         best.covariance->topLeftCorner<2, 2>().isZero(0.0);
}

/// Fills in the results of the estimate.
void add_estimate(const TagEstimate& estimate, TagRecord& record) {
  record.verdict = estimate.verdict;
  record.reason = estimate.reason;
  if (estimate.candidates.empty()) return;
  const Candidate& best = estimate.candidates.front();
  record.expected_error = best.expected_error_m;
  record.claims_no_error = claims_no_error(best);
  if (estimate.verdict == Verdict::kLocated) add_errors(best, record);
  if (estimate.verdict == Verdict::kAmbiguous && record.truth) {
    record.nearest_candidate = nearest_error(estimate.candidates, *record.truth);
  }
}

}  // namespace

std::vector<TagRecord> records_of(const LocalizationProblem& problem,
                                  const std::vector<TagOutcome>& outcomes) {
  std::vector<TagRecord> records;
  for (const TagOutcome& outcome : outcomes) {
    if (outcome.reference) continue;
    TagRecord record;
    record.tag = outcome.estimate.tag;
    record.reads = outcome.reads;
    record.height_estimated = side_to_estimate(problem, record.tag).has_value();
    record.moved = outcome.moved;
    record.truth = outcome.truth_m;
    add_estimate(outcome.estimate, record);
    records.push_back(std::move(record));
  }
  return records;
}

void judge_by(const Bounds& bounds, MethodRun& run) {
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < bounds.tags.size(); ++i) places[bounds.tags[i]] = i;
  std::vector<NeesItem> items;
  for (TagRecord& tag : run.tags) {
    if (tag.nees) items.push_back({tag.tag, tag.nees->dof});
    const auto place = places.find(tag.tag);
    if (place == places.end()) continue;
    tag.bound = bound_of(covariance_of(bounds, place->second));
  }
  run.nees_correlation = correlation_of(items, bounds);
}

void judge_claims(const Faults& faults, MethodRun& run) {
  const bool can_be_true = has_true_position(faults, run.method);
  for (TagRecord& tag : run.tags) {
    if (tag.verdict != Verdict::kLocated) continue;
    const bool states_error = tag.expected_error > 0.0 || tag.claims_no_error;
    const bool too_far = tag.error && states_error && *tag.error > kFalseClaim * tag.expected_error;
    tag.false_claim = !can_be_true || tag.moved || too_far;
  }
}

void add_aligned_errors(std::vector<TagRecord>& tags) {
  std::vector<Eigen::Vector2d> from;
  std::vector<Eigen::Vector2d> to;
  for (const TagRecord& tag : tags) {
    if (!tag.error) continue;
    from.emplace_back(tag.estimate->head<2>());
    to.emplace_back(tag.truth->head<2>());
  }
  if (from.size() < kFewestToAlign) return;
  const PlanarMotion motion = best_motion(from, to);
  for (TagRecord& tag : tags) {
    if (!tag.error) continue;
    const Eigen::Vector2d aligned = motion * Eigen::Vector2d(tag.estimate->head<2>());
    tag.aligned_error = (aligned - tag.truth->head<2>()).norm();
  }
}

}  // namespace tagfield
