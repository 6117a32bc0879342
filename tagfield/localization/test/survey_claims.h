// SPDX-License-Identifier: Apache-2.0
/// @file
/// What methods claim about the tags of synthetic surveys (made_survey.h), and how right that is.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "tagfield/localization/locate.h"
#include "tagfield/localization/test/made_survey.h"
#include "tagfield/localization/test/method_study.h"

namespace tagfield::made {

/// Counts over tags of unknown position.
struct Claims {
  int tags = 0;
  int located = 0;
  int ambiguous = 0;
  int ambiguous_with_truth = 0;  ///< Some candidate is within 0.3 m.
  int false_ones = 0;            ///< Over five expected errors off.
  double squares = 0.0;          ///< Σ (error/expected)².
  double worst = 0.0;            ///< The largest error/expected.

  /// Root mean square of error/expected; 1 if the expected errors are right.
  [[nodiscard]] double calibration() const { return std::sqrt(squares / std::max(located, 1)); }

  void add(const TagEstimate& estimate, const Eigen::Vector3d& p_WT) {
    constexpr double kFalse = 5.0;
    ++tags;
    if (estimate.verdict == Verdict::kAmbiguous) {
      ++ambiguous;
      if (nearest(estimate, p_WT) < 0.3) ++ambiguous_with_truth;
    }
    if (estimate.verdict != Verdict::kLocated) return;
    const Candidate& best = estimate.candidates.front();
    const double ratio = level_error(best, p_WT) / best.expected_error_m;
    ++located;
    if (ratio > kFalse) ++false_ones;
    squares += ratio * ratio;
    worst = std::max(worst, ratio);
  }
};

/// Adds what a built-in method claims about a survey.
inline void add_claims(const std::string& method, const Survey& survey, Claims& claims) {
  LocalizationOptions options;
  options.method = method;
  options.known = survey.known;
  Diagnostics diagnostics;
  const auto result = locate_tags(survey.reads, survey.poses, options, diagnostics);
  for (const TagEstimate& estimate : result.estimates) {
    if (survey.known.reference_tags.count(estimate.tag) > 0) continue;
    claims.add(estimate, survey.truth.at(estimate.tag));
  }
}

}  // namespace tagfield::made
