// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "tagfield/report/internal/error_rows.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

constexpr const char* kUnknown = "–";

/// A number with a typographic minus sign.
std::string number(double value, int decimals) {
  const std::string digits = fmt::format("{:.{}f}", value, decimals);
  return digits.front() == '-' ? fmt::format("−{}", digits.substr(1)) : digits;
}

std::string cell(const std::string& html) { return fmt::format("<td>{}</td>", html); }

std::string words(const std::string& html) {
  return fmt::format("<td class=\"words\">{}</td>", html);
}

std::string millimetres(const std::optional<double>& length_m) {
  return cell(length_m ? number(1e3 * *length_m, 1) : kUnknown);
}

std::string place_cells(const std::optional<Eigen::Vector3d>& p) {
  std::string cells;
  for (int i = 0; i < 3; ++i) cells += cell(p ? number((*p)[i], 3) : kUnknown);
  return cells;
}

std::string name_cell(const std::string& tag) {
  return fmt::format("<th scope=\"row\" title=\"{}\"><bdi>{}</bdi></th>", escaped(tag),
                     escaped(shortened(tag, 28)));
}

std::string verdict_words(const TagOutcome& outcome) {
  if (outcome.reference) return "reference";
  const Verdict verdict = outcome.estimate.verdict;
  if (verdict == Verdict::kLocated) return "located";
  return verdict == Verdict::kAmbiguous ? "ambiguous" : "not located";
}

std::string remark_on(const TagOutcome& outcome) {
  std::string remark = clean_text(outcome.estimate.reason);
  if (outcome.moved) remark += (remark.empty() ? "" : "; ") + std::string("the tag moved");
  return escaped(remark);
}

constexpr const char* kSingleHead =
    "<thead><tr><th scope=\"col\" rowspan=\"2\">Tag</th>"
    "<th scope=\"col\" rowspan=\"2\" class=\"words\">Verdict</th>"
    "<th scope=\"colgroup\" colspan=\"3\">True position [m]</th>"
    "<th scope=\"colgroup\" colspan=\"3\">Estimate [m]</th>"
    "<th scope=\"col\" rowspan=\"2\">Error<br>[mm]</th>"
    "<th scope=\"col\" rowspan=\"2\"><i>E</i> (rms)<br>[mm]</th>"
    "<th scope=\"col\" rowspan=\"2\">Expected<br>error [mm]</th>"
    "<th scope=\"col\" rowspan=\"2\">Reads</th>";
constexpr const char* kSingleHeadEnd =
    "</tr><tr><th scope=\"col\">x</th><th scope=\"col\">y</th>"
    "<th scope=\"col\">z</th><th scope=\"col\">x</th><th scope=\"col\">y</th>"
    "<th scope=\"col\">z</th></tr></thead>";

/// None if it is 0: the method, such as `fixed`, or a third-party table does not state it.
std::optional<double> stated(double error_m) {
  return error_m > 0.0 ? std::optional(error_m) : std::nullopt;
}

std::string single_row(const TagOutcome& outcome, bool remarks) {
  const TagEstimate& estimate = outcome.estimate;
  const Candidate* best = estimate.candidates.empty() ? nullptr : &estimate.candidates.front();
  const bool located = best != nullptr && estimate.verdict == Verdict::kLocated;
  std::string row = "<tr>" + name_cell(estimate.tag) + words(verdict_words(outcome));
  row += place_cells(outcome.truth_m);
  row += place_cells(located ? std::optional(best->p_WT) : std::nullopt);
  row += millimetres(error_of(outcome));
  const bool has_errors = best != nullptr && !outcome.reference;
  row += millimetres(has_errors ? stated(best->rms_m) : std::nullopt);
  row += millimetres(has_errors ? stated(best->expected_error_m) : std::nullopt);
  row += cell(grouped(outcome.reads));
  if (remarks) row += words(remark_on(outcome));
  return row + "</tr>\n";
}

