// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/joint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

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

/// A solution without its equations, which take as much memory as the reads.
struct JointSolution {
  std::map<std::string, TagEstimate> by_tag;
  std::set<std::string> refused;  ///< Tags of the system that are not located.
  std::size_t tags = 0;           ///< In the system.
  std::vector<AntennaPose> corrected_poses;
  double lambda_m = 0.0;
};

JointState solved_state(const LocalizationProblem& problem, const std::set<std::string>& without,
                        int threads) {
  JointState state = begin_jointly(problem, without, threads);
  if (state.system.tags.empty()) return state;
  fit_unwrapped_jointly(state, threads);
  if (is_pose_error_unknown(problem)) learn_pose_error(state, threads);
  find_better_positions(state, threads);
  fit_wrapped_jointly(state, threads);
  find_alternatives(state, threads);
  return state;
}

JointSolution solution_of(const LocalizationProblem& problem, const std::set<std::string>& without,
                          int threads) {
  JointState state = solved_state(problem, without, threads);
  const JointCovariance covariance = covariance_of(state.system, threads);
  JointSolution solution;
  solution.by_tag = std::move(state.not_located);
  solution.tags = state.system.tags.size();
  for (std::size_t i = 0; i < state.system.tags.size(); ++i) {
    const JointTag& tag = state.system.tags[i];
    TagEstimate estimate = estimate_of(state, covariance, i);
    if (estimate.verdict == Verdict::kNotLocated && !tag.fixed) solution.refused.insert(tag.id);
    solution.by_tag[tag.id] = std::move(estimate);
  }
  solution.corrected_poses = corrected_poses(problem, state.system.knots, state.system.u);
  if (!state.system.tags.empty()) {
    solution.lambda_m = 2.0 * longest_cycle(state.system.tags.front().phases);
  }
  return solution;
}

/// Whether no located tag moves by over two expected errors from one solution to another with fewer
/// tags.
bool agree(const JointSolution& one, const JointSolution& other) {
  return std::all_of(one.by_tag.begin(), one.by_tag.end(), [&](const auto& named) {
    const auto found = other.by_tag.find(named.first);
    if (named.second.verdict != Verdict::kLocated || found == other.by_tag.end()) return true;
    if (found->second.candidates.empty()) return true;
    const Candidate& a = named.second.candidates.front();
    const Candidate& b = found->second.candidates.front();
    // The difference of an estimate and the same from fewer reads has the difference of their
    // variances.
    const double own = a.expected_error_m * a.expected_error_m;
    const double more = b.expected_error_m * b.expected_error_m - own;
    return (a.p_WT - b.p_WT).head<2>().squaredNorm() <= 4.0 * std::max(own, more);
  });
}

/// A tag that is refused may have bent the pose error, and with it all others' positions, to suit a
/// wrong one of its own. If the others move without it, they are right without it; if they don't,
/// it was of use.
JointSolution solution_that_stands(const LocalizationProblem& problem, int threads) {
  constexpr int kMaxRounds = 3;
  JointSolution best = solution_of(problem, {}, threads);
  std::set<std::string> without;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (best.refused.empty() || best.refused.size() == best.tags) break;
    without.insert(best.refused.begin(), best.refused.end());
    JointSolution next = solution_of(problem, without, threads);
    if (agree(best, next)) break;
    next.by_tag.merge(best.by_tag);
    best = std::move(next);
  }
  return best;
}

LocalizationResult locate_jointly(const LocalizationProblem& problem, int threads,
                                  Diagnostics& diagnostics) {
  LocalizationResult result;
  result.method = "joint";
  JointSolution solution = solution_that_stands(problem, threads);
  for (auto& [tag, estimate] : solution.by_tag) {
    // Reference tags keep their position, even if their phases could not be unwrapped.
    const auto known = problem.reference_tags.find(tag);
    result.estimates.push_back(known == problem.reference_tags.end()
                                   ? std::move(estimate)
                                   : reference_estimate(tag, known->second));
  }
  result.corrected_poses = std::move(solution.corrected_poses);
  if (is_pose_error_unknown(problem) && solution.tags > 0) {
    refuse_other_poses(problem, solution.lambda_m, result, diagnostics);
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
