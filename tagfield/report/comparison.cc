// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tagfield/base/error.h"
#include "tagfield/base/student.h"
#include "tagfield/report/internal/error_rows.h"
#include "tagfield/report/internal/figure_data.h"
#include "tagfield/report/internal/inventory_section.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

using ComparisonJson = nlohmann::ordered_json;

constexpr double kSamePosition_m = 0.001;

/// Positions of stationary tags known to a run.
std::map<std::string, Eigen::Vector3d> truths_of(const Summary& summary) {
  std::map<std::string, Eigen::Vector3d> truths;
  for (const TagOutcome& outcome : summary.tags) {
    if (outcome.truth_m) truths.emplace(outcome.estimate.tag, *outcome.truth_m);
  }
  return truths;
}

/// Adds true positions that only the other run knows, as 'localize' of a run's reads knows none;
/// returns their number.
std::size_t take_truths(Summary& summary, const std::map<std::string, Eigen::Vector3d>& others) {
  std::size_t taken = 0;
  for (TagOutcome& outcome : summary.tags) {
    const auto found = others.find(outcome.estimate.tag);
    if (outcome.truth_m || outcome.moved || found == others.end()) continue;
    outcome.truth_m = found->second;
    ++taken;
  }
  return taken;
}

/// Those that ended, of an interrupted run.
std::size_t number_of_runs(const Summary& summary) {
  std::set<std::uint64_t> seeds;
  for (const TagOutcome& outcome : summary.tags) seeds.insert(outcome.seed);
  return std::max<std::size_t>(seeds.size(), 1);
}

ComparedRun whole_of(const Summary& summary, const std::string& name) {
  ComparedRun run;
  run.name = name;
  run.scenario = summary.scenario;
  run.method = summary.method;
  run.pose = summary.pose;
  run.seeds = summary.seeds;
  run.runs = number_of_runs(summary);
  run.locates = !is_inventory_alone(summary);
  run.tags = summary.tags.size();
  run.outcomes = count_to_locate(summary);
  run.located = count(summary, Verdict::kLocated);
  for (const TagOutcome& outcome : summary.tags) {
    run.reads += outcome.reads;
    if (outcome.reads > 0) ++run.read;
  }
  run.path_length_m = summary.path_length_m;
  run.error_m = error_statistics(summary);
  return run;
}

/// Whether a tag was read, of a run that locates none.
std::string read_words(const TagRow& row) {
  const auto read = std::count_if(row.outcomes.begin(), row.outcomes.end(),
                                  [](const TagOutcome* one) { return one->reads > 0; });
  if (row.outcomes.size() > 1) return fmt::format("read in {} of {}", read, row.outcomes.size());
  return read == 1 ? "read" : "not read";
}

ComparedOutcome outcome_of(const TagRow& row, bool locates) {
  ComparedOutcome outcome;
  for (const TagOutcome* one : row.outcomes) outcome.reads += one->reads;
  if (!row.errors_m.empty()) {
    double sum = 0.0;
    for (const double error : row.errors_m) sum += error;
    outcome.error_m = sum / static_cast<double>(row.errors_m.size());
  }
  if (!locates) {
    outcome.verdict = read_words(row);
    return outcome;
  }
  const TagOutcome& first = *row.outcomes.front();
  if (first.reference) {
    outcome.verdict = outcome_words(first);
    return outcome;
  }
  std::size_t located = 0;
  for (const TagOutcome* one : row.outcomes) {
    if (one->estimate.verdict == Verdict::kLocated) ++located;
  }
  if (row.outcomes.size() > 1) {
    outcome.verdict = fmt::format("located in {} of {}", located, row.outcomes.size());
  } else {
    outcome.verdict = located == 1 ? "located" : outcome_words(first);
  }
  if (!first.estimate.candidates.empty() && first.estimate.verdict == Verdict::kLocated) {
    outcome.position_m = first.estimate.candidates.front().p_WT;
  }
  return outcome;
}

