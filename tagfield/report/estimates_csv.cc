// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/estimates_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "tagfield/base/spelling.h"
#include "tagfield/files/csv.h"

namespace tagfield {
namespace {

std::string covariance_fields(const Candidate& candidate) {
  if (!candidate.covariance) return ",,,";
  const Eigen::Matrix3d& c = *candidate.covariance;
  return fmt::format("{:.6g},{:.6g},{:.6g},{:.6g}", c(0, 0), c(0, 1), c(1, 1), c(2, 2));
}

/// The table's columns by name, few of which are required.
class EstimateRows {
 public:
  EstimateRows(const CsvTable& table, const HeightOfTag& height) : table_(table), height_(height) {
    for (const char* needed : {"tag", "x_m", "y_m"}) static_cast<void>(table.column(needed));
  }

  [[nodiscard]] std::string word(const CsvRow& row, const char* column) const {
    return table_.has_column(column) ? row.fields[table_.column(column)] : "";
  }
  [[nodiscard]] bool has(const CsvRow& row, const char* column) const {
    return !word(row, column).empty();
  }
  [[nodiscard]] double number(const CsvRow& row, const char* column) const {
    return table_.number(row, table_.column(column));
  }
  /// None where the row does not say.
  [[nodiscard]] std::optional<Verdict> verdict(const CsvRow& row) const {
    if (!has(row, "verdict")) return std::nullopt;
    try {
      return verdict_from_string(word(row, "verdict"));
    } catch (const Error& error) {
      fail({table_.file, row.line}, error.what());
    }
  }
  [[nodiscard]] Candidate candidate(const CsvRow& row, const std::string& tag) const {
    Candidate candidate;
    candidate.p_WT.x() = table_.length(row, table_.column("x_m"));
    candidate.p_WT.y() = table_.length(row, table_.column("y_m"));
    candidate.p_WT.z() = has(row, "z_m") ? table_.length(row, table_.column("z_m")) : height_(tag);
    if (has(row, "rms_m")) candidate.rms_m = not_negative(row, "rms_m");
    candidate.covariance = covariance(row);
    if (candidate.covariance) {
      candidate.expected_error_m = std::sqrt(candidate.covariance->topLeftCorner<2, 2>().trace());
    }
    if (has(row, "expected_error_m")) {
      const double stated = not_negative(row, "expected_error_m");
      if (stated > 0.0) candidate.expected_error_m = stated;
      if (stated == 0.0 && !candidate.covariance) candidate.covariance = Eigen::Matrix3d::Zero();
    }
    return candidate;
  }

 private:
  [[nodiscard]] double not_negative(const CsvRow& row, const char* column) const {
    const double value = number(row, column);
    if (value < 0.0) fail({table_.file, row.line}, fmt::format("{} is below 0", column));
    return value;
  }
  [[nodiscard]] std::optional<Eigen::Matrix3d> covariance(const CsvRow& row) const {
    if (!has(row, "cov_xx") || !has(row, "cov_yy")) return std::nullopt;
    Eigen::Matrix3d c = Eigen::Matrix3d::Zero();
    c(0, 0) = not_negative(row, "cov_xx");
    c(1, 1) = not_negative(row, "cov_yy");
    if (has(row, "cov_xy")) c(0, 1) = c(1, 0) = number(row, "cov_xy");
    if (has(row, "cov_zz")) c(2, 2) = not_negative(row, "cov_zz");
    if (c(0, 1) * c(0, 1) > c(0, 0) * c(1, 1) * (1.0 + 1e-4)) {
      fail({table_.file, row.line}, "cov_xx, cov_xy, cov_yy are not a covariance");
    }
    return c;
  }

