// SPDX-License-Identifier: Apache-2.0
/// @file
/// A sweep divided into points and runs. Work is keyed, not scheduled: the set of runs follows from
/// the suite alone (and, if it is adaptive, from the closed rungs), so it makes no difference which
/// process does which run, or when.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/experiment/bench/suite.h"
#include "tagfield/experiment/store/result_log.h"

namespace tagfield {

/// One set of values of the swept keys.
struct SweepPoint {
  std::size_t condition = 0;       ///< In the suite.
  std::vector<Override> settings;  ///< Of the swept keys.
  std::uint64_t seeds = 1;         ///< Total number of seeds.
  std::string name;  ///< "pose.sigma_m=0.01, …", after the condition's if there are several.
};

struct SweepPlan {
  Suite suite;
  std::vector<std::string> keys;  ///< Swept ones, in the suite's order.
  std::vector<SweepPoint> points;
};

/// The points of each rung except the first, in ascending order; empty for a sweep that is not
/// adaptive.
struct ClosedRungs {
  std::vector<std::vector<std::uint64_t>> survivors;
};

/// The plan of a suite; one without a section `sweep` has one point per condition. Throws Error if
/// there are over a million points.
SweepPlan planned(const Suite& suite);

/// Value of a key at a point, as YAML; "" if the point does not set it.
std::string value_at(const SweepPoint& point, const std::string& key);

/// The suite that has this point as its only condition.
Suite suite_of_point(const SweepPlan& plan, std::uint64_t point);

/// Number of seeds per point at the end of each rung: it begins with `first_seeds` and grows by a
/// factor of `keep_one_in` per rung, up to the suite's number in the last. One entry if the sweep
/// is not adaptive.
std::vector<std::uint64_t> rung_seeds(const SweepPlan& plan);

/// Number of points that reach each rung, including the first.
std::vector<std::size_t> rung_points(const SweepPlan& plan);

/// All runs of the closed rungs and of the next, open one. By rung, then by point, then by seed.
std::vector<RunKey> runs_of(const SweepPlan& plan, const ClosedRungs& closed);

/// The part of `runs` for shard `shard` of `count`, 1 ≤ shard ≤ count: every `count`-th one, so
/// that shards have similar costs.
std::vector<RunKey> runs_of_shard(const std::vector<RunKey>& runs, std::size_t shard,
                                  std::size_t count);

/// The points kept after a rung with these scores (less is better): the best 1/`keep_one_in` of
/// them, rounded up; ties go to the first. In ascending order.
std::vector<std::uint64_t> best_of(const std::map<std::uint64_t, double>& scores,
                                   std::uint64_t keep_one_in);

}  // namespace tagfield
