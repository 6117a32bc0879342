#include <cmath>
#include <nlohmann/json.hpp>

#include "tagfield/base/error.h"
#include "tagfield/report/internal/checked_json.h"
#include "tagfield/report/summary.h"

namespace tagfield {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kFarOff = 0.3;  ///< [m]

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json point(const Eigen::Vector3d& p) {
  return Json::array({number(p.x()), number(p.y()), number(p.z())});
}

Json statistics_json(const std::optional<ErrorStatistics>& statistics) {
  if (!statistics) return nullptr;
  return {{"mean", number(statistics->mean)}, {"median", number(statistics->median)},
          {"p95", number(statistics->p95)},   {"max", number(statistics->max)},
          {"min", number(statistics->min)},   {"count", statistics->count}};
}

Json pose_error_json(const std::optional<PoseErrorSummary>& error) {
  if (!error) return nullptr;
  return {{"sigma_m", number(error->sigma_m)},
          {"time_constant_s", number(error->time_constant_s)},
          {"yaw_sigma_rad", number(error->yaw_sigma_rad)},
          {"position_rms_m", number(error->position_rms_m)},
          {"error_with_true_pose_m", statistics_json(error->error_with_true_pose_m)},
          {"corrected_rms_m", number(error->corrected_rms_m)}};
}

Json compared_pose_json(const std::optional<ComparedPose>& compared) {
  if (!compared) return nullptr;
  return {{"pose", compared->pose},
          {"position_rms_m", number(compared->position_rms_m)},
          {"error_m", statistics_json(compared->error_m)},
          {"located", compared->located}};
}

Json compared_methods_json(const std::vector<MethodSummary>& methods) {
  Json rows = Json::array();
  for (const MethodSummary& of_method : methods) {
    rows.push_back({{"method", of_method.method},
                    {"located", of_method.located},
                    {"ambiguous", of_method.ambiguous},
                    {"not_located", of_method.not_located},
                    {"error_m", statistics_json(of_method.error_m)},
                    {"aligned_error_m", statistics_json(of_method.aligned_error_m)}});
  }
  return rows;
}

Json finding_json(const std::optional<FindingSummary>& finding) {
  if (!finding) return nullptr;
  return {{"count", finding->count},
          {"noticed", finding->noticed},
          {"found", finding->found},
          {"wrong", finding->wrong},
          {"seconds", statistics_json(finding->seconds)},
          {"driven_m", statistics_json(finding->driven_m)}};
}

Json unreached_json(const std::vector<UnreachedGoal>& goals) {
  Json list = Json::array();
  for (const UnreachedGoal& goal : goals) {
    list.push_back({{"seed", goal.seed}, {"goal", point(goal.goal)}, {"reason", goal.reason}});
  }
  return list;
}

Json navigation_json(const std::optional<NavigationSummary>& navigation) {
  if (!navigation) return nullptr;
  return {{"walls_found", number(navigation->walls_found)},
          {"walls_false", number(navigation->walls_false)},
          {"walls_double", number(navigation->walls_double)},
          {"floor_known", number(navigation->floor_known)},
          {"mapping_path_m", number(navigation->mapping_path_m)},
          {"mapping_s", number(navigation->mapping_s)},
          {"position_error_m", statistics_json(navigation->position_error_m)},
          {"yaw_error_rad", statistics_json(navigation->yaw_error_rad)},
          {"goals", navigation->goals},
          {"goals_reached", navigation->goals_reached},
          {"goals_unreached", unreached_json(navigation->goals_unreached)},
          {"closest_m", number(navigation->closest_m)},
          {"collisions", navigation->collisions},
          {"times_lost", navigation->times_lost},
          {"unknown_starts", finding_json(navigation->unknown_starts)},
          {"carried", finding_json(navigation->carried)},
          {"lost", finding_json(navigation->lost)}};
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
  json["rms_m"] = all.empty() ? Json(nullptr) : number(all.front().rms_m);
  json["expected_error_m"] = all.empty() ? Json(nullptr) : number(all.front().expected_error_m);
  json["candidates_m"] = of_each(all, [](const Candidate& c) { return point(c.p_WT); });
  json["candidates_rms_m"] = of_each(all, [](const Candidate& c) { return number(c.rms_m); });
  json["candidates_expected_error_m"] =
      of_each(all, [](const Candidate& c) { return number(c.expected_error_m); });
}

Json tag_json(const TagOutcome& outcome) {
  const TagEstimate& estimate = outcome.estimate;
  const bool located = estimate.verdict == Verdict::kLocated && !estimate.candidates.empty();
  Json json;
  json["id"] = estimate.tag;
  json["seed"] = outcome.seed;
  json["verdict"] = to_string(estimate.verdict);
  json["reason"] = estimate.reason;
  json["truth_m"] = outcome.truth_m ? point(*outcome.truth_m) : Json(nullptr);
  json["moved"] = outcome.moved;
  json["estimate_m"] = located ? point(estimate.candidates.front().p_WT) : Json(nullptr);
  json["error_m"] = number(error_of(outcome));
  put_candidates(json, estimate);
  json["reads"] = outcome.reads;
  json["reads_used"] = estimate.reads;
  json["reference"] = outcome.reference;
  return json;
}

Json effects_json(const std::vector<EffectCost>& effects) {
  Json rows = Json::array();
  for (const EffectCost& cost : effects) {
    rows.push_back({{"effect", cost.effect},
                    {"set", to_string(cost.set)},
                    {"tags", cost.tags},
                    {"located", cost.located},
                    {"reads", cost.reads},
                    {"error_m", statistics_json(cost.error_m)}});
  }
  return rows;
}

void put_run(Json& json, const Summary& summary) {
  json["scenario"] = summary.scenario;
  json["description"] = summary.description;
  json["seeds"] = summary.seeds;
  json["method"] = summary.method;
  json["method_asked"] = summary.method_asked;
  json["method_why"] = summary.method_why;
  json["pose"] = summary.pose;
  json["complete"] = summary.complete;
  json["path_length_m"] = number(summary.path_length_m);
  json["reads"] = summary.reads;
  json["simulated_s"] = number(summary.simulated_s);
  json["wall_s"] = number(summary.wall_s);
  json["real_time_factor"] = number(summary.real_time_factor);
  json["pose_error"] = pose_error_json(summary.pose_error);
  json["compared_pose"] = compared_pose_json(summary.compared_pose);
  json["compared_methods"] = compared_methods_json(summary.compared_methods);
  json["navigation"] = navigation_json(summary.navigation);
  json["effects"] = effects_json(summary.effects);
}

/// A figure of the run; null, that is unknown, reads as 0.
double number_or_zero(const JsonPlace& place) { return is_null(place) ? 0.0 : number_at(place); }

std::optional<ErrorStatistics> statistics_at(const JsonPlace& place) {
  if (is_null(place)) return std::nullopt;
  ErrorStatistics result;
  result.count = whole_at(member(place, "count"));
  result.mean = number_at(member(place, "mean"));
  result.median = number_at(member(place, "median"));
  result.p95 = number_at(member(place, "p95"));
  result.max = number_at(member(place, "max"));
  result.min = number_at(member(place, "min"));
  return result;
}

std::optional<PoseErrorSummary> pose_error_at(const JsonPlace& place) {
  if (is_null(place)) return std::nullopt;
  PoseErrorSummary result;
  result.sigma_m = number_or_zero(member(place, "sigma_m"));
  result.time_constant_s = number_or_zero(member(place, "time_constant_s"));
  result.yaw_sigma_rad = number_or_zero(member(place, "yaw_sigma_rad"));
  result.position_rms_m = number_or_zero(member(place, "position_rms_m"));
  result.error_with_true_pose_m = statistics_at(member(place, "error_with_true_pose_m"));
  if (place.value->contains("corrected_rms_m")) {
    const JsonPlace corrected = member(place, "corrected_rms_m");
    if (!is_null(corrected)) result.corrected_rms_m = number_at(corrected);
  }
  return result;
}

/// Summaries of an older version have none.
std::optional<ComparedPose> compared_pose_at(const JsonPlace& top) {
  if (!top.value->contains("compared_pose")) return std::nullopt;
  const JsonPlace place = member(top, "compared_pose");
  if (is_null(place)) return std::nullopt;
  ComparedPose result;
  result.pose = text_at(member(place, "pose"));
  result.position_rms_m = number_or_zero(member(place, "position_rms_m"));
  result.error_m = statistics_at(member(place, "error_m"));
  result.located = whole_at(member(place, "located"));
  return result;
}

/// As compared_pose_at().
std::vector<MethodSummary> compared_methods_at(const JsonPlace& top) {
  std::vector<MethodSummary> methods;
  if (!top.value->contains("compared_methods")) return methods;
  for (const JsonPlace& row : elements(member(top, "compared_methods"))) {
    methods.push_back({text_at(member(row, "method")), whole_at(member(row, "located")),
                       whole_at(member(row, "ambiguous")), whole_at(member(row, "not_located")),
                       statistics_at(member(row, "error_m")),
                       statistics_at(member(row, "aligned_error_m"))});
  }
  return methods;
}

std::optional<FindingSummary> finding_at(const JsonPlace& place) {
  if (is_null(place)) return std::nullopt;
  FindingSummary result;
  result.count = whole_at(member(place, "count"));
  result.noticed = whole_at(member(place, "noticed"));
  result.found = whole_at(member(place, "found"));
  result.wrong = whole_at(member(place, "wrong"));
  result.seconds = statistics_at(member(place, "seconds"));
  result.driven_m = statistics_at(member(place, "driven_m"));
  return result;
}

/// What summaries of an older version don't have.
void take_findings(const JsonPlace& place, NavigationSummary& result) {
  if (!place.value->contains("collisions")) return;
  result.collisions = whole_at(member(place, "collisions"));
  for (const JsonPlace& goal : elements(member(place, "goals_unreached"))) {
    result.goals_unreached.push_back({whole_at(member(goal, "seed")),
                                      point_at(member(goal, "goal")),
                                      text_at(member(goal, "reason"))});
  }
  result.unknown_starts = finding_at(member(place, "unknown_starts"));
  result.carried = finding_at(member(place, "carried"));
  result.lost = finding_at(member(place, "lost"));
}

/// As compared_pose_at().
std::optional<NavigationSummary> navigation_at(const JsonPlace& top) {
  if (!top.value->contains("navigation")) return std::nullopt;
  const JsonPlace place = member(top, "navigation");
  if (is_null(place)) return std::nullopt;
  NavigationSummary result;
  result.walls_found = number_or_zero(member(place, "walls_found"));
  result.walls_false = number_or_zero(member(place, "walls_false"));
  result.walls_double = number_or_zero(member(place, "walls_double"));
  result.floor_known = number_or_zero(member(place, "floor_known"));
  result.mapping_path_m = number_or_zero(member(place, "mapping_path_m"));
  result.mapping_s = number_or_zero(member(place, "mapping_s"));
  result.position_error_m = statistics_at(member(place, "position_error_m"));
  result.yaw_error_rad = statistics_at(member(place, "yaw_error_rad"));
  result.goals = whole_at(member(place, "goals"));
  result.goals_reached = whole_at(member(place, "goals_reached"));
  result.closest_m = number_or_zero(member(place, "closest_m"));
  result.times_lost = whole_at(member(place, "times_lost"));
  take_findings(place, result);
  return result;
}

EffectSet effect_set_at(const JsonPlace& place) {
  const std::string word = text_at(place);
  for (const EffectSet set :
       {EffectSet::kNone, EffectSet::kAlone, EffectSet::kAllButThis, EffectSet::kAll}) {
    if (word == to_string(set)) return set;
  }
  fail_at(place, "is '" + word + "', expected none, alone, all_but_this or all");
}

/// As compared_pose_at().
std::vector<EffectCost> effects_at(const JsonPlace& top) {
  std::vector<EffectCost> effects;
  if (!top.value->contains("effects")) return effects;
  for (const JsonPlace& row : elements(member(top, "effects"))) {
    effects.push_back({text_at(member(row, "effect")), effect_set_at(member(row, "set")),
                       whole_at(member(row, "tags")), whole_at(member(row, "located")),
                       whole_at(member(row, "reads")), statistics_at(member(row, "error_m"))});
  }
  return effects;
}

Verdict verdict_at(const JsonPlace& place) {
  const std::string word = text_at(place);
  try {
    return verdict_from_string(word);
  } catch (const Error&) {
    fail_at(place, "is '" + word + "', expected located, ambiguous or not_located");
  }
}

std::vector<Candidate> candidates_at(const JsonPlace& tag) {
  const auto points = elements(member(tag, "candidates_m"));
  const auto misfits = elements(member(tag, "candidates_rms_m"));
  const auto expected = elements(member(tag, "candidates_expected_error_m"));
  if (misfits.size() != points.size() || expected.size() != points.size()) {
    fail_at(tag, "has lists of candidates of different lengths");
  }
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < points.size(); ++i) {
    candidates.push_back(
        {point_at(points[i]), number_or_zero(misfits[i]), number_or_zero(expected[i])});
  }
  return candidates;
}

