// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/tracking_run.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <mutex>
#include <utility>

#include "tagfield/base/parallel.h"
#include "tagfield/experiment/known_beforehand.h"
#include "tagfield/experiment/stoppable.h"
#include "tagfield/simulator/simulation.h"
#include "tagfield/stream/recording.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {
namespace {

/// Simulates the scenario and keeps what tracking needs.
TrackingRun simulated(const Scenario& scenario, std::uint64_t seed, const RunControl& control) {
  Recording recording;
  Simulation simulation(scenario, seed, recorded_in(recording), nullptr, nullptr, control.threads);
  while (!simulation.finished() && !stopped(control)) simulation.step();
  simulation.finish();
  TrackingRun run;
  run.seed = seed;
  run.reads = std::move(recording.reads);
  run.believed_poses = std::move(recording.believed_poses);
  run.truth = std::move(recording.truth);
  return run;
}

/// Adds each tag's first and last read.
void add_ends(const std::vector<TagRead>& reads, std::vector<TagRead>& ends) {
  std::map<std::string, std::pair<const TagRead*, const TagRead*>> by_tag;
  for (const TagRead& read : reads) {
    auto& [first, last] = by_tag.try_emplace(read.tag, &read, &read).first->second;
    if (read.stamp < first->stamp) first = &read;
    if (read.stamp > last->stamp) last = &read;
  }
  for (const auto& [tag, of_tag] : by_tag) {
    ends.push_back(*of_tag.first);
    if (of_tag.second != of_tag.first) ends.push_back(*of_tag.second);
  }
}

void thin(std::vector<double>& errors) {
  const std::size_t every = errors.size() / kErrorsKept + 1;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < errors.size(); i += every) errors[kept++] = errors[i];
  errors.resize(kept);
  errors.shrink_to_fit();
}

/// Adds the passings of a part's tags.
void add_passings(std::vector<PassingOrder> of_part, std::vector<PassingOrder>& orders) {
  if (orders.empty()) {
    orders = std::move(of_part);
    return;
  }
  for (std::size_t i = 0; i < of_part.size(); ++i) {  // Same order in all parts.
    std::vector<Passing>& all = orders[i].passings;
    const auto middle = static_cast<std::ptrdiff_t>(all.size());
    std::move(of_part[i].passings.begin(), of_part[i].passings.end(), std::back_inserter(all));
    std::inplace_merge(all.begin(), all.begin() + middle, all.end(),
                       [](const Passing& a, const Passing& b) { return a.stamp < b.stamp; });
  }
}

}  // namespace

void track(const TrackingSpec& spec, const KnownBeforehand& known, const RunControl& control,
           TrackingRun& run, Diagnostics& diagnostics) {
  LocalizationProblem problem = make_problem(run.reads, run.believed_poses, known, diagnostics);
  problem.on_locating = control.on_stage;
  make_stoppable(control.stop, problem.on_locating, problem.trace);
  TrackingOptions options = spec.options;
  options.seed = run.seed;
  run.tracks = track_tags(problem, options, control.threads, diagnostics);
  run.line = spec.line;
  run.orders = passing_orders(problem, run.tracks, spec.line);
  run.outcomes = judge_tracks(run.seed, run.tracks, run.truth);
  run.order_outcomes =
      judge_orders(run.orders, passing_orders(problem, true_tracks(run.truth), spec.line));
}

void track_in_parts(const TrackingSpec& spec, const KnownBeforehand& known, int threads,
                    const ReadParts& parts,
                    const std::function<void(const std::vector<TagTrack>&)>& on_tracks,
                    const std::function<void(double)>& on_progress, TrackingRun& run,
                    Diagnostics& diagnostics) {
  TrackingOptions options = spec.options;
  options.seed = run.seed;
  WarningsOfParts warnings(parts.count);
  run.line = spec.line;
  LocalizationProblem problem;
  for (std::size_t i = 0; i < parts.count; ++i) {
    if (on_progress) on_progress(static_cast<double>(i) / static_cast<double>(parts.count));
    Diagnostics of_part;
    {
      const std::vector<TagRead> reads = parts.reads(i);
      add_ends(reads, run.reads);
      problem = make_problem(reads, run.believed_poses, known, of_part);
    }
    std::vector<TagTrack> tracks = track_tags(problem, options, threads, of_part);
    warnings.take(of_part);
    on_tracks(tracks);
    add_passings(passing_orders(problem, tracks, spec.line), run.orders);
    for (TrackOutcome& outcome : judge_tracks(run.seed, tracks, run.truth)) {
      for (auto* errors : {&outcome.along_m, &outcome.across_m, &outcome.speed_m_s}) thin(*errors);
      run.outcomes.push_back(std::move(outcome));
    }
    const std::size_t kept = std::min(tracks.size(), kTracksKept - run.tracks.size());
    std::move(tracks.begin(), tracks.begin() + static_cast<std::ptrdiff_t>(kept),
              std::back_inserter(run.tracks));
  }
  warnings.give(diagnostics);
  run.order_outcomes =
      judge_orders(run.orders, passing_orders(problem, true_tracks(run.truth), spec.line));
}

namespace {

/// Without tracks if it is stopped; reads of a simulation that was stopped before are tracked.
void track_or_stop(const TrackingSpec& spec, const KnownBeforehand& known, RunControl control,
                   TrackingRun& run, Diagnostics& diagnostics) {
  if (stopped(control)) control.stop = nullptr;
  try {
    track(spec, known, control, run, diagnostics);
  } catch (const LocatingStopped&) {
    run.tracks.clear();
  }
}

}  // namespace

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
  RunControl of_one = control;
  if (count > 1) of_one.threads = 1;
  parallel_for(count, control.threads, [&](std::size_t i) {
    if (i > 0 && stopped(control)) return;
    runs[i] = simulated(scenario, first + i, control);
    track_or_stop(scenario.tracking, known, of_one, runs[i], warnings[i]);
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
