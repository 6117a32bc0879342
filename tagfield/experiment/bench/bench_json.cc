// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "tagfield/experiment/bench/bench_files.h"
#include "tagfield/experiment/internal/statistics.h"

namespace tagfield {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json text(const std::string& words) { return words.empty() ? Json(nullptr) : Json(words); }

Json to_json(const std::optional<ErrorStatistics>& statistics) {
  if (!statistics) return nullptr;
  return {{"mean", number(statistics->mean)}, {"median", number(statistics->median)},
          {"p95", number(statistics->p95)},   {"max", number(statistics->max)},
          {"min", number(statistics->min)},   {"count", statistics->count}};
}

Json to_json(const std::optional<BoundRatio>& ratio) {
  if (!ratio) return nullptr;
  return {{"mean", number(ratio->mean)}, {"rms", number(ratio->rms)}, {"count", ratio->count}};
}

Json to_json(const std::optional<NeesSummary>& nees) {
  if (!nees) return nullptr;
  return {{"mean", number(nees->mean)},
          {"expected", number(nees->expected)},
          {"band", Json::array({number(nees->band.low), number(nees->band.high)})},
          {"verdict", to_string(nees->consistency)},
          {"count", nees->count}};
}

Json to_json(const BenchCondition& condition) {
  return {{"name", condition.name},
          {"scenario", text(condition.scenario)},
          {"recording", text(condition.recording)},
          {"faults", condition.faults},
          {"pose", condition.pose},
          {"runs_planned", condition.runs_planned},
          {"bound_knows_pose_error", condition.bound_knows_pose_error},
          {"no_bound", text(condition.no_bound)}};
}

Json to_json(const BenchEntry& entry, Timing timing) {
  const EntryStatistics all = statistics_of(entry);
  Json json = {{"condition", entry.condition},
               {"name", entry.name},
               {"method", entry.method},
               {"methods_used", all.methods_used},
               {"runs", all.runs},
               {"tags", all.tags},
               {"located", all.located},
               {"ambiguous", all.ambiguous},
               {"not_located", all.not_located},
               {"wrong", all.wrong},
               {"false_claims", all.false_claims},
               {"error_m", to_json(all.error_m)},
               {"error_3d_m", to_json(all.error_3d_m)},
               {"aligned_error_m", to_json(all.aligned_error_m)},
               {"nearest_candidate_m", to_json(all.nearest_candidate_m)},
               {"candidate_hits", all.candidate_hits},
               {"error_over_expected",
                all.error_over_expected ? number(*all.error_over_expected) : Json(nullptr)},
               {"bound", all.bound},
               {"ratio_to_bound", to_json(all.ratio)},
               {"nees", to_json(all.nees)}};
  if (timing == Timing::kWithTimes) {
    json["time_per_tag_ms"] = all.time_per_tag_ms ? number(*all.time_per_tag_ms) : Json(nullptr);
  }
  return json;
}

}  // namespace

std::string bench_to_json(const Bench& bench, Timing timing) {
  Json json = {{"suite", bench.name},        {"description", bench.description},
               {"complete", bench.complete}, {"conditions", Json::array()},
               {"entries", Json::array()},   {"warnings", bench.warnings}};
  for (const BenchCondition& condition : bench.conditions) {
    json["conditions"].push_back(to_json(condition));
  }
  for (const BenchEntry& entry : bench.entries) json["entries"].push_back(to_json(entry, timing));
  if (timing == Timing::kWithTimes) {
    json["wall_s"] = number(bench.wall_s);
    json["threads"] = bench.threads;
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tagfield
