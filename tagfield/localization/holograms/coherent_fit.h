// SPDX-License-Identifier: Apache-2.0
/// @file
/// Likelihood of positions from wrapped phase: the phasors of an aperture, rotated back by the
/// phase expected from a tag at the position, add up to S = Σ e^{j(φ − k r)}. With von Mises noise
/// and an unknown offset, the log-likelihood is κ Σ |S| up to constants; with a known offset, Re S
/// replaces |S|.
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
                 const HeightModel& height, const PositionVector& place);

/// The local maximum of coherence() near `start`: scoring steps (expected information in place of
/// the Hessian) with Levenberg's damping. Finite for finite input.
PositionVector climb(const TagPhases& phases, const std::vector<Aperture>& parts,
                     const HeightModel& height, const PositionVector& start);

/// The position with its covariance (fit_candidates.h), larger where a stated pose error turns
/// phases by a radian.
Candidate candidate_at(const TagPhases& phases, const HeightModel& height,
                       const PositionVector& place);

/// coherence() of whole apertures over the number of reads, in [0, 1].
double coherent_share(const TagPhases& phases, const HeightModel& height,
                      const PositionVector& place);

/// Below this coherent_share(), the phases are not those of a single wave with noise: reflections
/// or pose errors distort them.
inline constexpr double kBentShare = 0.97;

/// Ratio of a method's error at a position to that of an optimal estimator from the same phases; at
/// least 1.
using ErrorFactor = std::function<double(const TagPhases& phases, const HeightModel& height,
                                         const PositionVector& place)>;

/// How the positions found by a search are refined and judged.
struct CoherentJudgement {
  /// Minimum coherent_share() of a tag at rest; that of random phases is about 0.1.
  double min_share = 0.35;
  /// For methods whose positions are not maxima of coherence, which inflates their residuals:
  /// covariances are those of the nearest maxima, times the square of this factor at the best
  /// position. Empty if the positions are maxima.
  ErrorFactor error_factor;
  bool climb = true;          ///< Climb from each position to the nearest maximum of coherence().
  bool at_maxima = true;      ///< The positions are near those maxima, with or without the climb.
  bool known_offsets = true;  ///< Use known offsets.
};

/// Valid range of a minimum share.
inline constexpr ValueRange kShareRange{0.0, true, 1.0};

/// Final step: climbs from the positions and from mirror images of the best, and sets verdict,
/// candidates (those that the data cannot distinguish from the best) and covariances. Where the
/// phases are distorted and the positions are maxima, those less likely than the best by a factor
/// of e⁻⁴ are dropped, and lobes within 0.3 m of it widen its covariance.
TagEstimate judge_places(const TagPhases& phases, const HeightModel& height,
                         const std::vector<PositionVector>& places,
                         const CoherentJudgement& judgement, const EstimateLimits& limits,
                         TagEstimate estimate);

/// Finds possible positions of a tag from its phases.
using FindPlaces =
    std::function<std::vector<PositionVector>(const TagPhases& phases, const HeightModel& height)>;

/// Locates one tag: reports why that is hopeless, or searches for positions with `find` and judges
/// them.
TagEstimate locate_by_waves(const LocalizationProblem& problem, const std::string& tag,
                            const SamplesOfTag& samples, const CoherentJudgement& judgement,
                            const FindPlaces& find);

}  // namespace tagfield
