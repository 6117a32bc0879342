// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/sar.h"

#include <algorithm>
#include <vector>

namespace tagfield {
namespace {

/// From coarse to fine, and where that leads to no place that most waves agree on, thoroughly.
std::vector<PlaceVector> brightest_places(const TagPhases& phases, const HeightModel& height,
                                          SearchOptions options) {
  constexpr double kMost = 0.85;
  constexpr std::size_t kMoreMaxima = 3;  ///< Times as many, as reflections make many.
  std::vector<PlaceVector> places = search_places(phases, height, options, coherent_light());
  const bool agreed = std::any_of(places.begin(), places.end(), [&](const PlaceVector& place) {
    return coherent_share(phases, height, place) > kMost;
  });
  if (agreed) return places;
  options.thorough = true;
  options.maxima *= kMoreMaxima;
  return search_places(phases, height, options, coherent_light());
}

TagEstimate locate_by_hologram(const LocalizationProblem& problem, const std::string& tag,
                               const SamplesOfTag& samples, const SarOptions& options) {
  CoherentJudgement judgement;
  judgement.min_share = options.min_share;
  const SearchOptions& search = options;
  return locate_by_waves(problem, tag, samples, judgement,
                         [&](const TagPhases& phases, const HeightModel& height) {
                           return brightest_places(phases, height, search);
                         });
}

/// The keys of its options.
const OptionTable<SarOptions>& sar_options() {
  static const OptionTable<SarOptions> of = [] {
    OptionTable<SarOptions> table{{setting<SarOptions>(
        "min_share", "", "minimum coherence; below it a tag is not taken to be at rest",
        &SarOptions::min_share, kShareRange)}};
    add_search_options(table);
    return table;
  }();
  return of;
}

}  // namespace

Method sar_method(const SarOptions& options) {
  return one_by_one("sar", "hologram of a synthetic aperture: phasors added up over a grid",
                    sar_options(), options, locate_by_hologram);
}

}  // namespace tagfield
