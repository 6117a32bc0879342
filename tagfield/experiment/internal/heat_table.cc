// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/heat_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tagfield/experiment/bench/bench_figures.h"
#include "tagfield/experiment/internal/statistics.h"
#include "tagfield/experiment/internal/winner.h"
#include "tagfield/files/csv.h"
#include "tagfield/report/page_text.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxHeatName = 24;

/// A step of the scale, with a contrasting text colour.
struct HeatColor {
  const char* paper;
  const char* ink;
};

/// Even steps of lightness, from small errors to large ones; distinguishable without red and green.
constexpr std::array<HeatColor, 9> kHeat = {{{"#fde725", "#111111"},
                                             {"#addc30", "#111111"},
                                             {"#5ec962", "#111111"},
                                             {"#28ae80", "#111111"},
                                             {"#26a2a0", "#111111"},
                                             {"#2a768e", "#ffffff"},
                                             {"#355f8d", "#ffffff"},
                                             {"#443983", "#ffffff"},
                                             {"#440154", "#ffffff"}}};

/// Range of the mean errors of the whole bench, divided into equal logarithmic steps.
struct HeatScale {
  double low_m = 0.0;
  double high_m = 0.0;
};

HeatScale scale_of_means(const Bench& bench) {
  HeatScale scale;
  for (const BenchEntry& entry : bench.entries) {
    const auto errors = statistics_of(entry).error_m;
    if (!errors) continue;
    const double mean = std::max(errors->mean, 1e-5);
    scale.low_m = scale.low_m > 0.0 ? std::min(scale.low_m, mean) : mean;
    scale.high_m = std::max(scale.high_m, mean);
  }
  return scale;
}

const HeatColor& color_of_mean(const HeatScale& scale, double mean_m) {
  if (!(scale.high_m > scale.low_m)) return kHeat.front();
  const double part =
      std::log(std::max(mean_m, 1e-5) / scale.low_m) / std::log(scale.high_m / scale.low_m);
  const double step = std::clamp(part, 0.0, 1.0) * static_cast<double>(kHeat.size());
  return kHeat[std::min(static_cast<std::size_t>(step), kHeat.size() - 1)];
}

/// Upper edge of a step [m].
double edge_of(const HeatScale& scale, std::size_t step) {
  return scale.low_m * std::pow(scale.high_m / scale.low_m,
                                static_cast<double>(step) / static_cast<double>(kHeat.size()));
}

std::string heat_number(double error_m) {
  const double mm = 1e3 * error_m;
  return fmt::format("{:.{}f}", mm, mm < 99.95 ? 1 : 0);
}

std::string heat_cell(const BenchEntry* entry, const HeatScale& scale, bool is_best) {
  if (entry == nullptr) return "<td class=\"none\" title=\"not run\"></td>";
  const EntryStatistics all = statistics_of(*entry);
  const std::string said =
      fmt::format("{}, {}: {} of {} located, {} over 0.3 m off", clean_text(entry->condition),
                  clean_text(entry->name), all.located, all.tags, all.wrong);
  if (!all.error_m) {
    return fmt::format("<td class=\"none\" title=\"{}\">–</td>", escaped(said));
  }
  const HeatColor& color = color_of_mean(scale, all.error_m->mean);
  const std::string part =
      all.located < all.tags ? fmt::format("<br><small>{}/{}</small>", all.located, all.tags) : "";
  return fmt::format("<td{} style=\"background:{};color:{}\" title=\"{}\">{}{}</td>",
                     is_best ? " class=\"best\"" : "", color.paper, color.ink, escaped(said),
                     heat_number(all.error_m->mean), part);
}

const BenchEntry* entry_named(const std::vector<const BenchEntry*>& entries,
                              const std::string& name) {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const BenchEntry* entry) { return entry->name == name; });
  return found == entries.end() ? nullptr : *found;
}

