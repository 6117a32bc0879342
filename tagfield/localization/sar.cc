#include "tagfield/localization/sar.h"

#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

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
  judgement.max_rms_rad = options.max_rms_rad;
  return judge_places(phases, height,
                      search_places(phases, height, options.search, coherent_brightness), judgement,
                      problem.limits, std::move(estimate));
}

}  // namespace

Method sar_method(const SarOptions& options) {
  check(options.search);
  if (!(options.max_rms_rad > 0.0)) throw Error("max_rms_rad must be over 0");
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
