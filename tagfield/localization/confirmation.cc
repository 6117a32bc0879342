// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/confirmation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tagfield/base/median.h"
#include "tagfield/localization/at_rest.h"
#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/holograms/robust.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

constexpr double kMinPower = 0.5;
constexpr double kDeviations = 3.0;

/// Share of the phases' power explained at the position, in [0, 1].
double explained_power(const LocalizationProblem& problem, const TagEstimate& estimate) {
  const TagPhases phases = coherent_reads(problem, problem.samples.at(estimate.tag));
  if (phases.size() == 0) return 1.0;
  const HeightModel height = height_model(problem, estimate.tag, phases);
  const PositionVector place = to_unknowns(height, estimate.candidates.front().p_WT);
  return std::pow(coherent_share(phases, height, place), 2);
}

bool takes_way_as_coherent(const std::string& method) {
  constexpr const char* kSuch[] = {"hyperbola", "least_squares", "ml", "sar", "dah", "particle"};
  return std::any_of(std::begin(kSuch), std::end(kSuch),
                     [&](const char* name) { return method == name; });
}

bool agree(const Candidate& one, const Candidate& other) {
  return (one.p_WT - other.p_WT).head<2>().norm() <=
         kDeviations * std::hypot(one.expected_error_m, other.expected_error_m);
}

/// Raises the uncertainty of the position to at least that of the confirming one.
void take_doubt(const Candidate& by, Candidate& place) {
  const Eigen::Vector3d off = (by.p_WT - place.p_WT).cwiseProduct(Eigen::Vector3d(1.0, 1.0, 0.0));
  const double error = std::hypot(by.expected_error_m, off.norm());
  if (error <= place.expected_error_m) return;
  place.expected_error_m = error;
  if (by.covariance) place.covariance = *by.covariance + off * off.transpose();
}

/// Indices of the estimates in question.
std::vector<std::size_t> doubtful(const LocalizationProblem& problem,
                                  const LocalizationResult& result) {
  std::vector<std::size_t> numbers = claimed_tags(problem, result);
  std::erase_if(numbers, [&](std::size_t i) {
    return explained_power(problem, result.estimates[i]) >= kMinPower;
  });
  return numbers;
}

/// Indices of the estimates with residuals far larger than those of most others, whose positions or
/// motion the poses corrected with them do not fit.
std::vector<std::size_t> misfitting(const LocalizationProblem& problem,
                                    const LocalizationResult& result) {
  constexpr std::size_t kFewest = 4;
  constexpr double kTimesTheMedian = 2.0;
  const auto misfit_m = [&](std::size_t i) { return result.estimates[i].candidates.front().rms_m; };
  std::vector<std::size_t> numbers = claimed_tags(problem, result);
  if (numbers.size() < kFewest) return {};
  std::vector<double> misfits_m;
  misfits_m.reserve(numbers.size());
  for (const std::size_t i : numbers) misfits_m.push_back(misfit_m(i));
  const double most = kTimesTheMedian * median(misfits_m);
  std::erase_if(numbers, [&](std::size_t i) { return misfit_m(i) <= most; });
  return numbers;
}

bool corrects_poses(const LocalizationProblem& problem, const std::string& method) {
  return method == "joint" && !has_exact_poses(problem);
}

/// Indices of the estimates that a second method must confirm.
std::vector<std::size_t> to_confirm(const LocalizationProblem& problem,
                                    const LocalizationResult& result) {
  if (corrects_poses(problem, result.method)) return misfitting(problem, result);
  const bool as_coherent = result.method == "joint" || takes_way_as_coherent(result.method);
  if (!as_coherent || stated_pose_error(problem)) return {};
  return doubtful(problem, result);
}

}  // namespace

void refuse_unconfirmed(const LocalizationProblem& problem, int threads,
                        LocalizationResult& result) {
  const std::vector<std::size_t> numbers = to_confirm(problem, result);
  if (numbers.empty()) return;
  LocalizationProblem those = problem;
  those.samples.clear();
  for (const std::size_t i : numbers) {
    const std::string& tag = result.estimates[i].tag;
    those.samples[tag] = problem.samples.at(tag);
  }
  Diagnostics unheard;
  const LocalizationResult second = robust_method().locate(those, threads, unheard);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    TagEstimate& estimate = result.estimates[numbers[k]];
    const TagEstimate& other = second.estimates[k];
    if (other.verdict == Verdict::kLocated &&
        agree(estimate.candidates.front(), other.candidates.front())) {
      take_doubt(other.candidates.front(), estimate.candidates.front());
      judge(problem.limits, estimate);
      continue;
    }
    estimate =
        not_located(std::move(estimate),
                    std::string(corrects_poses(problem, result.method)
                                    ? "its residuals are over twice those of most tags"
                                    : "the position explains less than half of the phases' power") +
                        ", and separate sections of the path (method robust) do not confirm it");
  }
}

}  // namespace tagfield
