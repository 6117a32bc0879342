// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/judgement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tagfield {
namespace {

/// Largest extent of any antenna's positions, in space and seen from above [m].
struct Extent {
  double whole = 0.0;
  double level = 0.0;
};

Extent extent_in_space(const std::vector<PhaseSample>& samples) {
  if (samples.empty()) return {};
  Eigen::Vector3d low = samples.front().p_WA;
  Eigen::Vector3d high = low;
  for (const PhaseSample& sample : samples) {
    low = low.cwiseMin(sample.p_WA);
    high = high.cwiseMax(sample.p_WA);
  }
  return {(high - low).norm(), (high - low).head<2>().norm()};
}

Extent largest_extent(const SamplesOfTag& samples) {
  Extent largest;
  for (const auto& [antenna, series] : samples) {
    const Extent extent = extent_in_space(series);
    largest.whole = std::max(largest.whole, extent.whole);
    largest.level = std::max(largest.level, extent.level);
  }
  return largest;
}

/// Why the best candidate is not acceptable; empty if it is.
std::string doubt(const EstimateLimits& limits, const Candidate& best) {
  if (best.rms_m > limits.max_rms_m) {
    return fmt::format("the phase does not fit a tag at rest: misfit {:.3f} m, limit {:.3f} m",
                       best.rms_m, limits.max_rms_m);
  }
  if (best.expected_error_m > limits.max_expected_error_m) {
    return best.expected_error_m > 100.0
               ? "geometry too weak: the tag may be anywhere"
               : fmt::format("geometry too weak: expected error {:.2f} m, limit {:.2f} m",
                             best.expected_error_m, limits.max_expected_error_m);
  }
  return "";
}

}  // namespace

double extent_of(const std::vector<PhaseSample>& samples) { return extent_in_space(samples).whole; }

std::size_t count_reads(const SamplesOfTag& samples) {
  std::size_t count = 0;
  for (const auto& [antenna, series] : samples) count += series.size();
  return count;
}

std::string why_not_locatable(const SamplesOfTag& samples) {
  const std::size_t reads = count_reads(samples);
  const Extent extent = largest_extent(samples);
  if (reads == 0) return "no reads that have an antenna pose and a phase";
  if (reads < kFewestReads) {
    return fmt::format("only {} reads, at least {} are needed", reads, kFewestReads);
  }
  if (extent.whole < kStillExtent) {
    return fmt::format("the antenna moved only {:.2f} m", extent.whole);
  }
  if (extent.level < kStillExtent) {
    return fmt::format(
        "geometry too weak: the antenna moved {:.2f} m, but only {:.2f} m of it sideways, so the "
        "tag "
        "may be anywhere around it",
        extent.whole, extent.level);
  }
  return "";
}

bool is_pose_error_unknown(const LocalizationProblem& problem) {
  return !problem.pose_error && problem.drift.empty();
}

bool has_exact_poses(const LocalizationProblem& problem) {
  const auto& error = problem.pose_error;
  return error && error->sigma_m == 0.0 && error->yaw_sigma_rad == 0.0;
}

TagEstimate begun(const std::string& tag, const SamplesOfTag& samples) {
  TagEstimate estimate;
  estimate.tag = tag;
  estimate.reads = count_reads(samples);
  return estimate;
}

TagEstimate not_located(TagEstimate estimate, const std::string& why) {
  estimate.verdict = Verdict::kNotLocated;
  estimate.reason = fmt::format("cannot localize: {}", why);
  estimate.candidates.clear();
  return estimate;
}

void add_error(const Eigen::Matrix2d& covariance, Candidate& candidate) {
  Eigen::Matrix3d horizontal = Eigen::Matrix3d::Zero();
  horizontal.topLeftCorner<2, 2>() = covariance;
  add_error(horizontal, candidate);
}

void add_error(const Eigen::Matrix3d& covariance, Candidate& candidate) {
  if (candidate.covariance) *candidate.covariance += covariance;
  candidate.expected_error_m =
      std::hypot(candidate.expected_error_m, std::sqrt(covariance.topLeftCorner<2, 2>().trace()));
}

void judge(const EstimateLimits& limits, TagEstimate& estimate) {
  const std::string why_not = doubt(limits, estimate.candidates.front());
  if (!why_not.empty()) {
    estimate = not_located(std::move(estimate), why_not);
  } else if (estimate.candidates.size() == 1) {
    estimate.verdict = Verdict::kLocated;
    estimate.reason.clear();
  } else {
    estimate.verdict = Verdict::kAmbiguous;
    estimate.reason = fmt::format(
        "{} positions explain the phase equally well; a turn in the path would distinguish them",
        estimate.candidates.size());
  }
}

}  // namespace tagfield
