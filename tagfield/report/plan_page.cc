// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/plan_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tagfield/report/internal/color_bands.h"
#include "tagfield/report/page.h"
#include "tagfield/report/page_script.h"
#include "tagfield/report/page_text.h"
#include "tagfield/report/text.h"
#include "tagfield/report/warnings_note.h"

namespace tagfield {
namespace {

constexpr const char* kGainColors[] = {"#c2410c", "#f2a65a", "#c9cfd6", "#7fb2e8", "#1659d6"};
constexpr double kGainEdges[] = {-0.2, -0.02, 0.02, 0.2};

std::string planned_number(const std::string& name, const std::string& value, const char* field,
                           bool lead = false) {
  return fmt::format("<div{}><dt>{}</dt><dd data-field=\"{}\">{}</dd></div>\n",
                     lead ? " class=\"lead\"" : "", escaped(name), field, escaped(value));
}

std::string read_text(const PlannedLayout& layout) {
  return fmt::format("{:.0f}", layout.read.mean);
}

std::string range_text(const PlannedLayout& layout) {
  return fmt::format("{:.0f} to {:.0f}", std::ceil(layout.read.low), std::floor(layout.read.high));
}

std::string cross_text(const PlannedLayout& layout) {
  double worst = 0.0;
  for (const PlannedZone& zone : layout.zones) {
    if (zone.tags > 0) worst = std::max(worst, zone.cross.mean / static_cast<double>(zone.tags));
  }
  return fmt::format("{:.1f} %", 100.0 * worst);
}

std::string plan_numbers(const AntennaPlan& plan) {
  const PlannedLayout& layout = plan.layouts[plan.chosen];
  std::string html = "<dl class=\"numbers\">\n";
  html += planned_number("Antennas", fmt::format("{}", layout.antennas.size()), "antennas");
  html += planned_number("Readers", fmt::format("{}", layout.readers), "readers");
  html += planned_number(
      fmt::format("Of {} tags {} in {:g} s", grouped(plan.tags), words_for(plan.aim), plan.dwell_s),
      read_text(layout), "read", true);
  html += planned_number("With 95 % confidence", range_text(layout), "range");
  if (layout.zones.size() > 1) {
    html += planned_number("Cross-read in the worst zone", cross_text(layout), "cross");
  }
  html += planned_number("Cost", fmt::format("{:g}", layout.cost), "cost");
  html += planned_number(
      "Short of the best by at most",
      fmt::format("{:.2f} %", 100.0 * std::max(0.0, layout.bound - layout.score)), "gap");
  return html + "</dl>\n";
}

/// The data for the script.
std::string plan_data(const AntennaPlan& plan) {
  const ColorBands bands = probability_bands();
  nlohmann::json data;
  data["edges"] = bands.edges;
  data["colors"] = bands.colors;
  data["gain_edges"] = kGainEdges;
  data["gain_colors"] = kGainColors;
  data["names"] = nlohmann::json::array();
  for (const PlannedPlace& place : plan.places) {
    data["names"].push_back(fmt::format("{} ({:.2f}, {:.2f}, {:.2f}) m", clean_text(place.group),
                                        place.p_W.x() + 0.0, place.p_W.y() + 0.0,
                                        place.p_W.z() + 0.0));
  }
  data["layouts"] = nlohmann::json::array();
  for (const PlannedLayout& layout : plan.layouts) {
    nlohmann::json one;
    one["antennas"] = layout.antennas.size();
    one["readers"] = layout.readers;
    one["read"] = read_text(layout);
    one["range"] = range_text(layout);
    one["cross"] = cross_text(layout);
    one["cost"] = fmt::format("{:g}", layout.cost);
    one["gap"] = fmt::format("{:.2f} %", 100.0 * std::max(0.0, layout.bound - layout.score));
    std::vector<int> percent;
    for (const double p : layout.places)
      percent.push_back(static_cast<int>(std::lround(100.0 * p)));
    one["places"] = percent;
    data["layouts"].push_back(std::move(one));
  }
  std::string text = data.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  // The text must not end the element that contains it.
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    text.replace(at, 1, "\\u003c");
  }
  return "<script type=\"application/json\" id=\"plan-data\">" + text + "</script>\n";
}

std::string swatches(const char* id, const std::vector<std::pair<std::string, std::string>>& colors,
                     bool hidden) {
  std::string html = fmt::format("<p class=\"swatches\" id=\"{}\"{}>", id, hidden ? " hidden" : "");
  for (const auto& [color, words] : colors) {
    html += fmt::format("<span><i style=\"background:{}\"></i>{}</span>", color, escaped(words));
  }
  return html + "</p>\n";
}

std::string controls(const AntennaPlan& plan) {
  std::string html = fmt::format(
      "<div class=\"controls\" id=\"plan-controls\" hidden><label>Antennas <input type=\"range\" "
      "id=\"plan-count\" min=\"0\" max=\"{}\" value=\"{}\"></label>\n"
      "<label>compare with <select id=\"plan-other\"><option value=\"\">no other</option>",
      plan.layouts.size() - 1, plan.chosen);
  for (std::size_t i = 0; i < plan.layouts.size(); ++i) {
    html += fmt::format("<option value=\"{}\">{}</option>", i,
                        counted(plan.layouts[i].antennas.size(), "antenna"));
  }
  html += "</select></label></div>\n";
  const ColorBands bands = probability_bands();
  std::vector<std::pair<std::string, std::string>> colors;
  for (std::size_t i = 0; i < bands.colors.size(); ++i) {
    const double from = i == 0 ? 0.0 : bands.edges[i - 1];
    const double to = i < bands.edges.size() ? bands.edges[i] : 1.0;
    colors.emplace_back(
        bands.colors[i].empty() ? "#8a949e" : bands.colors[i],
        i == 0 ? fmt::format("{} under {:.0f} %",
                             plan.aim.kind == PlannedAim::Kind::kReadProbability ? "read by" : "in",
                             100.0 * to)
        : i + 1 == bands.colors.size()
            ? fmt::format("{:.0f} %{}", 100.0 * from, from >= 0.995 ? "" : " and more")
            : fmt::format("{:.0f} to {:.0f} %", 100.0 * from, 100.0 * to));
  }
  html += swatches("plan-legend", colors, false);
  return html + swatches("plan-gain-legend",
                         {{kGainColors[0], "worse by over 20 points"},
                          {kGainColors[1], "worse"},
                          {kGainColors[2], "the same to 2 points"},
                          {kGainColors[3], "better"},
                          {kGainColors[4], "better by over 20 points"}},
                         true);
}

/// The words with a capital letter, as a column header.
std::string capital(std::string words) {
  if (!words.empty() && words[0] >= 'a' && words[0] <= 'z') words[0] += 'A' - 'a';
  return words;
}

/// `label` names the region for screen readers.
std::string table_begin(const std::string& label, const std::vector<std::string>& columns,
                        const std::string& id = "") {
  std::string html = fmt::format(
      "<div class=\"table told\" role=\"region\" aria-label=\"{}\" tabindex=\"0\"{}><table>\n"
      "<thead><tr>",
      escaped(label), id.empty() ? "" : " id=\"" + id + "\"");
  for (const std::string& column : columns) html += "<th scope=\"col\">" + column + "</th>";
  return html + "</tr></thead>\n<tbody>\n";
}

constexpr const char* kTableEnd = "</tbody></table></div>\n";

std::string plan_row(const std::string& name, const std::vector<std::string>& cells,
                     const std::string& words = "", const std::string& attributes = "") {
  std::string html =
      "<tr" + attributes + "><th scope=\"row\"><bdi>" + escaped(name) + "</bdi></th>";
  for (const std::string& cell : cells) html += "<td>" + escaped(cell) + "</td>";
  if (!words.empty()) html += "<td class=\"words\">" + escaped(words) + "</td>";
  return html + "</tr>\n";
}

std::string count_range(const ExpectedCount& count) {
  return fmt::format("{:.0f} to {:.0f}", std::ceil(count.low), std::floor(count.high));
}

std::string layouts_table(const AntennaPlan& plan) {
  std::string html = "<h2>By number of antennas</h2>\n" +
                     table_begin("By number of antennas",
                                 {"Antennas", "Readers", "Cost", "Tags " + words_for(plan.aim),
                                  "95 % of runs", "Score", "Bound", "Cross reads,<br>worst zone"});
  for (const PlannedLayout& layout : plan.layouts) {
    html += plan_row(fmt::format("{}", layout.antennas.size()),
                     {fmt::format("{}", layout.readers), fmt::format("{:g}", layout.cost),
                      fmt::format("{:.1f}", layout.read.mean), count_range(layout.read),
                      fmt::format("{:.4f}", layout.score),
                      fmt::format("{:.4f}{}", layout.bound, layout.is_exact ? " (exact)" : ""),
                      layout.zones.size() > 1 ? cross_text(layout) : "–"});
  }
  return html + kTableEnd;
}

std::string zones_of_plan(const AntennaPlan& plan) {
  const PlannedLayout& layout = plan.layouts[plan.chosen];
  if (layout.zones.size() < 2) return "";
  std::string html = "<h2>By zone, as chosen</h2>\n" +
                     table_begin("Zones", {"Zone", "Tags", capital(words_for(plan.aim)),
                                           "95 % of runs", "Cross-read", "95 % of runs"});
  for (const PlannedZone& zone : layout.zones) {
    html += plan_row(zone.zone, {grouped(zone.tags), fmt::format("{:.1f}", zone.read.mean),
                                 count_range(zone.read), fmt::format("{:.1f}", zone.cross.mean),
                                 count_range(zone.cross)});
  }
  return html + kTableEnd;
}

std::string antennas_table(const AntennaPlan& plan) {
  std::string html =
      "<h2>The antennas</h2>\n" + table_begin("Antennas",
                                              {"Antenna", "Reader", "x [m]", "y [m]", "z [m]",
                                               "Looks along", "Power [dBm]", "Cost"},
                                              "plan-antennas");
  for (std::size_t i = 0; i < plan.layouts.size(); ++i) {
    for (const PlannedAntenna& antenna : plan.layouts[i].antennas) {
      const Eigen::Vector3d& b = antenna.boresight_W;
      html +=
          plan_row(antenna.name,
                   {clean_text(antenna.reader), fmt::format("{:.2f}", antenna.p_W.x() + 0.0),
                    fmt::format("{:.2f}", antenna.p_W.y() + 0.0),
                    fmt::format("{:.2f}", antenna.p_W.z() + 0.0),
                    fmt::format("{:.2f}, {:.2f}, {:.2f}", b.x() + 0.0, b.y() + 0.0, b.z() + 0.0),
                    fmt::format("{:g}", antenna.power_dbm), fmt::format("{:g}", antenna.cost)},
                   "", fmt::format(" data-layout=\"{}\"{}", i, i == plan.chosen ? "" : " hidden"));
    }
  }
  return html + kTableEnd;
}

std::string hard_table(const AntennaPlan& plan) {
  if (plan.hard.empty()) {
    return fmt::format(
        "<h2>Hard tags</h2>\n<p>At every position tags are {} in 90 % and more.</p>\n",
        words_for(plan.aim));
  }
  std::string html = "<h2>Hard tags, as chosen</h2>\n" +
                     table_begin("Hard tags", {"Position", capital(words_for(plan.aim)) + " [%]",
                                               "Best antenna", "Distance [m]", "Why"});
  for (const HardPlace& hard : plan.hard) {
    const PlannedPlace& place = plan.places[hard.place];
    html += plan_row(fmt::format("{} ({:.2f}, {:.2f}, {:.2f}) m", clean_text(place.group),
                                 place.p_W.x() + 0.0, place.p_W.y() + 0.0, place.p_W.z() + 0.0),
                     {fmt::format("{:.0f}", 100.0 * hard.probability),
                      hard.best_antenna.empty() ? "–" : clean_text(hard.best_antenna),
                      fmt::format("{:.1f}", hard.distance_m)},
                     hard.why);
  }
  return html + kTableEnd;
}

std::string sensitivity_table(const AntennaPlan& plan) {
  std::string html =
      "<h2>If something is different</h2>\n" +
      table_begin("If something is different",
                  {"The chosen layout", "Tags " + words_for(plan.aim), "95 % of runs", "Lost"});
  for (const PlanVariant& variant : plan.sensitivity) {
    html += plan_row(
        variant.what,
        {fmt::format("{:.1f}", variant.read.mean), count_range(variant.read),
         fmt::format("{:.1f}", plan.sensitivity.front().read.mean - variant.read.mean + 0.0)});
  }
  return html + kTableEnd;
}

double mean_of(const std::vector<double>& values) {
  double mean = 0.0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  return mean;
}

std::string check_text(const AntennaPlan& plan) {
  if (!plan.check || plan.check->read.empty()) return "";
  const double mean = mean_of(plan.check->read);
  const PlannedLayout& layout = plan.layouts[plan.chosen];
  std::string text = fmt::format(
      "<div class=\"note\"><p><strong>Checked.</strong> In {} with other tags and seeds {:.1f} "
      "tags were {} on average; {:.1f} were forecast, and {} of {} are within the stated range of "
      "{:.0f} to {:.0f}.",
      counted(plan.check->read.size(), "full simulation"), mean, words_for(plan.aim),
      layout.read.mean, plan.check->inside, plan.check->read.size(), std::ceil(layout.read.low),
      std::floor(layout.read.high));
  if (!plan.check->cross.empty()) {
    text += fmt::format(
        " Cross reads, with links as they are: {:.1f} tags on average; {:.1f} were forecast, and "
        "{} of {} are within {:.0f} to {:.0f}.",
        mean_of(plan.check->cross), layout.cross.mean, plan.check->cross_inside,
        plan.check->cross.size(), std::ceil(layout.cross.low), std::floor(layout.cross.high));
  }
  return text + "</p></div>\n";
}

std::string plan_fact(const std::string& name, const std::string& value) {
  return value.empty() ? "" : "<dt>" + escaped(name) + "</dt><dd>" + escaped(value) + "</dd>\n";
}

std::string aim_text(const AntennaPlan& plan) {
  const PlannedAim& aim = plan.aim;
  std::string text;
  if (aim.kind != PlannedAim::Kind::kReadProbability) {
    text = fmt::format("each tag {} in {:g} s", words_for(aim), plan.dwell_s);
  } else if (aim.value < 1.0) {
    text = fmt::format("each tag read with {:g} % in {:g} s", 100.0 * aim.value, plan.dwell_s);
  } else {
    text = fmt::format("most tags read in {:g} s", plan.dwell_s);
  }
  if (aim.share) {
    text += fmt::format(", to {:g} %{}: {}", 100.0 * *aim.share,
                        aim.is_for_least_cost ? " at the least cost" : "",
                        plan.reaches_aim ? "reached" : "not reached");
  }
  return text;
}

/// Explanation of the dots.
std::string dots_text(const PlannedAim& aim) {
  const std::string over = "over orientations and fading, before contention for slots";
  if (aim.kind == PlannedAim::Kind::kReadProbability) {
    return "with the probability that one there is read, " + over;
  }
  std::string text =
      fmt::format("with the share in which one there is {}, {}", words_for(aim), over);
  if (aim.kind == PlannedAim::Kind::kPosition) {
    text +=
        ": by the Cramér-Rao bound of the direct path, which no estimator can beat, and with "
        "reflections hardly any reaches";
  }
  return text;
}

std::string plan_facts(const AntennaPlan& plan) {
  const std::string guaranteed =
      plan.guaranteed
          ? fmt::format(
                "at least {:.0f} % of the best in any case; the table has what holds for this one",
                std::floor(100.0 * *plan.guaranteed))
          : "none beforehand with these limits; the table has what holds for this case";
  return "<dl class=\"facts\">\n" + plan_fact("Aim", aim_text(plan)) +
         plan_fact("Limits", plan.limits) + plan_fact("More is prevented by", plan.stopped_by) +
         plan_fact("Choice",
                   fmt::format("of {} ways to mount an antenna, for {}", grouped(plan.options),
                               counted(plan.places.size(), "position"))) +
         plan_fact("Greedy choice guarantees", guaranteed) + "</dl>\n";
}

}  // namespace

