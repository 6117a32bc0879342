// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/bench/bench_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "tagfield/experiment/internal/series.h"
#include "tagfield/experiment/internal/statistics.h"
#include "tagfield/files/csv.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

constexpr double kLeast_mm = 0.1;
constexpr std::size_t kSteps = 300;  ///< Of a curve.
constexpr double kBottom = 48.0;

double millimetres(double metres) { return std::max(1e3 * metres, kLeast_mm); }

/// A logarithmic axis over these values; from 1 to 10 if there are none.
Scale scale_over(const std::vector<double>& values) {
  if (values.empty()) return logarithmic_scale(1.0, 10.0);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return logarithmic_scale(std::max(*low, 1e-9), std::max(*high, 1e-9));
}

/// The plot's frame below a legend.
Axes frame(Scale x, Scale y, double top) {
  Axes axes{std::move(x), std::move(y)};
  axes.x.from = 58.0;
  axes.x.to = kDrawingWidth - 24.0;
  axes.y.to = top + 30.0;
  axes.y.from = axes.y.to + 270.0;
  return axes;
}

std::size_t count_tags(const BenchEntry& entry) {
  std::size_t count = 0;
  for (const MethodRun& run : entry.runs) count += run.tags.size();
  return count;
}

/// Cumulative share of the `tags` over the error, as a step function.
std::vector<Place> curve_of(const Axes& axes, const std::vector<double>& errors_m,
                            std::size_t tags) {
  std::vector<Place> places = {{place_on(axes.x, millimetres(errors_m.front())), axes.y.from}};
  const std::size_t step = thinning(errors_m.size(), kSteps);
  const auto add = [&](std::size_t i) {
    const double share = 100.0 * static_cast<double>(i + 1) / static_cast<double>(tags);
    const Place place = place_in(axes, millimetres(errors_m[i]), share);
    places.emplace_back(place.x(), places.back().y());
    places.push_back(place);
  };
  for (std::size_t i = step - 1; i < errors_m.size(); i += step) add(i);
  add(errors_m.size() - 1);
  places.emplace_back(axes.x.to, places.back().y());
  return places;
}

std::vector<std::string> names_of(const std::vector<const BenchEntry*>& entries) {
  std::vector<std::string> names;
  names.reserve(entries.size());
  for (const BenchEntry* entry : entries) names.push_back(entry->name);
  return names;
}

/// One group per condition that has any marks.
std::vector<MarkGroup> groups_of(
    const Bench& bench,
    const std::function<std::optional<RowMark>(const BenchEntry& entry)>& mark_of) {
  std::vector<MarkGroup> groups;
  for (const BenchCondition& condition : bench.conditions) {
    MarkGroup group{condition.name, {}};
    for (const BenchEntry* entry : entries_of(bench, condition.name)) {
      if (auto mark = mark_of(*entry)) group.marks.push_back(std::move(*mark));
    }
    if (!group.marks.empty()) groups.push_back(std::move(group));
  }
  return groups;
}

std::optional<RowMark> ratio_mark(const BenchEntry& entry) {
  const EntryStatistics all = statistics_of(entry);
  if (!all.ratio) return std::nullopt;
  return RowMark{&entry, all.ratio->mean,
                 fmt::format("{}, {}: {:.2f} times the {} bound", entry.condition, entry.name,
                             all.ratio->mean, all.bound),
                 0.0, 0.0};
}

std::optional<RowMark> nees_mark(const BenchEntry& entry) {
  const auto nees = statistics_of(entry).nees;
  if (!nees) return std::nullopt;
  return RowMark{&entry, nees->mean / nees->expected,
                 fmt::format("{}, {}: {:.2f}, {}", entry.condition, entry.name,
                             nees->mean / nees->expected, to_string(nees->consistency)),
                 nees->band.low / nees->expected, nees->band.high / nees->expected};
}

/// An entry with its time and error.
struct Cost {
  const BenchEntry* entry = nullptr;
  double time_ms = 0.0;
  double error_mm = 0.0;
};

std::vector<Cost> costs_of(const Bench& bench) {
  std::vector<Cost> costs;
  for (const BenchEntry& entry : bench.entries) {
    const EntryStatistics all = statistics_of(entry);
    if (!all.error_m || !all.time_per_tag_ms) continue;
    costs.push_back({&entry, std::max(*all.time_per_tag_ms, 1e-3), millimetres(all.error_m->mean)});
  }
  return costs;
}

std::string errors_data(const std::vector<const BenchEntry*>& entries) {
  std::string csv = "method,error_m,share\n";
  for (const BenchEntry* entry : entries) {
    const std::vector<double> errors = errors_of(*entry);
    const auto tags = static_cast<double>(count_tags(*entry));
    const std::size_t step = thinning(errors.size(), kSteps);
    for (std::size_t i = step - 1; i < errors.size(); i += step) {
      csv += fmt::format("{},{:.6g},{:.6g}\n", csv_field(entry->name), errors[i],
                         static_cast<double>(i + 1) / tags);
    }
  }
  return csv;
}

std::string groups_data(const std::vector<MarkGroup>& groups, bool bands) {
  std::string csv;
  for (const MarkGroup& group : groups) {
    for (const RowMark& mark : group.marks) {
      csv += fmt::format("{},{},{:.6g}", csv_field(group.condition), csv_field(mark.entry->name),
                         mark.value);
      csv += bands ? fmt::format(",{:.6g},{:.6g}\n", mark.band_low, mark.band_high) : "\n";
    }
  }
  return csv;
}

}  // namespace

