// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "tagfield/report/internal/tables.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

constexpr const char* kHead =
    "<th scope=\"col\" rowspan=\"2\">Located</th><th scope=\"col\" rowspan=\"2\">Ambiguous</th>"
    "<th scope=\"colgroup\" colspan=\"4\">Error [mm]</th>";
constexpr const char* kStatisticsHead =
    "<th scope=\"col\">mean</th><th scope=\"col\">median</th><th scope=\"col\">95 %</th>"
    "<th scope=\"col\">greatest</th>";

std::string statistics_cells(const std::optional<ErrorStatistics>& errors) {
  std::string cells;
  for (const auto part : {&ErrorStatistics::mean, &ErrorStatistics::median, &ErrorStatistics::p95,
                          &ErrorStatistics::max}) {
    cells +=
        errors ? fmt::format("<td>{:.1f}</td>", 1e3 * (*errors).*part) : std::string("<td>–</td>");
  }
  return cells;
}

std::string row(const MethodSummary& of_method, bool aligned) {
  const std::size_t all = of_method.located + of_method.ambiguous + of_method.not_located;
  std::string html = fmt::format("<tr><th scope=\"row\">{}</th><td>{} of {}</td><td>{}</td>",
                                 escaped(of_method.method), grouped(of_method.located),
                                 grouped(all), grouped(of_method.ambiguous));
  html += statistics_cells(of_method.error_m);
  if (aligned) html += statistics_cells(of_method.aligned_error_m);
  return html + "</tr>\n";
}

std::string head(bool aligned) {
  std::string html = std::string("<thead><tr><th scope=\"col\" rowspan=\"2\">Method</th>") + kHead;
  if (aligned)
    html += "<th scope=\"colgroup\" colspan=\"4\">After the best rigid alignment [mm]</th>";
  html += std::string("</tr>\n<tr>") + kStatisticsHead;
  if (aligned) html += kStatisticsHead;
  return html + "</tr></thead>\n";
}

}  // namespace

std::string methods_table(const Summary& summary) {
  const std::vector<MethodSummary>& methods = summary.compared_methods;
  if (methods.empty()) return "";
  const bool aligned = std::any_of(methods.begin(), methods.end(), [](const MethodSummary& of) {
    return of.aligned_error_m.has_value();
  });
  std::string html = "<h2>Methods</h2>\n<p>The same reads and poses, located by each method.";
  if (aligned) {
    html +=
        " A pose that is off as a whole shifts and rotates all tags alike, which reads can’t "
        "reveal: the columns on the right are after the shift and rotation that fit best.";
  }
  html += "</p>\n<div class=\"table\" role=\"region\" aria-label=\"Methods\" tabindex=\"0\">";
  html += "<table>\n" + head(aligned) + "<tbody>\n";
  for (const MethodSummary& of_method : methods) html += row(of_method, aligned);
  return html + "</tbody></table></div>\n";
}

}  // namespace tagfield
