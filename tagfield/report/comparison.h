// SPDX-License-Identifier: Apache-2.0
/// @file
/// Two runs side by side: what each read and located, tag by tag.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/report/summary.h"

namespace tagfield {

/// The outcome of a tag in one of the runs, over all its seeds.
struct ComparedOutcome {
  std::size_t reads = 0;
  /// In two or three words: whether it was located, or only read, in a run that locates nothing;
  /// "not there" if only in the other run.
  std::string verdict;
  std::optional<double> error_m;              ///< Mean over the seeds that have one.
  std::optional<Eigen::Vector3d> position_m;  ///< The estimate of the first seed.
};

struct ComparedTag {
  std::string tag;
  std::array<ComparedOutcome, 2> runs;
  std::optional<Eigen::Vector3d> truth_m;  ///< From the first run that knows it.
};

/// One of the runs as a whole, over all its seeds.
struct ComparedRun {
  std::string name;  ///< As requested.
  std::string scenario;
  std::string method;
  std::string pose;  ///< Summary::pose.
  std::vector<std::uint64_t> seeds;
  std::size_t runs = 1;      ///< One per seed; 1 for a recording.
  bool locates = true;       ///< False for an inventory alone.
  std::size_t tags = 0;      ///< Outcomes of all tags, over all seeds.
  std::size_t outcomes = 0;  ///< Of tags to be located, over all seeds.
  std::size_t located = 0;
  std::size_t read = 0;   ///< Outcomes of tags that were read at all.
  std::size_t reads = 0;  ///< Of all tags and seeds.
  double path_length_m = 0.0;
  std::optional<ErrorStatistics> error_m;
};

/// Errors of the second run minus those of the first, over the tags that have one in both.
struct ErrorDifference {
  std::size_t tags = 0;
  std::size_t smaller = 0;  ///< Tags with the smaller error in the second run.
  std::size_t larger = 0;
  double mean_m = 0.0;
  /// 95 % confidence interval of the mean by Student's t, assuming independent tags; none for a
  /// single tag.
  std::optional<std::array<double, 2>> interval_m;
};

struct RunComparison {
  std::array<ComparedRun, 2> runs;
  std::vector<ComparedTag> tags;  ///< Of both runs, in natural order.
  std::optional<ErrorDifference> error;
  std::vector<std::string> warnings;
};

/// Compares two runs. A tag's true position that only one of them knows is used for both, with a
/// warning. Throws Error if the runs have no tag in common.
RunComparison compared(Summary first, const std::string& first_name, Summary second,
                       const std::string& second_name);

/// Whether either run locates tags; if neither does, only their reads can be compared.
bool any_locates(const RunComparison& comparison);

/// A count over all seeds of `run`, as the mean of its runs.
double per_run(const ComparedRun& run, std::size_t count);

/// Counts are over all seeds. `{runs: [{name, scenario, method, pose, seeds, tags, located, read,
/// reads, path_length_m, error_m}], error_difference_m: {tags, smaller, larger, mean, low, high} or
/// null, tags: [{tag, truth_m, runs: [{reads, verdict, error_m, estimate_m}]}], warnings}`.
std::string comparison_to_json(const RunComparison& comparison);

/// `tag,first_reads,second_reads,first_verdict,second_verdict,first_error_m,second_error_m,
/// difference_m`, one row per tag.
std::string comparison_to_csv(const RunComparison& comparison);

}  // namespace tagfield
