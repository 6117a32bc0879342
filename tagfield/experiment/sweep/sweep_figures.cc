// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/sweep/sweep_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "tagfield/base/number.h"
#include "tagfield/experiment/internal/panels.h"
#include "tagfield/experiment/sweep/design.h"
#include "tagfield/files/csv.h"
#include "tagfield/report/style_sheet.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxPanels = 24;
constexpr std::size_t kMaxGridKeys = 3;
constexpr std::size_t kMaxTitle = 30;
constexpr double kLogarithmicOver = 10.0;  // Ratio of the largest to the smallest value.
constexpr double kMinShown_mm = 0.01;
constexpr double kNinetyFivePercent = 1.96;

/// A value of a row, with its error bar.
struct Measured {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// The quantity on the vertical axis.
struct Metric {
  std::string name;
  std::string title;
  std::string axis;
  std::string caption;
  bool logarithmic = false;
  std::function<std::optional<Measured>(const SweepRow&)> of;
};

std::optional<Measured> mean_error_mm(const SweepRow& row) {
  if (!row.error_m) return std::nullopt;
  const double mean = std::max(1e3 * row.error_m->mean, kMinShown_mm);
  const double half = 1e3 * kNinetyFivePercent * row.mean_standard_error_m.value_or(0.0);
  return Measured{mean, std::max(mean - half, kMinShown_mm), mean + half};
}

std::optional<Measured> located_percent(const SweepRow& row) {
  const std::optional<double> share = located_share(row);
  if (!share) return std::nullopt;
  return Measured{100.0 * *share, 100.0 * *share, 100.0 * *share};
}

std::vector<Metric> metrics() {
  return {
      {"mean_error", "Mean error", "mean error [mm]",
       "Horizontal errors of the tags that were located, in the mean over all seeds. Bars: 95 % "
       "by the standard error over seeds.",
       true, mean_error_mm},
      {"located", "Tags located", "tags located [%]",
       "The share of all tags that were located; the rest was ambiguous or not located.", false,
       located_percent}};
}

/// Distinct values of a key, in order of first occurrence.
std::vector<std::string> values_of_key(const SweepPlan& plan, const std::string& key) {
  std::vector<std::string> values;
  std::set<std::string> seen;
  for (const SweepPoint& point : plan.points) {
    const std::string value = value_at(point, key);
    if (seen.insert(value).second) values.push_back(value);
  }
  return values;
}

bool all_numbers(const std::vector<std::string>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](const std::string& value) { return parse_number(value).has_value(); });
}

/// The horizontal axis for a key: its values as numbers, or side by side as categories.
struct KeyAxis {
  std::vector<std::string> values;
  bool numeric = false;

  [[nodiscard]] double place(const std::string& value) const {
    if (numeric) return *parse_number(value);
    return static_cast<double>(std::find(values.begin(), values.end(), value) - values.begin());
  }
};

KeyAxis key_axis(const SweepPlan& plan, const std::string& key) {
  KeyAxis axis;
  axis.values = values_of_key(plan, key);
  axis.numeric = axis.values.size() > 1 && all_numbers(axis.values);
  return axis;
}

Scale number_scale(const KeyAxis& axis) {
  double low = axis.place(axis.values.front());
  double high = low;
  for (const std::string& value : axis.values) {
    low = std::min(low, axis.place(value));
    high = std::max(high, axis.place(value));
  }
  if (low > 0.0 && high / low > kLogarithmicOver) return logarithmic_scale(low, high);
  return round_scale(low, high, 3);
}

std::vector<std::string> category_names(const std::vector<std::string>& values,
                                        std::size_t panels) {
  const std::size_t most = max_category_name(values.size(), panels);
  const bool fit = std::all_of(values.begin(), values.end(),
                               [&](const std::string& value) { return length_of(value) <= most; });
  std::vector<std::string> names;
  for (std::size_t i = 0; i < values.size(); ++i) {
    // Names that don't fit are replaced by numbers, which the caption explains.
    const bool shown = fit || i % (values.size() / 12 + 1) == 0;
    names.push_back(!shown ? "" : fit ? values[i] : fmt::format("{}", i + 1));
  }
  return names;
}

PanelForm form_of(const KeyAxis& axis, std::size_t panels) {
  PanelForm form;
  if (axis.numeric) {
    form.x = number_scale(axis);
  } else {
    form.x.low = -0.5;
    form.x.high = static_cast<double>(axis.values.size()) - 0.5;
    form.categories = category_names(axis.values, panels);
  }
  return form;
}

