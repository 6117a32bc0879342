// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/experiment.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <set>

#include "tagfield/base/parallel.h"
#include "tagfield/base/units.h"
#include "tagfield/experiment/internal/navigation_summary.h"
#include "tagfield/experiment/inventory.h"
#include "tagfield/experiment/judge.h"
#include "tagfield/experiment/known_beforehand.h"
#include "tagfield/experiment/stoppable.h"
#include "tagfield/experiment/store/run_store.h"
#include "tagfield/experiment/store/seed_run_json.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/report/method_summary.h"
#include "tagfield/simulator/pace.h"

namespace tagfield {
namespace {

std::vector<double> errors_of(const std::vector<TagOutcome>& outcomes) {
  std::vector<double> errors;
  for (const TagOutcome& outcome : outcomes) {
    if (const auto error = error_of(outcome)) errors.push_back(*error);
  }
  return errors;
}

/// Horizontal RMS distance between the believed and the true antenna poses [m].
double position_rms(const Recording& recording) {
  const std::vector<AntennaPose>& truth = recording.truth.antenna_poses;
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    sum += (recording.believed_poses[i].X_WA.translation - truth[i].X_WA.translation)
               .head<2>()
               .squaredNorm();
  }
  return truth.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(truth.size()));
}

PoseErrorSummary pose_error_of(const Scenario& scenario, const std::vector<SeedRun>& runs) {
  PoseErrorSummary summary;
  summary.sigma_m = scenario.pose.sigma_m;
  summary.time_constant_s = scenario.pose.time_constant_s;
  summary.yaw_sigma_rad = scenario.pose.yaw_sigma_rad;
  summary.position_rms_m = position_rms(runs.front().recording);
  std::vector<double> errors;
  for (const SeedRun& run : runs) {
    errors.insert(errors.end(), run.errors_with_true_pose_m.begin(),
                  run.errors_with_true_pose_m.end());
  }
  summary.error_with_true_pose_m = statistics(errors);
  const SeedRun& first = runs.front();
  if (!first.corrected_poses.empty()) {
    summary.corrected_rms_m =
        position_rms(first.corrected_poses, first.recording.truth.antenna_poses);
  }
  return summary;
}

void finish(const Simulation& simulation, SeedRun& run) {
  run.complete = simulation.finished();
  run.simulated_s = to_seconds(simulation.now());
  run.path_length_m = simulation.travelled_m();
}

/// The control's outlets, plus a recorder if the recording is kept.
Outlets outlets_of(const RunControl& control, Recording& recording) {
  Outlets outlets = control.outlets;
  if (control.keeps_recording) attach(std::make_shared<Recorder>(recording), outlets);
  return outlets;
}

SeedRun navigated(const Scenario& scenario, std::uint64_t seed, const RunControl& control,
                  const NavigationWorld& world) {
  SeedRun run;
  run.seed = seed;
  NavigatedRun made =
      run_navigation(scenario, seed, control, world, outlets_of(control, run.recording));
  run.complete = made.complete;
  run.simulated_s = made.simulated_s;
  run.path_length_m = made.path_length_m;
  run.navigation = std::move(made.navigation);
  return run;
}

/// Estimates in the scenario's order, with those of tags that were never read.
LocalizationResult located(const Scenario& scenario, const Recording& recording,
                           const std::vector<AntennaPose>& poses,
                           const LocalizationOptions& options, Diagnostics& diagnostics) {
  LocalizationResult result = locate_tags(recording.reads, poses, options, diagnostics);
  result.estimates = with_all_tags(std::move(result.estimates), {}, tags_of(scenario));
  return result;
}

std::vector<TagOutcome> outcomes_of(const SeedRun& run, const LocalizationOptions& options,
                                    const std::vector<TagEstimate>& estimates) {
  return judged(estimates, run.recording.reads, run.recording.truth, options.known.reference_tags,
                run.seed);
}

/// Results of the scenario's other methods, each once.
std::vector<ComparedMethod> compared(const Scenario& scenario, const SeedRun& run,
                                     LocalizationOptions options) {
  std::vector<ComparedMethod> others;
  std::set<std::string> done = {run.method};
  for (const std::string& name : scenario.localization.compare) {
    Diagnostics unheard;  // The run's own method has given all warnings already.
    options.method = name;
    const LocalizationResult result =
        located(scenario, run.recording, run.recording.believed_poses, options, unheard);
    if (!done.insert(result.method).second) continue;
    others.push_back({result.method, outcomes_of(run, options, result.estimates)});
  }
  return others;
}

/// Fills in all tags as not located: `why` of the run, `reason` of each tag.
void leave_unlocated(const Scenario& scenario, const std::string& why, const std::string& reason,
                     SeedRun& run) {
  run.method = kNoLocalization;
  run.method_why = why;
  for (const std::string& tag : tags_of(scenario)) {
    run.estimates.push_back({tag, Verdict::kNotLocated, reason, {}, 0});
  }
  run.outcomes = judged(run.estimates, run.recording.reads, run.recording.truth, {}, run.seed);
}