std::vector<std::string> method_names(const Bench& bench) {
  std::vector<std::string> names;
  for (const BenchEntry& entry : bench.entries) {
    if (std::find(names.begin(), names.end(), entry.name) == names.end()) {
      names.push_back(entry.name);
    }
  }
  return names;
}

Figure errors_figure(const Bench& bench, std::size_t condition) {
  const BenchCondition& of = bench.conditions[condition];
  Figure figure{fmt::format("errors_{}", condition + 1), "", of.name, "", {}, ""};
  const std::vector<const BenchEntry*> entries = entries_of(bench, of.name);
  std::vector<double> all_mm;
  for (const BenchEntry* entry : entries) {
    for (const double error : errors_of(*entry)) all_mm.push_back(millimetres(error));
  }
  if (all_mm.empty()) {
    figure.missing = "no tag with a known true position was located.";
    return figure;
  }
  Svg& svg = figure.svg;
  const double top = draw_legend(svg, legend_of(bench, names_of(entries), Symbol::kLine));
  const Axes axes = frame(scale_over(all_mm), round_scale(0.0, 100.0, 5), top);
  svg.height = axes.y.from + kBottom;
  draw_axes(svg, axes, "horizontal error [mm], logarithmic", "share of all tags [%]");
  for (const BenchEntry* entry : entries) {
    const std::vector<double> errors = errors_of(*entry);
    if (errors.empty()) continue;
    add_polyline(svg, curve_of(axes, errors, count_tags(*entry)),
                 styled(series_of(bench, entry->name).line));
  }
  figure.data = errors_data(entries);
  figure.caption = counted(count_tags(*entries.front()), "tag") + " for each method.";
  return figure;
}

Figure ratio_figure(const Bench& bench) {
  Figure figure{"ratio_to_bound", "", "Mean error over the bound’s", "", {}, ""};
  const std::vector<MarkGroup> groups = groups_of(bench, ratio_mark);
  if (groups.empty()) {
    figure.missing = "no condition has a bound.";
    return figure;
  }
  draw_groups(figure.svg, bench, groups, "mean error / expected at the bound");
  figure.data = "condition,method,mean_error_over_bound\n" + groups_data(groups, false);
  figure.caption =
      "1 is what an unbiased estimator can reach at best from these reads: each tag by itself, or, "
      "for methods that locate all tags together, all of them with the pose error.";
  return figure;
}

Figure nees_figure(const Bench& bench) {
  Figure figure{"nees", "", "Are stated covariances right? (NEES)", "", {}, ""};
  const std::vector<MarkGroup> groups = groups_of(bench, nees_mark);
  if (groups.empty()) {
    figure.missing = "no method states a covariance.";
    return figure;
  }
  draw_groups(figure.svg, bench, groups, "mean NEES / degrees of freedom");
  figure.data = "condition,method,nees_over_dof,band_low,band_high\n" + groups_data(groups, true);
  figure.caption =
      "Squared errors over the covariances that the methods state. 1 is right; within the grey "
      "band, chance explains the rest (95 %). Right of it a method is overconfident (too bold), "
      "left of it conservative (too cautious).";
  return figure;
}

Figure time_figure(const Bench& bench) {
  Figure figure{"time", "", "Error against time", "", {}, ""};
  const std::vector<Cost> costs = costs_of(bench);
  if (costs.empty()) {
    figure.missing = "no tag was located.";
    return figure;
  }
  std::vector<double> times;
  std::vector<double> errors;
  for (const Cost& cost : costs) {
    times.push_back(cost.time_ms);
    errors.push_back(cost.error_mm);
  }
  Svg& svg = figure.svg;
  const double top = draw_legend(svg, legend_of(bench, method_names(bench), Symbol::kSquare));
  const Axes axes = frame(scale_over(times), scale_over(errors), top);
  svg.height = axes.y.from + kBottom;
  draw_axes(svg, axes, "time for each tag [ms]", "mean error [mm]");
  for (const Cost& cost : costs) {
    add_circle(svg, place_in(axes, cost.time_ms, cost.error_mm), 5.0,
               styled(series_of(bench, cost.entry->name).dot),
               fmt::format("{}, {}: {:.1f} mm, {:.2f} ms", cost.entry->condition, cost.entry->name,
                           cost.error_mm, cost.time_ms));
  }
  figure.data = "condition,method,time_per_tag_ms,mean_error_mm\n";
  for (const Cost& cost : costs) {
    figure.data += fmt::format("{},{},{:.6g},{:.6g}\n", csv_field(cost.entry->condition),
                               csv_field(cost.entry->name), cost.time_ms, cost.error_mm);
  }
  figure.caption =
      "A dot for each condition and method: median over the runs of a method’s time for each tag, "
      "on "
      "one thread, while other runs share the machine.";
  return figure;
}

std::vector<Figure> bench_figures(const Bench& bench, Timing timing) {
  std::vector<Figure> figures = {ratio_figure(bench), nees_figure(bench)};
  if (timing == Timing::kWithTimes) figures.push_back(time_figure(bench));
  for (std::size_t i = 0; i < bench.conditions.size(); ++i) {
    figures.push_back(errors_figure(bench, i));
  }
  return figures;
}

}  // namespace tagfield
