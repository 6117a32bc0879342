// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/sweep/sweep_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/experiment/sweep/design.h"
#include "tagfield/experiment/sweep/design_yaml.h"
#include "tagfield/experiment/sweep/sweep_text.h"
#include "tagfield/report/page.h"
#include "tagfield/report/page_script.h"
#include "tagfield/report/page_text.h"
#include "tagfield/report/text.h"
#include "tagfield/report/warnings_note.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxPageRows = 200;
constexpr std::size_t kMaxPageFailures = 50;
constexpr std::size_t kMaxCell = 28;

const std::optional<Halving>& halving_in(const SweepResults& results) {
  static const std::optional<Halving> none;
  return results.plan.suite.sweep ? results.plan.suite.sweep->adaptive : none;
}

std::string incomplete_note(const SweepResults& results) {
  if (results.complete()) return "";
  const std::string what = results.missing > 0
                               ? fmt::format("{} of {} runs are missing", grouped(results.missing),
                                             grouped(results.planned))
                               : fmt::format("{} of {} rungs are complete",
                                             results.closed.survivors.size(), results.rungs);
  return "<div class=\"note incomplete\"><p><strong>Incomplete.</strong> " + what + ".</p></div>\n";
}

std::string sweep_header(const SweepResults& results) {
  const Suite& suite = results.plan.suite;
  std::string html = "<header>\n<p class=\"kind\">Tagfield sweep</p>\n<h1><bdi>" +
                     breakable(suite.name) + "</bdi></h1>\n";
  if (!suite.description.empty()) {
    html += "<p class=\"muted\">" + escaped(suite.description) + "</p>\n";
  }
  return html + incomplete_note(results) + "</header>\n";
}

std::string big_of(const std::string& name, const std::string& value) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(name), escaped(value));
}

std::string sweep_numbers(const SweepResults& results) {
  std::string html = "<dl class=\"numbers\">\n" +
                     big_of("Points", grouped(results.plan.points.size())) +
                     big_of("Methods", grouped(results.plan.suite.methods.size())) +
                     big_of("Runs", grouped(results.planned - results.missing));
  if (!results.failed.empty()) html += big_of("Failed", grouped(results.failed.size()));
  if (results.rungs > 1) html += big_of("Rungs", grouped(results.rungs));
  return html + "</dl>\n";
}

std::string sweep_failures(const SweepResults& results) {
  if (results.failed.empty()) return "";
  std::string html =
      "<div class=\"note\"><p><strong>Runs that failed</strong>, and how to run each again "
      "(<code>--again failed</code> for all)</p><ul>\n";
  for (std::size_t i = 0; i < std::min(results.failed.size(), kMaxPageFailures); ++i) {
    const FailedRun& run = results.failed[i];
    html += fmt::format(
        "<li>{}, seed {}: {}<br><code>tagfield sweep SUITE --out DIR --again {}"
        "</code></li>\n",
        escaped(results.plan.points[run.key.point].name), run.key.seed, escaped(run.reason),
        to_string(run.key));
  }
  if (results.failed.size() > kMaxPageFailures) {
    html +=
        fmt::format("<li>… and {} more</li>\n", grouped(results.failed.size() - kMaxPageFailures));
  }
  return html + "</ul></div>\n";
}

std::string plain_cell(const std::string& text) { return "<td>" + text + "</td>"; }

std::string mm_cell(const std::optional<ErrorStatistics>& errors, double ErrorStatistics::*of) {
  return plain_cell(errors ? fmt::format("{:.1f}", 1e3 * (*errors).*of) : "–");
}

std::string mean_cell(const SweepRow& row) {
  if (!row.error_m || !row.mean_standard_error_m) {
    return mm_cell(row.error_m, &ErrorStatistics::mean);
  }
  return plain_cell(
      fmt::format("{:.1f} ± {:.1f}", 1e3 * row.error_m->mean, 1e3 * *row.mean_standard_error_m));
}

/// Whether points are also identified by their conditions.
bool names_conditions(const SweepResults& results) {
  return results.plan.suite.conditions.size() > 1 || results.plan.keys.empty();
}

