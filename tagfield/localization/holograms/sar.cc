#include "tagfield/localization/holograms/sar.h"

#include <algorithm>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

/// From coarse to fine, and where that leads to no place that most waves agree on, thoroughly.
std::vector<PlaceVector> brightest_places(const TagPhases& phases, const HeightModel& height,
                                          SearchOptions options) {
  constexpr double kMost = 0.85;
  constexpr std::size_t kMoreMaxima = 3;  ///< Times as many, as reflections make many.
  std::vector<PlaceVector> places = search_places(phases, height, options, coherent_brightness);
  const bool agreed = std::any_of(places.begin(), places.end(), [&](const PlaceVector& place) {
    return coherent_share(phases, height, place) > kMost;
  });
  if (agreed) return places;
  options.thorough = true;
  options.maxima *= kMoreMaxima;
  return search_places(phases, height, options, coherent_brightness);
}

TagEstimate locate_by_hologram(const LocalizationProblem& problem, const std::string& tag,
                               const SamplesOfTag& samples, const SarOptions& options) {
  TagEstimate estimate;
  estimate.tag = tag;
  estimate.reads = count_reads(samples);
  const std::string hopeless = why_hopeless(samples);
  if (!hopeless.empty()) return not_located(std::move(estimate), hopeless);
  const TagPhases phases = coherent_reads(problem, samples);
  estimate.reads = static_cast<std::size_t>(phases.size());
  const std::string why_too_few = too_few(phases);
  if (!why_too_few.empty()) return not_located(std::move(estimate), why_too_few);
  const HeightModel height = height_model(problem, tag, phases);
  CoherentJudgement judgement;
  judgement.min_share = options.min_share;
  return judge_places(phases, height, brightest_places(phases, height, options.search), judgement,
                      problem.limits, std::move(estimate));
}

}  // namespace

Method sar_method(const SarOptions& options) {
  check(options.search);
  check_share(options.min_share);
  const auto locate = [options](const LocalizationProblem& problem, int threads, Diagnostics&) {
    LocalizationResult result;
    result.method = "sar";
    result.estimates =
        locate_each(problem, threads, [&](const std::string& tag, const SamplesOfTag& samples) {
          return locate_by_hologram(problem, tag, samples, options);
        });
    return result;
  };
  return {"sar", "hologram of a synthetic aperture: waves added up over a grid", locate};
}

}  // namespace tagfield