std::string heat_row(const Bench& bench, const BenchCondition& condition,
                     const std::vector<std::string>& methods, const HeatScale& scale) {
  const std::vector<const BenchEntry*> entries = entries_of(bench, condition.name);
  const std::optional<Winner> winner = winner_of(entries);
  std::string html = fmt::format(
      "<tr><th scope=\"row\" title=\"{}\"><bdi>{}</bdi></th><td class=\"words\">{}</td>",
      escaped(condition.name), escaped(shortened(condition.name, kMaxHeatName)),
      winner ? escaped(shortened(winner->entry->name, kMaxHeatName)) +
                   (winner->alike.empty() ? ""
                                          : fmt::format("<br><small>≈ {}</small>",
                                                        counted(winner->alike.size(), "other")))
             : "none");
  for (const std::string& method : methods) {
    const BenchEntry* const entry = entry_named(entries, method);
    html += heat_cell(entry, scale, winner && entry == winner->entry);
  }
  return html + "</tr>\n";
}

std::string heat_legend(const HeatScale& scale) {
  if (!(scale.high_m > scale.low_m)) return "";
  std::string html = "<p class=\"swatches\"><span>Mean error up to</span>";
  for (std::size_t i = 0; i < kHeat.size(); ++i) {
    html += fmt::format("<span><i style=\"background:{}\"></i>{}</span>", kHeat[i].paper,
                        spoken_length(edge_of(scale, i + 1)));
  }
  return html + "</p>\n";
}

std::string heat_data(const Bench& bench) {
  std::string csv = "condition,method,tags,located,right,mean_error_m,winner\n";
  for (const BenchCondition& condition : bench.conditions) {
    const std::vector<const BenchEntry*> entries = entries_of(bench, condition.name);
    const std::optional<Winner> winner = winner_of(entries);
    for (const BenchEntry* entry : entries) {
      const EntryStatistics all = statistics_of(*entry);
      csv += fmt::format("{},{},{},{},{},{},{}\n", csv_field(condition.name),
                         csv_field(entry->name), all.tags, all.located, count_right(*entry),
                         all.error_m ? fmt::format("{:.6g}", all.error_m->mean) : "",
                         winner && winner->entry == entry ? 1 : 0);
    }
  }
  return csv;
}

}  // namespace

std::string heat_table(const Bench& bench) {
  const std::vector<std::string> methods = method_names(bench);
  const HeatScale scale = scale_of_means(bench);
  std::string html =
      "<div class=\"table heat told\" role=\"region\" aria-label=\"Mean errors by condition and "
      "method\" tabindex=\"0\"><table>\n<thead><tr><th scope=\"col\">Condition</th>"
      "<th scope=\"col\" class=\"words\">Winner</th>";
  for (const std::string& method : methods) {
    html += "<th scope=\"col\"><bdi>" + escaped(shortened(method, kMaxHeatName)) + "</bdi></th>";
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const BenchCondition& condition : bench.conditions) {
    html += heat_row(bench, condition, methods, scale);
  }
  return html + "</tbody></table></div>\n" + heat_legend(scale) +
         "<p class=\"muted\">Mean error of the located tags [mm]; a fraction says how many were, "
         "where not all. The winner has the lowest mean error of the methods that got at least 95 "
         "% "
         "as many tags right (located, within 0.3 m) as the best; ≈ counts the others whose errors "
         "don’t differ significantly from it; the folds below name them. " +
         data_link("heatmap.csv", "Data as CSV", heat_data(bench)) + "</p>\n";
}

std::string winner_words(const Bench& bench, const BenchCondition& condition) {
  const std::optional<Winner> winner = winner_of(entries_of(bench, condition.name));
  if (!winner) return "none: no tag was located correctly";
  std::string words = clean_text(winner->entry->name);
  const auto errors = statistics_of(*winner->entry).error_m;
  if (errors) words += ", " + spoken_length(errors->mean);
  std::string alike;
  for (const BenchEntry* entry : winner->alike) {
    alike += (alike.empty() ? "" : ", ") + clean_text(entry->name);
  }
  return alike.empty() ? words : words + "; not significantly different from it: " + alike;
}

}  // namespace tagfield