TagOutcome tag_at(const JsonPlace& place) {
  TagOutcome outcome;
  outcome.seed = whole_at(member(place, "seed"));
  outcome.estimate.tag = text_at(member(place, "id"));
  outcome.estimate.verdict = verdict_at(member(place, "verdict"));
  outcome.estimate.reason = text_at(member(place, "reason"));
  outcome.estimate.candidates = candidates_at(place);
  outcome.reads = whole_at(member(place, "reads"));
  outcome.estimate.reads = whole_at(member(place, "reads_used"));
  const JsonPlace truth = member(place, "truth_m");
  if (!is_null(truth)) outcome.truth_m = point_at(truth);
  outcome.moved = truth_at(member(place, "moved"));
  const bool told = place.value->contains("reference");
  outcome.reference = told && truth_at(member(place, "reference"));
  const bool empty = outcome.estimate.candidates.empty();
  if (empty && outcome.estimate.verdict != Verdict::kNotLocated) {
    fail_at(place, "is " + to_string(outcome.estimate.verdict) + " but has no candidates_m");
  }
  return outcome;
}

/// As compared_pose_at(): without a word of it, the method that was used was asked for.
void take_method(const JsonPlace& top, Summary& summary) {
  summary.method = text_at(member(top, "method"));
  summary.method_asked = summary.method;
  if (!top.value->contains("method_asked")) return;
  summary.method_asked = text_at(member(top, "method_asked"));
  summary.method_why = text_at(member(top, "method_why"));
}

