// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/interleaved_tags.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tagfield/localization/each_position.h"
#include "tagfield/localization/holograms/coherent_reads.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/tag_fit.h"

namespace tagfield {
namespace {

constexpr double kNearTravel = 0.5;  ///< Of a cycle, λ/2.
constexpr double kApart = 0.3;       ///< [rad]
constexpr double kLoneBy = 5.0;
constexpr std::size_t kFewestTriples = 60;
constexpr double kMaxLone = 0.3;
constexpr double kMostLoneOfApart = 0.5;

double travel_between(const TagPhases& phases, Eigen::Index i, Eigen::Index j) {
  return std::hypot(phases.x[i] - phases.x[j], phases.y[i] - phases.y[j],
                    phases.z[i] - phases.z[j]);
}

/// Counts the triple of reads `i` to `i` + 2 with these errors [m].
void add(const TagPhases& phases, const TagPhases::Span& span, const Eigen::ArrayXd& errors,
         Eigen::Index i, PhaseTriples& triples) {
  const auto angle = [&](Eigen::Index j, Eigen::Index k) {
    return std::abs(nearest_to_zero(phases, span, errors[j] - errors[k])) * phases.wavenumber[i];
  };
  std::array<double, 3> angles{angle(i, i + 1), angle(i + 1, i + 2), angle(i, i + 2)};
  std::sort(angles.begin(), angles.end());
  ++triples.count;
  if (angles[1] <= kApart) return;
  ++triples.apart;
  if (angles[1] > kLoneBy * angles[0]) ++triples.lone;
}

bool are_of_two_tags(const PhaseTriples& triples) {
  const auto lone = static_cast<double>(triples.lone);
  return triples.count >= kFewestTriples && lone > kMaxLone * static_cast<double>(triples.count) &&
         lone > kMostLoneOfApart * static_cast<double>(triples.apart);
}

}  // namespace

PhaseTriples phase_triples(const TagPhases& phases, const HeightModel& height,
                           const PositionVector& place) {
  const Eigen::ArrayXd errors =
      residuals_of(phases, height, {place, offsets_at(phases, height, place), 0.0});
  PhaseTriples triples;
  for (const TagPhases::Span& span : phases.spans) {
    for (Eigen::Index i = span.begin; i + 2 < span.begin + span.count; ++i) {
      if (travel_between(phases, i, i + 2) > kNearTravel * span.cycle_m) continue;
      add(phases, span, errors, i, triples);
    }
  }
  return triples;
}

void refuse_interleaved_tags(const LocalizationProblem& problem, LocalizationResult& result) {
  for_each_position(problem, result, [&](const SamplesOfTag& samples, TagEstimate& estimate) {
    const TagPhases phases = coherent_reads(problem, samples);
    if (phases.size() == 0) return;
    const HeightModel height = height_model(problem, estimate.tag, phases);
    const PositionVector place = to_unknowns(height, estimate.candidates.front().p_WT);
    if (!are_of_two_tags(phase_triples(phases, height, place))) return;
    estimate = not_located(
        std::move(estimate),
        "the phase jumps back and forth from read to read, as with two tags under one EPC");
  });
}

}  // namespace tagfield
