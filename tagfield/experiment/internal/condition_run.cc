#include "tagfield/experiment/internal/condition_run.h"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "tagfield/experiment/experiment.h"
#include "tagfield/experiment/internal/read_loss.h"
#include "tagfield/experiment/internal/record.h"
#include "tagfield/experiment/judge.h"
#include "tagfield/localization/bound.h"
#include "tagfield/localization/locate.h"

namespace tagfield {
namespace {

/// What a method knows beforehand, the problem made of that, and the bounds of it, which are
/// computed when a method is judged by them.
class Given {
 public:
  Given(const PreparedCondition& condition, const Recording& recording,
        const KnownBeforehand& known, Diagnostics& diagnostics)
      : condition_(condition),
        recording_(recording),
        known_(known),
        problem_(make_problem(recording.reads, recording.believed_poses, known, diagnostics)) {}

  [[nodiscard]] const LocalizationProblem& problem() const { return problem_; }

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
    known.half_turns = problem_.half_turns;
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

/// The joint bound for those that locate all tags together.
BoundKind bound_of(const std::string& method) {
  return method == "joint" ? BoundKind::kJoint : BoundKind::kSingle;
}

MethodRun run_method(const PreparedMethod& method, const Scenario& scenario,
                     const Recording& recording, Given& given, Diagnostics& diagnostics) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const LocalizationResult result = locate_problem(method.method, given.problem(), 1, diagnostics);
  MethodRun run;
  run.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  run.tags_given = given.problem().samples.size();
  run.method = result.method.empty() ? method.method.name : result.method;
  run.bound = bound_of(run.method);
  const std::vector<TagEstimate> estimates = with_all_tags(result.estimates, {}, tags_of(scenario));
  run.tags = records_of(given.problem(), judged(estimates, recording.reads, recording.truth,
                                                given.problem().reference_tags));
  judge_by(given.bounds(run.bound), run);
  if (scenario.pose.source != PoseSource::kTrue) add_aligned_errors(run.tags);
  return run;
}

struct Recorded {
  Recording recording;
  std::optional<MapError> map_error;
  bool complete = false;
};

Recorded recorded(const PreparedCondition& condition, std::uint64_t seed,
                  const RunControl& control) {
  const NavigationWorld* const world = condition.world ? &*condition.world : nullptr;
  SeedRun run = simulate(condition.scenario, seed, control, world);
  const std::optional<ReadLoss>& lose = condition.condition.lose;
  if (lose) run.recording.reads = without_lost(run.recording.reads, *lose, seed);
  const std::optional<MapError> map_error = map_error_of(condition.scenario, run);
  return {std::move(run.recording), map_error, run.complete};
}

/// With what the run told of its map.
KnownBeforehand with_map(KnownBeforehand known, const std::optional<MapError>& map_error) {
  known.map_error = map_error;
  return known;
}

}  // namespace

std::optional<std::vector<MethodRun>> run_condition(const PreparedCondition& condition,
                                                    std::uint64_t seed, const RunControl& control,
                                                    Diagnostics& diagnostics) {
  const Recorded made = recorded(condition, seed, control);
  if (!made.complete) return std::nullopt;
  const Recording& recording = made.recording;
  Given shared(condition, recording, with_map(condition.known, made.map_error), diagnostics);
  std::vector<MethodRun> runs;
  for (const PreparedMethod& method : condition.methods) {
    if (stopped(control)) return std::nullopt;
    std::optional<Given> own;
    if (method.known) {
      own.emplace(condition, recording, with_map(*method.known, made.map_error), diagnostics);
    }
    runs.push_back(
        run_method(method, condition.scenario, recording, own ? *own : shared, diagnostics));
    runs.back().seed = seed;
  }
  return runs;
}

}  // namespace tagfield
