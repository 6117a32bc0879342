// SPDX-License-Identifier: Apache-2.0
/// @file
/// A sweep taken apart into points and runs. Work is keyed, not scheduled: which runs there are
/// follows from the suite alone (and, where it is adaptive, from the rungs that are closed), so
/// whoever does which run when makes no difference.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/experiment/bench/suite.h"
#include "tagfield/experiment/store/result_log.h"

namespace tagfield {

/// One set of values that is tried.
struct SweepPoint {
  std::size_t condition = 0;       ///< In the suite.
  std::vector<Override> settings;  ///< Of the swept keys.
  std::uint64_t seeds = 1;         ///< How many it has in all.
  std::string name;  ///< "pose.sigma_m=0.01, …", after the condition's where several.
};

struct SweepPlan {
  Suite suite;
  std::vector<std::string> keys;  ///< Swept ones, in the suite's order.
  std::vector<SweepPoint> points;
};

/// The points of which each rung but the first consists, rising; of a sweep that is not adaptive
/// none.
struct ClosedRungs {
  std::vector<std::vector<std::uint64_t>> survivors;
};

/// A suite without a section `sweep` has a point for each condition. Throws Error where points are
/// over a million.
SweepPlan planned(const Suite& suite);

/// Value of a key at a point, as YAML; "" where the point leaves it as it is.
std::string value_at(const SweepPoint& point, const std::string& key);

/// The suite that has this point as its only condition.
Suite suite_of_point(const SweepPlan& plan, std::uint64_t point);

/// Seeds of each point at the end of each rung, from `first_seeds` on, `keep_one_in` times as many
/// in each, the last with all that the suite has. One entry where it is not adaptive.
std::vector<std::uint64_t> rung_seeds(const SweepPlan& plan);

/// How many points reach each rung, the first included.
std::vector<std::size_t> rung_points(const SweepPlan& plan);

/// All runs of the rungs that are open: all closed ones and the next. By rung, then by point, then
/// by seed.
std::vector<RunKey> runs_of(const SweepPlan& plan, const ClosedRungs& closed);

/// Which of `runs` shard `shard` of `count` does, 1 ≤ shard ≤ count: every `count`-th from there
/// on, so that shards cost alike.
std::vector<RunKey> runs_of_shard(const std::vector<RunKey>& runs, std::size_t shard,
                                  std::size_t count);

/// The points that go on after a rung whose points came out with these scores (less is better): the
/// best one in `keep_one_in`, rounded up; of equal ones the first. Rising.
std::vector<std::uint64_t> best_of(const std::map<std::uint64_t, double>& scores,
                                   std::uint64_t keep_one_in);

}  // namespace tagfield
