// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/bench/bench_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/experiment/bench/bench_figures.h"
#include "tagfield/experiment/internal/heat_table.h"
#include "tagfield/experiment/internal/statistics.h"
#include "tagfield/report/page.h"
#include "tagfield/report/page_script.h"
#include "tagfield/report/page_text.h"
#include "tagfield/report/text.h"
#include "tagfield/report/warnings_note.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxName = 28;
constexpr std::size_t kMostPrinted = 6;  ///< Figures of errors that are printed.
constexpr const char* kErrorsText =
    "<p class=\"muted\">The share of the tags that were located no further off than the value "
    "below. "
    "Where a line ends below 100 %, the rest was ambiguous or not located.</p>\n";

std::string header(const Bench& bench) {
  std::string html = "<header>\n<p class=\"kind\">Tagfield bench</p>\n<h1><bdi>" +
                     breakable(bench.name) + "</bdi></h1>\n";
  if (!bench.description.empty()) {
    html += "<p class=\"muted\">" + escaped(bench.description) + "</p>\n";
  }
  if (!bench.complete) {
    html +=
        "<div class=\"note incomplete\"><p><strong>Incomplete.</strong> The bench was interrupted; "
        "only runs that were done by then count.</p></div>\n";
  }
  return html + "</header>\n";
}

std::size_t count_runs(const Bench& bench) {
  std::size_t runs = 0;
  for (const BenchCondition& condition : bench.conditions) {
    const std::vector<const BenchEntry*> entries = entries_of(bench, condition.name);
    if (!entries.empty()) runs += entries.front()->runs.size();
  }
  return runs;
}

std::string big(const std::string& name, const std::string& value) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(name), escaped(value));
}

std::string numbers(const Bench& bench, Timing timing) {
  std::string html =
      "<dl class=\"numbers\">\n" + big("Methods", grouped(method_names(bench).size())) +
      big("Conditions", grouped(bench.conditions.size())) + big("Runs", grouped(count_runs(bench)));
  if (timing == Timing::kWithTimes) {
    html +=
        big(fmt::format("Took, on {}", counted(static_cast<std::size_t>(bench.threads), "thread")),
            fmt::format("{:.0f} s", bench.wall_s));
  }
  return html + "</dl>\n";
}

std::string cell(const std::string& text) { return "<td>" + text + "</td>"; }

std::string length_cell(const std::optional<ErrorStatistics>& errors,
                        double ErrorStatistics::*property) {
  return cell(errors ? fmt::format("{:.1f}", 1e3 * (*errors).*property) : "–");
}

std::string nees_cell(const std::optional<NeesSummary>& nees) {
  if (!nees) return cell("–");
  constexpr const char* kMarks[] = {"", " ▼", " ▲"};
  return fmt::format("<td title=\"{}, 95 % band {:.2f} to {:.2f}\">{:.2f}{}</td>",
                     to_string(nees->consistency), nees->band.low / nees->expected,
                     nees->band.high / nees->expected, nees->mean / nees->expected,
                     kMarks[static_cast<int>(nees->consistency)]);
}

/// Which optional columns are shown.
struct Columns {
  bool height = false;
  bool aligned = false;
  bool times = false;
};

Columns columns_of(const Bench& bench, Timing timing) {
  Columns columns;
  columns.times = timing == Timing::kWithTimes;
  for (const BenchEntry& entry : bench.entries) {
    const EntryStatistics all = statistics_of(entry);
    columns.height = columns.height || all.error_3d_m;
    columns.aligned = columns.aligned || all.aligned_error_m;
  }
  return columns;
}

std::string head_of(const Columns& columns) {
  std::string html =
      "<thead><tr><th scope=\"col\">Method</th><th scope=\"col\">Located</th>"
      "<th scope=\"col\">Ambi-<br>guous</th><th scope=\"col\">Not<br>located</th>"
      "<th scope=\"col\">Wrong</th><th scope=\"col\">False<br>claims</th>"
      "<th scope=\"col\">Mean<br>[mm]</th>"
      "<th scope=\"col\">Median<br>[mm]</th><th scope=\"col\">95 %<br>[mm]</th>"
      "<th scope=\"col\">Max<br>[mm]</th>";
  if (columns.height) html += "<th scope=\"col\">Mean 3-D<br>[mm]</th>";
  if (columns.aligned) html += "<th scope=\"col\">Aligned<br>[mm]</th>";
  html +=
      "<th scope=\"col\">Times<br>expected</th><th scope=\"col\">Times<br>bound</th><th "
      "scope=\"col\">NEES<br>/dof</th>";
  if (columns.times) html += "<th scope=\"col\">Time per<br>tag [ms]</th>";
  return html + "</tr></thead>\n";
}

std::string ambiguous_cell(const EntryStatistics& all) {
  if (all.ambiguous == 0) return cell("0");
  return cell(fmt::format("{} ({})", all.ambiguous, all.candidate_hits));
}

std::string row_of(const BenchEntry& entry, const Columns& columns) {
  const EntryStatistics all = statistics_of(entry);
  std::string html = fmt::format(
      "<tr><th scope=\"row\" title=\"{}\"><bdi>{}</bdi></th><td>{} of {}</td>",
      escaped(entry.method), escaped(shortened(entry.name, kMaxName)), all.located, all.tags);
  html += ambiguous_cell(all) + cell(grouped(all.not_located)) + cell(grouped(all.wrong)) +
          cell(grouped(all.false_claims));
  html += length_cell(all.error_m, &ErrorStatistics::mean);
  html += length_cell(all.error_m, &ErrorStatistics::median);
  html += length_cell(all.error_m, &ErrorStatistics::p95);
  html += length_cell(all.error_m, &ErrorStatistics::max);
  if (columns.height) html += length_cell(all.error_3d_m, &ErrorStatistics::mean);
  if (columns.aligned) html += length_cell(all.aligned_error_m, &ErrorStatistics::mean);
  html += cell(all.error_over_expected ? fmt::format("{:.2f}", *all.error_over_expected) : "–");
  html += cell(all.ratio ? fmt::format("{:.2f}", all.ratio->mean) : "–") + nees_cell(all.nees);
  if (columns.times) {
    html += cell(all.time_per_tag_ms ? fmt::format("{:.1f}", *all.time_per_tag_ms) : "–");
  }
  return html + "</tr>\n";
}