/// Caption for numbered categories.
std::string numbers_text(const KeyAxis& axis, const PanelForm& form) {
  if (form.categories.empty() || form.categories == axis.values) return "";
  std::string text;
  for (std::size_t i = 0; i < std::min(axis.values.size(), kMaxPanels); ++i) {
    text += fmt::format("{}{}: {}", i == 0 ? " " : ", ", i + 1, shortened(axis.values[i], 40));
  }
  return text + (axis.values.size() > kMaxPanels ? ", …" : "");
}

std::size_t series_of_row(const SweepResults& results, const SweepRow& row) {
  const std::vector<SuiteMethod>& methods = results.plan.suite.methods;
  const auto found = std::find_if(methods.begin(), methods.end(), [&](const SuiteMethod& method) {
    return method.name == row.name;
  });
  return static_cast<std::size_t>(found - methods.begin());
}

PanelMark mark_of_row(const SweepResults& results, const SweepRow& row, const Metric& metric,
                      const Measured& measured, double x) {
  return {series_of_row(results, row),
          x,
          measured.value,
          measured.low,
          measured.high,
          fmt::format("{}, {}: {} {:.3g}", results.plan.points[row.point].name, row.name,
                      metric.axis, measured.value)};
}

void sort_marks(std::vector<Panel>& panels) {
  for (Panel& panel : panels) {
    std::stable_sort(panel.marks.begin(), panel.marks.end(),
                     [](const PanelMark& a, const PanelMark& b) {
                       return std::pair(a.series, a.x) < std::pair(b.series, b.x);
                     });
  }
}

std::string title_of_others(const SweepResults& results, const SweepPoint& point,
                            const std::string& x_key) {
  std::string title;
  const auto add = [&](const std::string& part) { title += (title.empty() ? "" : ", ") + part; };
  const std::vector<Condition>& conditions = results.plan.suite.conditions;
  if (conditions.size() > 1) add(conditions[point.condition].name);
  for (const std::string& key : results.plan.keys) {
    // The last word of a key is enough to identify its value.
    if (key != x_key) add(key.substr(key.rfind('.') + 1) + " " + value_at(point, key));
  }
  return title;
}

/// The numeric key with the most values, or else any key with the most.
std::string key_to_the_right(const SweepPlan& plan) {
  std::string best;
  std::pair<bool, std::size_t> most{false, 0};
  for (const std::string& key : plan.keys) {
    const KeyAxis axis = key_axis(plan, key);
    const std::pair<bool, std::size_t> size{axis.numeric, axis.values.size()};
    if (best.empty() || size > most) {
      best = key;
      most = size;
    }
  }
  return best;
}

/// Panels, their formats, and the caption.
struct Multiples {
  std::vector<Panel> panels;
  std::vector<PanelForm> forms;
  std::string caption;
};

Multiples panels_of_grid(const SweepResults& results, const Metric& metric) {
  Multiples all;
  const std::string x_key = key_to_the_right(results.plan);
  const KeyAxis axis = key_axis(results.plan, x_key);
  std::map<std::string, std::size_t> places;
  for (const SweepRow& row : results.rows) {
    const SweepPoint& point = results.plan.points[row.point];
    const std::string title = title_of_others(results, point, x_key);
    const auto [found, is_new] = places.emplace(title, all.panels.size());
    if (is_new) all.panels.push_back({title, {}});
    if (const auto measured = metric.of(row)) {
      all.panels[found->second].marks.push_back(
          mark_of_row(results, row, metric, *measured, axis.place(value_at(point, x_key))));
    }
  }
  if (all.panels.size() > kMaxPanels) {
    all.caption = fmt::format(" The first {} of {} panels.", kMaxPanels, all.panels.size());
    all.panels.resize(kMaxPanels);
  }
  PanelForm form = form_of(axis, all.panels.size());
  form.x_title = x_key;
  form.connected = axis.numeric;
  all.caption += numbers_text(axis, form);
  all.forms.push_back(std::move(form));
  return all;
}

Multiples panels_by_key(const SweepResults& results, const Metric& metric) {
  Multiples all;
  const std::size_t step = thinning(results.rows.size(), kMaxMarks);
  if (step > 1) all.caption = fmt::format(" One in {} of the points is drawn.", step);
  for (const std::string& key : results.plan.keys) {
    if (all.panels.size() == kMaxPanels) break;
    const KeyAxis axis = key_axis(results.plan, key);
    Panel panel{key, {}};
    for (std::size_t i = 0; i < results.rows.size(); i += step) {
      const SweepRow& row = results.rows[i];
      const auto measured = metric.of(row);
      if (!measured) continue;
      panel.marks.push_back(mark_of_row(results, row, metric, {measured->value, 0.0, 0.0},
                                        axis.place(value_at(results.plan.points[row.point], key))));
    }
    all.panels.push_back(std::move(panel));
    all.forms.push_back(form_of(axis, results.plan.keys.size()));
    const std::string numbers = numbers_text(axis, all.forms.back());
    if (!numbers.empty()) all.caption += fmt::format(" {}:{}.", key, numbers);
  }
  return all;
}

