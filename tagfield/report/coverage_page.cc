// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/coverage_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/report/coverage_figure.h"
#include "tagfield/report/page.h"
#include "tagfield/report/page_script.h"
#include "tagfield/report/page_text.h"
#include "tagfield/report/text.h"
#include "tagfield/report/warnings_note.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxTags = 500;

std::string big_number(const std::string& name, const std::string& value, bool lead = false) {
  return fmt::format("<div{}><dt>{}</dt><dd>{}</dd></div>\n", lead ? " class=\"lead\"" : "",
                     escaped(name), escaped(value));
}

std::string coverage_fact(const std::string& name, const std::string& value) {
  return "<dt>" + escaped(name) + "</dt><dd>" + escaped(value) + "</dd>\n";
}

std::size_t count(const Coverage& coverage, TagVerdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(coverage.tags.begin(), coverage.tags.end(),
                    [&](const TagCoverage& tag) { return tag.verdict == verdict; }));
}

std::string numbers(const Coverage& coverage) {
  std::string html = "<dl class=\"numbers\">\n";
  html += big_number(
      fmt::format("Tags read in {:.3g} s", coverage.run_s),
      fmt::format("{:.0f} of {}", coverage.expected_read.mean, grouped(coverage.tags.size())),
      true);
  html += big_number("With 95 % confidence",
                     fmt::format("{:.0f} to {:.0f}", std::ceil(coverage.expected_read.low),
                                 std::floor(coverage.expected_read.high)));
  html += big_number("Seldom read", grouped(count(coverage, TagVerdict::kSeldom)));
  html += big_number("Never read", grouped(count(coverage, TagVerdict::kNever)));
  for (const CoverageLayer& layer : coverage.layers) {
    html += big_number(fmt::format("Area read at {:.2f} m", layer.height_m + 0.0),
                       fmt::format("{:.0f} %", 100.0 * share_read(layer)));
  }
  if (coverage.antennas.size() > 1) {
    html += big_number("By others too", grouped(count(coverage, TagVerdict::kAlsoOther)));
    html += big_number("By others only", grouped(count(coverage, TagVerdict::kWrong)));
  }
  return html + "</dl>\n";
}

std::string antennas_text(const Coverage& coverage) {
  std::string text;
  for (const CoverageAntenna& antenna : coverage.antennas) {
    text += (text.empty() ? "" : ", ") + clean_text(antenna.name);
    if (antenna.places_W.size() > 1) {
      text += fmt::format(" ({} positions on its path)", antenna.places_W.size());
    }
  }
  return text;
}

std::string facts(const Coverage& coverage) {
  return "<dl class=\"facts\">\n" + coverage_fact("Tag", coverage.tag_kind) +
         coverage_fact("Orientation", coverage.orientation) +
         coverage_fact("Antennas", antennas_text(coverage)) +
         coverage_fact("When", coverage.moment) +
         coverage_fact("Cells", fmt::format("{} of {:g} m at each height",
                                            grouped(coverage.grid.size()), coverage.grid.step_m)) +
         "</dl>\n";
}

std::string number_cell(double db) {
  if (db < kMinPower_db) return "<td>–</td>";
  return db < 0.0 ? fmt::format("<td>−{:.1f}</td>", -db) : fmt::format("<td>{:.1f}</td>", db);
}

std::string row(const Coverage& coverage, const TagCoverage& tag) {
  return fmt::format(
             "<tr><th scope=\"row\" title=\"{}\"><bdi>{}</bdi></th><td class=\"words\">{}</td>",
             escaped(tag.id), escaped(shortened(tag.id, 28)), escaped(spoken(coverage, tag))) +
         number_cell(tag.best.margin_db) + number_cell(tag.best.power_dbm) +
         fmt::format("<td>{:.0f}</td><td>{:.2f}</td></tr>\n", 100.0 * tag.probability,
                     tag.nearest_m);
}

/// The tags that need attention come first.
std::vector<const TagCoverage*> sorted(const Coverage& coverage) {
  constexpr int kOrder[] = {0, 4, 3, 2, 1};  // By TagVerdict.
  std::vector<const TagCoverage*> tags;
  for (const TagCoverage& tag : coverage.tags) tags.push_back(&tag);
  std::stable_sort(tags.begin(), tags.end(), [&](const TagCoverage* a, const TagCoverage* b) {
    const int first = kOrder[static_cast<int>(a->verdict)];
    const int second = kOrder[static_cast<int>(b->verdict)];
    return first != second ? first < second : natural_less(a->id, b->id);
  });
  return tags;
}