struct NaturalOrder {
  bool operator()(const std::string& a, const std::string& b) const { return natural_less(a, b); }
};

/// Tags of both runs, and warnings about those that can't be compared.
std::vector<ComparedTag> tags_of(const std::array<const Summary*, 2>& summaries,
                                 std::vector<std::string>& warnings) {
  std::map<std::string, ComparedTag, NaturalOrder> tags;
  std::array<std::size_t, 2> alone{};
  std::size_t elsewhere = 0;
  for (std::size_t run = 0; run < 2; ++run) {
    const bool locates = !is_inventory_alone(*summaries[run]);
    for (const TagRow& row : rows_by_tag(*summaries[run])) {
      ComparedTag& tag = tags[row.tag];
      tag.tag = row.tag;
      tag.runs[run] = outcome_of(row, locates);
      const auto& truth = row.outcomes.front()->truth_m;
      if (!truth) continue;
      if (tag.truth_m && (*tag.truth_m - *truth).norm() > kSamePosition_m) ++elsewhere;
      if (!tag.truth_m) tag.truth_m = truth;
    }
  }
  std::vector<ComparedTag> all;
  for (auto& [name, tag] : tags) {
    for (std::size_t run = 0; run < 2; ++run) {
      if (!tag.runs[run].verdict.empty()) continue;
      tag.runs[run].verdict = "not there";
      ++alone[1 - run];
    }
    all.push_back(std::move(tag));
  }
  if (alone[0] + alone[1] >= all.size()) throw Error("compare: the runs have no tag in common");
  for (std::size_t run = 0; run < 2; ++run) {
    if (alone[run] == 0) continue;
    warnings.push_back(fmt::format("{} in the {} run alone", counted(alone[run], "tag"),
                                   run == 0 ? "first" : "second"));
  }
  if (elsewhere > 0) {
    warnings.push_back(fmt::format(
        "{} at another true position in the second run: each run is judged by its own truth",
        elsewhere == 1 ? "1 tag is" : grouped(elsewhere) + " tags are"));
  }
  return all;
}

std::optional<ErrorDifference> difference_of(const std::vector<ComparedTag>& tags) {
  ErrorDifference difference;
  std::vector<double> all;
  for (const ComparedTag& tag : tags) {
    if (!tag.runs[0].error_m || !tag.runs[1].error_m) continue;
    all.push_back(*tag.runs[1].error_m - *tag.runs[0].error_m);
    if (all.back() < 0.0) ++difference.smaller;
    if (all.back() > 0.0) ++difference.larger;
  }
  if (all.empty()) return std::nullopt;
  difference.tags = all.size();
  const auto n = static_cast<double>(all.size());
  for (const double one : all) difference.mean_m += one / n;
  if (all.size() < 2) return difference;
  double variance = 0.0;
  for (const double one : all) {
    variance += (one - difference.mean_m) * (one - difference.mean_m) / (n - 1.0);
  }
  const double half = student_975(n - 1.0) * std::sqrt(variance / n);
  difference.interval_m = {difference.mean_m - half, difference.mean_m + half};
  return difference;
}

ComparisonJson json_of(const std::optional<double>& value) {
  return value ? ComparisonJson(*value) : ComparisonJson(nullptr);
}

ComparisonJson json_of(const std::optional<Eigen::Vector3d>& p) {
  return p ? ComparisonJson({p->x(), p->y(), p->z()}) : ComparisonJson(nullptr);
}

ComparisonJson json_of(const ComparedRun& run) {
  ComparisonJson json = {{"name", run.name},       {"scenario", run.scenario},
                         {"method", run.method},   {"pose", run.pose},
                         {"seeds", run.seeds},     {"tags", run.outcomes},
                         {"located", run.located}, {"read", run.read},
                         {"reads", run.reads},     {"path_length_m", run.path_length_m}};
  json["error_m"] = nullptr;
  if (const auto& error = run.error_m) {
    json["error_m"] = {{"mean", error->mean}, {"median", error->median}, {"p95", error->p95},
                       {"max", error->max},   {"min", error->min},       {"count", error->count}};
  }
  return json;
}

}  // namespace

