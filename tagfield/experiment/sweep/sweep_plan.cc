// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/sweep/sweep_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tagfield/base/random.h"
#include "tagfield/experiment/sweep/design.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxPoints = 1'000'000;

using Settings = std::vector<Override>;

/// The value as YAML. Six digits are enough, and look like what a person would have written.
std::string value_text(double value, bool integer) {
  return integer ? fmt::format("{:.0f}", std::round(value)) : fmt::format("{:.6g}", value);
}

/// The value at `share` of the span, in [0, 1].
std::string value_along(const NumberSpan& span, double share) {
  const double value = span.logarithmic ? span.from * std::pow(span.to / span.from, share)
                                        : span.from + (span.to - span.from) * share;
  return value_text(value, span.integer);
}

std::vector<std::string> values_of(const SweptKey& key) {
  if (const auto* listed = std::get_if<std::vector<std::string>>(&key.values)) return *listed;
  const auto& span = std::get<NumberSpan>(key.values);
  std::vector<std::string> values;
  for (std::size_t i = 0; i < span.steps; ++i) {
    values.push_back(
        value_along(span, static_cast<double>(i) / static_cast<double>(span.steps - 1)));
    if (i > 0 && values[i] == values[i - 1]) {
      fail(key.location,
           fmt::format("{}: {} steps are more than there are values between", key.key, span.steps));
    }
  }
  return values;
}

void require_few(std::size_t points, const Location& location) {
  if (points <= kMaxPoints) return;
  fail(location, fmt::format("the sweep has over {} points", kMaxPoints));
}

std::vector<Settings> settings_of(const GridDesign& grid, const Location& location) {
  std::vector<Settings> points = {{}};
  for (const SweptKey& key : grid.keys) {
    const std::vector<std::string> values = values_of(key);
    require_few(points.size() * values.size(), location);
    std::vector<Settings> more;
    more.reserve(points.size() * values.size());
    for (const Settings& point : points) {
      for (const std::string& value : values) {
        more.push_back(point);
        more.back().emplace_back(key.key, value);
      }
    }
    points = std::move(more);
  }
  return points;
}

/// The numbers below `count` in random order (Fisher and Yates).
std::vector<std::size_t> shuffled(std::size_t count, RandomStream& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) {
    const auto other = static_cast<std::size_t>(uniform(random) * static_cast<double>(i));
    std::swap(order[i - 1], order[other]);
  }
  return order;
}

/// The value of a key at `share` of the stratum.
std::string value_in_stratum(const SweptKey& key, std::size_t stratum, std::size_t strata,
                             double share) {
  if (const auto* listed = std::get_if<std::vector<std::string>>(&key.values)) {
    return (*listed)[stratum % listed->size()];
  }
  return value_along(std::get<NumberSpan>(key.values),
                     (static_cast<double>(stratum) + share) / static_cast<double>(strata));
}

std::vector<Settings> settings_of(const LatinHypercubeDesign& design) {
  std::vector<Settings> points(design.points);
  for (const SweptKey& key : design.keys) {
    RandomStream random(design.seed, Purpose::kSweep, stream_key(key.key));
    const std::vector<std::size_t> strata = shuffled(design.points, random);
    for (std::size_t i = 0; i < design.points; ++i) {
      points[i].emplace_back(key.key,
                             value_in_stratum(key, strata[i], design.points, uniform(random)));
    }
  }
  return points;
}

std::vector<Settings> settings_of(const SweepDesign& design) {
  if (const auto* grid = std::get_if<GridDesign>(&design.points)) {
    return settings_of(*grid, design.location);
  }
  if (const auto* list = std::get_if<ListDesign>(&design.points)) return list->points;
  return settings_of(std::get<LatinHypercubeDesign>(design.points));
}

std::string name_of(const std::string& condition, const Settings& settings) {
  std::string name = condition;
  for (const auto& [key, value] : settings) {
    name += fmt::format("{}{}={}", name.empty() ? "" : ", ", key, value);
  }
  return name;
}

std::vector<std::string> keys_in(const std::vector<Settings>& points) {
  std::vector<std::string> keys;
  for (const Settings& point : points) {
    for (const Override& setting : point) {
      if (std::find(keys.begin(), keys.end(), setting.first) == keys.end()) {
        keys.push_back(setting.first);
      }
    }
  }
  return keys;
}

std::uint64_t seeds_of(const Suite& suite, const Condition& condition) {
  return condition.recording ? 1 : condition.count.value_or(suite.count);
}

void refuse_sweep_of_recordings(const Suite& suite) {
  for (const Condition& condition : suite.conditions) {
    if (suite.sweep && condition.recording) {
      fail(condition.location, "a recording has no keys of a scenario that could be swept");
    }
    if (suite.sweep && suite.sweep->adaptive && condition.count) {
      fail(condition.location, "'seeds' of a condition can't be used with an adaptive sweep");
    }
  }
}