  const CsvTable& table_;
  const HeightOfTag& height_;
};

/// A tag's estimate, and what its rows say of the verdict.
struct EstimateInTable {
  TagEstimate estimate;
  std::optional<Verdict> said;
};

/// Takes what a row says of its tag's verdict, which must be the same in all that say it.
void take_verdict(const Location& location, const std::optional<Verdict>& said,
                  EstimateInTable& of_tag) {
  if (!said) return;
  if (of_tag.said && *of_tag.said != *said) {
    fail(location, fmt::format("tag '{}' is {} here, but {} in a row above: expected one verdict",
                               of_tag.estimate.tag, to_string(*said), to_string(*of_tag.said)));
  }
  of_tag.said = said;
}

/// Adds a row to a tag's estimate.
void add_row(const EstimateRows& rows, const CsvRow& row, const Location& location,
             EstimateInTable& of_tag) {
  TagEstimate& estimate = of_tag.estimate;
  if (rows.has(row, "reads")) {
    estimate.reads = static_cast<std::size_t>(std::max(rows.number(row, "reads"), 0.0));
  }
  estimate.reason = rows.word(row, "reason");
  take_verdict(location, rows.verdict(row), of_tag);
  if (of_tag.said == Verdict::kNotLocated) return;
  estimate.candidates.push_back(rows.candidate(row, estimate.tag));
}

/// With the verdict that the rows give, or else that of their number. Only the best position of a
/// located tag counts.
TagEstimate with_verdict(EstimateInTable of_tag) {
  TagEstimate& estimate = of_tag.estimate;
  const bool several = estimate.candidates.size() > 1;
  estimate.verdict = of_tag.said.value_or(several ? Verdict::kAmbiguous : Verdict::kLocated);
  if (estimate.verdict == Verdict::kNotLocated) estimate.candidates.clear();
  if (estimate.verdict == Verdict::kLocated) estimate.candidates.resize(1);
  return std::move(estimate);
}

}  // namespace

std::string estimates_to_csv(const std::vector<TagEstimate>& estimates) {
  std::string text =
      "tag,verdict,candidate,x_m,y_m,z_m,rms_m,expected_error_m,reads,"
      "cov_xx,cov_xy,cov_yy,cov_zz,reason\n";
  for (const TagEstimate& estimate : estimates) {
    const std::string begin =
        fmt::format("{},{}", csv_field(estimate.tag), to_string(estimate.verdict));
    const std::string reason = csv_field(estimate.reason);
    if (estimate.candidates.empty()) {
      text += fmt::format("{},,,,,,,{},,,,,{}\n", begin, estimate.reads, reason);
    }
    for (std::size_t i = 0; i < estimate.candidates.size(); ++i) {
      const Candidate& candidate = estimate.candidates[i];
      const Eigen::Vector3d& p = candidate.p_WT;
      text += fmt::format("{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{},{},{}\n", begin, i + 1,
                          p.x(), p.y(), p.z(), candidate.rms_m, candidate.expected_error_m,
                          estimate.reads, covariance_fields(candidate), reason);
    }
  }
  return text;
}

std::vector<TagEstimate> read_estimates_csv(const std::string& path, const HeightOfTag& height) {
  const CsvTable table = read_csv(path);
  const EstimateRows rows(table, height);
  std::vector<EstimateInTable> tags;
  std::map<std::string, std::size_t> numbers;
  for (const CsvRow& row : table.rows) {
    const std::string& tag = table.text(row, table.column("tag"));
    const auto [found, is_new] = numbers.emplace(tag, tags.size());
    if (is_new) tags.emplace_back().estimate.tag = tag;
    add_row(rows, row, {path, row.line}, tags[found->second]);
  }
  std::vector<TagEstimate> estimates;
  estimates.reserve(tags.size());
  for (EstimateInTable& of_tag : tags) estimates.push_back(with_verdict(std::move(of_tag)));
  return estimates;
}

void drop_strangers(const Location& location, const std::string& whole,
                    const std::set<std::string>& known, std::vector<TagEstimate>& estimates,
                    Diagnostics& diagnostics) {
  const std::vector<std::string> names(known.begin(), known.end());
  std::erase_if(estimates, [&](const TagEstimate& estimate) {
    if (known.count(estimate.tag) > 0) return false;
    diagnostics.warn(location, fmt::format("{} no tag '{}'{}: it does not count", whole,
                                           estimate.tag, suggestion(estimate.tag, names)));
    return true;
  });
}

}  // namespace tagfield
