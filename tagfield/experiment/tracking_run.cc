// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/tracking_run.h"

#include <mutex>

#include "tagfield/base/parallel.h"
#include "tagfield/experiment/known_beforehand.h"
#include "tagfield/simulator/simulation.h"
#include "tagfield/stream/recording.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {
namespace {

/// Tags at rest are not what tracking is asked for.
TrackingRun simulated(const Scenario& scenario, std::uint64_t seed, const RunControl& control) {
  Recording recording;
  Simulation simulation(scenario, seed, recorded_in(recording));
  while (!simulation.finished() && !stopped(control)) simulation.step();
  simulation.finish();
  TrackingRun run;
  run.seed = seed;
  run.reads = std::move(recording.reads);
  run.believed_poses = std::move(recording.believed_poses);
  run.truth = std::move(recording.truth);
  return run;
}

}  // namespace

void track(const TrackingSpec& spec, const KnownBeforehand& known, int threads, TrackingRun& run,
           Diagnostics& diagnostics) {
  const LocalizationProblem problem =
      make_problem(run.reads, run.believed_poses, known, diagnostics);
  TrackingOptions options = spec.options;
  options.seed = run.seed;
  run.tracks = track_tags(problem, options, threads, diagnostics);
  run.orders = passing_orders(problem, run.tracks, spec.line);
  run.outcomes = judge_tracks(run.seed, run.tracks, run.truth);
  run.order_outcomes =
      judge_orders(run.orders, passing_orders(problem, true_tracks(run.truth), spec.line));
}

std::vector<TrackingRun> track_seeds(const Scenario& scenario, std::uint64_t first,
                                     std::size_t count, const RunControl& control,
                                     Diagnostics& diagnostics) {
  if (scenario.pose.source == PoseSource::kSlam) {
    throw Error(
        "track: robots that navigate by themselves can't be run here; "
        "tagfield run, then track its reads.csv");
  }
  const KnownBeforehand known = known_beforehand(scenario);
  std::vector<TrackingRun> runs(count);
  std::vector<Diagnostics> warnings(count);
  std::vector<char> done(count, 0);
  std::mutex mutex;
  double finished = 0.0;
  parallel_for(count, control.threads, [&](std::size_t i) {
    if (i > 0 && stopped(control)) return;
    runs[i] = simulated(scenario, first + i, control);
    track(scenario.tracking, known, count > 1 ? 1 : control.threads, runs[i], warnings[i]);
    done[i] = i == 0 || !stopped(control) ? 1 : 0;
    if (i > 0) {
      runs[i].reads.clear();
      runs[i].truth = {};
      runs[i].tracks.clear();
    }
    const std::lock_guard lock(mutex);
    finished += 1.0;
    if (control.on_progress) control.on_progress(finished / static_cast<double>(count));
  });
  std::vector<TrackingRun> kept;
  for (std::size_t i = 0; i < count; ++i) {
    if (done[i] != 0) kept.push_back(std::move(runs[i]));
    for (const std::string& warning : warnings[i].warnings()) diagnostics.warn(warning);
  }
  return kept;
}

}  // namespace tagfield
