#include "tagfield/experiment/store/method_runs_json.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace tagfield {
namespace {

using Line = nlohmann::json;

constexpr double kEndless = std::numeric_limits<double>::infinity();

/// JSON has no infinity, which stands for an error that nobody can expect.
Line encoded(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
}

double double_in(const Line& json) {
  if (json.is_number()) return json.get<double>();
  const auto word = json.get<std::string>();
  if (word == "inf") return kEndless;
  if (word == "-inf") return -kEndless;
  return std::numeric_limits<double>::quiet_NaN();
}

Line encoded(const std::optional<double>& value) { return value ? encoded(*value) : Line(); }

std::optional<double> optional_in(const Line& json) {
  if (json.is_null()) return std::nullopt;
  return double_in(json);
}

Line encoded(const std::optional<Eigen::Vector3d>& p) {
  if (!p) return nullptr;
  return Line::array({encoded(p->x()), encoded(p->y()), encoded(p->z())});
}

std::optional<Eigen::Vector3d> place_in(const Line& json) {
  if (json.is_null()) return std::nullopt;
  return Eigen::Vector3d(double_in(json.at(0)), double_in(json.at(1)), double_in(json.at(2)));
}

Line encoded(const TagRecord& tag) {
  Line bound;
  if (tag.bound) bound = {encoded(tag.bound->mean_error_m), encoded(tag.bound->variance_m2)};
  Line nees;
  if (tag.nees) nees = {encoded(tag.nees->value), tag.nees->dof};
  return Line::array({tag.tag, to_string(tag.verdict), tag.reason, tag.reads, tag.moved,
                      encoded(tag.truth), encoded(tag.estimate), tag.height_estimated,
                      encoded(tag.expected_error), encoded(tag.error), encoded(tag.error_3d),
                      encoded(tag.aligned_error), encoded(tag.nearest_candidate), std::move(bound),
                      std::move(nees), tag.false_claim});
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
  tag.truth = place_in(next());
  tag.estimate = place_in(next());
  tag.height_estimated = next().get<bool>();
  tag.expected_error = double_in(next());
  tag.error = optional_in(next());
  tag.error_3d = optional_in(next());
  tag.aligned_error = optional_in(next());
  tag.nearest_candidate = optional_in(next());
  const Line& bound = next();
  if (!bound.is_null()) tag.bound = {double_in(bound.at(0)), double_in(bound.at(1))};
  const Line& nees = next();
  if (!nees.is_null()) tag.nees = {double_in(nees.at(0)), nees.at(1).get<int>()};
  tag.false_claim = next().get<bool>();
  return tag;
}

Line encoded(const MethodRun& run) {
  Line tags = Line::array();
  for (const TagRecord& tag : run.tags) tags.push_back(encoded(tag));
  return {{"seed", run.seed},
          {"method", run.method},
          {"bound", to_string(run.bound)},
          {"nees_correlation", encoded(run.nees_correlation)},
          {"seconds", encoded(run.seconds)},
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
  run.nees_correlation = double_in(json.at("nees_correlation"));
  run.seconds = double_in(json.at("seconds"));
  run.tags_given = json.at("tags_given").get<std::size_t>();
  for (const Line& tag : json.at("tags")) run.tags.push_back(tag_in(tag));
  return run;
}

}  // namespace

std::string to_json_line(const ConditionRun& run) {
  Line methods = Line::array();
  for (const MethodRun& method : run.methods) methods.push_back(encoded(method));
  const Line json = {{"methods", std::move(methods)}, {"warnings", run.warnings}};
  return json.dump(-1, ' ', false, Line::error_handler_t::replace);
}

ConditionRun condition_run_in(std::string_view json, const Location& location) {
  try {
    const Line parsed = Line::parse(json.begin(), json.end());
    ConditionRun run;
    for (const Line& method : parsed.at("methods")) run.methods.push_back(method_run_in(method));
    run.warnings = parsed.at("warnings").get<std::vector<std::string>>();
    return run;
  } catch (const Line::exception&) {
    fail(location, "is no run's result");
  } catch (const Error& error) {
    fail(location, fmt::format("is no run's result: {}", error.what()));
  }
}

}  // namespace tagfield
