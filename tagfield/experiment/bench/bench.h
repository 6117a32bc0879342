// SPDX-License-Identifier: Apache-2.0
/// @file
/// A comparison of methods, the door of this room: what it comes to, each tag of each run, and what
/// it was judged by.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

struct Method;         // of localization/method.h
struct PreparedSuite;  // of prepared.h
struct RunControl;     // of simulator/simulation.h
class RunStore;        // of store/run_store.h
struct Suite;          // of suite.h

/// Which Cramér-Rao bound a method is judged by (tagfield/localization/bound.h).
enum class BoundKind { kSingle, kJoint };

/// "single", "joint".
std::string to_string(BoundKind kind);

/// How well a tag could be located at best in this run.
struct TagBound {
  double mean_error_m = 0.0;  ///< Mean length of the horizontal error of an efficient estimator.
  double variance_m2 = 0.0;   ///< Trace of the horizontal covariance.
};

/// Error against the covariance that the method told of it.
struct Nees {
  double value = 0.0;  ///< eᵀ Σ⁻¹ e; of expectation `dof` where the covariance is right.
  int dof = 2;         ///< 2, or 3 where the height was estimated.
};

/// One tag in one run by one method. All lengths in m.
struct TagRecord {
  std::string tag;
  Verdict verdict = Verdict::kNotLocated;
  std::string reason;
  std::size_t reads = 0;                 ///< Of the tag in this run, those that were lost excepted.
  bool moved = false;                    ///< So that it has no place that could be told.
  std::optional<Eigen::Vector3d> truth;  ///< None for a tag that moves.
  std::optional<Eigen::Vector3d> estimate;  ///< Of a located tag.
  bool height_estimated = false;
  double expected_error = 0.0;              ///< As the method told it, of the best candidate.
  std::optional<double> error;              ///< Horizontal, of a located tag with a known place.
  std::optional<double> error_3d;           ///< Likewise, where the height was estimated.
  std::optional<double> aligned_error;      ///< After the best rigid motion of the run's tags.
  std::optional<double> nearest_candidate;  ///< Error of the best candidate of an ambiguous tag.
  std::optional<TagBound> bound;
  std::optional<Nees> nees;
  bool false_claim = false;  ///< Located, but no place is right, or too far off for what was told.
};

/// One run (one seed) by one method.
struct MethodRun {
  std::uint64_t seed = 0;
  std::string method;  ///< That made the estimates; of "auto" the one that it chose.
  BoundKind bound = BoundKind::kSingle;
  std::vector<TagRecord> tags;  ///< In the scenario's order, reference tags left out.
  /// Σ_ij ‖Σ_ii^(−1/2) Σ_ij Σ_jj^(−1/2)‖² over the tags that have a `nees`, by the bound.
  double nees_correlation = 0.0;
  double seconds = 0.0;        ///< That the method took.
  std::size_t tags_given = 0;  ///< In which it located so many tags, the reference tags too.
};

/// All runs of one method in one condition.
struct BenchEntry {
  std::string condition;
  std::string name;             ///< Of the method, in the suite.
  std::string method;           ///< As Tagfield calls it.
  std::vector<MethodRun> runs;  ///< In rising order of seeds.
};

/// One condition, as it was run.
struct BenchCondition {
  std::string name;
  std::string scenario;             ///< Name; "" of a recording.
  std::string recording;            ///< Name of its file or folder; "" of a scenario.
  std::vector<std::string> faults;  ///< By the suite's keys.
  std::string pose;  ///< "true", "noisy", "odometry", "slam"; of a recording "given".
  std::size_t runs_planned = 0;
  /// Whether the bound takes the pose error into account: not where nobody knows its model.
  bool bound_knows_pose_error = true;
  std::string no_bound;  ///< Why there is no bound; "" where there is one.
};

struct Bench {
  std::string name;
  std::string description;
  bool complete = true;  ///< False where it was interrupted.
  std::vector<BenchCondition> conditions;
  std::vector<BenchEntry> entries;  ///< By condition, then by method, both in the suite's order.
  std::vector<std::string> warnings;
  double wall_s = 0.0;
  int threads = 1;
};

/// Each condition with each seed is simulated once, and all its methods get the same problem. The
/// result does not depend on the number of threads, times excepted. Runs that were not over when
/// `control.stop` was set are left out. Warnings are those of each condition's first seed. What
/// runs come to goes into `store`, where given, or is taken from there (its keys: place of the
/// condition in the suite, seed).
Bench run_bench(const PreparedSuite& prepared, const RunControl& control,
                RunStore* store = nullptr);

/// Reads scenarios, then runs. Throws Error as prepare() does, and on a recording that is there.
Bench run_bench(const Suite& suite, const std::vector<Method>& methods, const RunControl& control);

}  // namespace tagfield
