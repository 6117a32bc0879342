// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "tagfield/report/axes.h"
#include "tagfield/report/figures.h"
#include "tagfield/report/internal/error_rows.h"
#include "tagfield/report/internal/figure_data.h"

namespace tagfield {
namespace {

constexpr double kLeast = 0.01;      ///< [mm] Smaller values are drawn here.
constexpr double kFarOff = 300.0;    ///< [mm]
constexpr std::size_t kSteps = 400;  ///< Of the curve.

Axes distribution_axes(double low_mm, double high_mm) {
  Axes axes{logarithmic_scale(std::max(low_mm, kLeast), std::max(high_mm, kFarOff)),
            round_scale(0.0, 100.0, 5)};
  axes.x.from = 52.0;
  axes.x.to = kDrawingWidth - 24.0;
  axes.y.from = 310.0;
  axes.y.to = 34.0;
  return axes;
}

/// Cumulative share of errors as a step function.
std::vector<Place> curve_of(const Axes& axes, const std::vector<double>& errors_m) {
  std::vector<Place> places = {{place_on(axes.x, 1e3 * errors_m.front()), axes.y.from}};
  const std::size_t step = thinning(errors_m.size(), kSteps);
  const auto add = [&](std::size_t i) {
    const double share = 100.0 * static_cast<double>(i + 1) / static_cast<double>(errors_m.size());
    const Place place = place_in(axes, 1e3 * errors_m[i], share);
    places.emplace_back(place.x(), places.back().y());
    places.push_back(place);
  };
  for (std::size_t i = step - 1; i < errors_m.size(); i += step) add(i);
  add(errors_m.size() - 1);
  places.emplace_back(axes.x.to, axes.y.to);
  return places;
}

/// A vertical line at an error, with its text to the right, where the curve can't be.
void draw_mark(Svg& svg, const Axes& axes, double error_mm, const std::string& text, double y) {
  const double x = place_on(axes.x, error_mm);
  const bool fits = x + 6.0 + text_width(text) < kDrawingWidth;
  add_line(svg, {x, axes.y.to}, {x, axes.y.from}, styled("rule"));
  add_rimmed_text(svg, {x + (fits ? 6.0 : -6.0), y}, text, fits ? Anchor::kStart : Anchor::kEnd);
}

}  // namespace

Figure distribution_figure(const RunFiles& run) {
  Figure figure{"fig10_distribution", "with Fig. 10", "Distribution of all errors", "", {}, ""};
  const std::vector<double> errors = all_errors(run.summary);
  const auto numbers = statistics(errors);
  if (!numbers) {
    figure.missing = "no tag with a known true position was located.";
    return figure;
  }
  const Axes axes = distribution_axes(1e3 * numbers->min, 1e3 * numbers->max);
  Svg& svg = figure.svg;
  svg.height = 358.0;
  draw_axes(svg, axes, "error [mm], logarithmic", "share of errors [%]");
  add_polyline(svg, curve_of(axes, errors), styled("curve"));
  draw_mark(svg, axes, kFarOff, "0.3 m", 150.0);
  draw_mark(svg, axes, 1e3 * numbers->p95, "95 % " + spoken_length(numbers->p95), 240.0);
  draw_mark(svg, axes, 1e3 * numbers->mean, "mean " + spoken_length(numbers->mean), 290.0);
  figure.data = "error_mm,share\n";
  const std::size_t step = thinning(errors.size(), kSteps);
  for (std::size_t i = step - 1; i < errors.size(); i += step) {
    add_data(figure.data, 1e3 * errors[i],
             static_cast<double>(i + 1) / static_cast<double>(errors.size()));
  }
  const std::size_t over = count_over(run.summary, 1e-3 * kFarOff);
  figure.caption = fmt::format(
      "Share of the {} that are no greater than the value below. Marked are the mean, the 95th"
      " percentile, and 0.3 m, beyond which {}.",
      counted(errors.size(), "error"),
      over == 0 ? "there is none"
                : fmt::format("there {} {}", over == 1 ? "is" : "are", grouped(over)));
  return figure;
}

}  // namespace tagfield
