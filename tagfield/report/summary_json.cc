// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "tagfield/base/error.h"
#include "tagfield/report/internal/checked_json.h"
#include "tagfield/report/summary.h"

namespace tagfield {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kFarOffM = 0.3;  ///< [m]

// Members of structs in the file, by name, in the file's order, for both writing and reading.

constexpr auto fields(const ErrorStatistics* /*of*/) {
  using S = ErrorStatistics;
  return std::tuple(std::pair("mean", &S::mean), std::pair("median", &S::median),
                    std::pair("p95", &S::p95), std::pair("max", &S::max), std::pair("min", &S::min),
                    std::pair("count", &S::count));
}

constexpr auto fields(const PoseErrorSummary* /*of*/) {
  using S = PoseErrorSummary;
  return std::tuple(std::pair("sigma_m", &S::sigma_m),
                    std::pair("time_constant_s", &S::time_constant_s),
                    std::pair("yaw_sigma_rad", &S::yaw_sigma_rad),
                    std::pair("position_rms_m", &S::position_rms_m),
                    std::pair("error_with_true_pose_m", &S::error_with_true_pose_m),
                    std::pair("corrected_rms_m", &S::corrected_rms_m));
}

constexpr auto fields(const ComparedPose* /*of*/) {
  using S = ComparedPose;
  return std::tuple(std::pair("pose", &S::pose), std::pair("position_rms_m", &S::position_rms_m),
                    std::pair("error_m", &S::error_m), std::pair("located", &S::located));
}

constexpr auto fields(const MethodSummary* /*of*/) {
  using S = MethodSummary;
  return std::tuple(std::pair("method", &S::method), std::pair("located", &S::located),
                    std::pair("ambiguous", &S::ambiguous),
                    std::pair("not_located", &S::not_located), std::pair("error_m", &S::error_m),
                    std::pair("aligned_error_m", &S::aligned_error_m));
}

constexpr auto fields(const FindingSummary* /*of*/) {
  using S = FindingSummary;
  return std::tuple(std::pair("count", &S::count), std::pair("noticed", &S::noticed),
                    std::pair("found", &S::found), std::pair("wrong", &S::wrong),
                    std::pair("seconds", &S::seconds), std::pair("driven_m", &S::driven_m));
}

constexpr auto fields(const UnreachedGoal* /*of*/) {
  using S = UnreachedGoal;
  return std::tuple(std::pair("seed", &S::seed), std::pair("goal", &S::goal),
                    std::pair("reason", &S::reason));
}

constexpr auto fields(const NavigationSummary* /*of*/) {
  using S = NavigationSummary;
  return std::tuple(
      std::pair("walls_found", &S::walls_found), std::pair("walls_false", &S::walls_false),
      std::pair("walls_double", &S::walls_double), std::pair("floor_known", &S::floor_known),
      std::pair("mapping_path_m", &S::mapping_path_m), std::pair("mapping_s", &S::mapping_s),
      std::pair("position_error_m", &S::position_error_m),
      std::pair("yaw_error_rad", &S::yaw_error_rad), std::pair("goals", &S::goals),
      std::pair("goals_reached", &S::goals_reached),
      std::pair("goals_unreached", &S::goals_unreached), std::pair("closest_m", &S::closest_m),
      std::pair("collisions", &S::collisions), std::pair("times_lost", &S::times_lost),
      std::pair("unknown_starts", &S::unknown_starts), std::pair("kidnapped", &S::kidnapped),
      std::pair("lost", &S::lost));
}

constexpr auto fields(const InventoryShare* /*of*/) {
  using S = InventoryShare;
  return std::tuple(std::pair("name", &S::name), std::pair("reader", &S::reader),
                    std::pair("tags", &S::tags), std::pair("only", &S::only),
                    std::pair("reads", &S::reads));
}

constexpr auto fields(const CrossRead* /*of*/) {
  using S = CrossRead;
  return std::tuple(std::pair("reader", &S::reader), std::pair("tags", &S::tags),
                    std::pair("reads", &S::reads));
}

constexpr auto fields(const ZoneInventory* /*of*/) {
  using S = ZoneInventory;
  return std::tuple(std::pair("zone", &S::zone), std::pair("readers", &S::readers),
                    std::pair("tags", &S::tags), std::pair("read", &S::read),
                    std::pair("read_by_own", &S::read_by_own), std::pair("crossed", &S::crossed),
                    std::pair("cross", &S::cross));
}

constexpr auto fields(const LevelInventory* /*of*/) {
  using S = LevelInventory;
  return std::tuple(std::pair("low_m", &S::low_m), std::pair("high_m", &S::high_m),
                    std::pair("tags", &S::tags), std::pair("read", &S::read));
}

constexpr auto fields(const InventoryMoment* /*of*/) {
  using S = InventoryMoment;
  return std::tuple(std::pair("time_s", &S::time_s), std::pair("share", &S::share));
}

constexpr auto fields(const ReachedShare* /*of*/) {
  using S = ReachedShare;
  return std::tuple(std::pair("share", &S::share), std::pair("time_s", &S::time_s));
}

constexpr auto fields(const InventoryWithout* /*of*/) {
  using S = InventoryWithout;
  return std::tuple(std::pair("antenna", &S::antenna), std::pair("read", &S::read));
}

constexpr auto fields(const InventorySummary* /*of*/) {
  using S = InventorySummary;
  return std::tuple(std::pair("tags", &S::tags), std::pair("duration_s", &S::duration_s),
                    std::pair("read", &S::read), std::pair("min_read", &S::min_read),
                    std::pair("max_read", &S::max_read), std::pair("reads", &S::reads),
                    std::pair("median_reads", &S::median_reads), std::pair("reached", &S::reached),
                    std::pair("readers", &S::readers), std::pair("antennas", &S::antennas),
                    std::pair("zones", &S::zones), std::pair("levels", &S::levels),
                    std::pair("without", &S::without), std::pair("curve", &S::curve));
}

constexpr auto fields(const EffectCost* /*of*/) {
  using S = EffectCost;
  return std::tuple(std::pair("effect", &S::effect), std::pair("set", &S::set),
                    std::pair("tags", &S::tags), std::pair("located", &S::located),
                    std::pair("reads", &S::reads), std::pair("error_m", &S::error_m));
}

/// Members of a run; tags and warnings follow after their counts.
constexpr auto fields(const Summary* /*of*/) {
  using S = Summary;
  return std::tuple(
      std::pair("scenario", &S::scenario), std::pair("description", &S::description),
      std::pair("seeds", &S::seeds), std::pair("method", &S::method),
      std::pair("method_asked", &S::method_asked), std::pair("method_why", &S::method_why),
      std::pair("pose", &S::pose), std::pair("complete", &S::complete),
      std::pair("path_length_m", &S::path_length_m), std::pair("reads", &S::reads),
      std::pair("simulated_s", &S::simulated_s), std::pair("wall_s", &S::wall_s),
      std::pair("real_time_factor", &S::real_time_factor), std::pair("pose_error", &S::pose_error),
      std::pair("compared_pose", &S::compared_pose),
      std::pair("compared_methods", &S::compared_methods), std::pair("navigation", &S::navigation),
      std::pair("inventory", &S::inventory), std::pair("effects", &S::effects));
}

template <class Value>
concept Struct = requires(const Value* value) {
  fields(value);
};

Json json_of(bool value) { return value; }
Json json_of(std::uint64_t value) { return value; }
Json json_of(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json json_of(const std::string& value) { return value; }
Json json_of(EffectSet value) { return to_string(value); }
Json json_of(const Eigen::Vector3d& p) {
  return Json::array({json_of(p.x()), json_of(p.y()), json_of(p.z())});
}
template <Struct Value>
Json json_of(const Value& value);
template <class Value>
Json json_of(const std::vector<Value>& values);

template <class Value>
Json json_of(const std::optional<Value>& value) {
  return value ? json_of(*value) : Json(nullptr);
}

template <class Value>
Json json_of(const std::vector<Value>& values) {
  Json list = Json::array();
  for (const Value& value : values) list.push_back(json_of(value));
  return list;
}

template <Struct Value>
Json json_of(const Value& value) {
  Json json;
  const auto put = [&](const auto&... field) {
    ((json[field.first] = json_of(value.*field.second)), ...);
  };
  std::apply(put, fields(&value));
  return json;
}

/// One property of each candidate, best first.
template <typename Property>
Json of_each(const std::vector<Candidate>& candidates, Property property) {
  Json list = Json::array();
  for (const Candidate& candidate : candidates) list.push_back(property(candidate));
  return list;
}

void put_candidates(Json& json, const TagEstimate& estimate) {
  const auto& all = estimate.candidates;
  json["rms_m"] = all.empty() ? Json(nullptr) : json_of(all.front().rms_m);
  json["expected_error_m"] = all.empty() ? Json(nullptr) : json_of(all.front().expected_error_m);
  json["candidates_m"] = of_each(all, [](const Candidate& c) { return json_of(c.p_WT); });
  json["candidates_rms_m"] = of_each(all, [](const Candidate& c) { return json_of(c.rms_m); });
  json["candidates_expected_error_m"] =
      of_each(all, [](const Candidate& c) { return json_of(c.expected_error_m); });
}

Json tag_json(const TagOutcome& outcome) {
  const TagEstimate& estimate = outcome.estimate;
  const bool located = estimate.verdict == Verdict::kLocated && !estimate.candidates.empty();
  Json json;
  json["id"] = estimate.tag;
  json["seed"] = outcome.seed;
  json["verdict"] = to_string(estimate.verdict);
  json["reason"] = estimate.reason;
  json["truth_m"] = json_of(outcome.truth_m);
  json["moved"] = outcome.moved;
  json["estimate_m"] = located ? json_of(estimate.candidates.front().p_WT) : Json(nullptr);
  json["error_m"] = json_of(error_of(outcome));
  put_candidates(json, estimate);
  json["reads"] = outcome.reads;
  json["reads_used"] = estimate.reads;
  json["reference"] = outcome.reference;
  return json;
}

EffectSet effect_set_at(const JsonLocation& place) {
  const std::string word = text_at(place);
  for (const EffectSet set :
       {EffectSet::kNone, EffectSet::kAlone, EffectSet::kAllButThis, EffectSet::kAll}) {
    if (word == to_string(set)) return set;
  }
  fail_at(place, "is '" + word + "', expected none, alone, all_but_this or all");
}

void take(const JsonLocation& place, bool& value) { value = truth_at(place); }
void take(const JsonLocation& place, std::uint64_t& value) { value = whole_at(place); }
/// Null, which means unknown, is read as 0.
void take(const JsonLocation& place, double& value) {
  value = is_null(place) ? 0.0 : number_at(place);
}
void take(const JsonLocation& place, std::string& value) { value = text_at(place); }
void take(const JsonLocation& place, EffectSet& value) { value = effect_set_at(place); }
void take(const JsonLocation& place, Eigen::Vector3d& value) { value = point_at(place); }
template <Struct Value>
void take(const JsonLocation& place, Value& value);
template <class Value>
void take(const JsonLocation& place, std::vector<Value>& values);

template <class Value>
void take(const JsonLocation& place, std::optional<Value>& value) {
  if (!is_null(place)) take(place, value.emplace());
}

template <class Value>
void take(const JsonLocation& place, std::vector<Value>& values) {
  for (const JsonLocation& element : elements(place)) take(element, values.emplace_back());
}

template <Struct Value>
void take(const JsonLocation& place, Value& value) {
  const auto take_all = [&](const auto&... field) {
    (take(member(place, field.first), value.*field.second), ...);
  };
  std::apply(take_all, fields(&value));
}

Verdict verdict_at(const JsonLocation& place) {
  const std::string word = text_at(place);
  try {
    return verdict_from_string(word);
  } catch (const Error&) {
    fail_at(place, "is '" + word + "', expected located, ambiguous or not_located");
  }
}

std::vector<Candidate> candidates_at(const JsonLocation& tag) {
  const auto points = elements(member(tag, "candidates_m"));
  const auto misfits = elements(member(tag, "candidates_rms_m"));
  const auto expected = elements(member(tag, "candidates_expected_error_m"));
  if (misfits.size() != points.size() || expected.size() != points.size()) {
    fail_at(tag, "has lists of candidates of different lengths");
  }
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Candidate& candidate = candidates.emplace_back();
    candidate.p_WT = point_at(points[i]);
    take(misfits[i], candidate.rms_m);
    take(expected[i], candidate.expected_error_m);
  }
  return candidates;
}

TagOutcome tag_at(const JsonLocation& place) {
  TagOutcome outcome;
  outcome.seed = whole_at(member(place, "seed"));
  outcome.estimate.tag = text_at(member(place, "id"));
  outcome.estimate.verdict = verdict_at(member(place, "verdict"));
  outcome.estimate.reason = text_at(member(place, "reason"));
  outcome.estimate.candidates = candidates_at(place);
  outcome.reads = whole_at(member(place, "reads"));
  outcome.estimate.reads = whole_at(member(place, "reads_used"));
  take(member(place, "truth_m"), outcome.truth_m);
  outcome.moved = truth_at(member(place, "moved"));
  outcome.reference = truth_at(member(place, "reference"));
  const bool empty = outcome.estimate.candidates.empty();
  if (empty && outcome.estimate.verdict != Verdict::kNotLocated) {
    fail_at(place, "is " + to_string(outcome.estimate.verdict) + " but has no candidates_m");
  }
  return outcome;
}

}  // namespace