std::string title_of(const Bench& bench, const BenchCondition& condition) {
  const std::vector<const BenchEntry*> entries = entries_of(bench, condition.name);
  const std::size_t runs = entries.empty() ? 0 : entries.front()->runs.size();
  return fmt::format(
      "<strong><bdi>{}</bdi></strong> <span class=\"muted\">({}, pose: {})</span> Winner: {}",
      escaped(condition.name), counted(runs, "run"), escaped(condition.pose),
      escaped(winner_words(bench, condition)));
}

/// All numbers, collapsed except for the first condition.
std::string tables(const Bench& bench, Timing timing) {
  const Columns columns = columns_of(bench, timing);
  std::string html;
  for (const BenchCondition& condition : bench.conditions) {
    html += fmt::format(
        "<details{}><summary>{}</summary>\n<div class=\"table\" role=\"region\" "
        "aria-label=\"{}\" tabindex=\"0\"><table>\n",
        html.empty() ? " open" : "", title_of(bench, condition), escaped(condition.name));
    html += head_of(columns) + "<tbody>\n";
    for (const BenchEntry* entry : entries_of(bench, condition.name)) {
      html += row_of(*entry, columns);
    }
    html += "</tbody></table></div></details>\n";
  }
  return html;
}

/// What the bounds ignore, by condition.
std::string bound_notes(const Bench& bench) {
  std::string items;
  for (const BenchCondition& condition : bench.conditions) {
    const std::string name = "<li><bdi>" + escaped(condition.name) + "</bdi>: ";
    if (!condition.no_bound.empty()) {
      items += name + "no bound, as " + escaped(condition.no_bound) + "</li>\n";
    } else if (!condition.bound_knows_pose_error) {
      items +=
          name + "the bound takes the poses as exact, as the law of their errors is unknown</li>\n";
    }
  }
  return items.empty() ? "" : "<ul class=\"muted\">\n" + items + "</ul>\n";
}

std::string legend(const Columns& columns) {
  std::string html =
      "<p class=\"muted\">Errors are horizontal, of the tags that were located; wrong are those "
      "over 0.3 m off. False claims: located where no position is right, or off by over five times "
      "the expected error. In brackets: ambiguous tags with a candidate within 0.1 m. Times "
      "expected: root mean square of error over the error that the method expected. Times bound: "
      "the mean error over that of an efficient estimator (the Cramér-Rao bound). NEES/dof: "
      "squared errors over the stated covariances; 1 is right, ▲ overconfident beyond chance (too "
      "bold), ▼ conservative (too cautious).";
  if (columns.aligned) {
    html +=
        " Aligned: mean error after the shift and rotation that bring a run’s tags closest to "
        "their true positions, as a map may be off as a whole.";
  }
  return html + "</p>\n";
}

bool is_of_errors(const Figure& figure) { return figure.name.rfind("errors_", 0) == 0; }

std::string figures_html(const std::vector<Figure>& figures, bool of_errors) {
  std::string drawn;
  std::string missing;
  for (const Figure& figure : figures) {
    if (is_of_errors(figure) != of_errors) continue;
    (figure.missing.empty() ? drawn : missing) += figure_html(figure);
  }
  const char* const kind = of_errors ? "figures" : "figures tall";
  return (drawn.empty() ? "" : fmt::format("<div class=\"{}\">\n{}</div>\n", kind, drawn)) +
         missing;
}

/// In a fold, which printing closes, if there are many.
std::string error_figures(const std::vector<Figure>& figures) {
  const auto count =
      static_cast<std::size_t>(std::count_if(figures.begin(), figures.end(), is_of_errors));
  const std::string html = kErrorsText + figures_html(figures, true);
  if (count <= kMostPrinted) return "<h2>Errors by condition</h2>\n" + html;
  return fmt::format(
      "<details class=\"more\" open><summary><strong>Errors by condition</strong> <span "
      "class=\"muted\">({} figures)</span></summary>\n{}</details>\n",
      count, html);
}

}  // namespace

std::string bench_page(const Bench& bench, const std::vector<Figure>& figures, Timing timing) {
  return page_head(bench.name + " – Tagfield bench",
                   {table_script().hash, figure_script().hash, link_script().hash}) +
         "<body>\n" + header(bench) + "<main>\n" + heat_table(bench) + numbers(bench, timing) +
         warnings_note(bench.warnings, "bench.json") + "<h2>Figures</h2>\n" +
         figures_html(figures, false) +
         "<h2>All numbers</h2>\n"
         "<p class=\"left-out\">The tables are unfolded only on a screen.</p>\n" +
         tables(bench, timing) + legend(columns_of(bench, timing)) + bound_notes(bench) +
         error_figures(figures) +
         "</main>\n<footer>\n<p>Made by Tagfield; bench.json, bench.csv and tags.csv are beside "
         "this page, the figures in figures/ as SVG files.</p>\n</footer>\n" +
         script_html(table_script()) + script_html(figure_script()) + script_html(link_script()) +
         "</body>\n</html>\n";
}

}  // namespace tagfield
