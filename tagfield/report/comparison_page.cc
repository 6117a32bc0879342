// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/comparison_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/report/internal/tables.h"
#include "tagfield/report/page.h"
#include "tagfield/report/page_script.h"
#include "tagfield/report/page_text.h"
#include "tagfield/report/text.h"
#include "tagfield/report/warnings_note.h"

namespace tagfield {
namespace {

/// "−3.1 mm", "+1.20 m", "0".
std::string signed_length(double length_m) {
  if (length_m == 0.0) return "0";
  return (length_m < 0.0 ? "−" : "+") + spoken_length(std::abs(length_m));
}

std::string signed_count(double first, double second) {
  std::string text = tally(std::abs(second - first));
  if (text == "0") return text;
  return (second > first ? "+" : "−") + text;
}

using Count = std::size_t ComparedRun::*;

std::string mean_count(const ComparedRun& run, Count count) {
  return tally(per_run(run, run.*count));
}

/// "68 and 60.6 of 68 tags were read", means of several runs.
std::string read_sentence(const RunComparison& comparison) {
  const auto& [first, second] = comparison.runs;
  const std::string all = mean_count(first, &ComparedRun::tags);
  const std::string others = mean_count(second, &ComparedRun::tags);
  const std::string of_first = all == others ? "" : fmt::format(" of {}", all);
  std::string text =
      fmt::format("{}{} and {} of {} tags were read", mean_count(first, &ComparedRun::read),
                  of_first, mean_count(second, &ComparedRun::read), others);
  if (std::max(first.runs, second.runs) > 1) text += ", on average over the seeds";
  return text + (any_locates(comparison) ? "; no tag has a known error in both runs." : ".");
}

std::string compared_header(const RunComparison& comparison) {
  const auto& [first, second] = comparison.runs;
  return "<header>\n<p class=\"kind\">Tagfield comparison</p>\n<h1><bdi>" + breakable(first.name) +
         "</bdi> and <bdi>" + breakable(second.name) + "</bdi></h1>\n<p>" +
         escaped(comparison_sentence(comparison)) + "</p>\n</header>\n";
}

std::string compared_number(const std::string& name, const std::string& value, bool lead = false) {
  return fmt::format("<div{}><dt>{}</dt><dd>{}</dd></div>\n", lead ? " class=\"lead\"" : "",
                     escaped(name), escaped(value));
}

/// The headline numbers: errors if both runs have some, else tags read.
std::string compared_numbers(const RunComparison& comparison) {
  std::string html = "<dl class=\"numbers\">\n";
  const bool has_errors = comparison.runs[0].error_m && comparison.runs[1].error_m;
  for (const ComparedRun& run : comparison.runs) {
    const std::string name = shortened(run.name, 24);
    html += has_errors ? compared_number("Mean error, " + name, spoken_length(run.error_m->mean))
                       : compared_number("Tags read, " + name, mean_count(run, &ComparedRun::read));
  }
  if (comparison.error) {
    html += compared_number("Mean difference", signed_length(comparison.error->mean_m), true);
    html += compared_number("Smaller in the second",
                            fmt::format("{} of {}", grouped(comparison.error->smaller),
                                        grouped(comparison.error->tags)));
  }
  return html + "</dl>\n";
}

std::string cells(const std::string& name, const std::string& first, const std::string& second,
                  const std::string& difference) {
  return "<tr><th scope=\"row\">" + escaped(name) + "</th><td>" + escaped(first) + "</td><td>" +
         escaped(second) + "</td><td>" + escaped(difference) + "</td></tr>\n";
}

std::string error_cells(const RunComparison& comparison, const std::string& name,
                        double ErrorStatistics::*member) {
  const auto& [first, second] = comparison.runs;
  if (!first.error_m && !second.error_m) return "";
  const auto of = [&](const ComparedRun& run) {
    return run.error_m ? spoken_length((*run.error_m).*member) : std::string("–");
  };
  const std::string difference =
      first.error_m && second.error_m
          ? signed_length((*second.error_m).*member - (*first.error_m).*member)
          : "–";
  return cells(name, of(first), of(second), difference);
}

std::string count_cells(const RunComparison& comparison, const std::string& name, Count count) {
  const auto& [first, second] = comparison.runs;
  return cells(name, mean_count(first, count), mean_count(second, count),
               signed_count(per_run(first, first.*count), per_run(second, second.*count)));
}

/// None if neither run locates tags.
std::string location_cells(const RunComparison& comparison) {
  if (!any_locates(comparison)) return "";
  return count_cells(comparison, "Tags located", &ComparedRun::located) +
         error_cells(comparison, "Mean error", &ErrorStatistics::mean) +
         error_cells(comparison, "Median error", &ErrorStatistics::median) +
         error_cells(comparison, "95 % of errors below", &ErrorStatistics::p95) +
         error_cells(comparison, "Maximum error", &ErrorStatistics::max);
}

std::string seeds_of(const ComparedRun& run) {
  if (run.seeds.empty()) return "–";
  if (run.seeds.size() == 1) return fmt::format("{}", run.seeds.front());
  return fmt::format("{} from {}", run.seeds.size(), run.seeds.front());
}

/// Whether two settings differ.
std::string same_or_not(const std::string& first, const std::string& second) {
  return first == second ? "same" : "differs";
}

std::string whole_table(const RunComparison& comparison) {
  const auto& [first, second] = comparison.runs;
  std::string html =
      "<h2>The runs</h2>\n<div class=\"table\" role=\"region\" aria-label=\"Runs\" tabindex=\"0\">"
      "<table>\n<thead><tr><th scope=\"col\">Quantity</th><th scope=\"col\">" +
      escaped(shortened(first.name, 40)) + "</th><th scope=\"col\">" +
      escaped(shortened(second.name, 40)) +
      "</th><th scope=\"col\">Difference</th></tr></thead>\n<tbody>\n";
  html += location_cells(comparison);
  html += count_cells(comparison, "Tags read", &ComparedRun::read);
  html += count_cells(comparison, "Reads", &ComparedRun::reads);
  html += cells("Path of the antenna", spoken_length(first.path_length_m),
                spoken_length(second.path_length_m),
                signed_length(second.path_length_m - first.path_length_m));
  html += cells("Scenario", first.scenario, second.scenario,
                same_or_not(first.scenario, second.scenario));
  html += cells("Method", first.method, second.method, same_or_not(first.method, second.method));
  html += cells("Poses", first.pose, second.pose, same_or_not(first.pose, second.pose));
  const std::string seeds = first.seeds == second.seeds ? "same" : "differs";
  html += cells("Seeds", seeds_of(first), seeds_of(second), seeds);
  return html + "</tbody></table></div>\n";
}

std::string millimetres_or_none(const std::optional<double>& length_m) {
  return length_m ? fmt::format("{:.1f}", 1e3 * *length_m) : "–";
}

std::string tag_errors(const ComparedTag& tag) {
  const auto& [first, second] = tag.runs;
  std::string difference = "–";
  if (first.error_m && second.error_m) {
    const double mm = 1e3 * (*second.error_m - *first.error_m);
    difference = fmt::format("{}{:.1f}", mm < 0.0 ? "−" : "+", std::abs(mm));
  }
  return fmt::format("<td>{}</td><td>{}</td><td>{}</td>", millimetres_or_none(first.error_m),
                     millimetres_or_none(second.error_m), difference);
}

std::string tag_cells(const RunComparison& comparison, const ComparedTag& tag) {
  const auto& [first, second] = tag.runs;
  return fmt::format(
      "<tr><th scope=\"row\" title=\"{}\"><bdi>{}</bdi></th>{}"
      "<td>{}</td><td>{}</td><td class=\"words\">{}</td><td class=\"words\">{}</td></tr>\n",
      escaped(tag.tag), escaped(shortened(tag.tag, 28)),
      any_locates(comparison) ? tag_errors(tag) : "",
      tally(per_run(comparison.runs[0], first.reads)),
      tally(per_run(comparison.runs[1], second.reads)), escaped(first.verdict),
      escaped(second.verdict));
}

std::string tags_table(const RunComparison& comparison) {
  std::string html =
      "<h2>Tags</h2>\n<div class=\"table\" role=\"region\" aria-label=\"Tags\" tabindex=\"0\">"
      "<table>\n<thead><tr><th scope=\"col\">Tag</th>";
  if (any_locates(comparison)) {
    html +=
        "<th scope=\"col\">First<br>error [mm]</th><th scope=\"col\">Second<br>error [mm]</th>"
        "<th scope=\"col\">Difference<br>[mm]</th>";
  }
  html +=
      "<th scope=\"col\">First<br>reads</th><th scope=\"col\">Second<br>reads</th>"
      "<th scope=\"col\" class=\"words\">First</th><th scope=\"col\" class=\"words\">Second</th>"
      "</tr></thead>\n<tbody>\n";
  const std::size_t most = std::min(comparison.tags.size(), kMaxTableRows);
  for (std::size_t i = 0; i < most; ++i) html += tag_cells(comparison, comparison.tags[i]);
  html += "</tbody></table></div>\n";
  if (most < comparison.tags.size()) {
    html += fmt::format("<p class=\"muted\">The first {} of {} tags; compare.csv holds all.</p>\n",
                        most, grouped(comparison.tags.size()));
  }
  return html;
}

}  // namespace

std::string comparison_sentence(const RunComparison& comparison) {
  const auto& error = comparison.error;
  if (!error) return read_sentence(comparison);
  std::string text = fmt::format(
      "Of {} that both located, the second run has the smaller error for {} and the larger for {}. "
      "Its errors differ by {} on average",
      counted(error->tags, "tag"), grouped(error->smaller), grouped(error->larger),
      signed_length(error->mean_m));
  if (!error->interval_m) return text + ".";
  const auto& [low, high] = *error->interval_m;
  text += fmt::format(" ({} to {} with 95 % confidence)", signed_length(low), signed_length(high));
  return text + (low <= 0.0 && high >= 0.0 ? ", which may be chance." : ".");
}

std::string comparison_page(const RunComparison& comparison, const std::vector<Figure>& figures) {
  std::string drawn;
  std::string missing;
  for (const Figure& figure : figures) {
    (figure.missing.empty() ? drawn : missing) += figure_html(figure);
  }
  return page_head(
             comparison.runs[0].name + " and " + comparison.runs[1].name + " – Tagfield comparison",
             {table_script().hash, figure_script().hash, link_script().hash}) +
         "<body>\n" + compared_header(comparison) + "<main>\n" + compared_numbers(comparison) +
         warnings_note(comparison.warnings, "compare.json") + "<div class=\"figures\">\n" + drawn +
         "</div>\n" + missing + whole_table(comparison) + tags_table(comparison) +
         "</main>\n<footer>\n<p>Made by Tagfield; compare.csv and compare.json are beside this "
         "page, figures/ holds the figures. Differences are the second run minus the first; of "
         "several seeds, counts are means; the confidence assumes that tags are independent of "
         "each other, which pose errors of the "
         "antenna make less true.</p>\n</footer>\n" +
         script_html(table_script()) + script_html(figure_script()) + script_html(link_script()) +
         "</body>\n</html>\n";
}

}  // namespace tagfield