std::string to_json(const Summary& summary) {
  Json json = json_of(summary);
  Json& tags = json["tags"] = Json::array();
  for (const TagOutcome& outcome : summary.tags) tags.push_back(tag_json(outcome));
  json["error_m"] = json_of(error_statistics(summary));
  json["over_0_3_m"] = count_over(summary, kFarOffM);
  json["located"] = count(summary, Verdict::kLocated);
  json["ambiguous"] = count(summary, Verdict::kAmbiguous);
  json["not_located"] = count(summary, Verdict::kNotLocated);
  json["warnings"] = summary.warnings;
  // Names come from outside and may not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_json(const InventorySummary& inventory) {
  return json_of(inventory).dump(-1, ' ', false, Json::error_handler_t::replace);
}

InventorySummary inventory_from_json(const std::string& text, const std::string& file) {
  const nlohmann::json json = parsed_json(text, file);
  InventorySummary inventory;
  take(JsonLocation{&json, file, ""}, inventory);
  return inventory;
}

Summary summary_from_json(const std::string& text, const std::string& file) {
  const nlohmann::json json = parsed_json(text, file);
  const JsonLocation top{&json, file, ""};
  Summary summary;
  take(top, summary);
  for (const JsonLocation& tag : elements(member(top, "tags"))) summary.tags.push_back(tag_at(tag));
  take(member(top, "warnings"), summary.warnings);
  return summary;
}

}  // namespace tagfield