std::string plan_page(const AntennaPlan& plan, const std::vector<Figure>& figures) {
  std::string maps = "<div class=\"figures\">\n";
  for (const Figure& figure : figures) maps += figure_html(figure);
  maps += "</div>\n";
  std::string html =
      page_head(plan.scenario + " – Tagfield plan", {table_script().hash, figure_script().hash,
                                                     link_script().hash, plan_script().hash}) +
      "<body>\n<header>\n<p class=\"kind\">Tagfield plan</p>\n<h1><bdi>" +
      breakable(plan.scenario) + "</bdi></h1>\n";
  if (!plan.description.empty())
    html += "<p class=\"muted\">" + escaped(plan.description) + "</p>\n";
  html += "</header>\n<main>\n" + plan_numbers(plan) + plan_facts(plan) + check_text(plan) +
          warnings_note(plan.warnings, "plan.json") + "<h2>The hall from above</h2>\n" +
          "<p>Each dot is a position where tags can be, " + dots_text(plan.aim) + ".</p>\n" +
          controls(plan) + maps + layouts_table(plan) + zones_of_plan(plan) + antennas_table(plan) +
          hard_table(plan) + sensitivity_table(plan) + "<h2>Tables</h2>\n<p>" +
          data_link("plan_layouts.csv", "layouts", plan_layouts_to_csv(plan)) + " · " +
          data_link("plan_antennas.csv", "antennas", plan_antennas_to_csv(plan)) + " · " +
          data_link("plan_positions.csv", "positions", plan_positions_to_csv(plan)) +
          " (CSV)</p>\n";
  return html +
         "</main>\n<footer>\n<p>Made by Tagfield; the same tables are beside this page, and "
         "layout.yaml is the chosen layout as a scenario.</p>\n</footer>\n" +
         plan_data(plan) + script_html(table_script()) + script_html(figure_script()) +
         script_html(link_script()) + script_html(plan_script()) + "</body>\n</html>\n";
}

}  // namespace tagfield
