// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "tagfield/experiment/bench/bench_files.h"
#include "tagfield/experiment/internal/statistics.h"
#include "tagfield/files/csv.h"

namespace tagfield {
namespace {

/// A row under construction.
class Row {
 public:
  Row& text(const std::string& field) { return put(csv_field(field)); }
  Row& whole(std::uint64_t number) { return put(fmt::format("{}", number)); }
  Row& number(double value) { return put(std::isfinite(value) ? fmt::format("{}", value) : ""); }
  Row& number(const std::optional<double>& value) { return value ? number(*value) : put(""); }
  Row& point(const std::optional<Eigen::Vector3d>& p) {
    if (!p) return put("").put("").put("");
    return number(p->x()).number(p->y()).number(p->z());
  }
  Row& errors(const std::optional<ErrorStatistics>& statistics) {
    if (!statistics) return put("").put("").put("").put("");
    return number(statistics->mean)
        .number(statistics->median)
        .number(statistics->p95)
        .number(statistics->max);
  }
  Row& empty() { return put(""); }
  [[nodiscard]] std::string line() const { return line_ + "\n"; }

 private:
  Row& put(const std::string& field) {
    if (!is_first_) line_ += ",";
    is_first_ = false;
    line_ += field;
    return *this;
  }

  std::string line_;
  bool is_first_ = true;
};

void put_nees(const std::optional<NeesSummary>& nees, Row& row) {
  if (!nees) {
    row.empty().empty().empty().empty().empty();
    return;
  }
  row.number(nees->mean).number(nees->expected).number(nees->band.low).number(nees->band.high);
  row.text(to_string(nees->consistency));
}

std::string row_of(const BenchEntry& entry, Timing timing) {
  const EntryStatistics all = statistics_of(entry);
  Row row;
  row.text(entry.condition).text(entry.name).text(entry.method);
  row.whole(all.runs).whole(all.tags).whole(all.located).whole(all.ambiguous);
  row.whole(all.not_located).whole(all.wrong).whole(all.false_claims);
  row.errors(all.error_m).errors(all.error_3d_m).errors(all.aligned_error_m);
  row.errors(all.nearest_candidate_m).whole(all.candidate_hits);
  row.number(all.error_over_expected).text(all.bound);
  row.number(all.ratio ? std::optional(all.ratio->mean) : std::nullopt);
  row.number(all.ratio ? std::optional(all.ratio->rms) : std::nullopt);
  put_nees(all.nees, row);
  if (timing == Timing::kWithTimes) row.number(all.time_per_tag_ms);
  return row.line();
}

std::string tag_row(const BenchEntry& entry, const MethodRun& run, const TagRecord& tag) {
  Row row;
  row.text(entry.condition).text(entry.name).text(run.method).whole(run.seed).text(tag.tag);
  row.text(to_string(tag.verdict)).text(tag.reason).whole(tag.reads);
  row.number(tag.error).number(tag.error_3d).number(tag.aligned_error);
  row.number(tag.nearest_candidate).point(tag.truth).point(tag.estimate);
  row.number(tag.verdict == Verdict::kNotLocated ? std::nullopt
                                                 : std::optional(tag.expected_error));
  row.text(tag.bound ? to_string(run.bound) : "");
  row.number(tag.bound ? std::optional(tag.bound->mean_error_m) : std::nullopt);
  row.number(tag.bound ? std::optional(std::sqrt(tag.bound->variance_m2)) : std::nullopt);
  row.number(tag.nees ? std::optional(tag.nees->value) : std::nullopt);
  if (tag.nees) {
    row.whole(static_cast<std::uint64_t>(tag.nees->dof));
  } else {
    row.empty();
  }
  row.whole(tag.false_claim ? 1 : 0);
  return row.line();
}

}  // namespace

std::string bench_to_csv(const Bench& bench, Timing timing) {
  std::string csv =
      "condition,name,method,runs,tags,located,ambiguous,not_located,wrong,false_claims,"
      "mean_m,median_m,p95_m,max_m,mean_3d_m,median_3d_m,p95_3d_m,max_3d_m,"
      "aligned_mean_m,aligned_median_m,aligned_p95_m,aligned_max_m,"
      "candidate_mean_m,candidate_median_m,candidate_p95_m,candidate_max_m,candidate_hits,"
      "error_over_expected,bound,ratio_mean,ratio_rms,nees_mean,nees_expected,nees_low,nees_high,"
      "nees_verdict";
  csv += timing == Timing::kWithTimes ? ",time_per_tag_ms\n" : "\n";
  for (const BenchEntry& entry : bench.entries) csv += row_of(entry, timing);
  return csv;
}

std::string bench_tags_to_csv(const Bench& bench) {
  std::string csv =
      "condition,name,method,seed,tag,verdict,reason,reads,error_m,error_3d_m,aligned_error_m,"
      "nearest_candidate_m,truth_x_m,truth_y_m,truth_z_m,x_m,y_m,z_m,expected_error_m,bound,"
      "bound_mean_error_m,bound_rms_error_m,nees,nees_dof,false_claim\n";
  for (const BenchEntry& entry : bench.entries) {
    for (const MethodRun& run : entry.runs) {
      for (const TagRecord& tag : run.tags) csv += tag_row(entry, run, tag);
    }
  }
  return csv;
}

}  // namespace tagfield
