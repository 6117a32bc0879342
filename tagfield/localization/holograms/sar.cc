// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/sar.h"

#include <algorithm>
#include <vector>

namespace tagfield {
namespace {

/// Coarse-to-fine search, followed by a thorough one if it finds no position that most phasors
/// agree on.
std::vector<PositionVector> hologram_peaks(const TagPhases& phases, const HeightModel& height,
                                           SearchOptions options) {
  constexpr double kMost = 0.85;
  constexpr std::size_t kMoreMaxima = 3;  ///< Times as many, as reflections cause many.
  std::vector<PositionVector> places = search_positions(phases, height, options, coherent_light());
  const bool agreed = std::any_of(places.begin(), places.end(), [&](const PositionVector& place) {
    return coherent_share(phases, height, place) > kMost;
  });
  if (agreed) return places;
  options.thorough = true;
  options.maxima *= kMoreMaxima;
  return search_positions(phases, height, options, coherent_light());
}

TagEstimate locate_by_hologram(const LocalizationProblem& problem, const std::string& tag,
                               const SamplesOfTag& samples, const SarOptions& options) {
  CoherentJudgement judgement;
  judgement.min_share = options.min_share;
  const SearchOptions& search = options;
  return locate_by_waves(problem, tag, samples, judgement,
                         [&](const TagPhases& phases, const HeightModel& height) {
                           return hologram_peaks(phases, height, search);
                         });
}

/// Keys of the options.
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
