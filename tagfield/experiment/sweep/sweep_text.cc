// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/sweep/sweep_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "tagfield/experiment/internal/sweep_target.h"
#include "tagfield/experiment/sweep/design.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxTextRows = 20;
constexpr std::size_t kMaxPointName = 60;

std::string in_mm(const std::optional<ErrorStatistics>& errors, double ErrorStatistics::*of) {
  return errors ? fmt::format("{:.1f}", 1e3 * (*errors).*of) : "-";
}

std::string padded_to(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, length_of(text)), ' ');
}

std::string text_row(const SweepResults& results, const SweepRow& row, std::size_t points,
                     std::size_t names) {
  const std::string point = shortened(results.plan.points[row.point].name, kMaxPointName);
  std::string text = fmt::format("  {}  {} {:>6} {:>9} {:>8}", padded_to(point, points),
                                 padded_to(shortened(row.name, kMaxPointName), names), row.runs,
                                 fmt::format("{}/{}", row.located, row.tags),
                                 in_mm(row.error_m, &ErrorStatistics::mean));
  text += fmt::format(
      " {:>7} {:>8} {:>8} {:>8}\n",
      row.mean_standard_error_m ? fmt::format("{:.1f}", 1e3 * *row.mean_standard_error_m) : "-",
      in_mm(row.error_m, &ErrorStatistics::median), in_mm(row.error_m, &ErrorStatistics::p95),
      in_mm(row.error_m, &ErrorStatistics::max));
  return text;
}

}  // namespace

std::vector<const SweepRow*> best_first(const SweepResults& results) {
  const auto& adaptive =
      results.plan.suite.sweep ? results.plan.suite.sweep->adaptive : std::optional<Halving>{};
  const SweepTarget target = adaptive ? adaptive->target : SweepTarget::kMean;
  std::vector<std::tuple<bool, std::size_t, double, const SweepRow*>> order;
  for (const SweepRow& row : results.rows) {
    const bool other = adaptive && row.name != adaptive->method;
    order.emplace_back(other, results.rungs - rung_of(results, row.point),
                       target_value(row, target), &row);
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return std::tie(std::get<0>(a), std::get<1>(a), std::get<2>(a)) <
           std::tie(std::get<0>(b), std::get<1>(b), std::get<2>(b));
  });
  std::vector<const SweepRow*> rows;
  rows.reserve(order.size());
  for (const auto& entry : order) rows.push_back(std::get<3>(entry));
  return rows;
}

std::string sweep_to_text(const SweepResults& results) {
  const std::vector<const SweepRow*> rows = best_first(results);
  const std::size_t shown = std::min(rows.size(), kMaxTextRows);
  std::size_t points = 5;
  std::size_t names = 6;
  for (std::size_t i = 0; i < shown; ++i) {
    const std::string& point = results.plan.points[rows[i]->point].name;
    points = std::max(points, length_of(shortened(point, kMaxPointName)));
    names = std::max(names, length_of(shortened(rows[i]->name, kMaxPointName)));
  }
  std::string text = fmt::format("{}: {}, {} (errors in mm)\n", clean_text(results.plan.suite.name),
                                 counted(results.plan.points.size(), "point"),
                                 counted(results.planned - results.missing, "run"));
  text +=
      fmt::format("  {:<{}}  {:<{}} {:>6} {:>9} {:>8} {:>7} {:>8} {:>8} {:>8}\n", "point", points,
                  "method", names, "runs", "located", "mean", "±", "median", "p95", "max");
  for (std::size_t i = 0; i < shown; ++i) text += text_row(results, *rows[i], points, names);
  if (shown < rows.size()) {
    text += fmt::format("  the best {} of {} rows; points.csv has all\n", shown, rows.size());
  }
  return text;
}

}  // namespace tagfield
