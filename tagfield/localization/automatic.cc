// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/automatic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "tagfield/base/parallel.h"
#include "tagfield/localization/drift.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/outliers.h"
#include "tagfield/localization/phase_curves/least_squares.h"
#include "tagfield/localization/residuals.h"
#include "tagfield/localization/scan/scan_field.h"
#include "tagfield/localization/signal_strength/landmarc.h"

namespace tagfield {
namespace {

/// Methods that may be chosen.
constexpr const char* kChosen[] = {
    "joint", "ml", "sar", "robust", "multipath", "scan", "trilateration", "fixed", "landmarc"};
constexpr std::size_t kLooks = 20;  ///< Number of tags examined.
/// Reads; with fewer per segment, unwrapping leaves little.
constexpr double kShortSegment = 12.0;
constexpr double kMost = 0.5;  ///< Share of the reads examined.
/// Correlation factor beyond which residuals are more than noise: noise alone leaves 1 to 1.5,
/// reflections 5 and more over decimetres.
constexpr double kSlow = 3.0;
/// Ratio of misfit to noise beyond which there is more than noise. For the joint estimate it is 0.7
/// to 0.9 with all sorts of pose errors, 2.6 to 3.7 in a hall with reflections
/// (docs/estimators.md).
constexpr double kLeftOver = 1.6;

/// Lower median: of two tags a single odd one is no sign of reflections. 0 for an empty list.
double lesser_median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto half = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), half, values.end());
  return *half;
}

/// Findings for one tag.
struct Look {
  double reads = 0.0;
  double segments = 0.0;
  double misfit = -1.0;  ///< Divided by the noise; negative if there is no fit.
  double noise_m = 0.0;  ///< Of a single read.
  double samples = 0.0;  ///< Total number of reads, for a tag that might be located.
  bool is_short_scan = false;
  bool has_outliers = false;
  double reads_worth_one = 1.0;  ///< Correlation factor of the residuals at the brightest position.
};

void look_at_brightest(const LocalizationProblem& problem, const std::string& tag,
                       const SamplesOfTag& samples, Look& look) {
  look.is_short_scan = scan_field(problem, tag, samples).why_not.empty();
  const HologramPeak there = hologram_peak(problem, tag, samples);
  if (there.residuals_rad.size() == 0) return;
  look.reads_worth_one = there.reads_worth_one;
  look.has_outliers = outliers_at(there).has_value();
}

Look look_at(const LocalizationProblem& problem, const std::string& tag,
             const SamplesOfTag& samples) {
  const UnwrappedFit fit = fit_unwrapped(problem, tag, samples);
  Look look;
  if (why_not_locatable(samples).empty()) look.samples = static_cast<double>(count_reads(samples));
  look.reads = static_cast<double>(fit.reads_followed);
  look.segments = static_cast<double>(fit.segments);
  look_at_brightest(problem, tag, samples, look);
  if (!fit.why_not.empty()) return look;
  const Eigen::ArrayXd errors = residuals_of(fit.phases, fit.height, fit.fits.front());
  look.noise_m = std::max(noise_of_one(fit.phases.spans, errors), 1e-6);
  look.misfit = std::sqrt(errors.square().mean()) / look.noise_m;
  return look;
}

/// Up to kLooks of the tags, evenly spread.
std::vector<const SamplesByTag::value_type*> some_tags(const LocalizationProblem& problem) {
  std::vector<const SamplesByTag::value_type*> all;
  for (const auto& entry : problem.samples) all.push_back(&entry);
  std::vector<const SamplesByTag::value_type*> some;
  const std::size_t count = std::min(kLooks, all.size());
  for (std::size_t i = 0; i < count; ++i) some.push_back(all[i * all.size() / count]);
  return some;
}

void add_scans(const std::vector<Look>& looks, DataTraits& traits) {
  double all = 0.0;
  double scans = 0.0;
  double unexplained = 0.0;
  double spoilt = 0.0;
  double bent = 0.0;
  for (const Look& look : looks) {
    all += look.samples;
    if (look.has_outliers) spoilt += look.samples;
    if (look.reads_worth_one > kSlow) bent += look.samples;
    if (!look.is_short_scan) continue;
    scans += look.samples;
    if (look.reads_worth_one > kSlow) unexplained += look.samples;
  }
  traits.short_scans = all > 0.0 ? scans / all : 0.0;
  traits.has_outliers = spoilt > kMost * all;
  traits.bent = all > 0.0 ? bent / all : 0.0;
  traits.unexplained = scans > 0.0 ? unexplained / scans : 0.0;
}

