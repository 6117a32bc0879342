#include "tagfield/localization/joint/joint.h"

#include "tagfield/localization/joint/internal/joint_state.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

TagEstimate estimate_of(const JointState& state, const JointCovariance& covariance,
                        std::size_t index) {
  const JointTag& tag = state.system.tags[index];
  TagEstimate estimate;
  estimate.tag = tag.id;
  estimate.reads = static_cast<std::size_t>(tag.phases.size());
  estimate.candidates = {candidate_of(state.system, index, covariance.of_tag[index])};
  for (const Candidate& other : state.alternatives[index]) estimate.candidates.push_back(other);
  judge(state.problem->limits, estimate);
  return estimate;
}

LocalizationResult locate_jointly(const LocalizationProblem& problem, int threads) {
  LocalizationResult result;
  result.method = "joint";
  JointState state = begin_jointly(problem, threads);
  if (!state.system.tags.empty()) {
    fit_unwrapped_jointly(state, threads);
    if (!problem.pose_error) learn_pose_error(state, threads);
    find_better_places(state, threads);
    fit_wrapped_jointly(state, threads);
    find_alternatives(state, threads);
  }
  const JointCovariance covariance = covariance_of(state.system, threads);
  std::map<std::string, TagEstimate> by_tag = std::move(state.not_located);
  for (std::size_t i = 0; i < state.system.tags.size(); ++i) {
    by_tag[state.system.tags[i].id] = estimate_of(state, covariance, i);
  }
  for (auto& [tag, estimate] : by_tag) {
    // Reference tags keep their place, also those whose phases could not be followed.
    const auto known = problem.reference_tags.find(tag);
    result.estimates.push_back(known == problem.reference_tags.end()
                                   ? std::move(estimate)
                                   : reference_estimate(tag, known->second));
  }
  result.corrected_poses = corrected_poses(problem, state.system.knots, state.system.u);
  return result;
}

}  // namespace

Method joint_method() {
  return {"joint", "all tags and the pose error together, from unwrapped, then wrapped phase",
          [](const LocalizationProblem& problem, int threads, Diagnostics&) {
            return locate_jointly(problem, threads);
          }};
}

}  // namespace tagfield
