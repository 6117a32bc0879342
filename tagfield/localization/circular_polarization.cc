// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/circular_polarization.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tagfield/base/parallel.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/wire_fit.h"

namespace tagfield {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Misfits that differ by less, in units of the noise of independent reads, are not distinguished.
constexpr double kAsGood = 9.0;

/// The tag's samples with the phase rotations removed.
SamplesOfTag turned_back(const LocalizationProblem& problem, const SamplesOfTag& given,
                         const Vector3d& p_WT, const Vector3d& axis_W) {
  SamplesOfTag samples = given;
  for (auto& [antenna, series] : samples) {
    const std::optional<KnownHand> known = known_hand(problem, antenna);
    if (!known) continue;
    for (PhaseSample& sample : series) {
      const RigidTransform X_WA = held_pose_at(known->track->X_WA, sample.stamp);
      const double turn = polarization_turn(known->hand, X_WA.rotation.toRotationMatrix(),
                                            p_WT - sample.p_WA, axis_W);
      sample.phase_rad = wrap_to_two_pi(sample.phase_rad - problem.multiple() * turn);
    }
  }
  return samples;
}

std::optional<PolarizationAllowance> allowance_of(const LocalizationProblem& problem,
                                                  const TagEstimate& estimate) {
  const PolarizedReads reads = polarized_reads(problem, estimate.tag);
  const bool any =
      std::any_of(reads.hand.begin(), reads.hand.end(), [](double hand) { return hand != 0.0; });
  if (!any || static_cast<std::size_t>(reads.phases.size()) < kFewestReads + kFewestSpare) {
    return std::nullopt;
  }
  std::vector<WireFits> at_candidates;
  for (const Candidate& candidate : estimate.candidates) {
    WireFits all = fit_wire(reads, candidate.p_WT);
    if (!all.fits.empty()) at_candidates.push_back(std::move(all));
  }
  if (at_candidates.empty()) return std::nullopt;
  const auto best = std::min_element(at_candidates.begin(), at_candidates.end(),
                                     [](const WireFits& a, const WireFits& b) {
                                       return a.fits.front().cost < b.fits.front().cost;
                                     });
  for (const WireFits& other : at_candidates) {
    if (&other == &*best) continue;
    const double worse = other.fits.front().cost - best->fits.front().cost;
    if (worse < kAsGood * best->noise_m2) return std::nullopt;
  }
  const WirePoint& fit = best->fits.front();
  PolarizationAllowance allowance;
  if (!is_clean(reads, fit)) {
    allowance.added = added_by_any_wire(reads, estimate.candidates.front().p_WT);
    return allowance;
  }
  allowance.added = added_by_wire(reads.height, *best);
  allowance.samples = turned_back(problem, problem.samples.at(estimate.tag),
                                  to_position(reads.height, fit.place), fit.axis_W);
  return allowance;
}

}  // namespace

double polarization_turn(Hand hand, const Matrix3d& R_WA, const Vector3d& way_W,
                         const Vector3d& axis_W) {
  const Vector3d u = way_W / std::max(way_W.norm(), 0.01);
  return -2.0 * std::arg(crossed_wires_on(sign_of(hand), R_WA, u, axis_W));
}

PolarizationAllowances allow_for_polarization(const LocalizationProblem& problem,
                                              const LocalizationResult& result, int threads) {
  std::vector<std::optional<PolarizationAllowance>> of_tags(result.estimates.size());
  parallel_for(of_tags.size(), threads, [&](std::size_t i) {
    const TagEstimate& estimate = result.estimates[i];
    if (estimate.candidates.empty() || problem.samples.count(estimate.tag) == 0) return;
    if (problem.reference_tags.count(estimate.tag) > 0) return;
    of_tags[i] = allowance_of(problem, estimate);
  });
  PolarizationAllowances all;
  for (std::size_t i = 0; i < of_tags.size(); ++i) {
    if (of_tags[i]) all[result.estimates[i].tag] = std::move(*of_tags[i]);
  }
  return all;
}

void add_polarization_error(const PolarizationAllowances& allowances, const EstimateLimits& limits,
                            LocalizationResult& result) {
  for (TagEstimate& estimate : result.estimates) {
    const auto allowance = allowances.find(estimate.tag);
    if (allowance == allowances.end() || estimate.candidates.empty()) continue;
    for (Candidate& candidate : estimate.candidates) add_error(allowance->second.added, candidate);
    if (estimate.verdict == Verdict::kLocated) judge(limits, estimate);
  }
}

}  // namespace tagfield