RunComparison compared(Summary first, const std::string& first_name, Summary second,
                       const std::string& second_name) {
  RunComparison comparison;
  const auto of_first = truths_of(first);
  const auto of_second = truths_of(second);
  for (const bool is_first : {true, false}) {
    const std::size_t taken =
        is_first ? take_truths(first, of_second) : take_truths(second, of_first);
    if (taken == 0) continue;
    comparison.warnings.push_back(fmt::format(
        "the {} run does not know where {}: judged by the {} run's truth",
        is_first ? "first" : "second", taken == 1 ? "1 tag is" : grouped(taken) + " tags are",
        is_first ? "second" : "first"));
  }
  comparison.runs = {whole_of(first, first_name), whole_of(second, second_name)};
  comparison.tags = tags_of({&first, &second}, comparison.warnings);
  comparison.error = difference_of(comparison.tags);
  // Recordings have no seeds.
  if (!first.seeds.empty() && !second.seeds.empty() && first.seeds != second.seeds) {
    comparison.warnings.push_back(
        "the runs have different seeds: a part of the difference is chance");
  }
  for (const Summary* summary : {&first, &second}) {
    if (summary->complete) continue;
    comparison.warnings.push_back(
        fmt::format("the {} run was interrupted", summary == &first ? "first" : "second"));
  }
  return comparison;
}

bool any_locates(const RunComparison& comparison) {
  return comparison.runs[0].locates || comparison.runs[1].locates;
}

double per_run(const ComparedRun& run, std::size_t count) {
  return static_cast<double>(count) / static_cast<double>(run.runs);
}

std::string comparison_to_json(const RunComparison& comparison) {
  ComparisonJson json;
  json["runs"] = {json_of(comparison.runs[0]), json_of(comparison.runs[1])};
  json["error_difference_m"] = nullptr;
  if (const auto& error = comparison.error) {
    const auto& interval = error->interval_m;
    json["error_difference_m"] = {
        {"tags", error->tags},
        {"smaller", error->smaller},
        {"larger", error->larger},
        {"mean", error->mean_m},
        {"low", json_of(interval ? std::optional((*interval)[0]) : std::nullopt)},
        {"high", json_of(interval ? std::optional((*interval)[1]) : std::nullopt)}};
  }
  json["tags"] = ComparisonJson::array();
  for (const ComparedTag& tag : comparison.tags) {
    ComparisonJson one = {{"tag", tag.tag}, {"truth_m", json_of(tag.truth_m)}};
    one["runs"] = ComparisonJson::array();
    for (const ComparedOutcome& run : tag.runs) {
      one["runs"].push_back({{"reads", run.reads},
                             {"verdict", run.verdict},
                             {"error_m", json_of(run.error_m)},
                             {"estimate_m", json_of(run.position_m)}});
    }
    json["tags"].push_back(std::move(one));
  }
  json["warnings"] = comparison.warnings;
  return json.dump(2, ' ', false, ComparisonJson::error_handler_t::replace) + "\n";
}

std::string comparison_to_csv(const RunComparison& comparison) {
  std::string csv =
      "tag,first_reads,second_reads,first_verdict,second_verdict,first_error_m,second_error_m,"
      "difference_m\n";
  for (const ComparedTag& tag : comparison.tags) {
    const auto& [first, second] = tag.runs;
    const auto difference = first.error_m && second.error_m
                                ? std::optional(*second.error_m - *first.error_m)
                                : std::nullopt;
    add_data(csv, tag.tag, first.reads, second.reads, first.verdict, second.verdict, first.error_m,
             second.error_m, difference);
  }
  return csv;
}

}  // namespace tagfield