std::optional<InventorySummary> mean_inventory(const std::vector<SeedRun>& runs) {
  std::vector<InventorySummary> all;
  for (const SeedRun& run : runs) {
    if (run.inventory) all.push_back(*run.inventory);
  }
  if (all.empty()) return std::nullopt;
  return mean_of(all);
}

/// Summaries over all seeds: the run's own method, then the others.
std::vector<MethodSummary> compared_methods(const std::string& method, bool believed,
                                            const std::vector<SeedRun>& runs,
                                            const std::vector<TagOutcome>& own) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<TagOutcome>> by_method;
  for (const SeedRun& run : runs) {
    for (const ComparedMethod& other : run.compared) {
      std::vector<TagOutcome>& outcomes = by_method[other.method];
      if (outcomes.empty()) order.push_back(other.method);
      outcomes.insert(outcomes.end(), other.outcomes.begin(), other.outcomes.end());
    }
  }
  if (order.empty()) return {};
  std::vector<MethodSummary> methods = {summary_of_method(method, own, believed)};
  for (const std::string& name : order) {
    methods.push_back(summary_of_method(name, by_method[name], believed));
  }
  return methods;
}

/// The methods used over all seeds, in order of first use.
std::string methods_of(const std::vector<SeedRun>& runs) {
  std::string names;
  std::set<std::string> done;
  for (const SeedRun& run : runs) {
    if (!done.insert(run.method).second) continue;
    names += (names.empty() ? "" : ", ") + run.method;
  }
  return names;
}

/// Fills in all results of localization. Throws LocatingStopped.
void locate_run(const Scenario& scenario, const RunControl& control, SeedRun& run,
                Diagnostics& diagnostics) {
  LocalizationOptions options = localization_options(scenario, control.threads);
  // The few reads of an interrupted simulation are located.
  const std::atomic<bool>* const stop = stopped(control) ? nullptr : control.stop;
  options.on_locating = control.on_stage;
  make_stoppable(stop, options.on_locating, options.known.trace);
  options.known.map_error = map_error_of(scenario, run);
  const Recording& recording = run.recording;
  LocalizationResult result =
      located(scenario, recording, recording.believed_poses, options, diagnostics);
  run.estimates = std::move(result.estimates);
  run.method = result.method;
  run.method_why = result.why;
  run.corrected_poses = std::move(result.corrected_poses);
  run.outcomes = outcomes_of(run, options, run.estimates);
  run.compared = compared(scenario, run, options);
  if (pose_source_of(scenario) == PoseSource::kTrue) return;
  LocalizationOptions exact = options;
  exact.known.pose_error = PoseErrorModel{};
  exact.known.map_error.reset();
  result = located(scenario, recording, recording.truth.antenna_poses, exact, diagnostics);
  run.errors_with_true_pose_m = errors_of(outcomes_of(run, options, result.estimates));
}

/// The run of a seed other than the first; only the first one goes to the outlets and keeps its
/// recording.
SeedRun another_seed(const Scenario& scenario, std::uint64_t seed, RunControl control,
                     const NavigationWorld* world, RunStore* store, Diagnostics& warnings) {
  const RunKey key{0, seed};
  if (const std::string* const kept = store == nullptr ? nullptr : store->find(key)) {
    KeptSeed found = kept_seed_in(*kept, store->location());
    for (const std::string& warning : found.warnings) warnings.warn(warning);
    return std::move(found.run);
  }
  control.outlets = {};
  control.navigation = nullptr;
  SeedRun run = simulate(scenario, seed, control, world);
  localize(scenario, run, control, warnings);
  run.recording = {};
  run.corrected_poses = {};
  if (store != nullptr && run.complete) store->add(key, to_json_line(run, warnings.warnings()));
  return run;
}

/// Simulated time spent on mapping.
double mapping_s(const SeedRun& run) {
  return run.navigation && run.navigation->survey ? run.navigation->survey->simulated_s : 0.0;
}

}  // namespace

LocalizationOptions localization_options(const Scenario& scenario, int threads) {
  LocalizationOptions options;
  options.method = scenario.localization.method;
  options.settings = scenario.localization.settings;
  options.known = known_beforehand(scenario);
  options.threads = threads;
  return options;
}

std::optional<MapError> map_error_of(const Scenario& scenario, const SeedRun& run) {
  if (!run.navigation) return std::nullopt;
  MapError error;
  error.origin_W = position_of(mapping_robot(scenario).start);
  if (run.navigation->survey) {
    error.covariance = run.navigation->survey->start_covariance;
    return error;
  }
  const double of_cells_m = run.navigation->map.resolution_m / std::sqrt(12.0);
  const double sigma_m = navigation_of(scenario).map_sigma_m.value_or(of_cells_m);
  error.covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, 0.0;
  return error;
}

