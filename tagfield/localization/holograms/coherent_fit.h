// SPDX-License-Identifier: Apache-2.0
/// @file
/// Likelihood of places by wrapped phase: the waves of an aperture, turned back by the phase that a
/// tag there would give, add up to S = Σ e^{j(φ − k r)}. With von Mises noise and the offset
/// unknown the log-likelihood is κ Σ |S| but for constants; with a known offset Re S takes the
/// place of |S|.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "tagfield/base/setting.h"
#include "tagfield/localization/height_model.h"
#include "tagfield/localization/holograms/coherent_reads.h"
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

/// coherence() of whole apertures over the number of reads, in [0, 1].
double coherent_share(const TagPhases& phases, const HeightModel& height, const PlaceVector& place);

/// At a lesser coherent_share() the phases are not those of one wave with noise: reflections or
/// pose errors bend them.
inline constexpr double kBentShare = 0.97;

/// How many times those of the best use of the phases a method's errors are at a place; at least 1.
using ErrorFactor = std::function<double(const TagPhases& phases, const HeightModel& height,
                                         const PlaceVector& place)>;

/// What is done with places that a search found.
struct CoherentJudgement {
  /// A lesser coherent_share() is no tag at rest; that of phases that say nothing is about 0.1.
  double min_share = 0.35;
  /// Of places that are not maxima of coherence, whose own residuals tell of that too: covariances
  /// are those of the maxima next to them, times the square of this at the best. None where they
  /// are.
  ErrorFactor error_factor;
  bool climb = true;          ///< Go from each place to the maximum of coherence() near it.
  bool at_maxima = true;      ///< The places, climbed to or not, are about those maxima.
  bool known_offsets = true;  ///< Offsets that are known are made use of.
};

/// What a smallest share may be.
inline constexpr ValueRange kShareRange{0.0, true, 1.0};

/// Finishes: climbs from the places and from mirror images of the best, and gives verdict,
/// candidates (those that the data can't tell from the best) and covariances. Where the phases are
/// bent and the places are maxima, those that are e⁻⁴ less likely than the best are dropped, and
/// lobes within 0.3 m of it widen its covariance.
TagEstimate judge_places(const TagPhases& phases, const HeightModel& height,
                         const std::vector<PlaceVector>& places, const CoherentJudgement& judgement,
                         const EstimateLimits& limits, TagEstimate estimate);

/// Where a tag may be, by its phases.
using FindPlaces =
    std::function<std::vector<PlaceVector>(const TagPhases& phases, const HeightModel& height)>;

/// Locates one tag: says why that is hopeless, or lets `find` look for places and judges them.
TagEstimate locate_by_waves(const LocalizationProblem& problem, const std::string& tag,
                            const SamplesOfTag& samples, const CoherentJudgement& judgement,
                            const FindPlaces& find);

}  // namespace tagfield
