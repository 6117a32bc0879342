/// @file
/// Likelihood of places by wrapped phase: the waves of an aperture, turned back by the phase that a
/// tag there would give, add up to S = Σ e^{j(φ − k r)}. With von Mises noise and the offset
/// unknown the log-likelihood is κ Σ |S| but for constants; with a known offset Re S takes the
/// place of |S|.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/localization/coherent_reads.h"
#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

/// Σ |S| over the apertures, Re S where the offset is known; at most the number of reads.
double coherence(const TagPhases& phases, const std::vector<Aperture>& parts,
                 const HeightModel& height, const PlaceVector& place);

/// The local maximum of coherence() near `start`: scoring steps (expected information in place of
/// the Hessian) with Levenberg's damping. Finite for finite input.
PlaceVector climb(const TagPhases& phases, const std::vector<Aperture>& parts,
                  const HeightModel& height, const PlaceVector& start);

/// The place with its covariance (fit_candidates.h).
Candidate candidate_at(const TagPhases& phases, const HeightModel& height,
                       const PlaceVector& place);

/// What is done with places that a search found.
struct CoherentJudgement {
  /// A greater rms of the wrapped residuals [rad] is no tag at rest; phases that say nothing have
  /// π/√3 = 1.81.
  double max_rms_rad = 1.2;
  bool climb = true;  ///< Go from each place to the maximum of coherence() near it.
};

/// Finishes: climbs from the places and from mirror images of the best, and gives verdict,
/// candidates (those that the data can't tell from the best) and covariances.
TagEstimate judge_places(const TagPhases& phases, const HeightModel& height,
                         const std::vector<PlaceVector>& places, const CoherentJudgement& judgement,
                         const EstimateLimits& limits, TagEstimate estimate);

}  // namespace tagfield
