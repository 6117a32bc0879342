// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/report/axes.h"
#include "tagfield/report/figures.h"
#include "tagfield/report/internal/error_rows.h"
#include "tagfield/report/internal/figure_data.h"

namespace tagfield {
namespace {

constexpr double kTagNameWidth = 122.0;
constexpr double kErrorTop = 30.0;
constexpr double kBottom = 48.0;
constexpr double kValueRoom = 46.0;
constexpr double kGreatSpread = 12.0;  ///< Ratio of the largest error to the median.
constexpr double kMinError = 0.01;     ///< [mm] Smaller values are drawn here.
constexpr std::size_t kMaxSpots = 60;  ///< Of one row.

std::string millimetres(double error_m) {
  return fmt::format("{:.{}f}", error_m * 1e3, error_m < 0.00995 ? 1 : 0);
}

/// Whether a few errors are so large that they would squeeze the others on a linear axis.
bool is_spread(const ErrorStatistics& errors) {
  return errors.max > kGreatSpread * errors.median && errors.median > 0.0;
}

/// Logarithmic for several seeds with far outliers; linear for bars, which need a zero.
Axes row_axes(const ErrorStatistics& errors, std::size_t rows, bool several) {
  Axes axes;
  axes.x = several && is_spread(errors)
               ? logarithmic_scale(std::max(1e3 * errors.min, kMinError), 1e3 * errors.max)
               : round_scale(0.0, 1e3 * errors.max, 5);
  axes.x.from = kTagNameWidth;
  axes.x.to = kDrawingWidth - kValueRoom;
  axes.y.to = kErrorTop;
  axes.y.from = kErrorTop + row_height(rows) * static_cast<double>(rows) + 4.0;
  return axes;
}

double row_center(std::size_t row, std::size_t rows) {
  return kErrorTop + row_height(rows) * (static_cast<double>(row) + 0.5) + 2.0;
}

void draw_name(Svg& svg, const std::string& tag, double y) {
  add_text(svg, {kTagNameWidth - 10.0, y + 5.0}, shortened(tag, 10), Anchor::kEnd);
}

void draw_bar(Svg& svg, const Axes& axes, const TagRow& row, double y) {
  if (row.errors_m.empty()) {
    add_text(svg, {axes.x.from + 8.0, y + 5.0}, outcome_words(*row.outcomes.front()),
             Anchor::kStart, "faint");
    return;
  }
  const double error = row.errors_m.front();
  const double end = place_on(axes.x, 1e3 * error);
  add_rectangle(svg, {axes.x.from, y - 8.5}, {std::max(end - axes.x.from, 1.0), 17.0},
                styled("bar"), fmt::format("{}: {}", clean_text(row.tag), spoken_length(error)));
  add_rimmed_text(svg, {end + 7.0, y + 5.0}, millimetres(error), Anchor::kStart);
}

/// Whiskers from minimum to maximum, box over the middle half, line at the median.
void draw_box(Svg& svg, const Axes& axes, const TagRow& row, double y) {
  const std::vector<double>& errors = row.errors_m;
  const auto at = [&](double fraction) {
    const double rank = fraction * static_cast<double>(errors.size() - 1);
    return place_on(axes.x, 1e3 * errors[static_cast<std::size_t>(std::lround(rank))]);
  };
  add_line(svg, {at(0.0), y}, {at(1.0), y}, styled("whisker"));
  add_rectangle(
      svg, {at(0.25), y - 8.5}, {std::max(at(0.75) - at(0.25), 1.0), 17.0}, styled("box"),
      fmt::format("{}: median {}, greatest {}", clean_text(row.tag),
                  spoken_length(errors[errors.size() / 2]), spoken_length(errors.back())));
  const std::size_t step = thinning(errors.size(), kMaxSpots);
  for (std::size_t i = 0; i < errors.size(); i += step) {
    add_circle(svg, {place_on(axes.x, 1e3 * errors[i]), y}, 2.5, styled("spot"));
  }
  add_line(svg, {at(0.5), y - 9.0}, {at(0.5), y + 9.0}, styled("path"));
}

void draw_row(Svg& svg, const Axes& axes, const TagRow& row, double y, bool several) {
  draw_name(svg, row.tag, y);
  if (!several || row.errors_m.empty()) {
    draw_bar(svg, axes, row, y);
    return;
  }
  draw_box(svg, axes, row, y);
  if (row.errors_m.size() < row.outcomes.size()) {
    add_text(svg, {kDrawingWidth - 2.0, y + 5.0},
             fmt::format("{}/{}", row.errors_m.size(), row.outcomes.size()), Anchor::kEnd, "faint");
  }
}

void draw_mean(Svg& svg, const Axes& axes, double mean_m) {
  const double x = place_on(axes.x, 1e3 * mean_m);
  add_line(svg, {x, axes.y.to}, {x, axes.y.from}, styled("rule"));
  add_rimmed_text(svg, {x, axes.y.to - 8.0}, "mean " + spoken_length(mean_m),
                  x > 0.5 * (axes.x.from + axes.x.to) ? Anchor::kEnd : Anchor::kStart);
}

void draw_rows(Figure& figure, const std::vector<TagRow>& rows, const ErrorStatistics& errors,
               std::size_t seeds) {
  const Axes axes = row_axes(errors, rows.size(), seeds > 1);
  figure.svg.height = axes.y.from + kBottom;
  draw_x_axis(figure.svg, axes, axes.x.logarithmic ? "error [mm], logarithmic" : "error [mm]");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    draw_row(figure.svg, axes, rows[i], row_center(i, rows.size()), seeds > 1);
  }
  draw_mean(figure.svg, axes, errors.mean);
  figure.data = "tag,seed,error_mm\n";
  for (const TagRow& row : rows) {
    for (const TagOutcome* outcome : row.outcomes) {
      const auto error = error_of(*outcome);
      add_data(figure.data, row.tag, std::to_string(outcome->seed),
               error ? std::optional(1e3 * *error) : std::nullopt);
    }
  }
  figure.caption = "Distance between the estimated and the true position of each tag.";
  if (seeds > 1) {
    figure.caption += fmt::format(
        " Over {} seeds: every error is a dot, the box holds the middle half, its line is the "
        "median, the whiskers reach to the minimum and the maximum; a fraction at the right says "
        "in "
        "how many seeds the tag was located.",
        seeds);
  }
}

/// Bounds of the histogram's classes, each 10^(1/8) times the previous one.
std::vector<double> class_bounds(double low, double high) {
  constexpr double kPerDecade = 8.0;
  std::vector<double> bounds;
  double step = std::floor(std::log10(low) * kPerDecade);
  do {
    bounds.push_back(std::pow(10.0, step / kPerDecade));
    ++step;
  } while (bounds.back() <= high);
  return bounds;
}

void draw_histogram(Figure& figure, std::vector<double> errors) {
  for (double& error : errors) error = std::max(1e3 * error, kMinError);
  const std::vector<double> bounds = class_bounds(errors.front(), errors.back());
  std::vector<std::size_t> counts(bounds.size() - 1);
  for (const double error : errors) {
    const auto above = std::upper_bound(bounds.begin() + 1, bounds.end() - 1, error);
    ++counts[static_cast<std::size_t>(above - bounds.begin()) - 1];
  }
  const auto most = static_cast<double>(*std::max_element(counts.begin(), counts.end()));
  Axes axes{logarithmic_scale(bounds.front(), bounds.back()), round_scale(0.0, most, 5)};
  axes.x.from = 52.0;
  axes.x.to = kDrawingWidth - 24.0;
  axes.y.from = 310.0;
  axes.y.to = 34.0;
  figure.svg.height = 358.0;
  draw_axes(figure.svg, axes, "error [mm], logarithmic", "number of errors");
  figure.data = "from_mm,to_mm,errors\n";
  for (std::size_t i = 0; i < counts.size(); ++i) {
    add_data(figure.data, bounds[i], bounds[i + 1], counts[i]);
    if (counts[i] == 0) continue;
    const Place low = place_in(axes, bounds[i], 0.0);
    const Place high = place_in(axes, bounds[i + 1], static_cast<double>(counts[i]));
    add_rectangle(figure.svg, {low.x() + 0.5, high.y()},
                  {high.x() - low.x() - 1.0, low.y() - high.y()}, styled("bar"),
                  fmt::format("{:.2g} to {:.2g} mm: {}", bounds[i], bounds[i + 1],
                              counted(counts[i], "error")));
  }
}

}  // namespace

Figure error_figure(const RunFiles& run) {
  Figure figure{"fig10_errors", "Fig. 10", "Error of each tag", "", {}, ""};
  const auto errors = error_statistics(run.summary);
  if (!errors) {
    figure.missing = "no tag with a known true position was located.";
    return figure;
  }
  const std::vector<TagRow> rows = rows_by_tag(run.summary);
  if (rows.size() <= kMaxRows) {
    draw_rows(figure, rows, *errors, run.summary.seeds.size());
    return figure;
  }
  figure.title = "Errors of the tags";
  draw_histogram(figure, all_errors(run.summary));
  figure.caption = fmt::format(
      "How often errors of each size occur. With {} tags, too many for a bar each, they are "
      "counted in eight classes per decade; errors below 0.01 mm count as that.",
      grouped(rows.size()));
  return figure;
}

}  // namespace tagfield