void take_run(const JsonPlace& top, Summary& summary) {
  summary.scenario = text_at(member(top, "scenario"));
  summary.description = text_at(member(top, "description"));
  for (const JsonPlace& seed : elements(member(top, "seeds"))) {
    summary.seeds.push_back(whole_at(seed));
  }
  take_method(top, summary);
  summary.pose = text_at(member(top, "pose"));
  summary.complete = truth_at(member(top, "complete"));
  summary.path_length_m = number_or_zero(member(top, "path_length_m"));
  summary.reads = whole_at(member(top, "reads"));
  summary.simulated_s = number_or_zero(member(top, "simulated_s"));
  summary.wall_s = number_or_zero(member(top, "wall_s"));
  summary.real_time_factor = number_or_zero(member(top, "real_time_factor"));
  summary.pose_error = pose_error_at(member(top, "pose_error"));
  summary.compared_pose = compared_pose_at(top);
  summary.compared_methods = compared_methods_at(top);
  summary.navigation = navigation_at(top);
  summary.effects = effects_at(top);
}

}  // namespace

std::string to_json(const Summary& summary) {
  Json json;
  put_run(json, summary);
  Json& tags = json["tags"] = Json::array();
  for (const TagOutcome& outcome : summary.tags) tags.push_back(tag_json(outcome));
  json["error_m"] = statistics_json(error_statistics(summary));
  json["over_0_3_m"] = count_over(summary, kFarOff);
  json["located"] = count(summary, Verdict::kLocated);
  json["ambiguous"] = count(summary, Verdict::kAmbiguous);
  json["not_located"] = count(summary, Verdict::kNotLocated);
  json["warnings"] = summary.warnings;
  // Names come from outside and may not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Summary summary_from_json(const std::string& text, const std::string& file) {
  const nlohmann::json json = parsed_json(text, file);
  const JsonPlace top{&json, file, ""};
  Summary summary;
  take_run(top, summary);
  for (const JsonPlace& tag : elements(member(top, "tags"))) summary.tags.push_back(tag_at(tag));
  for (const JsonPlace& warning : elements(member(top, "warnings"))) {
    summary.warnings.push_back(text_at(warning));
  }
  return summary;
}

}  // namespace tagfield
