// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/joint.h"

#include <fmt/format.h>

#include <cmath>

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

/// Plausibility check of the poses by their estimated error.
struct PoseCheck {
  double rms_m = 0.0;      ///< Rms of the error.
  double late_s = 0.0;     ///< Latency that explains most of it,
  double explained = 0.0;  ///< and the share of the variance that it explains.
};

PoseCheck check_of(const LocalizationProblem& problem, const std::vector<AntennaPose>& corrected) {
  Eigen::Vector2d mean_error = Eigen::Vector2d::Zero();
  Eigen::Vector2d mean_velocity = Eigen::Vector2d::Zero();
  double count = 0.0;
  double squares = 0.0;
  double errors = 0.0;
  double velocities = 0.0;
  double both = 0.0;
  std::map<std::string, std::size_t> at;
  for (const AntennaPose& pose : corrected) {
    const Trajectory& believed = problem.tracks.at(pose.antenna).X_WA;
    const std::size_t i = at[pose.antenna]++;
    if (i == 0 || i + 1 >= believed.size()) continue;
    const double seconds = to_seconds(believed[i + 1].stamp) - to_seconds(believed[i - 1].stamp);
    if (seconds <= 0.0) continue;
    const Eigen::Vector2d error = (believed[i].X_WB.translation - pose.X_WA.translation).head<2>();
    const Eigen::Vector2d velocity =
        (believed[i + 1].X_WB.translation - believed[i - 1].X_WB.translation).head<2>() / seconds;
    count += 1.0;
    mean_error += error;
    mean_velocity += velocity;
    squares += error.squaredNorm();
    velocities += velocity.squaredNorm();
    both += error.dot(velocity);
  }
  PoseCheck check;
  if (count < 2.0) return check;
  // The mean error is not observable: it shifts all tags alike.
  errors = squares - mean_error.squaredNorm() / count;
  velocities -= mean_velocity.squaredNorm() / count;
  both -= mean_error.dot(mean_velocity) / count;
  check.rms_m = std::sqrt(squares / count);
  if (errors <= 0.0 || velocities <= 0.0) return check;
  check.late_s = both / velocities;
  check.explained = both * both / (errors * velocities);
  return check;
}

/// Why poses with unknown error cannot belong to the reads; empty if they can.
std::string why_other_poses(const PoseCheck& check, double lambda) {
  // In a run with about ten independent errors, chance explains as much once in a thousand.
  constexpr double kExplained = 0.7;
  constexpr double kLeast = 0.02;  // [m]
  if (check.rms_m > 0.5 * lambda) {
    return fmt::format(
        "the poses seem to be off by {:.2f} m, over half a wavelength, which reads can't correct: "
        "do they belong to this run?",
        check.rms_m);
  }
  if (check.explained > kExplained && check.rms_m > kLeast) {
    return fmt::format(
        "the poses' error is along the path, as if stamps of reads were {:.2f} s {} relative to "
        "those of poses",
        std::abs(check.late_s), check.late_s > 0.0 ? "late" : "early");
  }
  return "";
}

void refuse_other_poses(const LocalizationProblem& problem, double lambda,
                        LocalizationResult& result, Diagnostics& diagnostics) {
  const std::string why = why_other_poses(check_of(problem, result.corrected_poses), lambda);
  if (why.empty()) return;
  diagnostics.warn(why);
  for (TagEstimate& estimate : result.estimates) {
    const bool is_known = problem.reference_tags.count(estimate.tag) > 0;
    if (is_known || estimate.verdict == Verdict::kNotLocated) continue;
    result.misfits_m.push_back(estimate.candidates.front().rms_m);
    estimate = not_located(std::move(estimate), why);
  }
}

LocalizationResult locate_jointly(const LocalizationProblem& problem, int threads,
                                  Diagnostics& diagnostics) {
  LocalizationResult result;
  result.method = "joint";
  JointState state = begin_jointly(problem, threads);
  if (!state.system.tags.empty()) {
    fit_unwrapped_jointly(state, threads);
    if (!problem.pose_error) learn_pose_error(state, threads);
    find_better_positions(state, threads);
    fit_wrapped_jointly(state, threads);
    find_alternatives(state, threads);
  }
  const JointCovariance covariance = covariance_of(state.system, threads);
  std::map<std::string, TagEstimate> by_tag = std::move(state.not_located);
  for (std::size_t i = 0; i < state.system.tags.size(); ++i) {
    by_tag[state.system.tags[i].id] = estimate_of(state, covariance, i);
  }
  for (auto& [tag, estimate] : by_tag) {
    // Reference tags keep their position, even if their phases could not be unwrapped.
    const auto known = problem.reference_tags.find(tag);
    result.estimates.push_back(known == problem.reference_tags.end()
                                   ? std::move(estimate)
                                   : reference_estimate(tag, known->second));
  }
  result.corrected_poses = corrected_poses(problem, state.system.knots, state.system.u);
  if (!problem.pose_error && !state.system.tags.empty()) {
    const double lambda = 2.0 * longest_cycle(state.system.tags.front().phases);
    refuse_other_poses(problem, lambda, result, diagnostics);
  }
  return result;
}

}  // namespace

Method joint_method() {
  return {"joint", "all tags and the pose error together, from unwrapped, then wrapped phase",
          [](const LocalizationProblem& problem, int threads, Diagnostics& diagnostics) {
            return locate_jointly(problem, threads, diagnostics);
          }};
}

}  // namespace tagfield
