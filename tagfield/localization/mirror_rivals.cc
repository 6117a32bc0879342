// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/mirror_rivals.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tagfield/base/parallel.h"
#include "tagfield/fit/symmetric.h"
#include "tagfield/localization/fit_candidates.h"
#include "tagfield/localization/height_model.h"
#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/holograms/coherent_reads.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

constexpr double kSamePlace = 0.3;  ///< Positions nearer than this are lobes of one [m].

double apart(const PositionVector& a, const PositionVector& b) { return (a - b).head<2>().norm(); }

/// Mirror image across the plane of the antennas' positions; nullopt if they are further from any
/// plane than an error of the poses explains.
std::optional<Eigen::Vector3d> image_across_plane(const TagPhases& phases, double pose_sigma_m,
                                                  const Eigen::Vector3d& p_WT) {
  constexpr double kDeviations = 3.0;
  Eigen::MatrixX3d positions(phases.size(), 3);
  positions << phases.x, phases.y, phases.z;
  const Eigen::RowVector3d middle = positions.colwise().mean();
  positions.rowwise() -= middle;
  const Eigen::Matrix3d scatter =
      positions.transpose() * positions / static_cast<double>(phases.size());
  const SymmetricEigen<3> axes = symmetric_eigen(scatter);
  if (std::sqrt(std::max(axes.values[0], 0.0)) > kDeviations * pose_sigma_m) return std::nullopt;
  const Eigen::Vector3d normal = axes.vectors.col(0);
  return p_WT - 2.0 * normal.dot(p_WT - middle.transpose()) * normal;
}

/// Mirror image of a position, if the antennas' path has one but for an error of the poses.
std::optional<Eigen::Vector3d> image_of(const TagPhases& phases, const HeightModel& height,
                                        double pose_sigma_m, const Eigen::Vector3d& p_WT) {
  if (height.kind == HeightModel::Kind::kFree)
    return image_across_plane(phases, pose_sigma_m, p_WT);
  if (!may_be_straight(phases, pose_sigma_m)) return std::nullopt;
  Eigen::Vector3d image = p_WT;
  image.head<2>() = mirror_image(phases, p_WT.head<2>());
  return image;
}

/// The maximum of coherence at a position, or the position itself if there is none near it.
PositionVector maximum_at(const TagPhases& phases, const HeightModel& height,
                          const PositionVector& place) {
  const PositionVector top = climb(phases, apertures(phases, kWholeAperture), height, place);
  return apart(top, place) < kSamePlace ? top : place;
}

/// `of_lines`: also across straight paths, not only across planes.
void add_mirror_image(const LocalizationProblem& problem, bool of_lines, TagEstimate& estimate) {
  const auto samples = problem.samples.find(estimate.tag);
  if (samples == problem.samples.end()) return;
  const TagPhases phases = coherent_reads(problem, samples->second);
  if (!too_few(phases).empty()) return;
  const HeightModel height = height_model(problem, estimate.tag, phases);
  if (!of_lines && height.kind != HeightModel::Kind::kFree) return;
  const Eigen::Vector3d& p_WT = estimate.candidates.front().p_WT;
  const auto image = image_of(phases, height, problem.pose_error->sigma_m, p_WT);
  if (!image) return;
  const PositionVector there = maximum_at(phases, height, to_unknowns(height, *image));
  if (apart(there, to_unknowns(height, p_WT)) < kSamePlace) return;
  estimate.candidates.push_back(candidate_at(phases, height, there));
  judge(problem.limits, estimate);
}

}  // namespace

void add_mirror_images(const LocalizationProblem& problem, int threads,
                       LocalizationResult& result) {
  if (!problem.pose_error || problem.pose_error->sigma_m == 0.0) return;
  // Methods that correct poses find the images across lines themselves.
  const bool of_lines = result.corrected_poses.empty();
  parallel_for(result.estimates.size(), threads, [&](std::size_t i) {
    TagEstimate& estimate = result.estimates[i];
    const bool is_reference = problem.reference_tags.count(estimate.tag) > 0;
    if (estimate.verdict == Verdict::kLocated && !is_reference)
      add_mirror_image(problem, of_lines, estimate);
  });
}

}  // namespace tagfield
