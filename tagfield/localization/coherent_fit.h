/// @file
/// Likelihood of places by wrapped phase: the waves of a group, turned back by the phase that a tag
/// there would give, add up to S = Σ e^{j(φ − k r)}. With von Mises noise and the offset unknown
/// the log-likelihood is κ Σ_groups |S| but for constants; with a known offset Re S takes the place
/// of |S|.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/localization/coherent_reads.h"
#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

/// Σ |S| over the groups, Re S where the offset is known; at most the number of reads.
double coherence(const CoherentReads& reads, const std::vector<CoherentGroup>& groups,
                 const HeightModel& model, const FitPlace& place);

/// The local maximum of coherence() near `start`: scoring steps (expected information in place of
/// the Hessian) with Levenberg's damping. Finite for finite input.
FitPlace climb(const CoherentReads& reads, const std::vector<CoherentGroup>& groups,
               const HeightModel& model, const FitPlace& start);

/// Phase less that of a tag at `place`, as distance within ±λ/4, each group's offset removed [m].
Eigen::ArrayXd wrapped_residuals(const CoherentReads& reads, const HeightModel& model,
                                 const FitPlace& place);

/// The place with its covariance: σ² τ N⁻¹ from the residuals' variance and correlation
/// (residuals.h) and the normal matrix N, offsets eliminated. Rows of a height that was given are
/// 0; an estimated q becomes a height by the slope of √q over one standard deviation.
Candidate candidate_at(const CoherentReads& reads, const HeightModel& model, const FitPlace& place);

/// What is done with places that a search found.
struct CoherentJudgement {
  /// A greater rms of the wrapped residuals [rad] is no tag at rest; phases that say nothing have
  /// π/√3 = 1.81.
  double max_rms_rad = 1.2;
  bool climb = true;  ///< Go from each place to the maximum of coherence() near it.
};

/// Finishes: climbs from the places and from mirror images of the best, and gives verdict,
/// candidates (those that the data can't tell from the best) and covariances.
TagEstimate judge_places(const CoherentReads& reads, const HeightModel& model,
                         const std::vector<FitPlace>& places, const CoherentJudgement& judgement,
                         const EstimateLimits& limits, TagEstimate estimate);

}  // namespace tagfield