std::string single_table(const std::vector<TagRow>& rows, std::size_t shown) {
  const bool remarks = std::any_of(rows.begin(), rows.end(), [](const TagRow& row) {
    return !remark_on(*row.outcomes.front()).empty();
  });
  std::string html = kSingleHead;
  if (remarks) html += "<th scope=\"col\" rowspan=\"2\" class=\"words\">Remark</th>";
  html += kSingleHeadEnd;
  html += "\n<tbody>\n";
  for (std::size_t i = 0; i < shown; ++i) html += single_row(*rows[i].outcomes.front(), remarks);
  return html;
}

constexpr const char* kSeveralHead =
    "<thead><tr><th scope=\"col\">Tag</th><th scope=\"col\">Located<br>in seeds</th>"
    "<th scope=\"col\">Mean<br>error [mm]</th><th scope=\"col\">Median<br>[mm]</th>"
    "<th scope=\"col\">95 %<br>[mm]</th><th scope=\"col\">Maximum<br>[mm]</th>"
    "<th scope=\"col\">Least<br>[mm]</th><th scope=\"col\">Mean expected<br>error [mm]</th>"
    "<th scope=\"col\">Mean<br>reads</th></tr></thead>\n<tbody>\n";

/// Mean over the located outcomes; none for a reference tag.
std::optional<double> mean_expected_error(const TagRow& row) {
  double sum = 0.0;
  std::size_t located = 0;
  for (const TagOutcome* outcome : row.outcomes) {
    const TagEstimate& estimate = outcome->estimate;
    const bool located_it = estimate.verdict == Verdict::kLocated && !outcome->reference;
    if (!located_it || estimate.candidates.empty()) continue;
    sum += estimate.candidates.front().expected_error_m;
    ++located;
  }
  if (located == 0) return std::nullopt;
  return stated(sum / static_cast<double>(located));
}

std::string several_row(const TagRow& tag) {
  std::size_t located = 0;
  std::size_t reads = 0;
  for (const TagOutcome* outcome : tag.outcomes) {
    if (outcome->estimate.verdict == Verdict::kLocated) ++located;
    reads += outcome->reads;
  }
  const auto errors = statistics(tag.errors_m);
  std::string row = "<tr>" + name_cell(tag.tag);
  row +=
      cell(tag.outcomes.front()->reference ? "reference"
                                           : fmt::format("{} of {}", located, tag.outcomes.size()));
  for (const auto part : {&ErrorStatistics::mean, &ErrorStatistics::median, &ErrorStatistics::p95,
                          &ErrorStatistics::max, &ErrorStatistics::min}) {
    row += millimetres(errors ? std::optional((*errors).*part) : std::nullopt);
  }
  row += millimetres(mean_expected_error(tag));
  row += cell(number(static_cast<double>(reads) / static_cast<double>(tag.outcomes.size()), 0));
  return row + "</tr>\n";
}

std::string several_table(const std::vector<TagRow>& rows, std::size_t shown) {
  std::string html = kSeveralHead;
  for (std::size_t i = 0; i < shown; ++i) html += several_row(rows[i]);
  return html;
}

}  // namespace

std::string tag_table(const Summary& summary) {
  const std::vector<TagRow> rows = rows_by_tag(summary);
  if (rows.empty()) return "<p>No tag was read.</p>\n";
  const std::size_t shown = std::min(rows.size(), kMaxTableRows);
  const bool several = summary.seeds.size() > 1;
  std::string html = "<div class=\"table\" role=\"region\" aria-label=\"Tags\" tabindex=\"0\">";
  html += "<table>\n" + (several ? several_table(rows, shown) : single_table(rows, shown)) +
          "</tbody></table></div>\n";
  if (shown < rows.size()) {
    html += fmt::format("<p class=\"muted\">The first {} of {} tags; summary.json holds all.</p>\n",
                        shown, grouped(rows.size()));
  }
  return html;
}

}  // namespace tagfield
