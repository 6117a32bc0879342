// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/condition_run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iterator>

#include "tagfield/experiment/experiment.h"
#include "tagfield/experiment/internal/faults.h"
#include "tagfield/experiment/internal/read_loss.h"
#include "tagfield/experiment/internal/record.h"
#include "tagfield/experiment/judge.h"
#include "tagfield/experiment/stoppable.h"
#include "tagfield/localization/bound.h"
#include "tagfield/localization/locate.h"

namespace tagfield {
namespace {

/// The prior knowledge of a method, the problem built from it, and its bounds, which are computed
/// on demand.
class Given {
 public:
  Given(const PreparedCondition& condition, const Recording& recording,
        const KnownBeforehand& known, const std::atomic<bool>* stop, Diagnostics& diagnostics)
      : condition_(condition),
        recording_(recording),
        known_(known),
        problem_(make_problem(recording.reads, recording.believed_poses, known, diagnostics)) {
    make_stoppable(stop, problem_.on_locating, problem_.trace);
  }

  [[nodiscard]] const LocalizationProblem& problem() const { return problem_; }
  /// For locate_problem(), which changes it meanwhile.
  LocalizationProblem& open_problem() { return problem_; }

  const Bounds& bounds(BoundKind kind) {
    std::optional<Bounds>& bounds = kind == BoundKind::kJoint ? joint_ : single_;
    if (bounds) return *bounds;
    if (!condition_.no_bound.empty()) return bounds.emplace();
    const BoundInput input = bound_input();
    bounds = kind == BoundKind::kJoint ? joint_bounds(input) : single_bounds(input);
    return *bounds;
  }

 private:
  [[nodiscard]] BoundInput bound_input() const {
    KnownBeforehand known = known_;
    known.pi_ambiguity = problem_.pi_ambiguity;
    known.pose_error = true_pose_error(condition_.scenario).value_or(PoseErrorModel{});
    Diagnostics unheard;
    BoundInput input;
    input.truth = make_problem(recording_.reads, recording_.truth.antenna_poses, known, unheard);
    input.phase_noise_rad = condition_.phase_noise_rad;
    for (const TagSpec& tag : condition_.scenario.tags) {
      if (!moves(tag)) input.places[tag.id] = tag.motion.front().X_WB.translation;
    }
    return input;
  }

  const PreparedCondition& condition_;
  const Recording& recording_;
  KnownBeforehand known_;
  LocalizationProblem problem_;
  std::optional<Bounds> single_;
  std::optional<Bounds> joint_;
};

/// The joint bound for methods that locate all tags jointly.
BoundKind bound_of(const std::string& method) {
  return method == "joint" ? BoundKind::kJoint : BoundKind::kSingle;
}

/// Tags of a recording without known positions can't be judged.
void drop_strangers(std::vector<TagRecord>& tags) {
  std::erase_if(tags, [](const TagRecord& tag) { return !tag.truth; });
}

MethodRun run_method(const PreparedMethod& method, const PreparedCondition& condition,
                     const Recording& recording, Given& given, Diagnostics& diagnostics) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const LocalizationResult result =
      locate_problem(method.method, given.open_problem(), 1, diagnostics);
  MethodRun run;
  run.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  run.tags_given = given.problem().samples.size();
  run.method = result.method.empty() ? method.method.name : result.method;
  run.bound = bound_of(run.method);
  const bool recorded = condition.recording.has_value();
  const std::vector<TagEstimate> estimates = with_all_tags(
      result.estimates, recorded ? recording.truth : Truth{}, tags_of(condition.scenario));
  run.tags = records_of(given.problem(), judged(estimates, recording.reads, recording.truth,
                                                given.problem().reference_tags));
  if (recorded) drop_strangers(run.tags);
  judge_by(given.bounds(run.bound), run);
  judge_claims(condition.condition.fault.value_or(Faults{}), run);
  if (recorded || condition.scenario.pose.source != PoseSource::kTrue) {
    add_aligned_errors(run.tags);
  }
  return run;
}

/// The data of a run to locate tags from.
struct Recorded {
  Recording recording;
  std::optional<MapError> map_error;  ///< Of the map that the robot made.
};

/// None if `control.stop` was set before the end of the run.
std::optional<Recorded> simulated(const PreparedCondition& condition, std::uint64_t seed,
                                  const RunControl& control) {
  const NavigationWorld* const world = condition.world ? &*condition.world : nullptr;
  SeedRun run = simulate(condition.scenario, seed, control, world);
  if (!run.complete) return std::nullopt;
  const std::optional<MapError> map_error = map_error_of(condition.scenario, run);
  return Recorded{std::move(run.recording), map_error};
}

std::optional<Recorded> recorded(const PreparedCondition& condition, std::uint64_t seed,
                                 const RunControl& control) {
  if (!condition.recording) return simulated(condition, seed, control);
  return Recorded{*condition.recording, std::nullopt};
}

/// `known` with the error of the run's map.
KnownBeforehand with_map(KnownBeforehand known, const std::optional<MapError>& map_error) {
  known.map_error = map_error;
  return known;
}

void spoil(const Condition& condition, std::uint64_t seed, Recording& recording) {
  if (condition.lose) recording.reads = without_lost(recording.reads, *condition.lose, seed);
  if (condition.fault) add_faults(*condition.fault, seed, recording);
}

/// A run by each method, in order. Throws LocatingStopped.
std::vector<MethodRun> run_methods(const PreparedCondition& condition, const Recorded& made,
                                   const RunControl& control, Diagnostics& diagnostics) {
  const Recording& recording = made.recording;
  Given shared(condition, recording, with_map(condition.known, made.map_error), control.stop,
               diagnostics);
  std::vector<MethodRun> runs;
  for (const PreparedMethod& method : condition.methods) {
    if (stopped(control)) throw LocatingStopped{};
    std::optional<Given> own;
    if (method.known) {
      own.emplace(condition, recording, with_map(*method.known, made.map_error), control.stop,
                  diagnostics);
    }
    runs.push_back(run_method(method, condition, recording, own ? *own : shared, diagnostics));
  }
  return runs;
}

}  // namespace

std::optional<std::vector<MethodRun>> run_condition(const PreparedCondition& condition,
                                                    std::uint64_t seed, const RunControl& control,
                                                    Diagnostics& diagnostics) {
  std::optional<Recorded> made = recorded(condition, seed, control);
  if (!made) return std::nullopt;
  spoil(condition.condition, seed, made->recording);
  try {
    std::vector<MethodRun> runs = run_methods(condition, *made, control, diagnostics);
    for (MethodRun& run : runs) run.seed = seed;
    return runs;
  } catch (const LocatingStopped&) {
    return std::nullopt;
  }
}

}  // namespace tagfield