void look_at_all(const LocalizationProblem& problem, DataTraits& traits) {
  traits.has_phases = problem.has_phases;
  std::set<double> carriers;
  for (const auto& [tag, of_tag] : problem.samples) {
    traits.has_reads = traits.has_reads || count_reads(of_tag) >= kFewestReads;
    traits.antennas = std::max(traits.antennas, of_tag.size());
    for (const auto& [antenna, series] : of_tag) {
      traits.antennas_move = traits.antennas_move || extent_of(series) >= kStillExtent;
      // Those before and after a jump differ by 1 mHz (phase_jumps.h).
      for (const PhaseSample& sample : series) carriers.insert(std::round(sample.frequency_hz));
    }
  }
  traits.channels = carriers.size();
}

/// Misfit, divided by the noise, of tags with candidates or refused together.
double misfit_left(const LocalizationResult& result, double noise_m) {
  std::vector<double> misfits = result.misfits_m;
  for (const TagEstimate& estimate : result.estimates) {
    if (!estimate.candidates.empty()) misfits.push_back(estimate.candidates.front().rms_m);
  }
  return noise_m > 0.0 ? lesser_median(std::move(misfits)) / noise_m : 0.0;
}

LocalizationProblem without_outliers(const LocalizationProblem& given, int threads,
                                     Diagnostics& diagnostics) {
  LocalizationProblem cleaned = given;
  std::vector<SamplesByTag::value_type*> tags;
  std::size_t all = 0;
  for (auto& entry : cleaned.samples) {
    tags.push_back(&entry);
    all += count_reads(entry.second);
  }
  std::vector<std::size_t> removed(tags.size());
  parallel_for(tags.size(), threads, [&](std::size_t i) {
    removed[i] = remove_outliers(given, tags[i]->first, tags[i]->second);
  });
  const double share =
      static_cast<double>(std::accumulate(removed.begin(), removed.end(), std::size_t{0})) /
      static_cast<double>(std::max<std::size_t>(all, 1));
  warn_of_outliers(share, diagnostics);
  return cleaned;
}

/// Number of tags located in the result.
std::size_t places_in(const LocalizationResult& result) {
  return static_cast<std::size_t>(std::count_if(
      result.estimates.begin(), result.estimates.end(),
      [](const TagEstimate& estimate) { return estimate.verdict == Verdict::kLocated; }));
}

/// Tries `joint`: unlike adding up phasors, it estimates the pose error, so that the phase may be
/// tracked even over short segments. Accepted if it leaves no more than noise and locates no fewer
/// tags.
void try_jointly(const std::vector<Method>& methods, const LocalizationProblem& problem,
                 const DataTraits& traits, int threads, Diagnostics& diagnostics, Choice& choice,
                 LocalizationResult& result) {
  Diagnostics of_joint;
  LocalizationResult joint = find_method(methods, "joint").locate(problem, threads, of_joint);
  if (places_in(joint) < std::max<std::size_t>(places_in(result), 1)) return;
  // If no phases could be tracked, there is no noise estimate to compare with.
  if (!(traits.noise_m > 0.0) || misfit_left(joint, traits.noise_m) > kLeftOver) return;
  for (const std::string& warning : of_joint.warnings()) diagnostics.warn(warning);
  result = std::move(joint);
  choice = {"joint", fmt::format("the pose is not exact, and with its error estimated the phases "
                                 "can be followed, over {:.0f} reads on average",
                                 traits.reads_per_segment)};
}

/// Uses all reads as given: phases that jump where waves cancel are not outliers.
LocalizationResult locate_robustly(const std::vector<Method>& methods,
                                   const LocalizationProblem& given, double misfit, int threads,
                                   Diagnostics& diagnostics, Choice& choice) {
  choice = {"robust", fmt::format("even with the pose error estimated the misfit is {:.1f} times "
                                  "the noise, as with reflections",
                                  misfit)};
  return find_method(methods, choice.method).locate(given, threads, diagnostics);
}

/// Largest number of tags located with a known world unless requested: each takes seconds.
constexpr std::size_t kMaxThroughWorld = 100;

/// Drift of the poses while a tag is read beyond which whole cycles between parts of the path are
/// not observable, as for `ml`: `multipath` searches for tags along the path as it is believed.
constexpr double kMaxDrift = 1.0 / 24.0;  // [wavelengths]

bool drifts_too_far(const LocalizationProblem& problem, Diagnostics& diagnostics) {
  if (usual_drift_in_wavelengths(problem) <= kMaxDrift) return false;
  diagnostics.warn(
      "the world is known, but its reflections are not traced: the wheels usually drift by over a "
      "24th of a wavelength while a tag is read, and 'multipath' starts from the path as believed");
  return true;
}

