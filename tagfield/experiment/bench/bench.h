// SPDX-License-Identifier: Apache-2.0
/// @file
/// A comparison of methods, the interface of this module: its results, down to each tag of each
/// run, and what they are judged by.
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

/// The Cramér-Rao bound that a method is compared with (tagfield/localization/bound.h).
enum class BoundKind { kSingle, kJoint };

/// "single", "joint".
std::string to_string(BoundKind kind);

/// The best accuracy attainable for a tag in this run.
struct TagBound {
  double mean_error_m = 0.0;  ///< Mean length of the horizontal error of an efficient estimator.
  double variance_m2 = 0.0;   ///< Trace of the horizontal covariance.
};

/// Error normalized by the covariance that the method stated (NEES).
struct Nees {
  double value = 0.0;  ///< eᵀ Σ⁻¹ e; has the expectation `dof` if the covariance is right.
  int dof = 2;         ///< 2, or 3 if the height was estimated.
};

/// One tag in one run by one method. All lengths in m.
struct TagRecord {
  std::string tag;
  Verdict verdict = Verdict::kNotLocated;
  std::string reason;
  std::size_t reads = 0;                    ///< Of the tag in this run, without lost ones.
  bool moved = false;                       ///< If so, it has no single true position.
  std::optional<Eigen::Vector3d> truth;     ///< None for a moving tag.
  std::optional<Eigen::Vector3d> estimate;  ///< Of a located tag.
  bool height_estimated = false;
  double expected_error = 0.0;  ///< As stated by the method, of the best candidate.
  bool claims_no_error =
      false;                    ///< The method states 0; without, an `expected_error` of 0 is none.
  std::optional<double> error;  ///< Horizontal, of a located tag with a known position.
  std::optional<double> error_3d;           ///< Same, but in 3D, if the height was estimated.
  std::optional<double> aligned_error;      ///< After the best rigid motion of the run's tags.
  std::optional<double> nearest_candidate;  ///< Error of an ambiguous tag's closest candidate.
  std::optional<TagBound> bound;
  std::optional<Nees> nees;
  bool false_claim = false;      ///< Located, but no position is true, or far off the stated error.
  bool flat_covariance = false;  ///< That of a located tag has no inverse, so there is no `nees`.
};

/// One run (one seed) by one method.
struct MethodRun {
  std::uint64_t seed = 0;
  std::string method;  ///< The one that made the estimates; for "auto" the one that it chose.
  BoundKind bound = BoundKind::kSingle;
  std::vector<TagRecord> tags;  ///< In the scenario's order, without reference tags.
  /// Σ_ij ‖Σ_ii^(−1/2) Σ_ij Σ_jj^(−1/2)‖² over the tags that have a `nees`, from the bound's
  /// covariance.
  double nees_correlation = 0.0;
  double seconds = 0.0;        ///< Run time of the method.
  std::size_t tags_given = 0;  ///< Number of tags given to the method, including reference tags.
};

/// All runs of one method in one condition.
struct BenchEntry {
  std::string condition;
  std::string name;             ///< Of the method, in the suite.
  std::string method;           ///< Its name in Tagfield.
  std::vector<MethodRun> runs;  ///< In ascending order of seeds.
};

/// One condition, as it was run.
struct BenchCondition {
  std::string name;
  std::string scenario;             ///< Name; "" for a recording.
  std::string recording;            ///< Name of its file or folder; "" for a scenario.
  std::vector<std::string> faults;  ///< Named by the suite's keys.
  std::string pose;  ///< "true", "noisy", "odometry", "slam"; for a recording "given".
  std::size_t runs_planned = 0;
  /// Whether the bound takes the pose error into account: not if its model is unknown.
  bool bound_knows_pose_error = true;
  std::string no_bound;  ///< Why there is no bound; "" if there is one.
};

struct Bench {
  std::string name;
  std::string description;
  bool complete = true;  ///< False if it was interrupted.
  std::vector<BenchCondition> conditions;
  std::vector<BenchEntry> entries;  ///< By condition, then by method, both in the suite's order.
  std::vector<std::string> warnings;
  double wall_s = 0.0;
  int threads = 1;
};

/// Simulates each condition once per seed; all methods get the same problem. The result does not
/// depend on the number of threads, except for times. Runs not finished when `control.stop` was set
/// are left out. Warnings are those of each condition's first seed. If `store` is given, results of
/// runs are added to it, or taken from it (its keys: index of the condition in the suite, seed).
Bench run_bench(const PreparedSuite& prepared, const RunControl& control,
                RunStore* store = nullptr);

/// Prepares the suite, then runs it. Throws Error as prepare() does, and on any recording that
/// exists, as it cannot read recordings.
Bench run_bench(const Suite& suite, const std::vector<Method>& methods, const RunControl& control);

}  // namespace tagfield
