// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/store/method_runs_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tagfield/experiment/internal/exact_json.h"

namespace tagfield {
namespace {

using Line = nlohmann::json;

Line encoded(const TagRecord& tag) {
  Line bound;
  if (tag.bound) bound = {exact_json(tag.bound->mean_error_m), exact_json(tag.bound->variance_m2)};
  Line nees;
  if (tag.nees) nees = {exact_json(tag.nees->value), tag.nees->dof};
  return Line::array({tag.tag, to_string(tag.verdict), tag.reason, tag.reads, tag.moved,
                      exact_json(tag.truth), exact_json(tag.estimate), tag.height_estimated,
                      exact_json(tag.expected_error), exact_json(tag.error),
                      exact_json(tag.error_3d), exact_json(tag.aligned_error),
                      exact_json(tag.nearest_candidate), std::move(bound), std::move(nees),
                      tag.false_claim, tag.claims_no_error, tag.flat_covariance});
}

TagRecord tag_in(const Line& json) {
  TagRecord tag;
  std::size_t i = 0;
  const auto next = [&]() -> const Line& { return json.at(i++); };
  tag.tag = next().get<std::string>();
  tag.verdict = verdict_from_string(next().get<std::string>());
  tag.reason = next().get<std::string>();
  tag.reads = next().get<std::size_t>();
  tag.moved = next().get<bool>();
  tag.truth = exact_place_in(next());
  tag.estimate = exact_place_in(next());
  tag.height_estimated = next().get<bool>();
  tag.expected_error = exact_double_in(next());
  tag.error = exact_optional_in(next());
  tag.error_3d = exact_optional_in(next());
  tag.aligned_error = exact_optional_in(next());
  tag.nearest_candidate = exact_optional_in(next());
  const Line& bound = next();
  if (!bound.is_null()) tag.bound = {exact_double_in(bound.at(0)), exact_double_in(bound.at(1))};
  const Line& nees = next();
  if (!nees.is_null()) tag.nees = {exact_double_in(nees.at(0)), nees.at(1).get<int>()};
  tag.false_claim = next().get<bool>();
  tag.claims_no_error = next().get<bool>();
  tag.flat_covariance = next().get<bool>();
  return tag;
}

Line encoded(const MethodRun& run) {
  Line tags = Line::array();
  for (const TagRecord& tag : run.tags) tags.push_back(encoded(tag));
  return {{"seed", run.seed},
          {"method", run.method},
          {"bound", to_string(run.bound)},
          {"nees_correlation", exact_json(run.nees_correlation)},
          {"seconds", exact_json(run.seconds)},
          {"tags_given", run.tags_given},
          {"tags", std::move(tags)}};
}

MethodRun method_run_in(const Line& json) {
  MethodRun run;
  run.seed = json.at("seed").get<std::uint64_t>();
  run.method = json.at("method").get<std::string>();
  run.bound = json.at("bound").get<std::string>() == to_string(BoundKind::kJoint)
                  ? BoundKind::kJoint
                  : BoundKind::kSingle;
  run.nees_correlation = exact_double_in(json.at("nees_correlation"));
  run.seconds = exact_double_in(json.at("seconds"));
  run.tags_given = json.at("tags_given").get<std::size_t>();
  for (const Line& tag : json.at("tags")) run.tags.push_back(tag_in(tag));
  return run;
}

}  // namespace

std::string to_json_line(const ConditionRun& run) {
  Line methods = Line::array();
  for (const MethodRun& method : run.methods) methods.push_back(encoded(method));
  const Line json = {{"methods", std::move(methods)}, {"warnings", run.warnings}};
  return one_line_of(json);
}

ConditionRun condition_run_in(std::string_view json, const Location& location) {
  try {
    const Line parsed = Line::parse(json.begin(), json.end());
    ConditionRun run;
    for (const Line& method : parsed.at("methods")) run.methods.push_back(method_run_in(method));
    run.warnings = parsed.at("warnings").get<std::vector<std::string>>();
    return run;
  } catch (const Line::exception&) {
    fail(location, "is not a run's result");
  } catch (const Error& error) {
    fail(location, fmt::format("is not a run's result: {}", error.what()));
  }
}

}  // namespace tagfield