SeedRun simulate(const Scenario& scenario, std::uint64_t seed, const RunControl& control,
                 const NavigationWorld* world) {
  if (scenario.pose.source == PoseSource::kSlam) {
    if (world == nullptr) throw Error("navigation 'slam' needs a world that was prepared for it");
    if (control.remote != nullptr) {
      throw Error("navigation 'slam' can't be used with a robot that is driven from outside");
    }
    return navigated(scenario, seed, control, *world);
  }
  SeedRun run;
  run.seed = seed;
  Simulation simulation(scenario, seed, outlets_of(control, run.recording), nullptr, control.remote,
                        control.threads);
  const Pace pace(scenario.real_time);
  while (!simulation.finished() && !stopped(control)) {
    simulation.step();
    if (control.on_progress) control.on_progress(simulation.progress());
    pace.wait_for(simulation.now());
  }
  simulation.finish();
  finish(simulation, run);
  return run;
}

void localize(const Scenario& scenario, SeedRun& run, const RunControl& control,
              Diagnostics& diagnostics) {
  const std::string why_not = why_inventory_alone(scenario);
  if (!why_not.empty() || all_antennas_rest(scenario)) {
    run.inventory = inventory_of(scenario, run.recording, run.simulated_s);
  }
  if (!why_not.empty()) {
    leave_unlocated(scenario, why_not, "not asked for: " + why_not, run);
    return;
  }
  try {
    locate_run(scenario, control, run, diagnostics);
  } catch (const LocatingStopped&) {
    run.complete = false;
    // Otherwise only comparisons are missing.
    if (run.outcomes.empty()) {
      leave_unlocated(scenario, "localization was interrupted", "interrupted", run);
    }
  }
}

std::vector<SeedRun> run_seeds(const Scenario& scenario, std::uint64_t first, std::size_t count,
                               const RunControl& control, Diagnostics& diagnostics,
                               const NavigationWorld* world, RunStore* store) {
  std::vector<SeedRun> runs(count);
  std::vector<Diagnostics> warnings(count);
  std::vector<char> begun(count, 0);
  std::mutex progress_mutex;
  double finished = 0.0;
  // A single seed reports its own progress; for several the finished ones are counted.
  RunControl of_one = control;
  if (count > 1) {
    of_one.on_progress = nullptr;
    of_one.on_stage = nullptr;
    of_one.threads = 1;
  }
  parallel_for(count, control.threads, [&](std::size_t i) {
    if (i > 0 && stopped(control)) return;
    begun[i] = 1;
    if (i > 0) {
      runs[i] = another_seed(scenario, first + i, of_one, world, store, warnings[i]);
    } else {
      runs[i] = simulate(scenario, first, of_one, world);
      localize(scenario, runs[i], of_one, warnings[i]);
    }
    const std::lock_guard lock(progress_mutex);
    finished += 1.0;
    if (control.on_progress && count > 1) {
      control.on_progress(finished / static_cast<double>(count));
    }
  });
  std::vector<SeedRun> kept;
  for (std::size_t i = 0; i < count; ++i) {
    // An interrupted seed would distort the statistics of the complete ones.
    if (begun[i] != 0 && (i == 0 || runs[i].complete)) kept.push_back(std::move(runs[i]));
    for (const std::string& warning : warnings[i].warnings()) diagnostics.warn(warning);
  }
  warn_of_robot_contacts(kept, diagnostics);
  return kept;
}

Summary summarize(const Scenario& scenario, const std::vector<SeedRun>& runs, double wall_s,
                  const Diagnostics& diagnostics, const NavigationWorld* world) {
  const SeedRun& first = runs.front();
  Summary summary;
  summary.scenario = scenario.name;
  summary.description = scenario.description;
  summary.method = methods_of(runs);
  summary.method_asked = scenario.localization.method;
  summary.method_why = first.method_why;
  summary.pose = to_string(pose_source_of(scenario));
  summary.path_length_m = first.path_length_m;
  summary.reads = first.recording.reads.size();
  summary.simulated_s = first.simulated_s;
  summary.wall_s = wall_s;
  double simulated_s = 0.0;
  for (const SeedRun& run : runs) {
    summary.seeds.push_back(run.seed);
    summary.complete = summary.complete && run.complete;
    simulated_s += run.simulated_s + mapping_s(run);
    summary.tags.insert(summary.tags.end(), run.outcomes.begin(), run.outcomes.end());
  }
  const bool believed = pose_source_of(scenario) != PoseSource::kTrue;
  summary.compared_methods = compared_methods(summary.method, believed, runs, summary.tags);
  summary.real_time_factor = wall_s > 0.0 ? simulated_s / wall_s : 0.0;
  summary.inventory = mean_inventory(runs);
  const bool is_located = summary.method != kNoLocalization;
  if (believed && is_located) {
    summary.pose_error = pose_error_of(scenario, runs);
  }
  if (world != nullptr && first.navigation) summary.navigation = navigation_summary(runs, *world);
  summary.warnings = alike_as_one(diagnostics.warnings());
  return summary;
}

}  // namespace tagfield