/// Whether a known world is available and may be used.
bool is_through_world(const AutomaticOptions& options, const LocalizationProblem& problem,
                      const DataTraits& traits, Diagnostics& diagnostics) {
  if (!options.known_world) return false;
  if (!problem.trace && options.wants_known_world) {
    diagnostics.warn(
        "known_world has no effect: there is no world whose paths could be traced (a scenario with "
        "model: multipath has one)");
  }
  if (!problem.trace || !traits.antennas_move || !traits.has_phases) return false;
  if (drifts_too_far(problem, diagnostics)) return false;
  if (problem.samples.size() <= kMaxThroughWorld || options.wants_known_world) return true;
  diagnostics.warn(
      fmt::format("the world is known, but tracing its reflections for more than {} tags takes "
                  "long: {} are located without it (known_world: true uses it nevertheless)",
                  kMaxThroughWorld, problem.samples.size()));
  return false;
}

/// Warns of limits that were set although the chosen method has its own.
void warn_of_limits(const Method& chosen, const EstimateLimits& limits, Diagnostics& diagnostics) {
  constexpr EstimateLimits kUsual;
  const auto warn = [&](const char* key, double limit, double usual) {
    if (limit == usual || !all_ignore({chosen}, key)) return;
    diagnostics.warn(
        fmt::format("{} has no effect with {}, which was chosen and has its own limit, "
                    "rssi_max_error_m",
                    key, chosen.name));
  };
  warn("max_expected_error_m", limits.max_expected_error_m, kUsual.max_expected_error_m);
  warn("max_rms_m", limits.max_rms_m, kUsual.max_rms_m);
}

/// By `multipath`; nullopt if no phases fit the known world.
std::optional<LocalizationResult> located_through_world(const std::vector<Method>& methods,
                                                        const LocalizationProblem& given,
                                                        int threads, Diagnostics& diagnostics) {
  std::optional<LocalizationResult> result =
      find_method(methods, "multipath").locate(given, threads, diagnostics);
  result->why =
      "the world is known, and the effect of its reflections on the phases is traced "
      "(known_world: false locates without it)";
  if (result->explained.empty()) result.reset();
  return result;
}

/// Chooses among these and runs the chosen one.
LocateFunction among(const std::vector<Method>& methods, const AutomaticOptions& options) {
  return
      [methods, options](const LocalizationProblem& given, int threads, Diagnostics& diagnostics) {
        DataTraits traits = traits_of(given, threads);
        if (is_through_world(options, given, traits, diagnostics)) {
          auto through_world = located_through_world(methods, given, threads, diagnostics);
          if (through_world) return *std::move(through_world);
        }
        LocalizationProblem cleaned;
        // Amid reflections phases jump where the field fades: those are no outliers.
        const auto is_bent = [&] {
          const std::string method = choose_method(traits, given.reference_tags.size()).method;
          return method == "scan" || method == "robust";
        };
        Diagnostics of_choice;
        if (traits.has_outliers) {
          Diagnostics of_cleaning;
          cleaned = without_outliers(given, threads, of_cleaning);
          const DataTraits as_given = std::exchange(traits, traits_of(cleaned, threads));
          if (is_bent()) {
            cleaned = {};
            traits = as_given;
          } else {
            of_choice = std::move(of_cleaning);
          }
        }
        const LocalizationProblem& problem = cleaned.samples.empty() ? given : cleaned;
        Choice choice = choose_method(traits, problem.reference_tags.size());
        LocalizationResult result =
            find_method(methods, choice.method).locate(problem, threads, of_choice);
        const double misfit = choice.method == "joint" ? misfit_left(result, traits.noise_m) : 0.0;
        if (misfit > kLeftOver) {
          of_choice = {};
          result = locate_robustly(methods, given, misfit, threads, of_choice, choice);
        }
        for (const std::string& warning : of_choice.warnings()) diagnostics.warn(warning);
        const bool is_by_waves = choice.method == "sar" || choice.method == "robust";
        if (is_by_waves && misfit == 0.0 && !traits.pose_is_exact) {
          try_jointly(methods, problem, traits, threads, diagnostics, choice, result);
        }
        warn_of_limits(find_method(methods, choice.method), given.limits, diagnostics);
        result.why = choice.why;
        return result;
      };
}

}  // namespace