void add_runs(const SweepPlan& plan, std::uint64_t point, std::uint64_t from, std::uint64_t to,
              std::vector<RunKey>& runs) {
  for (std::uint64_t seed = from; seed < to; ++seed) {
    runs.push_back({point, plan.suite.first_seed + seed});
  }
}

}  // namespace

SweepPlan planned(const Suite& suite) {
  refuse_sweep_of_recordings(suite);
  SweepPlan plan;
  plan.suite = suite;
  const std::vector<Settings> settings =
      suite.sweep ? settings_of(*suite.sweep) : std::vector<Settings>{{}};
  plan.keys = keys_in(settings);
  const bool one = suite.conditions.size() == 1 && suite.sweep;
  const Location location = suite.sweep ? suite.sweep->location : suite.conditions[0].location;
  require_few(suite.conditions.size() * settings.size(), location);
  for (std::size_t i = 0; i < suite.conditions.size(); ++i) {
    const Condition& condition = suite.conditions[i];
    for (const Settings& point : settings) {
      plan.points.push_back(
          {i, point, seeds_of(suite, condition), name_of(one ? "" : condition.name, point)});
    }
  }
  return plan;
}

std::string value_at(const SweepPoint& point, const std::string& key) {
  for (const auto& [name, value] : point.settings) {
    if (name == key) return value;
  }
  return "";
}

Suite suite_of_point(const SweepPlan& plan, std::uint64_t point) {
  const SweepPoint& of = plan.points.at(point);
  Suite suite;
  suite.name = plan.suite.name;
  suite.first_seed = plan.suite.first_seed;
  suite.count = of.seeds;
  suite.methods = plan.suite.methods;
  Condition condition = plan.suite.conditions[of.condition];
  condition.name = of.name;
  condition.settings.insert(condition.settings.end(), of.settings.begin(), of.settings.end());
  suite.conditions = {std::move(condition)};
  return suite;
}

std::vector<std::uint64_t> rung_seeds(const SweepPlan& plan) {
  if (!plan.suite.sweep || !plan.suite.sweep->adaptive) return {plan.suite.count};
  const Halving& halving = *plan.suite.sweep->adaptive;
  std::vector<std::uint64_t> seeds = {halving.first_seeds};
  while (seeds.back() < plan.suite.count) {
    seeds.push_back(std::min(plan.suite.count, seeds.back() * halving.keep_one_in));
  }
  return seeds;
}

std::vector<std::size_t> rung_points(const SweepPlan& plan) {
  std::vector<std::size_t> points = {plan.points.size()};
  for (std::size_t rung = 1; rung < rung_seeds(plan).size(); ++rung) {
    const std::uint64_t one_in = plan.suite.sweep->adaptive->keep_one_in;
    points.push_back((points.back() + one_in - 1) / one_in);
  }
  return points;
}

std::vector<RunKey> runs_of(const SweepPlan& plan, const ClosedRungs& closed) {
  std::vector<RunKey> runs;
  const std::vector<std::uint64_t> seeds = rung_seeds(plan);
  const bool adaptive = seeds.size() > 1;
  for (std::uint64_t point = 0; point < plan.points.size(); ++point) {
    add_runs(plan, point, 0, adaptive ? seeds[0] : plan.points[point].seeds, runs);
  }
  for (std::size_t rung = 0; rung < closed.survivors.size() && rung + 1 < seeds.size(); ++rung) {
    for (const std::uint64_t point : closed.survivors[rung]) {
      add_runs(plan, point, seeds[rung], seeds[rung + 1], runs);
    }
  }
  return runs;
}

std::vector<RunKey> runs_of_shard(const std::vector<RunKey>& runs, std::size_t shard,
                                  std::size_t count) {
  std::vector<RunKey> own;
  own.reserve(runs.size() / count + 1);
  for (std::size_t i = shard - 1; i < runs.size(); i += count) own.push_back(runs[i]);
  return own;
}

std::vector<std::uint64_t> best_of(const std::map<std::uint64_t, double>& scores,
                                   std::uint64_t keep_one_in) {
  std::vector<std::pair<double, std::uint64_t>> order;
  order.reserve(scores.size());
  for (const auto& [point, score] : scores) order.emplace_back(score, point);
  std::sort(order.begin(), order.end());
  order.resize((order.size() + keep_one_in - 1) / keep_one_in);
  std::vector<std::uint64_t> best;
  best.reserve(order.size());
  for (const auto& [score, point] : order) best.push_back(point);
  std::sort(best.begin(), best.end());
  return best;
}

}  // namespace tagfield