/// For a suite without a section `sweep`.
Multiples panel_of_conditions(const SweepResults& results, const Metric& metric) {
  Multiples all;
  KeyAxis axis;
  for (const Condition& condition : results.plan.suite.conditions) {
    axis.values.push_back(condition.name);
  }
  Panel panel;
  for (const SweepRow& row : results.rows) {
    if (const auto measured = metric.of(row)) {
      panel.marks.push_back(
          mark_of_row(results, row, metric, *measured, static_cast<double>(row.point)));
    }
  }
  all.panels.push_back(std::move(panel));
  all.forms.push_back(form_of(axis, 1));
  all.forms.back().x_title = "condition";
  all.caption = numbers_text(axis, all.forms.back());
  return all;
}

Multiples multiples_of(const SweepResults& results, const Metric& metric) {
  const SweepPlan& plan = results.plan;
  if (plan.keys.empty()) return panel_of_conditions(results, metric);
  const bool grid = std::holds_alternative<GridDesign>(plan.suite.sweep->points);
  if (grid && plan.keys.size() <= kMaxGridKeys) return panels_of_grid(results, metric);
  return panels_by_key(results, metric);
}

/// The common vertical scale; none if there is nothing to draw.
std::optional<Scale> scale_upwards(const Metric& metric, const std::vector<Panel>& panels) {
  std::optional<std::pair<double, double>> range;
  for (const Panel& panel : panels) {
    for (const PanelMark& mark : panel.marks) {
      const bool barred = mark.high > mark.low;
      const double low = barred ? mark.low : mark.y;
      const double high = barred ? mark.high : mark.y;
      if (!range) range = {low, high};
      range = {std::min(range->first, low), std::max(range->second, high)};
    }
  }
  if (!range) return std::nullopt;
  if (metric.logarithmic) return logarithmic_scale(range->first, range->second);
  return round_scale(0.0, 100.0, 4);
}

std::vector<LegendEntry> legend_of_methods(const SweepResults& results) {
  std::vector<LegendEntry> legend;
  for (const SuiteMethod& method : results.plan.suite.methods) {
    legend.push_back({Symbol::kSquare, fmt::format("dot{}", legend.size() % kSeriesColors),
                      shortened(method.name, kMaxTitle)});
  }
  return legend;
}

std::string data_of_panels(const std::vector<Panel>& panels,
                           const std::vector<LegendEntry>& legend) {
  std::string csv = "panel,method,x,y,low,high\n";
  for (const Panel& panel : panels) {
    for (const PanelMark& mark : panel.marks) {
      const std::string method = mark.series < legend.size() ? legend[mark.series].text : "";
      csv += fmt::format("{},{},{:.6g},{:.6g},{:.6g},{:.6g}\n", csv_field(panel.title),
                         csv_field(method), mark.x, mark.y, mark.low, mark.high);
    }
  }
  return csv;
}

Figure figure_of(const SweepResults& results, const Metric& metric) {
  Figure figure{metric.name, "", metric.title, metric.caption, {}, ""};
  Multiples all = multiples_of(results, metric);
  const std::optional<Scale> upwards = scale_upwards(metric, all.panels);
  if (!upwards) {
    figure.missing = "no run has come to a result yet.";
    return figure;
  }
  sort_marks(all.panels);
  for (PanelForm& form : all.forms) {
    form.y = *upwards;
    form.y_title = metric.axis + (metric.logarithmic ? ", logarithmic" : "");
  }
  for (Panel& panel : all.panels) panel.title = shortened(panel.title, kMaxTitle);
  const double top = draw_legend(figure.svg, legend_of_methods(results)) + 4.0;
  draw_panels(figure.svg, all.panels, all.forms, top);
  figure.data = data_of_panels(all.panels, legend_of_methods(results));
  figure.caption += all.caption;
  return figure;
}

}  // namespace

std::vector<Figure> sweep_figures(const SweepResults& results) {
  std::vector<Figure> figures;
  for (const Metric& metric : metrics()) figures.push_back(figure_of(results, metric));
  return figures;
}

}  // namespace tagfield
