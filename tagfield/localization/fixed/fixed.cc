// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fixed/fixed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tagfield/base/parallel.h"
#include "tagfield/localization/fixed/internal/fixed_scene.h"
#include "tagfield/localization/fixed/internal/phase_field.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

constexpr double kMostOfArea = 0.7;  ///< Maximum expected error, in spreads of the area.

Candidate candidate_of(const PosteriorPart& part, double height) {
  Candidate candidate;
  candidate.p_WT = {part.mean.x(), part.mean.y(), height};
  candidate.covariance = Eigen::Matrix3d::Zero();
  candidate.covariance->topLeftCorner<2, 2>() = part.covariance;
  candidate.expected_error_m = std::sqrt(part.covariance.trace());
  return candidate;
}

constexpr const char* kHelp =
    "another antenna, a tag at a known position, or the area where tags can be (--box) would help";

TagEstimate located(const LocalizationProblem& problem, const FixedScene& scene, std::size_t number,
                    const FixedOptions& options) {
  const FixedTag& tag = scene.tags[number];
  TagEstimate estimate = begun(*tag.name, *tag.samples);
  if (!tag.why_not.empty()) return not_located(std::move(estimate), tag.why_not);
  if (!scene.swapped.empty()) {
    return not_located(std::move(estimate),
                       fmt::format("RSSI fits far better with the positions of antennas {} "
                                   "exchanged: are ports or poses mixed up?",
                                   scene.swapped));
  }
  if (scene.law.evidence < kMinLogEvidence) {
    return not_located(
        std::move(estimate),
        fmt::format("RSSI of all tags shows no significant dependence on distance; {}", kHelp));
  }
  const AreaCells cells{tag.grid.places.cells, tag.cell_m};
  const double height = plane_height(problem, *tag.name);
  for (const PosteriorPart& part :
       posterior_parts(cells, density_of(scene, number, scene.trust, options))) {
    estimate.candidates.push_back(candidate_of(part, height));
  }
  const double most = std::min(options.max_expected_error_m, kMostOfArea * tag.spread_m);
  const double error = estimate.candidates.front().expected_error_m;
  if (error > most) {
    return not_located(std::move(estimate), fmt::format("expected error {:.2f} m, limit {:.2f} m; "
                                                        "{}",
                                                        error, most, kHelp));
  }
  EstimateLimits limits;
  limits.max_expected_error_m = most;
  limits.max_rms_m = std::numeric_limits<double>::infinity();
  judge(limits, estimate);
  if (estimate.verdict == Verdict::kAmbiguous) {
    estimate.reason =
        fmt::format("{} positions explain RSSI and phases; {}", estimate.candidates.size(), kHelp);
  }
  return estimate;
}

LocalizationResult locate_from_fixed(const LocalizationProblem& problem, int threads,
                                     Diagnostics& diagnostics, const FixedOptions& options) {
  const FixedScene scene = fixed_scene(problem, threads, options);
  if (scene.out_of_order) {
    diagnostics.warn(
        "the phases are not used: they contradict the given order of the channels. The reader's "
        "own hop table has the right one; positions use RSSI only");
  } else if (problem.has_phases && scene.offsets.empty()) {
    diagnostics.warn(
        "the phases are not used: every channel of every port has its own offset, which only a tag "
        "at a known position that all antennas read (--reference) or a calibration (--calibration) "
        "would give; positions use RSSI only");
  }
  LocalizationResult result;
  result.method = "fixed";
  result.estimates.resize(scene.tags.size());
  parallel_for(scene.tags.size(), threads, [&](std::size_t i) {
    const auto known = problem.reference_tags.find(*scene.tags[i].name);
    result.estimates[i] = known != problem.reference_tags.end()
                              ? reference_estimate(known->first, known->second)
                              : located(problem, scene, i, options);
  });
  return result;
}

/// Keys of the options.
const OptionTable<FixedOptions>& fixed_options() {
  using O = FixedOptions;
  static const OptionTable<O> of{with_lobe<O>(
      {setting<O>("slope_db", "dB", "by which RSSI falls for ten times the distance", &O::slope_db,
                  kOverZero),
       setting<O>("slope_sigma_db", "dB", "prior standard deviation of that", &O::slope_sigma_db,
                  kAtLeastZero),
       setting<O>("tag_sigma_db", "dB", "standard deviation between tags of one kind",
                  &O::tag_sigma_db, kAtLeastZero),
       setting<O>("antenna_sigma_db", "dB", "standard deviation between antennas, cables included",
                  &O::antenna_sigma_db, kAtLeastZero),
       setting<O>("fading_db", "dB", "prior scatter of RSSI by reflections", &O::fading_db,
                  kOverZero),
       setting<O>("max_range_m", "m", "maximum distance from which a tag is read", &O::max_range_m,
                  kOverZero),
       setting<O>("rssi_max_error_m", "m",
                  "with a larger expected error a tag is not given as located",
                  &O::max_expected_error_m, kOverZero)})};
  return of;
}

}  // namespace

Method fixed_method(const FixedOptions& options) {
  return ignoring(
      {"offset", "pose_error", "max_expected_error_m", "max_rms_m"},
      method_with("fixed", "antennas at rest: RSSI by a law that tags share, phases over channels",
                  fixed_options(), options, locate_from_fixed));
}

}  // namespace tagfield