DataTraits traits_of(const LocalizationProblem& problem, int threads) {
  DataTraits traits;
  look_at_all(problem, traits);
  traits.pose_is_exact = problem.pose_error && problem.pose_error->sigma_m <= 0.0 &&
                         problem.pose_error->yaw_sigma_rad <= 0.0;
  if (!traits.antennas_move || !traits.has_phases) return traits;
  const auto tags = some_tags(problem);
  std::vector<Look> looks(tags.size());
  parallel_for(tags.size(), threads, [&](std::size_t i) {
    looks[i] = look_at(problem, tags[i]->first, tags[i]->second);
  });
  double all = 0.0;
  double reads = 0.0;
  double segments = 0.0;
  std::vector<double> misfits;
  std::vector<double> noises;
  add_scans(looks, traits);
  for (const Look& look : looks) {
    all += look.samples;
    reads += look.reads;
    segments += look.segments;
    if (look.misfit < 0.0) continue;
    misfits.push_back(look.misfit);
    noises.push_back(look.noise_m);
  }
  traits.reads_per_segment = segments > 0.0 ? reads / segments : 0.0;
  traits.followed = all > 0.0 ? reads / all : 1.0;
  traits.misfit = lesser_median(std::move(misfits));
  traits.noise_m = lesser_median(std::move(noises));
  return traits;
}

Choice choose_method(const DataTraits& traits, std::size_t reference_tags) {
  if (!traits.has_reads) return {"ml", "too few reads of any tag to choose by"};
  // With three or more antennas, a path-loss law locates tags better than neighbouring tags do.
  if (!traits.antennas_move && traits.antennas < 3 && reference_tags >= kFewestReferenceTags) {
    return {"landmarc",
            "at most two antennas, at rest, and there are reference tags to compare with"};
  }
  if (!traits.antennas_move) {
    return {"fixed",
            "the antennas are at rest: RSSI gives distances, as do phases over channels where "
            "their offsets are known"};
  }
  if (!traits.has_phases) return {"trilateration", "the reads have no phases"};
  if (traits.short_scans >= kMost && traits.unexplained >= kMost) {
    return {"scan",
            fmt::format(
                "a short straight scan, and {:.0f} % of its phases are biased, as by reflections",
                100.0 * traits.unexplained)};
  }
  const bool is_short = traits.reads_per_segment < kShortSegment;
  if ((is_short || traits.followed < kMost) && traits.bent >= kMost) {
    return {"robust", fmt::format("{:.0f} % of the phases are biased, as by reflections",
                                  100.0 * traits.bent)};
  }
  if (is_short) {
    return {"sar", fmt::format("the phase can be followed over {:.0f} reads on average only, with "
                               "{} channels: phasors are added up without unwrapping",
                               traits.reads_per_segment, traits.channels)};
  }
  if (traits.followed < kMost) {
    return {"sar", fmt::format("the phases of {:.0f} % of the reads are too noisy to be followed: "
                               "phasors are added up without unwrapping",
                               100.0 * (1.0 - traits.followed))};
  }
  if (!traits.pose_is_exact) {
    return {"joint", "the pose is not exact: its error is estimated with the tags"};
  }
  if (traits.misfit > kLeftOver) {
    return {
        "robust",
        fmt::format("with an exact pose the misfit is {:.1f} times the noise, as with reflections",
                    traits.misfit)};
  }
  return {"ml", "the pose is exact and the phase fits"};
}

namespace {

const OptionTable<AutomaticOptions>& automatic_options() {
  using O = AutomaticOptions;
  static const OptionTable<O> of{{setting<O>(
      "known_world", "multipath where a scenario's world is known, since its reads follow from it",
      &O::known_world)}};
  return of;
}

/// The settings that are its own.
MethodSettings own_settings(const MethodSettings& settings) {
  const std::vector<SettingHelp> own = helps_of(automatic_options().table);
  MethodSettings some;
  std::copy_if(settings.begin(), settings.end(), std::back_inserter(some),
               [&](const RawParameter& setting) { return has_key(own, setting.key); });
  return some;
}

}  // namespace

Method automatic_method(const std::vector<Method>& methods) {
  std::vector<Method> chosen;
  for (const char* const name : kChosen) chosen.push_back(find_method(methods, name));
  Method automatic{"auto", "one of the others, chosen by the data and named with the reason",
                   among(chosen, {}), helps_of(automatic_options().table)};
  for (const Method& method : chosen) {
    for (const SettingHelp& help : method.settings) {
      if (!has_key(automatic.settings, help.key)) automatic.settings.push_back(help);
    }
  }
  automatic.with = [chosen](const MethodSettings& settings) {
    std::vector<Method> set;
    set.reserve(chosen.size());
    for (const Method& method : chosen) set.push_back(configured(method, settings));
    const MethodSettings own = own_settings(settings);
    AutomaticOptions options = changed_options(automatic_options(), {}, own);
    options.wants_known_world = !own.empty();
    return among(set, options);
  };
  return automatic;
}

}  // namespace tagfield