std::string sweep_head(const SweepResults& results) {
  std::string html = "<thead><tr>";
  const auto column = [&](const std::string& name) {
    html += "<th scope=\"col\">" + name + "</th>";
  };
  column("Method");
  if (names_conditions(results)) column("Condition");
  for (const std::string& key : results.plan.keys) {
    // A long key may break after its words.
    std::string text = escaped(key);
    for (std::size_t at = 0; (at = text.find('.', at)) != std::string::npos; at += 6) {
      text.insert(at + 1, "<wbr>");
    }
    column(text);
  }
  if (results.rungs > 1) column("Rung");
  for (const char* name : {"Runs", "Located", "Mean<br>[mm]", "Median<br>[mm]", "95 %<br>[mm]",
                           "Max<br>[mm]", "Wrong", "Times<br>expected", "Times<br>bound"}) {
    column(name);
  }
  return html + "</tr></thead>\n";
}

std::string ratio_cell(const std::optional<double>& ratio) {
  return plain_cell(ratio ? fmt::format("{:.2f}", *ratio) : "–");
}

std::string sweep_row(const SweepResults& results, const SweepRow& row) {
  const SweepPoint& point = results.plan.points[row.point];
  std::string html = fmt::format("<tr><th scope=\"row\" title=\"point {}\"><bdi>{}</bdi></th>",
                                 row.point, escaped(shortened(row.name, kMaxCell)));
  if (names_conditions(results)) {
    const std::string& name = results.plan.suite.conditions[point.condition].name;
    html += "<td class=\"words\">" + escaped(shortened(name, kMaxCell)) + "</td>";
  }
  for (const std::string& key : results.plan.keys) {
    html += plain_cell(escaped(shortened(value_at(point, key), kMaxCell)));
  }
  if (results.rungs > 1) html += plain_cell(grouped(rung_of(results, row.point) + 1));
  return html + plain_cell(grouped(row.runs)) +
         plain_cell(fmt::format("{} of {}", row.located, row.tags)) + mean_cell(row) +
         mm_cell(row.error_m, &ErrorStatistics::median) +
         mm_cell(row.error_m, &ErrorStatistics::p95) + mm_cell(row.error_m, &ErrorStatistics::max) +
         plain_cell(grouped(row.wrong)) + ratio_cell(row.error_over_expected) +
         ratio_cell(row.ratio_to_bound) + "</tr>\n";
}

std::string order_text(const SweepResults& results) {
  const std::optional<Halving>& halving = halving_in(results);
  if (!halving) return "The smallest mean error first";
  return fmt::format(
      "Points that got furthest come first, and of those the best in <code>{}</code> of {}",
      to_string(halving->target), escaped(halving->method));
}

std::string sweep_table(const SweepResults& results) {
  const std::vector<const SweepRow*> rows = best_first(results);
  const std::size_t shown = std::min(rows.size(), kMaxPageRows);
  std::string html =
      "<div class=\"table\" role=\"region\" aria-label=\"Results\" tabindex=\"0\"><table>\n" +
      sweep_head(results) + "<tbody>\n";
  for (std::size_t i = 0; i < shown; ++i) html += sweep_row(results, *rows[i]);
  html += "</tbody></table></div>\n<p class=\"muted\">" + order_text(results);
  if (shown < rows.size()) {
    html += fmt::format("; {} of {} rows, points.csv has all", shown, grouped(rows.size()));
  }
  return html +
         ". Errors are horizontal, of the tags that were located; ± is the standard error of the "
         "mean over seeds; wrong are those over 0.3 m off. Times expected: root mean square of "
         "error over the error that the method expected. Times bound: the mean error over that of "
         "an efficient estimator (the Cramér-Rao bound).</p>\n";
}

std::string sweep_figures_html(const std::vector<Figure>& figures) {
  std::string html = "<div class=\"figures\">\n";
  for (const Figure& figure : figures) html += figure_html(figure);
  return html + "</div>\n";
}

}  // namespace

std::string sweep_page(const SweepResults& results, const std::vector<Figure>& figures) {
  return page_head(results.plan.suite.name + " – Tagfield sweep",
                   {table_script().hash, figure_script().hash, link_script().hash}) +
         "<body>\n" + sweep_header(results) + "<main>\n" + sweep_numbers(results) +
         warnings_note(results.warnings, "results.json") + sweep_failures(results) +
         sweep_figures_html(figures) + "<h2>Points</h2>\n" + sweep_table(results) +
         "</main>\n<footer>\n<p>Made by Tagfield; results.sqlite (tables points, results, runs, "
         "tags, failures), results.json, points.csv and runs.csv are beside this page, the figures "
         "in figures/ as SVG files.</p>\n</footer>\n" +
         script_html(table_script()) + script_html(figure_script()) + script_html(link_script()) +
         "</body>\n</html>\n";
}

}  // namespace tagfield