std::string table(const Coverage& coverage) {
  const bool paper = is_by_paper(coverage);
  std::string html =
      "<div class=\"table told\" role=\"region\" aria-label=\"Tags\" tabindex=\"0\"><table>\n"
      "<thead><tr><th scope=\"col\">Tag</th><th scope=\"col\" class=\"words\">Read by</th>"
      "<th scope=\"col\">Margin<br>[dB]</th><th scope=\"col\">";
  html += paper ? "RSSI<br>[dBm]" : "Power at<br>chip [dBm]";
  html +=
      "</th><th scope=\"col\">Read in<br>the run [%]</th><th scope=\"col\">Nearest<br>antenna "
      "[m]</th>"
      "</tr></thead>\n<tbody>\n";
  const std::vector<const TagCoverage*> tags = sorted(coverage);
  const std::size_t shown = std::min(tags.size(), kMaxTags);
  for (std::size_t i = 0; i < shown; ++i) html += row(coverage, *tags[i]);
  html += "</tbody></table></div>\n";
  if (shown < tags.size()) {
    html += fmt::format("<p class=\"muted\">{} of {} tags; coverage_tags.csv holds all.</p>\n",
                        shown, grouped(tags.size()));
  }
  return html;
}

std::vector<CoverageQuantity> quantities_of(const Coverage& coverage) {
  std::vector<CoverageQuantity> all = {CoverageQuantity::kProbability, CoverageQuantity::kMargin,
                                       CoverageQuantity::kPower};
  if (coverage.antennas.size() > 1) all.push_back(CoverageQuantity::kAntenna);
  return all;
}

/// The figures in [first, last); `dense` ones are printed smaller.
std::string figures_html(const std::vector<Figure>& figures, std::size_t first, std::size_t last,
                         bool dense) {
  std::string html = dense ? "<div class=\"figures dense\">\n" : "<div class=\"figures\">\n";
  for (std::size_t i = first; i < std::min(last, figures.size()); ++i) {
    html += figure_html(figures[i]);
  }
  return html + "</div>\n";
}

std::string header(const Coverage& coverage) {
  std::string html = "<header>\n<p class=\"kind\">Tagfield coverage</p>\n<h1><bdi>" +
                     breakable(coverage.scenario) + "</bdi></h1>\n";
  if (!coverage.description.empty()) {
    html += "<p class=\"muted\">" + escaped(coverage.description) + "</p>\n";
  }
  return html + "</header>\n";
}

}  // namespace

std::vector<Figure> coverage_figures(const Coverage& coverage,
                                     const std::vector<Silhouette>& top_view) {
  std::vector<Figure> figures;
  for (const CoverageLayer& layer : coverage.layers) {
    for (const CoverageQuantity quantity : quantities_of(coverage)) {
      figures.push_back(coverage_figure(coverage, layer, quantity, top_view));
    }
  }
  figures.push_back(coverage_tags_figure(coverage, top_view));
  return figures;
}

std::string coverage_page(const Coverage& coverage, const std::vector<Figure>& figures) {
  std::string maps;
  std::size_t next = 0;
  for (const CoverageLayer& layer : coverage.layers) {
    maps += fmt::format("<h2>{:.2f} m above the floor</h2>\n", layer.height_m + 0.0);
    maps += figures_html(figures, next, next + quantities_of(coverage).size(),
                         coverage.layers.size() > 1);
    next += quantities_of(coverage).size();
  }
  return page_head(coverage.scenario + " – Tagfield coverage",
                   {table_script().hash, figure_script().hash, link_script().hash}) +
         "<body>\n" + header(coverage) + "<main>\n" + numbers(coverage) + facts(coverage) +
         warnings_note(coverage.warnings, "coverage.json") + maps +
         "<h2>The scenario’s tags</h2>\n" + figures_html(figures, next, figures.size(), false) +
         table(coverage) +
         "</main>\n<footer>\n<p>Made by Tagfield; the cells are beside this page as CSV files, the "
         "maps in figures/ as SVG files.</p>\n</footer>\n" +
         script_html(table_script()) + script_html(figure_script()) + script_html(link_script()) +
         "</body>\n</html>\n";
}

}  // namespace tagfield
