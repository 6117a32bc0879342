// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/height_side.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

/// Whether a position with an estimated height is on the other side of all antennas than `side`, by
/// more than three times its vertical error.
bool is_on_wrong_side(HeightSide side, const SamplesOfTag& samples, const Candidate& candidate) {
  constexpr double kDeviations = 3.0;
  constexpr double kLevel = 0.01;  // [m]
  const double variance = candidate.covariance ? (*candidate.covariance)(2, 2) : 0.0;
  const double slack = kLevel + kDeviations * std::sqrt(std::max(variance, 0.0));
  const double up = side == HeightSide::kAbove ? 1.0 : -1.0;
  return std::all_of(samples.begin(), samples.end(), [&](const auto& of_antenna) {
    const std::vector<PhaseSample>& series = of_antenna.second;
    return std::all_of(series.begin(), series.end(), [&](const PhaseSample& sample) {
      return up * (candidate.p_WT.z() - sample.p_WA.z()) < -slack;
    });
  });
}

}  // namespace

void keep_on_height_side(const LocalizationProblem& problem, LocalizationResult& result) {
  for (TagEstimate& estimate : result.estimates) {
    const auto side = side_to_estimate(problem, estimate.tag);
    const auto samples = problem.samples.find(estimate.tag);
    if (!side || samples == problem.samples.end() || estimate.candidates.empty()) continue;
    if (problem.reference_tags.count(estimate.tag) > 0) continue;
    const std::size_t before = estimate.candidates.size();
    const auto wrong = std::remove_if(estimate.candidates.begin(), estimate.candidates.end(),
                                      [&](const Candidate& candidate) {
                                        return is_on_wrong_side(*side, samples->second, candidate);
                                      });
    estimate.candidates.erase(wrong, estimate.candidates.end());
    if (estimate.candidates.size() == before) continue;
    if (estimate.candidates.empty()) {
      estimate = not_located(std::move(estimate),
                             fmt::format("no position {} the antennas explains the reads",
                                         *side == HeightSide::kAbove ? "above" : "below"));
    } else {
      judge(problem.limits, estimate);
    }
  }
}

}  // namespace tagfield
